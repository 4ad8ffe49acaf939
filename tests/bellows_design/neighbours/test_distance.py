"""How far designs are apart."""

from __future__ import annotations

import math

import pytest

from bellows_design.design.overrides import with_overrides
from bellows_design.design.shipped import load_design
from bellows_design.neighbours.distance import distance

DESIGN = load_design("prototype_1")


def changed(*assignments: str) -> float:
    """Distance from Prototype 1 to what changes make of it."""
    return distance(DESIGN, with_overrides(DESIGN, assignments))


def test_distance_is_the_root_of_the_sum_of_squares_of_relative_differences() -> None:
    assert changed() == 0
    assert changed("bubble_width=19", "bubble_height=18") == pytest.approx(math.hypot(0.05, 0.1))
    assert changed("load.pressure=0.08") == pytest.approx(0.2)
    assert changed("material.mu=[0.19825, 3.0]") == pytest.approx(1 - 3.0 / 3.2778, rel=1e-3)


def test_distance_is_symmetric() -> None:
    other = with_overrides(DESIGN, ["tendon_width=10", "bubble_thickness=1.6"])
    assert distance(DESIGN, other) == distance(other, DESIGN)


@pytest.mark.parametrize(
    "assignment",
    ["name=other", "limits.max_von_mises=3", "port.depth=9", "printer=prusa_mk4", "length=52"],
)
def test_what_does_not_change_the_cells_does_not_count(assignment: str) -> None:
    assert changed(assignment) == 0


def test_another_kind_of_design_is_infinitely_far() -> None:
    assert changed("material=dragon_skin_30") == math.inf
    assert distance(DESIGN, load_design("finger")) == math.inf  # it has an indent
