"""Which designs' bodies have the same faces."""

from __future__ import annotations

from collections import Counter
from typing import Any

import numpy as np
import pytest
from random_designs import RANGES

from bellows_design.design.design import Design
from bellows_design.design.shipped import load_design
from bellows_design.design.topology import same_topology
from bellows_design.design.variation import geometric_parameters, kinked, varied
from bellows_design.errors import BellowsError, DesignError
from bellows_design.geometry.actuator import unit_cell

GROOVE = {"side": "outside", "shape": "rectangular", "depth": 0.5, "width": 3.0, "fillet": 0.3}
INSIDE = {"side": "inside", "shape": "rectangular", "depth": 0.7, "width": 1.7, "fillet": 0.3}


def design(indent: dict[str, Any] | None = None, **bellows: Any) -> Design:
    table = load_design("prototype_1").model_dump() | {"indent": indent}
    table["bellows"] |= bellows
    return Design.of(table)


@pytest.mark.parametrize(
    ("own", "other", "reason"),
    [
        (design(), design(bubble_thickness=1.2), "bubbles: 8 instead of 7"),
        (design(), design(GROOVE), "indent: outside rectangular instead of none"),
        (design(GROOVE), design(INSIDE), "indent: inside rectangular instead of outside"),
        (design(), design(inner_fillet=0.0), "the chamber's fillet: 0 mm"),
        (design(outer_fillet=0.0), design(), "the bubble's fillet: 1.5 mm"),
        (design(), design(inner_fillet=1.0), "flat between the chamber's fillets along x"),
        (design(), design(outer_fillet=2.5), "flat between the bubble's fillets along x"),
        (design(GROOVE), design({**GROOVE, "fillet": 0.5}), "flat of the indent's side"),
        (design(GROOVE), design({**GROOVE, "fillet": 0.0}), "the indent's fillet"),
        (design(GROOVE), design({**GROOVE, "width": 1.8}), "the indent inside of the bubble's"),
        (design(tendon_thickness=1.8), design(tendon_thickness=1.4), "the channel's floor"),
        (design(tendon_thickness=1.8), design(), "the channel's floor above the chamber's"),
        (design(), design(tendon_width=20.0), "the tendon's side inside of the bubble's"),
        (design(), design(length=49.0), "the tip beyond the last bubble"),
    ],
)
def test_faces_that_appear_or_vanish_are_named(own: Design, other: Design, reason: str) -> None:
    assert reason in same_topology(own, other)


def test_a_cell_has_no_ends() -> None:
    assert same_topology(design(), design(length=49.0), "unit-cell") == ""


def test_fingertips_tell_bodies_with_ends_apart_but_no_cells() -> None:
    pad = {"length": 8.0, "width": 14.0, "thickness": 3.0, "ribs": 3}
    own = Design.of(design(length=50.5).model_dump() | {"fingertip": pad})
    longer, slim, smooth, none = (
        Design.of(own.model_dump() | {"fingertip": each})
        for each in (pad | {"length": 9.0}, pad | {"width": 5.0}, pad | {"ribs": 0}, None)
    )
    assert same_topology(own, longer) == ""
    assert "the fingertip's side outside of the tendon's" in same_topology(own, slim)
    assert same_topology(own, smooth) == "ribs of the fingertip: 0 instead of 3"
    assert same_topology(own, none) == "ribs of the fingertip: no fingertip instead of 3"
    assert {same_topology(own, each, "unit-cell") for each in (slim, smooth, none)} == {""}


def test_a_design_is_its_own_neighbour() -> None:
    for indent in (None, GROOVE, INSIDE):
        assert same_topology(design(indent), design(indent)) == ""


def test_floors_that_are_level_may_part_where_fillets_smooth_the_step() -> None:
    assert same_topology(design(), design(tendon_thickness=1.45)) == ""
    assert same_topology(design(), design(tendon_thickness=1.55)) == ""
    sharp = {"inner_fillet": 0.0}
    assert same_topology(design(**sharp), design(**sharp, tendon_thickness=1.45)) != ""
    assert same_topology(design(INSIDE), design(INSIDE, tendon_thickness=1.45)) != ""


def drawn(generator: np.random.Generator) -> Design:
    """A random design of two bubbles, often one that sits on a border between topologies."""
    while True:
        numbers = {name: round(generator.uniform(*span), 2) for name, span in RANGES.items()}
        for chance in (
            {"inner_fillet": numbers["chamber_length"] / 2},
            {"outer_fillet": numbers["chamber_length"] / 2 + numbers["bubble_thickness"]},
            {"inner_fillet": 0.0},
            {"outer_fillet": 0.0},
        ):
            numbers |= chance if generator.random() < 0.15 else {}
        indent = [None, {"depth": 0.4, "width": 2.4}, GROOVE, INSIDE][generator.integers(4)]
        try:
            return design(indent, **numbers, length=30.0, offset=4.0, number_of_bubbles=2)
        except DesignError:
            continue


def beside(own: Design, generator: np.random.Generator) -> Design | None:
    """The design with four parameters changed by up to 10 %; None if that is no design."""
    values = geometric_parameters(own)
    chosen = generator.choice(list(values), 4, replace=False)
    try:
        return varied(own, {name: values[name] * generator.uniform(0.9, 1.1) for name in chosen})
    except DesignError:
        return None


def faces(own: Design) -> Counter[tuple[str, str]]:
    """How many faces of each name and kind the CAD solid has."""
    solid = unit_cell(own.bellows, own.indent)
    kinds = (face.geomType() for face in solid.solid.Faces())
    return Counter(zip(solid.face_names, kinds, strict=True))


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(12))
def test_neighbours_have_as_many_cad_faces_of_every_kind(seed: int) -> None:
    generator = np.random.default_rng(seed)
    compared = 0
    while compared < 4:
        own = drawn(generator)
        other = None if kinked(own) else beside(own, generator)
        if other is None or same_topology(own, other, "unit-cell"):
            continue
        try:
            here, there = faces(own), faces(other)
        except BellowsError:  # the CAD kernel's own refusals are no concern of this test
            continue
        assert here == there, (own.to_toml(), other.to_toml())
        compared += 1
