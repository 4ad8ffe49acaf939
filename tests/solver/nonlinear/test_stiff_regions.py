"""Newton's method where one region is stiffer than another by powers of ten."""

from __future__ import annotations

import pytest
from film_strip import bent


@pytest.mark.parametrize("ratio", [1e2, 1e5])
def test_a_stiff_film_takes_no_more_than_twice_the_iterations(ratio: float) -> None:
    """Without the stress extrapolated it is five times as many at 1e5: 34 instead of 7."""
    plain, stiff = bent(1.0), bent(ratio)
    assert stiff.converged
    assert stiff.newton_iterations <= 2 * plain.newton_iterations
    assert stiff.refused_steps == 0
