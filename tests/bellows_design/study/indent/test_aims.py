"""What indents are searched for."""

from __future__ import annotations

from typing import Literal

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bellows_design.design.indent import Indent
from bellows_design.design.overrides import with_overrides
from bellows_design.design.shipped import load_design
from bellows_design.study.changes import Changes
from bellows_design.study.indent.aims import (
    LEAST_STRESS,
    Aim,
    as_in_the_paper,
    deepest_printed,
    like,
    of_whole_layers,
)
from bellows_design.study.indent.kinds import SHALLOWEST

PLAIN = load_design("prototype_2")
PLACES = (Changes(5.0, 3.0), Changes(-1.5, -2.0), Changes(14.0, -9.0))


def test_the_paper_reports_a_larger_angle_at_less_stress() -> None:
    reported = as_in_the_paper()
    assert reported.bending_angle_percent == pytest.approx(11.9, abs=0.05)
    assert reported.max_von_mises_percent == pytest.approx(-6.5, abs=0.05)


@pytest.mark.parametrize("aim", [like(as_in_the_paper()), LEAST_STRESS], ids=lambda aim: aim.name)
@pytest.mark.parametrize("at", PLACES)
def test_slopes_are_those_of_the_value(aim: Aim, at: Changes) -> None:
    step = 1e-6
    angle, stress = at.bending_angle_percent, at.max_von_mises_percent
    by_angle = aim.value(Changes(angle + step, stress)) - aim.value(Changes(angle - step, stress))
    by_stress = aim.value(Changes(angle, stress + step)) - aim.value(Changes(angle, stress - step))
    expected = (by_angle / (2 * step), by_stress / (2 * step))
    assert aim.slope(at) == pytest.approx(expected, rel=1e-5, abs=1e-6)


def test_an_aim_is_reached_at_its_target_alone() -> None:
    target = as_in_the_paper()
    assert like(target).value(target) == 0 < like(target).value(PLACES[0])


def test_no_loss_of_angle_is_worth_its_stress() -> None:
    assert LEAST_STRESS.value(Changes(0.0, -1.0)) < LEAST_STRESS.value(Changes(-1.0, -9.0))


@pytest.mark.parametrize("depth", [0.12, 0.33, 0.79])
@pytest.mark.parametrize("side", ["outside", "inside"])
def test_printed_depths_are_whole_layers_and_leave_enough_of_them(depth: float, side: str) -> None:
    design = load_design("prototype_2")
    printer = design.profile()
    raw = Indent.model_validate(
        {"side": side, "shape": "rectangular", "depth": depth, "width": 1.2, "fillet": 0.1}
    )
    found = of_whole_layers(design, raw)
    assert found is not None
    layers = found.depth / printer.layer_height
    assert layers == pytest.approx(round(layers))
    left = found.remaining_wall(design.bellows)
    assert left >= printer.minimum_solid_layers * printer.layer_height - 1e-9
    assert found.depth <= deepest_printed(design, side == "outside") + 1e-9


@pytest.mark.parametrize("wall", [1.28, 1.35, 1.49, 1.51])
def test_walls_of_no_whole_number_of_layers_keep_enough_of_them(wall: float) -> None:
    design = with_overrides(load_design("prototype_2"), [f"bubble_thickness={wall}"])
    found = of_whole_layers(design, Indent(shape="rectangular", depth=0.5, width=1.2))
    assert found is not None
    assert found.remaining_wall(design.bellows) >= design.profile().minimum_floor - 1e-9


@settings(deadline=None)  # other work on the machine is no fault
@given(
    st.sampled_from(("prusa_i3", "nozzle_0_6")),
    st.sampled_from(("arc", "rectangular")),
    st.floats(0.05, 0.8),
    st.floats(0.2, 2.4),
)
def test_whole_layers_are_an_indent_that_leaves_enough_of_them_or_there_is_none(
    printer: str, shape: Literal["arc", "rectangular"], depth: float, width: float
) -> None:
    design = PLAIN.model_copy(update={"printer": printer})
    profile = design.profile()
    raw = Indent(shape=shape, depth=min(depth, width / 2), width=width)
    found = of_whole_layers(design, raw)
    most = min(deepest_printed(design, True), width / 2 if shape == "arc" else 5.0)
    if found is None:
        assert most < max(profile.layer_height, SHALLOWEST) + 1e-9
        return
    layers = found.depth / profile.layer_height
    assert layers == pytest.approx(round(layers)) and found.depth <= most + 1e-9


def test_where_no_layer_may_be_left_out_there_is_no_indent() -> None:
    thin = with_overrides(load_design("prototype_2"), ["bubble_thickness=0.85", "outer_fillet=1"])
    assert of_whole_layers(thin, Indent(depth=0.1, width=1.2)) is None
