"""Designs that no other one beats in angle and stress together."""

from __future__ import annotations

from collections.abc import Iterable

from bellows_design.study.optimize.point import Point


def front(points: Iterable[Point]) -> tuple[Point, ...]:
    """The non-dominated ones of those evaluated by themselves, from the least stress on.

    Larger angle and lower stress are better; of equal ones the first stays. Stresses count as
    they are: each has an error of its own beside it.
    """
    by_stress = sorted(
        (point for point in points if point.ordinary),
        key=lambda point: (point.values["stress"], -point.values["angle"]),
    )
    found: list[Point] = []
    for point in by_stress:
        if not found or point.values["angle"] > found[-1].values["angle"]:
            found.append(point)
    return tuple(found)
