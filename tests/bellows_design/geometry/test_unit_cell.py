"""The solid of the unit cell: a quarter of what repeats."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache
from typing import Any

import pytest

from bellows_design.design.bellows_parameters import BellowsParameters
from bellows_design.design.design import Design
from bellows_design.design.indent import Indent
from bellows_design.design.shipped import load_design, shipped_designs
from bellows_design.geometry.actuator import full_body, unit_cell
from bellows_design.geometry.named_solids import NamedSolid
from bellows_design.study.paper import TABLE_4

NAMES = {"cavity", "outside", "bubble_middle", "gap_middle", "symmetry"}
DESIGNS: dict[str, Callable[[], Design]] = {
    **{name: lambda name=name: load_design(name) for name in shipped_designs()},
    **{result.label: result.build for result in TABLE_4 if result.overrides},
}


def changed(**changes: Any) -> BellowsParameters:
    return BellowsParameters(**{**load_design("prototype_1").bellows.model_dump(), **changes})


SHARP = {"inner_fillet": 0.0, "outer_fillet": 0.0}
SHARP_BELLOWS = {
    "Prototype 1": changed(**SHARP),
    "channel above the chambers' floor": changed(**SHARP, tendon_thickness=1.9),
    "channel below it": changed(**SHARP, tendon_thickness=1.0, bubble_thickness=1.7),
    "tendon as wide as the bubbles": changed(**SHARP, tendon_width=20),
    "tall and narrow": changed(
        **SHARP, bubble_width=7.3, bubble_height=31.1, tendon_width=4.7, offset=2.2
    ),
}
INDENTS = {
    "none": None,
    "arc": Indent(depth=0.4, width=2.4),
    "rectangle": Indent(shape="rectangular", depth=0.5, width=3.0),
    "rounded": Indent(shape="rectangular", depth=0.5, width=3.0, fillet=0.3),
    "as long as the bubble": Indent(shape="rectangular", depth=0.5, width=5.0, fillet=0.5),
    "inside": Indent(side="inside", shape="rectangular", depth=0.7, width=1.6),
    "inside, rounded": Indent(side="inside", shape="rectangular", depth=0.7, width=1.6, fillet=0.3),
}


@cache
def cell(name: str) -> NamedSolid:
    design = DESIGNS[name]()
    return unit_cell(design.bellows, design.indent)


@pytest.mark.parametrize("name", SHARP_BELLOWS)
def test_a_cell_without_fillets_is_made_of_boxes(name: str) -> None:
    b = SHARP_BELLOWS[name]
    solid, (length, width, height) = unit_cell(b, None), b.bubble_size
    shared = b.tendon_height - b.tendon_thickness - max(b.tendon_thickness, b.bubble_thickness)
    tendon, channel = b.tendon_width * b.tendon_height, b.channel_width * b.channel_height
    outer = b.pitch * tendon + length * (width * height - tendon)
    overlap = b.chamber_length * b.channel_width * shared
    inner = math.prod(b.chamber_size) + b.pitch * channel - overlap
    assert 4 * solid.solid.Volume() == pytest.approx(outer - inner, rel=1e-9)
    assert 2 * solid.area("gap_middle") == pytest.approx(tendon - channel, rel=1e-9)
    opening = b.chamber_size[1] * b.chamber_size[2] + channel - b.channel_width * shared
    assert 2 * solid.area("bubble_middle") == pytest.approx(width * height - opening, rel=1e-9)
    beside = b.pitch * (b.tendon_height - b.channel_height)
    above = length * (height - b.tendon_height) - b.chamber_length * (b.chamber_size[2] - shared)
    assert 2 * solid.area("symmetry") == pytest.approx(beside + above, rel=1e-9)


@pytest.mark.parametrize("name", DESIGNS)
def test_every_design_has_a_cell_of_the_named_faces_between_its_planes(name: str) -> None:
    design, solid = DESIGNS[name](), cell(name)
    bounds, end = solid.solid.BoundingBox(), design.bellows.pitch / 2
    assert solid.solid.isValid() and len(solid.solid.Shells()) == 1
    assert set(solid.face_names) == NAMES
    lowest, highest = (bounds.xmin, bounds.ymin, bounds.zmin), (bounds.xmax, bounds.ymax)
    assert lowest == pytest.approx((0, 0, 0), abs=1e-6)
    assert highest == pytest.approx((end, design.bellows.bubble_width / 2), abs=1e-6)
    assert bounds.zmax == pytest.approx(design.bellows.bubble_height, abs=1e-6)
    for plane, axis, place in (
        ("bubble_middle", "x", 0.0),
        ("gap_middle", "x", end),
        ("symmetry", "y", 0.0),
    ):
        for face in solid.faces(plane):
            assert abs(getattr(face.normalAt(), axis)) == pytest.approx(1)
            assert getattr(face.Center(), axis) == pytest.approx(place, abs=1e-9)
    for wall in ("cavity", "outside"):
        assert all(0 < face.Center().x < end and face.Center().y > 0 for face in solid.faces(wall))


@pytest.mark.parametrize("name", DESIGNS)
def test_no_cell_has_slivers(name: str) -> None:
    solid = cell(name).solid
    assert min(edge.Length() for edge in solid.Edges()) > 0.09
    assert min(face.Area() for face in solid.Faces()) > 0.05


@pytest.mark.parametrize(
    ("name", "indent"),
    [
        ("prototype_1", "none"),
        ("prototype_1", "arc"),
        ("prototype_1", "inside, rounded"),
        ("prototype_2_indent", "own"),
        ("finger", "own"),
        ("tendon thickness 1.2", "none"),  # the channel shows below the chamber's floor
    ],
)
@pytest.mark.thorough
def test_four_cells_are_what_one_more_bubble_adds(name: str, indent: str) -> None:
    design = DESIGNS[name]()
    groove = design.indent if indent == "own" else INDENTS[indent]
    one, two = (full_body(of_bubbles(design.bellows, count), groove) for count in (1, 2))
    quarter = unit_cell(design.bellows, groove)
    added = two.solid.Volume() - one.solid.Volume()
    assert 4 * quarter.solid.Volume() == pytest.approx(added, rel=1e-6)
    for wall in ("cavity", "outside"):
        assert 4 * quarter.area(wall) == pytest.approx(two.area(wall) - one.area(wall), rel=1e-6)


def of_bubbles(bellows: BellowsParameters, count: int) -> BellowsParameters:
    """The same root and tip with so many bubbles between them."""
    length = 12 + bellows.bubble_length + (count - 1) * bellows.pitch
    numbers = {**bellows.model_dump(), "number_of_bubbles": count, "length": length}
    return BellowsParameters(**numbers)


@pytest.mark.parametrize("name", [name for name in INDENTS if name != "none"])
def test_an_indent_takes_from_a_cell_a_quarter_of_what_it_takes_from_a_bubble(name: str) -> None:
    bellows, indent = changed(**SHARP, length=12, number_of_bubbles=1), INDENTS[name]
    taken = unit_cell(bellows, None).solid.Volume() - unit_cell(bellows, indent).solid.Volume()
    whole = full_body(bellows, None).solid.Volume() - full_body(bellows, indent).solid.Volume()
    assert taken > 0.1
    assert 4 * taken == pytest.approx(whole, rel=1e-6)
    assert set(unit_cell(bellows, indent).face_names) == NAMES


@pytest.mark.parametrize("indent", [Indent(depth=1.2, width=2.4), Indent(depth=0.5, width=5.2)])
def test_an_indent_that_does_not_fit_is_refused(indent: Indent) -> None:
    with pytest.raises(ValueError, match=r"indent\.(depth|width)"):
        unit_cell(changed(), indent)
