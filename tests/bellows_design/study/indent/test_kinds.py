"""The kinds of indent, and the room of each."""

from __future__ import annotations

import itertools

import pytest

from bellows_design.design.overrides import with_overrides
from bellows_design.design.shipped import load_design
from bellows_design.study.indent.kinds import (
    KINDS,
    SHARPEST,
    Kind,
    kind_of,
    spread,
    with_indent,
)

DESIGNS = ("prototype_1", "prototype_2", "finger")


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.name)
@pytest.mark.parametrize("name", DESIGNS)
def test_every_corner_of_the_room_is_an_admissible_design(kind: Kind, name: str) -> None:
    design = load_design(name)
    for place in itertools.product((0.0, 1.0), repeat=3):
        indent = kind.indent(design.bellows, place)
        assert with_indent(design, indent).indent == indent
        assert kind_of(indent) == kind


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.name)
def test_no_outside_corner_is_so_sharp_that_its_stress_would_not_count(kind: Kind) -> None:
    if kind.shape == "rectangular":
        for indent in spread(kind, load_design("prototype_2").bellows, 50):
            assert indent.fillet >= SHARPEST


def test_a_spread_covers_both_halves_of_every_length() -> None:
    bellows = load_design("prototype_2").bellows
    kind = Kind("outside", "rectangular")
    found = list(spread(kind, bellows, 16))
    for name, (least, most) in kind.bounds(bellows).items():
        upper = [getattr(each, name) > (least + most) / 2 for each in found]
        assert len(found) == 16 and 4 <= sum(upper) <= 12


def test_a_wall_without_room_has_no_indents() -> None:
    thin = with_overrides(load_design("prototype_2"), ["bubble_thickness=0.45", "outer_fillet=1"])
    assert list(spread(Kind("outside", "rectangular"), thin.bellows, 4)) == []


def test_leaving_the_indent_out_gives_the_plain_design() -> None:
    shipped = load_design("prototype_2_indent")
    assert with_indent(shipped, None).digest == load_design("prototype_2").digest
