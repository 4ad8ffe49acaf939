"""Limit points and bifurcations between two successive equilibria of a path."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from solver.paths.arcs import ROUNDING, Arc, Arcs
from solver.paths.outcome import figures
from solver.results.solution import PathPoint

MOST_SECANTS = 8
FLAT = 1e-3
"""Ratio of slopes below which the smaller one is that of a limit point."""

RESOLVED = 0.1
"""The same ratio below which a limit point is reported if no smaller one is found."""

MOST_HALVINGS = 16
WIDTH = 2e-3
"""Difference of the loads on both sides of a bifurcation, relative to them, that is aimed at."""

SHARES = (0.5, 0.25, 0.75)
"""Of a bracket: where its next equilibrium is tried, in this order."""


@dataclass(frozen=True)
class Limit:
    """A limit point, where the load has an extremum along the path, or a bifurcation.

    Attributes:
        kind: of the load's extremum; ``bifurcation`` where the stability changes without one.
        point: the equilibrium there; the first one found behind a bifurcation.
        between: the nearest equilibria found before and behind it. A bifurcation lies between their
            loads, which differ by less than 0.2 % unless no equilibrium was found in between, as
            where a small imperfection of the body or its mesh parts the branches: the body then
            bends away from the path before, and the state behind is on a branch of its own.

    Examples:
        >>> from solver import Ogden, Problem, Supports, trace
        >>> from solver.mesh import block
        >>> shell = block((5, 5, 5), (3, 3, 3), hollow=((0, 0, 0), (2, 2, 2)))  # an eighth
        >>> held = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2})
        >>> rubber = Ogden.neo_hooke(0.5)
        >>> path = trace(Problem(shell, rubber, held, ("cavity",)), 1.0, steps=40, longest_step=0.1)
        >>> limit = path.limits[0]
        >>> print(limit.kind, f"{limit.point.pressure:.2f} MPa")
        maximum 0.20 MPa
    """

    kind: Literal["maximum", "minimum", "bifurcation"]
    point: PathPoint
    between: tuple[PathPoint, PathPoint]

    def describe(self, pressure: float) -> str:
        """As text, for a whole load with that pressure (MPa)."""
        before, behind = self.between
        if self.kind != "bifurcation":
            at = _at(self.point, pressure)
            return f"limit at {at}, beyond it there is no equilibrium nearby"
        if _narrow(before.load, behind.load):
            return f"stability is lost at {_at(self.point, pressure)}, where the body buckles"
        low, high = sorted(self.between, key=lambda point: abs(point.load))
        between = f"{_at(low, pressure)} and {_at(high, pressure)}"
        return f"stability is lost between {between}, where the body buckles"


def _at(point: PathPoint, pressure: float) -> str:
    """The load of a point as text."""
    if pressure:
        return f"p = {figures(point.pressure)} MPa"
    return f"{figures(100 * point.load)} % of the load"


@dataclass(frozen=True)
class LimitArc:
    """A limit with the ``arc`` at it; ``unresolved``: there must be one, but it was not found."""

    arc: Arc
    limit: Limit | None = None
    unresolved: bool = False


def limit_between(arcs: Arcs, a: Arc, b: Arc) -> LimitArc | None:
    """The limit between two successive arcs; None if there is none."""
    if a.slope * b.slope < 0:
        return _extremum_between(arcs, a, b)
    if a.unstable_modes != b.unstable_modes:
        before, behind = _bifurcation_between(arcs, a, b)
        points = _point(arcs, before), _point(arcs, behind)
        return LimitArc(behind, Limit("bifurcation", points[1], points))
    return None


def _extremum_between(arcs: Arcs, a: Arc, b: Arc) -> LimitArc:
    """The arc between two others where the slope of the load vanishes, by bracketed secants.

    It is an extremum only if the load is beyond that of all equilibria around it.
    """
    low, high, start, end = a, b, 0.0, b.arrived_by
    best = min(a, b, key=lambda arc: abs(arc.slope))
    for _ in range(MOST_SECANTS):
        share = low.slope / (low.slope - high.slope)
        length = start + min(max(share, 0.05), 0.95) * (end - start)
        tried = _either_way(arcs, a, b, length)
        if tried.failure:
            break
        best = min(best, tried, key=lambda arc: abs(arc.slope))
        if abs(tried.slope) < FLAT * abs(a.slope):
            break
        if tried.slope * a.slope > 0:
            low, start = tried, length
        else:
            high, end = tried, length
    if not _is_extremum(best, a, b):
        return LimitArc(best, unresolved=True)
    points = _point(arcs, low), _point(arcs, high)
    return LimitArc(
        best, Limit("maximum" if a.slope > 0 else "minimum", _point(arcs, best), points)
    )


def _either_way(arcs: Arcs, a: Arc, b: Arc, length: float) -> Arc:
    """The arc at a length from ``a`` towards ``b``, or if there is none, back from ``b``."""
    tried = arcs.step(a, length)
    return arcs.step(b, length - b.arrived_by) if tried.failure else tried


def _is_extremum(turn: Arc, a: Arc, b: Arc) -> bool:
    """Whether the load has a resolved extremum there: above those of both sides, or below."""
    steepest = max(abs(a.slope), abs(b.slope))
    loads = [end.load if a.slope > 0 else -end.load for end in (a, turn, b)]
    rounding = ROUNDING * max(abs(load) for load in loads)
    above = loads[1] >= max(loads[0], loads[2]) - rounding
    return above and abs(turn.slope) <= RESOLVED * steepest


def _bifurcation_between(arcs: Arcs, a: Arc, b: Arc) -> tuple[Arc, Arc]:
    """The nearest arcs found on both sides of a change of stability, by bisection of the load."""
    before, behind = a, b
    for _ in range(MOST_HALVINGS):
        if _narrow(before.load, behind.load):
            break
        tried = _inside(arcs, before, behind)
        if tried is None:
            break
        if tried.unstable_modes == a.unstable_modes:
            before = tried
        else:
            behind = tried
    return before, behind


def _inside(arcs: Arcs, before: Arc, behind: Arc) -> Arc | None:
    """An arc at a load between those of two others, started from the nearer one first."""
    for share in SHARES:
        load = before.load + share * (behind.load - before.load)
        for near in sorted((before, behind), key=lambda arc: abs((load - arc.load) / arc.slope)):
            tried = arcs.at_load(near, load)
            if not tried.failure:
                return tried
    return None


def _narrow(before: float, behind: float) -> bool:
    """Whether two loads differ by no more than is aimed at."""
    return abs(behind - before) <= WIDTH * max(abs(before), abs(behind))


def _point(arcs: Arcs, arc: Arc) -> PathPoint:
    there = arc.equilibrium
    return arcs.newton.point(there.state, there.load, there.iterations, there.stable)
