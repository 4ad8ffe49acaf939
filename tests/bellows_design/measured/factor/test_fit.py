"""The factor: exact without scatter, honest with it, refused where nothing determines it."""

from __future__ import annotations

import math

import numpy as np
import pytest
from synthetic_curves import HIGHEST, bend, made_up, measured, model

from bellows_design.measured.factor.fit import fit_factor
from bellows_design.measured.model.curve import Zeroed
from bellows_design.measured.quantities import ANGLE

PRESSURE = HIGHEST * np.arange(1, 21) / 20


@pytest.mark.parametrize("by_force", [False, True], ids=["angle", "force"])
@pytest.mark.parametrize("factor", [0.55, 1.0, 2.2])
def test_a_curve_without_scatter_gives_its_factor_back(factor: float, by_force: bool) -> None:
    rng = np.random.default_rng(0)
    found = fit_factor(
        made_up(rng, factor, scatter=1e-5, by_force=by_force), model(by_force=by_force)
    )
    assert found.factor is not None and found.used.all()
    assert found.factor.value == pytest.approx(factor, rel=1e-4)
    assert found.factor.scatter[1] / found.factor.scatter[0] < 1.001
    assert found.factor.high / found.factor.low < 1.01  # of the model's cubics
    assert found.factor.agrees == (factor == 1.0)


def test_an_offset_is_found_only_if_it_is_asked_for() -> None:
    rng = np.random.default_rng(3)
    moved = made_up(rng, 1.3, scatter=0.003)
    moved = measured(moved.value + 20, moved.pressure)
    plain, asked = fit_factor(moved, model()).factor, fit_factor(moved, model(), True).factor
    assert plain is not None and asked is not None
    assert plain.offset is None and asked.offset == pytest.approx(20, abs=0.5)
    assert asked.low <= 1.3 <= asked.high and asked.difference[1] < 0.2 * plain.difference[1]
    assert asked.high / asked.low < plain.high / plain.low


def test_the_models_error_widens_the_interval_by_what_it_makes_of_the_factor() -> None:
    """Angles too large by e are those of a factor that is smaller by e times f / |∂f/∂log s|."""
    part = made_up(np.random.default_rng(1), 1.2, scatter=1e-4)
    exact, rough = fit_factor(part, model()).factor, fit_factor(part, model(error=0.05)).factor
    assert exact is not None and rough is not None
    assert exact.model_percent < 0.05 and exact.value == pytest.approx(rough.value, rel=1e-6)
    softer = fit_factor(measured(1.05 * part.value, part.pressure), model()).factor
    assert softer is not None
    assert rough.model_percent / 100 == pytest.approx(math.log(exact.value / softer.value), rel=0.1)
    half = math.log(rough.high / rough.low) / 2
    assert half == pytest.approx(rough.model_percent / 100, rel=0.05)


def test_points_of_large_spread_count_less() -> None:
    rng = np.random.default_rng(5)
    part = made_up(rng, 1.2, scatter=0.002)
    wild = part.value.copy()
    wild[-4:] *= 1.5
    spread = np.where(np.arange(20) < 16, 0.002 * part.value, 60.0)
    told = fit_factor(measured(wild, PRESSURE, ANGLE, spread), model()).factor
    untold = fit_factor(measured(wild, PRESSURE), model()).factor
    assert told is not None and told.value == pytest.approx(1.2, rel=0.01)
    assert untold is None or untold.high / untold.low > 1.2 * told.high / told.low


def test_points_beyond_the_models_path_are_left_out() -> None:
    part = made_up(np.random.default_rng(2), 0.8, scatter=0.005)
    ended = fit_factor(part, model(0.08, ending="the model's load path ends at 0.08 MPa"))
    whole = fit_factor(part, model())
    assert ended.factor is not None and whole.factor is not None
    # 0.08 MPa of the model are 0.064 MPa of a part 0.8 times as stiff: 12 of 20 points at most.
    assert 8 <= ended.factor.points <= 12
    assert ended.factor.points + ended.factor.beyond == 20
    assert ended.factor.low <= 0.8 <= ended.factor.high
    assert ended.factor.high / ended.factor.low > whole.factor.high / whole.factor.low
    assert ended.wanted > 0.1 / 0.8


def test_a_zero_that_both_are_counted_from_tells_nothing_itself() -> None:
    part = made_up(np.random.default_rng(4), 1.4, scatter=0.004)
    zero = float(PRESSURE[3])
    counted = measured(part.value - part.value[3], PRESSURE)
    found = fit_factor(counted, Zeroed(model(), zero), zero=zero).factor
    assert found is not None and found.low <= 1.4 <= found.high


@pytest.mark.parametrize(
    ("value", "said"),
    [
        (np.random.default_rng(0).normal(size=20), "does not determine the stiffness"),
        (np.full(20, 1e-9), "does not determine the stiffness"),
        (1000 * bend(PRESSURE), "the model reaches too few|does not determine"),
    ],
    ids=["noise", "flat", "another unit"],
)
def test_what_determines_nothing_is_refused(value: np.ndarray, said: str) -> None:
    found = fit_factor(measured(value, PRESSURE), model())
    assert found.factor is None
    import re

    assert re.search(said, found.refused) and found.refused.endswith(".")


def test_too_few_points_are_refused_and_the_zero_is_none() -> None:
    few = made_up(np.random.default_rng(0), 1.0, 4)
    assert "4 points to compare, but a factor needs at least 5" in fit_factor(few, model()).refused
    five = made_up(np.random.default_rng(0), 1.0, 5)
    zero = float(five.pressure[0])
    assert fit_factor(five, Zeroed(model(), zero), zero=zero).factor is None
