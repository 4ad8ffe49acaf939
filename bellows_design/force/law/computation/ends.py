"""The ends' laws on a grid of pressures and moments, by continuation from no moment both ways."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Protocol

import numpy as np

from bellows_design.errors import BellowsError
from bellows_design.force.law.computation.continuation import Continuation, Solved
from bellows_design.force.law.computation.short_actuator import (
    EndPoint,
    Sections,
    ShortActuator,
    SolvedEnds,
)
from bellows_design.force.law.ends import EndPiece
from bellows_design.force.law.interpolation.tabulated import TabulatedLaw
from solver.arrays import Reals

if TYPE_CHECKING:
    from solver import Problem

STEPS = 6
"""So many moments press back, half as many curl further."""

SOFTEST = 6.0
"""Times the compliance without a moment: beyond, an end is about to collapse."""

LEAST_SHARE = 1.05
"""Axial compliance, of the least with which no loads gain energy."""


class Ends(Protocol):
    """What is solved for both ends."""

    @property
    def factorizations(self) -> int:
        """So far."""
        ...

    def from_zero(self, pressures: Sequence[float]) -> list[SolvedEnds]:
        """Without a moment, by the pressures' size. Raises ``BellowsError``."""
        ...

    def beside(self, near: SolvedEnds, moment: float) -> SolvedEnds | str:
        """At a moment (N mm) from that of a neighbour, or why there is none."""
        ...


@dataclass
class FreeHalf:
    """Half a bubble without neighbours, for either end."""

    cell: Continuation

    @property
    def factorizations(self) -> int:
        """So far."""
        return self.cell.factorizations

    def from_zero(self, pressures: Sequence[float]) -> list[SolvedEnds]:
        """Without a moment, by the pressures' size. Raises ``BellowsError``."""
        at_rest = self.cell.from_zero((0.0,))[0] if 0.0 in pressures else []
        loaded, reached = self.cell.from_zero(tuple(each for each in pressures if each))
        if len(at_rest) + len(loaded) < len(pressures):
            raise BellowsError(f"there is no law of the ends: {reached}")
        return [_as_ends(each) for each in (*at_rest, *loaded)]

    def beside(self, near: SolvedEnds, moment: float) -> SolvedEnds | str:
        """At a moment (N mm) from that of a neighbour, or why there is none."""
        assert near.point is not None
        found = self.cell.beside(Solved(near.point, near.solution), near.pressure, moment)
        return found if isinstance(found, str) else _as_ends(found)


def _as_ends(solved: Solved) -> SolvedEnds:
    point = solved.point
    by = point.derivatives
    end = EndPoint(np.array([point.rotation, point.extension]), by[:2, :2], by[:2, 2], point.volume)
    return SolvedEnds(point.pressure, point.moment, (end, end), solved.solution, point)


def ends_of(short: Problem, sections: Sections | None) -> Ends:
    """What solves an evaluation's ends; ``sections``: of a short actuator, None for a cell."""
    if sections is None:
        return FreeHalf(Continuation(short))
    return ShortActuator(short, sections)


def end_pieces(
    ends: Ends, inner: TabulatedLaw, pressures: Sequence[float]
) -> tuple[EndPiece, EndPiece]:
    """The laws of root and tip, about as far as that of the bubbles between them.

    Args:
        ends: what is solved.
        inner: half a bubble with neighbours, on a mesh of the same size.
        pressures: of the rows, MPa, 0 among them.

    Raises:
        BellowsError: a pressure that they do not reach without a moment.
    """
    reaches = [inner.table.reach(pressure) for pressure in pressures]
    low, high = np.array(reaches).min(axis=0)[0], np.array(reaches).max(axis=0)[1]
    moments = moments_between(low, high)
    free = sorted(ends.from_zero(pressures), key=lambda each: each.pressure)
    rows = [walked(ends, each, moments, inner.table.reach(each.pressure)) for each in free]
    root, tip = (_piece(rows, moments, end, inner) for end in (0, 1))
    return root, tip


def moments_between(low: float, high: float) -> Reals:
    """Ascending moments with 0 among them, that lie more densely about it."""
    shares = (np.arange(1, STEPS + 1) / STEPS) ** 1.5
    ahead = (np.arange(1, STEPS // 2 + 1) / (STEPS // 2)) ** 1.5
    return np.concatenate([low * shares[::-1], [0.0], high * ahead])


def walked(
    ends: Ends, free: SolvedEnds, moments: Reals, reach: tuple[float, float]
) -> list[SolvedEnds]:
    """States at moments from none both ways, up to the first one beyond ``reach``."""
    below = _walk(ends, free, moments[moments < 0][::-1], lambda moment: moment <= reach[0])
    above = _walk(ends, free, moments[moments > 0], lambda moment: moment >= reach[1])
    return [*below[::-1], free, *above]


def _walk(
    ends: Ends, free: SolvedEnds, moments: Reals, far_enough: Callable[[float], bool]
) -> list[SolvedEnds]:
    found: list[SolvedEnds] = []
    for moment in moments.tolist():
        near = found[-1] if found else free
        state = _halved(ends, near, moment)
        if isinstance(state, str) or _softness(state) > SOFTEST * _softness(free):
            break
        found.append(state)
        if far_enough(moment):
            break
    return found


def _halved(ends: Ends, near: SolvedEnds, moment: float) -> SolvedEnds | str:
    """At once, or else by a state half way."""
    found = ends.beside(near, moment)
    if isinstance(found, str):
        between = ends.beside(near, (near.moment + moment) / 2)
        return found if isinstance(between, str) else ends.beside(between, moment)
    return found


def _softness(state: SolvedEnds) -> float:
    """Of both ends together, rad per N mm."""
    return float(sum(end.compliance[0, 0] for end in state.ends))


def _piece(
    rows: Sequence[Sequence[SolvedEnds]], moments: Reals, end: int, inner: TabulatedLaw
) -> EndPiece:
    """The law of one end from the states of rows; beyond a row's its last one counts."""
    reaches = np.array([[row[0].moment, row[-1].moment] for row in rows])
    points = [[_at(row, end, moment) for moment in moments.tolist()] for row in rows]
    free = [next(each for each in row if each.moment == 0.0) for row in rows]
    return EndPiece(
        length=inner.length,
        pressures=np.array([each.pressure for each in free]),
        moments=moments,
        motion=np.array([[point.motion for point in row] for row in points]),
        compliance=np.array([[point.compliance for point in row] for row in points]),
        rate=np.array([[point.rate for point in row] for row in points]),
        volumes=np.array([each.ends[end].volume for each in free]),
        reaches=reaches,
        shear_compliance=inner.shear_compliance,
    )


def _at(row: Sequence[SolvedEnds], end: int, moment: float) -> EndPoint:
    """A row's point at a moment, or its nearest one continued with constant compliance."""
    near = min(row, key=lambda each: abs(each.moment - moment))
    point, more = near.ends[end], moment - near.moment
    compliance = admissible(point.compliance)
    return replace(point, motion=point.motion + more * compliance[:, 0], compliance=compliance)


def admissible(compliance: Reals) -> Reals:
    """The nearest compliance (2, 2) with which no loads gain energy, by its axial part alone.

    Raises ``BellowsError`` if a moment turns an end against itself.
    """
    soft, coupling, axial = compliance[0, 0], compliance[0, 1], compliance[1, 1]
    if soft <= 0:
        raise BellowsError("there is no law of the ends: a moment turns one against itself.")
    least = LEAST_SHARE * coupling**2 / soft
    return np.array([[soft, coupling], [coupling, max(axial, least)]])
