"""Results, their numbers and their places."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest

from printers import RuleResult
from printers.report import place


def result(where: str, message: str, measured: float = 1.0) -> RuleResult:
    return RuleResult("bridge", "warn", measured, 1.0, "mm", where, message)


def test_a_place_is_never_at_minus_zero() -> None:
    assert place((-0.04, 0.0, -1e-9)) == "(0.0, 0.0, 0.0) mm"
    assert place((-0.06, 5.25, 1e3)) == "(-0.1, 5.2, 1000.0) mm"


@pytest.mark.parametrize("name", ["measured", "required", "uncertainty", "tolerance", "margin"])
def test_no_number_of_a_result_is_minus_zero(name: str) -> None:
    numbers = dict.fromkeys(("measured", "required", "uncertainty", "tolerance", "margin"), 1.0)
    found = replace(result("", ""), **(numbers | {name: -0.0}))  # type: ignore[arg-type]
    assert math.copysign(1, getattr(found, name)) == 1


def test_a_result_keeps_the_points_that_its_words_name_in_their_order() -> None:
    first, second, other = (1.0, 2.0, 3.0), (-4.0, 5.12345678, 6.0), (7.0, 8.0, 9.0)
    found = result(place(second), f"near {place(first)}").at(first, other, second, first)
    assert found.points == ((-4.0, 5.123457, 6.0), first)


def test_moving_a_result_moves_the_points_and_rounds_afterwards() -> None:
    """Turning what is written, (0.0, 0.0, 1.0), by a factor of ten would give 10.0."""
    point = (0.04, -0.04, 1.04)
    found = result(place(point), f"a roof at {place(point)}, z = 1.0 mm").at(point)
    moved = found.moved(lambda at: (10 * at[0], 10 * at[1], 10 * at[2]))
    assert moved.where == "(0.4, -0.4, 10.4) mm"
    assert moved.message == "a roof at (0.4, -0.4, 10.4) mm, z = 1.0 mm"
    assert moved.points == ((0.4, -0.4, 10.4),)


def test_places_that_change_their_places_are_not_taken_for_each_other() -> None:
    left, right = (1.0, 0.0, 0.0), (-1.0, 0.0, 0.0)
    found = result(place(left), f"{place(left)} and {place(right)}").at(left, right)
    moved = found.moved(lambda at: (-at[0], at[1], at[2]))
    assert (moved.where, moved.message) == (place(right), f"{place(right)} and {place(left)}")
