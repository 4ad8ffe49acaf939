"""A row of the table: equilibria under one pressure, by ascending moment."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from bellows_design.force.law.interpolation.points import SectionPoint
from solver.arrays import Reals


@dataclass(frozen=True)
class Row:
    """Equilibria under one pressure, at least one.

    Attributes:
        points: by ascending moment.
        ends: why there are none below the first moment and above the last one, as text; empty where
            none were asked for.
    """

    points: tuple[SectionPoint, ...]
    ends: tuple[str, str] = ("", "")

    @property
    def pressure(self) -> float:
        """MPa."""
        return self.points[0].pressure

    @cached_property
    def moments(self) -> Reals:
        """N mm, (n,)."""
        return self.column(lambda point: point.moment)

    @property
    def reach(self) -> tuple[float, float]:
        """First and last moment, N mm."""
        return self.points[0].moment, self.points[-1].moment

    def column(self, number: Callable[[SectionPoint], float]) -> Reals:
        """A number of every point, (n,)."""
        return np.array([number(point) for point in self.points])

    @cached_property
    def derivatives(self) -> Reals:
        """Of rotation, extension and volume by moment, axial force and pressure, (n, 3, 3)."""
        return np.stack([point.derivatives for point in self.points])

    def with_point(self, point: SectionPoint) -> Row:
        """The row with a point more."""
        points = sorted((*self.points, point), key=lambda each: each.moment)
        return replace(self, points=tuple(points))

    def nearest(self, moment: float) -> SectionPoint:
        """The point nearest to a moment (N mm)."""
        return min(self.points, key=lambda point: abs(point.moment - moment))

    @property
    def apart(self) -> Row | None:
        """The part in which neighbours do not touch, from the free end on; None without any."""
        touching = [number for number, point in enumerate(self.points) if point.touches]
        free = int(np.abs(self.moments).argmin())
        start = max((number + 1 for number in touching if number <= free), default=0)
        end = min((number for number in touching if number > free), default=len(self.points))
        points = self.points[start:end]
        return replace(self, points=points) if points else None

    @property
    def onset(self) -> float | None:
        """Moment below which neighbouring bubbles touch, N mm; None if not between its points."""
        for below, above in zip(self.points, self.points[1:], strict=False):
            if below.touches and not above.touches:
                return meeting(below, above)
        return None


def meeting(below: SectionPoint, above: SectionPoint) -> float:
    """Moment at which the tangents of two points meet, N mm, well between them.

    Of a smooth law that is about the middle; where neighbours begin to touch it is near the kink.
    """
    low, high = below.moment, above.moment
    bend = above.compliance - below.compliance
    rise = above.rotation - below.rotation - below.compliance * (high - low)
    share = 1 - rise / (bend * (high - low)) if bend else 0.5
    return low + float(np.clip(share, CLOSEST, 1 - CLOSEST)) * (high - low)


CLOSEST = 0.06
"""Share of an interval that each part keeps at least when it is split."""


def doubt(below: SectionPoint, above: SectionPoint) -> float:
    """By how much two interpolations between points differ in rotation at most, rad.

    One knows the energies, the other one does not: the rotation is a quartic, or a cubic.
    """
    step = above.moment - below.moment
    mean = (below.rotation + above.rotation) / 2
    bend = (above.compliance - below.compliance) * step / 12
    return abs((above.energy - below.energy) / step - mean + bend) * 30 / 16
