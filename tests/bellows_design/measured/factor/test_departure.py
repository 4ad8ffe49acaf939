"""Where a measurement does something else than the model with any factor."""

from __future__ import annotations

import numpy as np
import pytest
from synthetic_curves import HIGHEST, bend, made_up, measured, model

from bellows_design.measured.factor.departure import departures
from bellows_design.measured.factor.fit import fit_factor

PRESSURE = HIGHEST * np.arange(1, 31) / 30


@pytest.mark.parametrize("correlation", [0.0, 0.15])
def test_scatter_is_no_departure(correlation: float) -> None:
    found = 0
    for seed in range(40):
        part = made_up(np.random.default_rng(seed), 1.2, correlation=correlation)
        fitted = fit_factor(part, model()).factor
        assert fitted is not None
        found += bool(departures(part, model(), fitted.value))
    assert found <= 2


def test_a_knee_that_the_model_does_not_have_is_found_at_its_pressure() -> None:
    knee = np.where(PRESSURE > 0.07, 60.0, 0.0)
    part = measured(bend(PRESSURE) * (1 + 0.01 * np.sin(97 * PRESSURE)) + knee, PRESSURE)
    places = departures(part, model(), 1.0)
    assert places and places[-1].largest > 30
    assert 0.06 < places[-1].start < 0.08 and places[-1].end == pytest.approx(HIGHEST)


def test_what_the_models_error_covers_is_no_departure() -> None:
    part = measured(1.1 * bend(PRESSURE), PRESSURE)
    assert departures(part, model(), 1.0)
    assert not departures(part, model(error=0.12), 1.0)
    assert not departures(part.at(np.arange(5)), model(), 1.0)  # too few to tell
