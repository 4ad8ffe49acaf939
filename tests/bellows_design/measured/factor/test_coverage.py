"""The interval of a factor holds the factor that a measurement was made with.

``tests/benchmarks/factor_coverage.py`` does the same a thousand times.
"""

from __future__ import annotations

import numpy as np
import pytest
from synthetic_curves import made_up, model

from bellows_design.measured.factor.fit import fit_factor

CASES, LEAST = 100, 95
FAMILIES = {"by themselves": 0.0, "correlated": 0.15}
"""Length over which the scatter of 2 % is correlated, by the range of pressures."""


@pytest.mark.parametrize("correlation", FAMILIES.values(), ids=FAMILIES)
def test_the_factor_lies_within_its_interval_in_95_of_100_cases(correlation: float) -> None:
    """Seeds are fixed, so that this is no matter of chance; the benchmark has the true share."""
    found = model()
    hits = 0
    for seed in range(CASES):
        rng = np.random.default_rng(seed)
        factor = float(np.exp(rng.uniform(np.log(0.6), np.log(1.7))))
        fitted = fit_factor(made_up(rng, factor, 12, correlation=correlation), found).factor
        assert fitted is not None
        hits += fitted.low <= factor <= fitted.high
        assert fitted.high < 1.25 * fitted.low  # and says something
    assert hits >= LEAST
