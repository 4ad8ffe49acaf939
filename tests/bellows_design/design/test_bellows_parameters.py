"""The twelve numbers: how many bubbles they make, and what they are refused for."""

from __future__ import annotations

from typing import Any

import pytest
from pydantic import ValidationError

from bellows_design.design.bellows_parameters import BellowsParameters, corner_thickness
from bellows_design.design.indent import Indent
from bellows_design.design.lengths import FULL_ROUND_SNAP, snapped_radius
from bellows_design.design.port import Port
from bellows_design.design.shipped import load_design
from bellows_design.study.paper import TABLE_4, Result

PROTOTYPE_1 = load_design("prototype_1").bellows
PROTOTYPE_2 = load_design("prototype_2").bellows

BUBBLES = {
    "bubble thickness 1.2": 8,
    "chamber length 1.2": 8,
    "bubble distance 1": 8,  # 45 mm hold 7.5 pitches; the paper's angle lies between 7 and 8
    "Prototype 2": 9,
    "Prototype 2 with indent": 9,
}
"""Bubbles the paper's angles imply, where they are not Prototype 1's seven."""


def changed(bellows: BellowsParameters, **changes: Any) -> BellowsParameters:
    return BellowsParameters(**{**bellows.model_dump(), **changes})


def sentence_of(error: pytest.ExceptionInfo[ValidationError]) -> str:
    """The one problem that was found."""
    (detail,) = error.value.errors()
    message: str = detail["msg"]
    assert "\n" not in message
    return message.removeprefix("Value error, ")


@pytest.mark.parametrize("result", TABLE_4, ids=lambda result: result.label)
def test_bubbles_are_as_many_as_the_papers_angles_imply(result: Result) -> None:
    assert result.build().bellows.bubble_count == BUBBLES.get(result.label, 7)


def test_a_given_number_of_bubbles_is_kept() -> None:
    assert changed(PROTOTYPE_1, number_of_bubbles=3).bubble_count == 3


@pytest.mark.parametrize("length", [12.0, 17.3, 24.9, 50.0, 111.0])
@pytest.mark.parametrize("offset", [1.5, 1.9, 5.0, 7.7])
def test_the_train_of_bubbles_lies_between_root_wall_and_tip(length: float, offset: float) -> None:
    bellows = changed(PROTOTYPE_1, length=length, offset=offset)
    half = bellows.bubble_length / 2
    middles = bellows.bubble_middles
    assert len(middles) == bellows.bubble_count
    assert middles[0] - half >= bellows.tendon_thickness - 1e-9
    assert middles[-1] + half <= length + 1e-9


def test_bubbles_begin_at_the_offset_where_they_fit_and_before_it_where_not() -> None:
    assert PROTOTYPE_2.root_length == pytest.approx(5)  # 9 x 5 - 1.2 = 43.8 mm fit into 45
    assert PROTOTYPE_1.root_length == pytest.approx(5)  # 7 x 6.5 - 1.5 = 44 mm
    assert changed(PROTOTYPE_1, offset=8, number_of_bubbles=7).root_length == pytest.approx(6)


def test_derived_lengths_of_prototype_1() -> None:
    assert PROTOTYPE_1.bubble_length == pytest.approx(5)
    assert PROTOTYPE_1.pitch == pytest.approx(6.5)
    assert PROTOTYPE_1.chamber_size == pytest.approx((2, 17, 17))
    assert (PROTOTYPE_1.channel_width, PROTOTYPE_1.channel_height) == pytest.approx((9, 2))


def test_both_fillets_of_prototype_2_are_exact_full_rounds() -> None:
    assert PROTOTYPE_2.chamber_fillet == PROTOTYPE_2.chamber_size[0] / 2
    assert PROTOTYPE_2.bubble_fillet == PROTOTYPE_2.bubble_size[0] / 2


def test_a_strip_too_narrow_to_print_is_rounded_away() -> None:
    assert snapped_radius(0.96, 1.0) == 1.0
    assert snapped_radius(1 - 1.01 * FULL_ROUND_SNAP, 1.0) == 1 - 1.01 * FULL_ROUND_SNAP
    assert changed(PROTOTYPE_1, inner_fillet=0.96).chamber_fillet == 1.0


def test_the_channel_takes_the_inner_fillet_as_far_as_it_fits() -> None:
    assert PROTOTYPE_1.channel_fillet == 0.5
    low = changed(PROTOTYPE_1, tendon_height=3.6)  # a channel 0.6 mm high
    assert low.channel_fillet == pytest.approx(0.3)


def test_the_corner_wall_is_the_distance_of_two_spheres_along_the_diagonal() -> None:
    outer, inner, wall = 3.0, 0.5, 1.2
    centres_apart = 3**0.5 * (outer - wall - inner)
    assert corner_thickness(outer, inner, wall) == pytest.approx(outer - inner - centres_apart)
    assert corner_thickness(inner + wall, inner, wall) == pytest.approx(wall)  # concentric
    assert corner_thickness(0.0, inner, wall) == wall  # a sharp corner is thicker elsewhere


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"bubble_thickness": 9.9}, "leaves 0.2 mm of bubble_width = 20 mm hollow"),
        ({"bubble_height": 5, "bubble_thickness": 2.4}, "of bubble_height = 5 mm hollow"),
        ({"tendon_width": 3.2}, "an air channel of 0.2 mm in tendon_width = 3.2 mm"),
        ({"tendon_height": 2}, "an air channel of -1 mm in tendon_height = 2 mm"),
        ({"tendon_width": 21}, "tendon_width = 21 mm must not exceed bubble_width = 20 mm"),
        ({"tendon_width": 20, "tendon_thickness": 1}, "wider than the chamber of 17 mm"),
        ({"tendon_height": 19}, "must not exceed 18.5 mm, the top of the chamber"),
        ({"bubble_thickness": 4, "inner_fillet": 0}, "an opening of -0.5 mm into the chamber"),
        ({"inner_fillet": 0.04}, "inner_fillet = 0.04 mm is no radius a printer resolves"),
        ({"outer_fillet": 0.01}, "outer_fillet = 0.01 mm is no radius a printer resolves"),
        ({"inner_fillet": 1.1}, "inner_fillet = 1.1 mm exceeds 1 mm, half of the chamber's length"),
        (
            {"outer_fillet": 2.6},
            "2.5 mm, half of the bubble's length; set outer_fillet=2.5 or less",
        ),
        ({"bubble_thickness": 1.2, "inner_fillet": 0, "outer_fillet": 2.2}, "the bubble's corners"),
        ({"length": 10, "offset": 8}, "length = 10 mm leaves no room for a bubble of 5 mm"),
        ({"number_of_bubbles": 8}, "number_of_bubbles = 8 makes a train of 50.5 mm"),
    ],
)
def test_a_bellows_that_cannot_be_is_refused_in_one_sentence(
    changes: dict[str, float], words: str
) -> None:
    with pytest.raises(ValidationError) as error:
        changed(PROTOTYPE_1, **changes)
    assert words in sentence_of(error)


@pytest.mark.parametrize(
    ("fields", "words"),
    [
        ({"side": "inside", "depth": 0.3, "width": 1.0}, "'arc' is for the outside"),
        ({"depth": 0.3, "width": 1.0, "fillet": 0.1}, "an arc has no corners"),
        ({"depth": 0.6, "width": 1.0}, "exceeds half of indent.width = 1 mm, the deepest arc"),
        (
            {"shape": "rectangular", "depth": 0.3, "width": 1.0, "fillet": 0.4},
            "exceeds 0.3 mm, the lesser of its depth and half of its width",
        ),
        (
            {"shape": "rectangular", "side": "inside", "depth": 0.9, "width": 1.0, "fillet": 0.6},
            "indent.fillet = 0.6 mm exceeds 0.5 mm, half of its width",
        ),
    ],
)
def test_an_indent_without_a_profile_is_refused_in_one_sentence(
    fields: dict[str, Any], words: str
) -> None:
    with pytest.raises(ValidationError) as error:
        Indent(**fields)
    assert words in sentence_of(error)


@pytest.mark.parametrize(
    ("fields", "words"),
    [
        ({"depth": 1.2, "width": 3.0}, "indent.depth = 1.2 mm leaves 0.3 mm of the bottom wall"),
        ({"depth": 0.5, "width": 5.1}, "exceeds 5 mm, the length of the bubble"),
        (
            {"side": "inside", "shape": "rectangular", "depth": 0.5, "width": 2.1},
            "exceeds 2 mm, the length of the chamber",
        ),
    ],
)
def test_an_indent_must_fit_under_the_chamber(fields: dict[str, Any], words: str) -> None:
    with pytest.raises(ValueError, match=r"^indent\.\w+ = ") as error:
        Indent(**fields).check_fits(PROTOTYPE_1)
    assert words in str(error.value)


def test_an_outside_indent_weakens_the_thinner_of_the_two_bottom_walls() -> None:
    thin_tendon = changed(PROTOTYPE_1, tendon_thickness=1.2)
    outside = Indent(depth=0.5, width=2.0)
    inside = Indent(side="inside", shape="rectangular", depth=0.5, width=2.0)
    assert outside.remaining_wall(thin_tendon) == pytest.approx(0.7)
    assert inside.remaining_wall(thin_tendon) == pytest.approx(1.0)


@pytest.mark.parametrize("diameter", [2.0, 4.0, 6.0])
def test_the_hole_of_the_port_lies_within_socket_and_channel(diameter: float) -> None:
    port = Port(tube_diameter=diameter)
    for bellows in (PROTOTYPE_1, PROTOTYPE_2):
        port.check_fits(bellows)
        radius, height = port.hole_radius(bellows), port.hole_height(bellows)
        floor = bellows.tendon_thickness
        assert floor <= height - radius < height + radius <= floor + bellows.channel_height
        assert abs(height - port.axis_height) + radius < diameter / 2


def test_a_port_that_misses_the_channel_is_refused_in_one_sentence() -> None:
    high = changed(PROTOTYPE_1, tendon_height=15, tendon_thickness=4.9, inner_fillet=0)
    with pytest.raises(ValueError, match=r"^port\.tube_diameter = 1 mm: the socket's axis"):
        Port(tube_diameter=1).check_fits(high)


@pytest.mark.parametrize(
    "changes",
    [
        {"bubble_width": 6, "tendon_width": 5.5, "chamber_length": 3},  # rounded past its floor
        {"bubble_width": 8, "tendon_width": 7, "chamber_length": 3, "inner_fillet": 1.5},
    ],
)
def test_an_inside_indent_needs_room_across_the_floor(changes: dict[str, float]) -> None:
    bellows = changed(PROTOTYPE_1, length=25, **changes)
    indent = Indent(side="inside", shape="rectangular", depth=0.5, width=3.0, fillet=1.5)
    with pytest.raises(ValueError, match=r"^indent\.fillet = 1\.5 mm"):
        indent.check_fits(bellows)


def test_a_fillet_of_an_indent_too_small_to_print_is_refused() -> None:
    with pytest.raises(ValidationError) as error:
        Indent(shape="rectangular", depth=0.4, width=2.4, fillet=0.01)
    assert "indent.fillet = 0.01 mm" in sentence_of(error)


def test_an_offset_shorter_than_the_wall_at_the_root_is_named_as_the_reason() -> None:
    with pytest.raises(ValidationError) as error:
        changed(PROTOTYPE_1, offset=1.0)
    assert sentence_of(error).startswith("offset = 1 mm")
