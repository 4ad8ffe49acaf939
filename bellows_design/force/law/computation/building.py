"""The table's rows: those asked for, and more between them where interpolation is not enough."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from itertools import pairwise
from typing import TYPE_CHECKING, TypeVar

import numpy as np

from bellows_design.errors import BellowsError
from bellows_design.force.law.computation.continuation import Continuation, Solved
from bellows_design.force.law.computation.side_by_side import side_by_side
from bellows_design.force.law.computation.unchecked import between_rows, within_rows
from bellows_design.force.law.computation.walking import Aim, SolvedRow, refined, retraced, walked
from bellows_design.force.law.interpolation.rows import Row
from bellows_design.force.law.interpolation.table import Table

if TYPE_CHECKING:
    from bellows_design.force.law.interpolation.points import SectionPoint

LEAST_SHARE = 1 / 64
"""Of the pressures' range; no row is added between rows that are nearer to each other."""

SAFETY = 2.0
"""Factor on the largest error at checks in the error that is stated: at random points Prototype 1's
table is off by up to 1.8 times as much (`tests/benchmarks/cell_laws.json`)."""

PLACES = (0.0, 0.5)
"""Of checks, between where neighbours begin to touch and the lowest moment."""

Interval = tuple[float, float]
"""Between two rows, MPa."""

Found = TypeVar("Found")


@dataclass(frozen=True)
class Check:
    """A point that is not in the table: what was computed, and by how much the table misses it.

    ``error`` of the rotation, rad.
    """

    point: SectionPoint
    error: float


@dataclass
class Builder:
    """Rows of a cell by continuation, two at a time where the machine has the processors.

    Attributes:
        cell: what is solved.
        aim: how far rows go, and how fine they are.
        rows: so far, by pressure.
        known: rows of the table without their states; those of the same pressure in ``rows`` count.
        checks: at pressures between rows.
        unchecked: intervals between rows without all of the usual checks.
        note: is told what is done.
        deadline: of the monotonic clock, s; nothing is refined after it.
        complete: whether refinement came to its end.
    """

    cell: Continuation
    aim: Aim
    rows: dict[float, SolvedRow] = field(default_factory=dict)
    known: dict[float, Row] = field(default_factory=dict)
    checks: list[Check] = field(default_factory=list)
    unchecked: list[Interval] = field(default_factory=list)
    note: Callable[[str], None] = lambda _: None
    deadline: float = float("inf")
    complete: bool = False

    @property
    def table(self) -> Table:
        """Of the rows so far, at least two."""
        rows = self.known | {pressure: solved.row for pressure, solved in self.rows.items()}
        return Table(tuple(rows[pressure] for pressure in sorted(rows)))

    def start(self, free: Sequence[Solved]) -> None:
        """Rows through points without a moment. Raises ``BellowsError`` for less than two."""
        if len(free) < 2:
            raise BellowsError("the section's law needs equilibria at two pressures at least.")
        self.add([SolvedRow((solved,)) for solved in free])

    def extend(self, free: Solved, moments: tuple[float, float]) -> None:
        """A row that is known, or a new one, up to moments (N mm), from its point without one."""
        pressure, start = free.point.pressure, SolvedRow((free,))
        self.note(f"section's law at {pressure:.4g} MPa")
        if pressure in self.known:
            start = retraced(self.cell, self.known[pressure], free)
        aim = replace(self.aim, moments=moments)
        self.rows[pressure] = refined(self.cell, walked(self.cell, start, aim), aim)

    def add(self, begun: Sequence[SolvedRow]) -> None:
        """Rows on from the points that are known of them."""
        pressures = [each.row.pressure for each in begun]
        self.note("section's law at " + ", ".join(f"{each:.4g}" for each in pressures) + " MPa")
        rows = self._computed([partial(_completed, each, self.aim) for each in begun])
        self.rows |= dict(zip(pressures, rows, strict=True))

    @property
    def worst(self) -> float:
        """Largest error, rad: ``SAFETY`` times that at checks, or an estimate where none are."""
        table = self.table
        at_checks = SAFETY * max((check.error for check in self.checks), default=0.0)
        between = (between_rows(table, *interval) for interval in self.unchecked)
        return max(at_checks, within_rows(table.rows), *between)

    def refine(self, beside: Sequence[Callable[[], None]] = ()) -> None:
        """Rows between others as long as points between them are not well interpolated.

        ``beside``: computed at the same time as the first points, with which it has nothing to do.
        """
        pressures = sorted(self.rows)
        least = LEAST_SHARE * (pressures[-1] - pressures[0])
        intervals = list(pairwise(pressures))
        while intervals and time.monotonic() < self.deadline:
            found = self._between(intervals, beside)
            split = self._judged(intervals, found, least)
            if split:
                self.add([SolvedRow(found[number]) for number in split])
            intervals = [half for number in split for half in _halves(*intervals[number])]
            beside = ()
        for task in beside:
            task()
        self.unchecked += intervals
        self.complete = not intervals

    def _between(
        self, intervals: Sequence[Interval], beside: Sequence[Callable[[], None]]
    ) -> list[tuple[Solved, ...]]:
        """Points of every interval, by ascending moment."""
        table, rows = self.table, dict(self.rows)
        tasks = [partial(_points, each, table, rows) for each in intervals]
        return self._computed(tasks, beside)

    def _judged(
        self, intervals: Sequence[Interval], found: Sequence[tuple[Solved, ...]], least: float
    ) -> list[int]:
        """Which intervals need a row; what is known of the others is kept."""
        table, split = self.table, []
        for number, (low, high) in enumerate(intervals):
            checks = [Check(each.point, error_at(table, each.point)) for each in found[number]]
            worst = max((each.error for each in checks), default=0.0)
            if worst > self.aim.tolerance and high - low >= 2 * least:
                split.append(number)
                continue
            self.checks += checks
            if len(checks) < len(PLACES):
                self.unchecked.append((low, high))
        return split

    def _computed(
        self,
        tasks: Sequence[Callable[[Continuation], Found]],
        beside: Sequence[Callable[[], None]] = (),
    ) -> list[Found]:
        """By cells of their own, so that no result depends on another."""
        cells = [self.cell.anew() for _ in tasks]
        found: dict[int, Found] = {}

        def compute(number: int) -> None:
            found[number] = tasks[number](cells[number])

        side_by_side([*beside, *(partial(compute, number) for number in range(len(tasks)))])
        self.cell.factorizations += sum(cell.factorizations for cell in cells)
        return [found[number] for number in range(len(tasks))]


def _completed(begun: SolvedRow, aim: Aim, cell: Continuation) -> SolvedRow:
    return refined(cell, walked(cell, begun, aim), aim)


def _points(
    interval: Interval, table: Table, rows: dict[float, SolvedRow], cell: Continuation
) -> tuple[Solved, ...]:
    """Midway between rows: where neighbours begin to touch, and where they press each other.

    Those that are found, each from that point of both rows that is nearest to it, relative to where
    neighbours begin to touch: to pass from one side of that to the other takes many factorizations.
    """
    pressure = sum(interval) / 2
    onset, (low, _) = table.curves(pressure).origin, table.reach(pressure)
    known = [
        (each.point.moment - table.curves(beside).origin, each)
        for beside in interval
        for each in rows[beside].solved
    ]
    solved: list[Solved] = []
    for share in PLACES:
        place = share * (low - onset)
        _, near = min(known, key=lambda each: abs(each[0] - place))
        found = cell.beside(near, pressure, onset + place)
        if not isinstance(found, str):
            solved.append(found)
    return tuple(sorted(solved, key=lambda each: each.point.moment))


def _halves(low: float, high: float) -> tuple[Interval, Interval]:
    middle = (low + high) / 2
    return (low, middle), (middle, high)


def error_at(table: Table, point: SectionPoint) -> float:
    """By how much a table misses the rotation of a point, rad."""
    fields = table.curves(point.pressure).fields(np.array([point.moment]))
    return abs(float(fields.by_moment[0, 0]) - point.rotation)


def aim_of(free: float, tolerance: float) -> Aim:
    """Of a law whose free rotation at the design's pressure is ``free``, rad.

    ``tolerance``: a fraction of that.
    """
    size = abs(free)
    low, high = min(-SLIGHTLY * size, BEYOND * free), max(SLIGHTLY * size, BEYOND * free)
    return Aim(low, high, STEP * size, tolerance * size)


BEYOND, SLIGHTLY, STEP = 1.15, 0.04, 1 / 3
"""Of the free rotation: how far rows go beyond it, and back beyond zero; from point to point."""
