"""Designs that no other one beats in angle and stress together."""

from __future__ import annotations

from collections.abc import Iterable

from bellows_design.study.optimize.goal import Goal
from bellows_design.study.optimize.point import Point


def front(points: Iterable[Point], goal: Goal) -> tuple[Point, ...]:
    """The non-dominated ones of those evaluated by themselves, from the least stress on.

    They keep all limits of the goal but that of the stress.

    Larger angle and lower stress are better; of equal ones the first stays. Stresses count as
    they are: each has an error of its own beside it.
    """
    by_stress = sorted(
        (each for each in points if each.ordinary and goal.kept_but_for_stress(each.values)),
        key=lambda point: (point.values["stress"], -point.values["angle"]),
    )
    found: list[Point] = []
    for point in by_stress:
        if not found or point.values["angle"] > found[-1].values["angle"]:
            found.append(point)
    return tuple(found)
