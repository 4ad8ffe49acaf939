"""Goals, fronts, the air passage, and the files of an optimum."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from power_law import answered
from scipy.integrate import trapezoid

from bellows_design.design.design import Design
from bellows_design.design.overrides import with_overrides
from bellows_design.design.shipped import load_design
from bellows_design.errors import DesignError
from bellows_design.study.optimize.designs import as_design
from bellows_design.study.optimize.front import front
from bellows_design.study.optimize.goal import Goal
from bellows_design.study.optimize.point import Point, Request, material_volume
from bellows_design.study.optimize.space.choices import Choice
from bellows_design.study.optimize.space.passage import VISCOSITY_PA_S, filling_seconds
from bellows_design.study.optimize.space.variables import Variables

FINGER = load_design("finger")
GOAL = Goal("angle", 4.0)
VARIABLES = Variables(FINGER, Choice(9, 3, 3, 4))
REQUEST = Request(VARIABLES, VARIABLES.rounded(VARIABLES.values(FINGER)), "ordinary")
POINT = REQUEST.point(answered(REQUEST.question), GOAL)


def at(angle: float, stress: float, origin: str = "ordinary") -> Point:
    answer = replace(POINT.answer, origin=origin)
    return replace(POINT, answer=answer, values={**POINT.values, "angle": angle, "stress": stress})


@given(st.lists(st.tuples(st.floats(10, 600), st.floats(1, 6)), min_size=1, max_size=30))
def test_no_design_beats_one_of_the_front_and_every_other_is_beaten(pairs):
    points = [at(*pair) for pair in pairs]
    found = front(points, GOAL)
    for point in points:
        better = [
            other
            for other in points
            if other.values["angle"] >= point.values["angle"]
            and other.values["stress"] <= point.values["stress"]
            and (other.values["angle"], other.values["stress"])
            != (point.values["angle"], point.values["stress"])
        ]
        same = [
            each
            for each in found
            if (each.values["angle"], each.values["stress"])
            == (point.values["angle"], point.values["stress"])
        ]
        assert len(same) == (0 if better else 1)


def test_neighbours_are_not_on_the_front():
    assert front([at(400, 3.0), at(500, 2.9, "neighbour")], GOAL) == (at(400, 3.0),)


def test_designs_that_touch_or_are_strained_too_much_are_not_on_the_front():
    touching = replace(at(500, 2.9), values=at(500, 2.9).values | {"gap": -0.5})
    strained = replace(at(500, 2.9), values=at(500, 2.9).values | {"strain": 0.6})
    goal = replace(GOAL, most_strain=0.5)
    assert front([at(400, 3.0), touching, strained], goal) == (at(400, 3.0),)


def test_a_stress_counts_with_its_margin():
    assert GOAL.kept({"angle": 400, "stress": 3.999 / 1.02})
    assert not GOAL.kept({"angle": 400, "stress": 3.99})


@given(st.floats(3.93, 8.0), st.floats(1.001, 2.0))
def test_breaking_a_limit_never_pays(stress, more):
    """A tenth more stress brings at most about a tenth more angle."""
    values = {"angle": 400.0, "stress": stress}
    beyond = {"angle": 400.0 * more**1.5, "stress": stress * more}
    assert GOAL.merit(beyond) > GOAL.merit(values)


def test_a_least_quantity_needs_an_angle():
    with pytest.raises(DesignError, match="--angle, in degrees"):
        Goal("stress", 4.0)


@pytest.mark.parametrize("wrong", [0.0, -1.0, math.nan, math.inf])
def test_limits_must_be_positive(wrong):
    with pytest.raises(DesignError, match="stress limit"):
        Goal("angle", wrong)


def test_a_narrow_channel_fills_as_laminar_flow_of_a_gas_says():
    """Laminar, isothermal: p dp/dx constant, so dm/dt = A D^2 (ps^2 - p^2) / (64 mu L R T)."""
    design = with_overrides(
        FINGER, ["tendon_width=3.7", "tendon_height=3.7", "length=1000", "load.pressure=0.01",
                 "number_of_bubbles=8"]
    )  # fmt: skip
    p = design.bellows
    side, length = 1e-3 * p.channel_width, 1e-3 * p.length
    atmosphere, volume = 101_325.0, 1e4
    supply = atmosphere + 1e4
    pressures = np.linspace(atmosphere, atmosphere + 0.95e4, 2000)
    flow_rt = side**2 * side**2 * (supply**2 - pressures**2) / (64 * VISCOSITY_PA_S * length)
    expected = 1e-9 * volume * trapezoid(1 / flow_rt, pressures)
    assert filling_seconds(design, volume) == pytest.approx(expected, rel=0.1)


def test_a_narrower_channel_and_more_air_take_longer():
    narrow = with_overrides(FINGER, ["tendon_width=4.2"])
    assert filling_seconds(narrow, 1e4) > filling_seconds(FINGER, 1e4)
    assert filling_seconds(FINGER, 2e4) == pytest.approx(2 * filling_seconds(FINGER, 1e4))
    assert 1e-3 < filling_seconds(FINGER, 1e4) < 1.0


def test_a_design_of_the_front_is_read_from_its_file_as_it_is():
    design = as_design("finger-best", POINT)
    assert Design.from_toml(design.to_toml()) == design
    assert design.digest == POINT.design.digest


@pytest.mark.slow
def test_material_changes_as_that_of_the_printed_part():
    """Fillets and port, which are left out, hardly depend on these lengths."""
    from bellows_design.geometry.actuator import printed_part

    def printed(design):
        solid = printed_part(design.bellows, design.indent, design.port).solid
        return float(solid.Volume())

    for change in ("bubble_width=18", "bubble_height=18", "tendon_height=7", "tendon_width=7"):
        other = with_overrides(FINGER, [change])
        expected = printed(other) - printed(FINGER)
        change = material_volume(other) - material_volume(FINGER)
        assert change == pytest.approx(expected, abs=0.01 * printed(FINGER))
    assert material_volume(FINGER) == pytest.approx(printed(FINGER), rel=0.12)
