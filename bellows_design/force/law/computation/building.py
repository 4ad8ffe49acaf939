"""The table's rows: those asked for, and more between them where interpolation is not enough."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from bellows_design.errors import BellowsError
from bellows_design.force.law.computation.continuation import Continuation, Solved
from bellows_design.force.law.computation.walking import Aim, SolvedRow, refined, retraced, walked
from bellows_design.force.law.interpolation.rows import Row
from bellows_design.force.law.interpolation.table import Table

if TYPE_CHECKING:
    from bellows_design.force.law.interpolation.points import SectionPoint

LEAST_SHARE = 1 / 64
"""Of the pressures' range; no row is added between rows that are nearer to each other."""


@dataclass(frozen=True)
class Check:
    """A point that is not in the table: what was computed, and by how much the table misses it.

    ``error`` of the rotation, rad.
    """

    point: SectionPoint
    error: float


@dataclass
class Builder:
    """Rows of a cell by continuation.

    Attributes:
        cell: what is solved.
        aim: how far rows go, and how fine they are.
        rows: so far, by pressure.
        known: rows of the table without their states; those of the same pressure in ``rows`` count.
        checks: at pressures between rows.
        note: is told what is done.
        deadline: of the monotonic clock, s; nothing is refined after it.
        complete: whether refinement came to its end.
    """

    cell: Continuation
    aim: Aim
    rows: dict[float, SolvedRow] = field(default_factory=dict)
    known: dict[float, Row] = field(default_factory=dict)
    checks: list[Check] = field(default_factory=list)
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
        for solved in free:
            self.add(SolvedRow((solved,)))

    def extend(self, free: Solved, moments: tuple[float, float]) -> None:
        """A row that is known, or a new one, up to moments (N mm), from its point without one."""
        pressure, start = free.point.pressure, SolvedRow((free,))
        self.note(f"section's law at {pressure:.4g} MPa")
        if pressure in self.known:
            start = retraced(self.cell, self.known[pressure], free)
        aim = replace(self.aim, moments=moments)
        self.rows[pressure] = refined(self.cell, walked(self.cell, start, aim), aim)

    def add(self, begun: SolvedRow) -> None:
        """A row on from the points that are known of it."""
        pressure = begun.solved[0].point.pressure
        self.note(f"section's law at {pressure:.4g} MPa")
        self.rows[pressure] = refined(self.cell, walked(self.cell, begun, self.aim), self.aim)

    @property
    def worst(self) -> float:
        """Largest error at the checks, rad."""
        return max((check.error for check in self.checks), default=0.0)

    def refine(self) -> None:
        """Rows between others as long as points between them are not well interpolated."""
        pressures = sorted(self.rows)
        least = LEAST_SHARE * (pressures[-1] - pressures[0])
        open_intervals = list(pairwise(pressures))
        while open_intervals and time.monotonic() < self.deadline:
            low, high = open_intervals.pop(0)
            middle = (low + high) / 2
            found = self._checked(middle)
            worst = max((check.error for check in found[1]), default=0.0)
            if worst <= self.aim.tolerance or high - low < 2 * least or not found[0]:
                self.checks += found[1]
                continue
            self.add(SolvedRow(tuple(sorted(found[0], key=lambda each: each.point.moment))))
            open_intervals += [(low, middle), (middle, high)]
        self.complete = not open_intervals

    def _checked(self, pressure: float) -> tuple[list[Solved], list[Check]]:
        """Points between rows: where neighbours begin to touch, and where they press each other."""
        table = self.table
        low, _ = table.reach(pressure)
        onset = table.curves(pressure).origin
        near = min(self.rows, key=lambda each: abs(each - pressure))
        at = self.rows[near].nearest(onset)
        solved: list[Solved] = []
        for moment in (onset, (onset + low) / 2):
            found = self.cell.beside(at, pressure, moment)
            if isinstance(found, str):
                break
            at = found
            solved.append(found)
        return solved, [Check(each.point, error_at(table, each.point)) for each in solved]


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
