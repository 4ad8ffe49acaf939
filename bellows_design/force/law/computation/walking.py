"""A row of the table by continuation in the moment: first a walk both ways, then refinement."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from bellows_design.force.law.computation.continuation import Continuation, Solved
from bellows_design.force.law.interpolation.rows import Row, doubt, meeting

if TYPE_CHECKING:
    from bellows_design.force.law.interpolation.points import SectionPoint

GROWTH = 2.0
"""Largest ratio of a step in the moment to the one before."""

IN_CONTACT = 2
"""So many points with touching neighbours a walk takes at least, to know how stiff they are."""

BEYOND_TOUCH = 1.5
"""Of the step to where neighbours touch, as far as the last one tells."""

BEYOND_END = 1.4
"""Of the step to the lowest rotation by the compliance: in contact half bubbles become stiffer."""

FARTHEST = 60
"""Points of a walk in one direction, at most."""

MOST_POINTS = 60
"""Of a row that is refined."""


@dataclass(frozen=True)
class Aim:
    """How far a row goes, and how fine it is; all in rad.

    ``low`` and ``high``: rotations that it passes. ``step``: of the rotation from point to point on
    the first walk. ``tolerance``: of the interpolated rotation. ``moments``: that it passes as
    well, N mm.
    """

    low: float
    high: float
    step: float
    tolerance: float
    moments: tuple[float, float] = (math.inf, -math.inf)


@dataclass(frozen=True)
class SolvedRow:
    """A row whose states are known: by ascending moment, with the reasons of ``Row.ends``."""

    solved: tuple[Solved, ...]
    ends: tuple[str, str] = ("", "")

    @property
    def row(self) -> Row:
        """Without the states."""
        return Row(tuple(each.point for each in self.solved), self.ends)

    def with_solved(self, *more: Solved) -> SolvedRow:
        """The row with further points; those that it has at the same moments stay."""
        known = {each.point.moment for each in self.solved}
        added = [each for each in more if each.point.moment not in known]
        ordered = sorted((*self.solved, *added), key=lambda each: each.point.moment)
        return replace(self, solved=tuple(ordered))

    def nearest(self, moment: float) -> Solved:
        """The point nearest to a moment (N mm)."""
        return min(self.solved, key=lambda each: abs(each.point.moment - moment))


def walked(cell: Continuation, start: SolvedRow, aim: Aim) -> SolvedRow:
    """From a row's ends on, until the rotation passes those of the aim or no state is found."""
    first, last = start.solved[:2], start.solved[-2:]
    down, below = _walk(cell, first[::-1], aim, -1.0, lambda walk: _low_enough(walk, aim))
    up, above = _walk(cell, last, aim, 1.0, lambda walk: _high_enough(walk, aim))
    ends = (start.ends[0] or below, start.ends[1] or above)
    return replace(start.with_solved(*down, *up), ends=ends)


def _low_enough(walk: list[Solved], aim: Aim) -> bool:
    """Whether the rotation has passed the lower one, and neighbours touch if they ever do."""
    end = walk[-1].point
    if end.rotation > aim.low or end.moment > aim.moments[0]:
        return False
    touching = sum(each.point.touches for each in walk)
    return end.gap is None or touching >= IN_CONTACT or end.rotation < aim.low - aim.high


def _high_enough(walk: list[Solved], aim: Aim) -> bool:
    end = walk[-1].point
    return end.rotation >= aim.high and end.moment >= aim.moments[1]


def _walk(
    cell: Continuation,
    known: tuple[Solved, ...],
    aim: Aim,
    direction: float,
    done: Callable[[list[Solved]], bool],
) -> tuple[list[Solved], str]:
    """Points from the last of those ``known`` in one direction, and why there are no more.

    That one is included; one before it, if any, tells which steps are short.
    """
    walk = [known[-1]]
    last = abs(known[-1].point.moment - known[0].point.moment) or math.inf
    while not done(walk) and len(walk) < FARTHEST:
        point = walk[-1].point
        usual = min(aim.step / point.compliance, GROWTH * last)
        last = min(usual, _to_touch(walk), _to_end(point, aim, direction))
        found = cell.beside(walk[-1], point.pressure, point.moment + direction * last)
        if isinstance(found, str):
            return walk, found
        walk.append(found)
    return walk, ""


def _to_touch(walk: list[Solved]) -> float:
    """Step in the moment, N mm, to a little beyond where neighbours touch; infinite if far away.

    A step far beyond takes many times as many factorizations, or leads nowhere.
    """
    if len(walk) < 2:
        return math.inf
    before, at = (each.point for each in walk[-2:])
    if before.gap is None or at.gap is None or not 0 < at.gap < before.gap:
        return math.inf
    return BEYOND_TOUCH * abs(at.moment - before.moment) * at.gap / (before.gap - at.gap)


def _to_end(point: SectionPoint, aim: Aim, direction: float) -> float:
    """Step of a touching point in the moment, N mm, to a little beyond the lowest rotation."""
    rest = point.rotation - aim.low
    if direction > 0 or not point.touches or rest <= 0:
        return math.inf
    return BEYOND_END * rest / point.compliance


def retraced(cell: Continuation, row: Row, free: Solved) -> SolvedRow:
    """The states of a row's points again, from that without a moment; as far as they are found."""
    found = SolvedRow((free,))
    inner_first = sorted(row.points, key=lambda point: abs(point.moment))
    for point in inner_first:
        near = found.solved[0] if point.moment < 0 else found.solved[-1]
        again = cell.beside(near, point.pressure, point.moment)
        if not isinstance(again, str):
            found = found.with_solved(again)
    return found


def refined(cell: Continuation, row: SolvedRow, aim: Aim) -> SolvedRow:
    """With points between those of a row, as long as its interpolation is in doubt."""
    settled: set[tuple[float, float]] = set()
    while len(row.solved) < MOST_POINTS:
        pair = _worst(row, aim, settled)
        if pair is None:
            break
        below, above = pair
        moment = meeting(below.point, above.point)
        found = cell.beside(row.nearest(moment), below.point.pressure, moment)
        if isinstance(found, str):
            settled.add((below.point.moment, above.point.moment))
        else:
            row = row.with_solved(found)
    return row


def _worst(
    row: SolvedRow, aim: Aim, settled: set[tuple[float, float]]
) -> tuple[Solved, Solved] | None:
    """The two neighbours between which interpolation is most in doubt, more than tolerated."""
    pairs = [
        pair
        for pair in zip(row.solved, row.solved[1:], strict=False)
        if (pair[0].point.moment, pair[1].point.moment) not in settled
    ]
    worst = max(pairs, key=lambda pair: doubt(pair[0].point, pair[1].point), default=None)
    if worst is None or doubt(worst[0].point, worst[1].point) <= aim.tolerance:
        return None
    return worst
