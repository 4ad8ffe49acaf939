"""Where a load path stops before its end: its last equilibrium, and why it goes no further."""

from __future__ import annotations

import math

from solver.assembly.state import State
from solver.nonlinear.attempts import Attempt
from solver.nonlinear.newton import Newton
from solver.paths.arc_length import bifurcation_near, limit_ahead
from solver.paths.limits import Limit
from solver.paths.outcome import Path, Points
from solver.paths.step_control import Segment, StepControl
from solver.results.solution import StopKind

LIMIT_DISTANCE = 0.05
"""Largest distance of a limit point that explains a stop, as a fraction of the load reached."""

LIMIT_STEPS = 24
"""Most steps by arc length in search of that limit point."""

BACKING_OFF = (1.0, 0.98, 0.9, 0.7)
"""Fractions of the load reached at which an equilibrium to the full tolerance is searched."""

UNSTABLE_START = (
    "the state that the stage begins with is unstable under the stage's supports; what held it "
    "before and is gone may be led away instead"
)


def stopped(newton: Newton, segment: Segment[Attempt], points: Points) -> Path:
    """A path that stops before the end, with the limit point that causes it if there is one.

    Its last state may fulfil the loose tolerance only: it is corrected once more.
    """
    kind, load = _stop_kind(newton, segment), segment.position
    with newton.budget.lifted():
        state, load, points, tolerance = _last_equilibrium(
            newton, segment.reached.state, load, points
        )
    limit = _limit_near(newton, state, load) if kind == "step" and load else None
    coarse = f" (its last state is in equilibrium to {tolerance:.2g} diagonals only)"
    note = coarse if tolerance > newton.options.tolerance else ""
    if limit is None:
        lost = kind == "step" and _starts_unstable(newton, points)
        reason = UNSTABLE_START if lost else segment.failure
        return Path(state, points, reason + note, stopped_by=kind)
    reason = limit.describe(max(newton.loading.pressures, key=abs)) + note
    return Path(state, points, reason, limit.point.load, "limit")


def _starts_unstable(newton: Newton, points: Points) -> bool:
    """Whether a path got nowhere because what the stage begins with is unstable."""
    return (
        len(newton.loading.supports_from) > 0
        and points[-1].load == 0
        and points[-1].stable is False
    )


def _last_equilibrium(
    newton: Newton, state: State, load: float, points: Points
) -> tuple[State, float, Points, float]:
    """A path's end, and the tolerance to which it is in equilibrium, in body diagonals.

    That is the full one; at a lower load where it is not met at ``load``. Where it is not met at
    lower loads either, the state that was reached is kept, corrected as far as that goes.
    """
    full = newton.options.tolerance
    for lower in (share * load for share in BACKING_OFF):
        found = newton.correct(state, lower, full)
        if found.failure:
            continue
        if lower == load:
            return found.state, load, corrected(newton, found, load, points), full
        before = tuple(point for point in points if point.load < lower)
        point = newton.point(found.state, lower, found.iterations, newton.system.stable)
        return found.state, lower, (*before, point), full
    if load == 0:
        return state, load, points, full
    for tolerance in _coarser(newton):
        found = newton.correct(state, load, tolerance)
        if not found.failure:
            return found.state, load, corrected(newton, found, load, points), tolerance
    return state, load, points, newton.loose_tolerance


def _coarser(newton: Newton) -> list[float]:
    """Tolerances between the full one and that of states on the way, ten times coarser each."""
    full, loose = newton.options.tolerance, newton.loose_tolerance
    count = max(0, math.ceil(math.log10(loose / full)))
    return [full * 10**power for power in range(1, count)] + [max(full, loose)]


def _stop_kind(newton: Newton, segment: Segment[Attempt]) -> StopKind:
    """What stopped a path: its budget, the guard, or that no step succeeds."""
    if newton.exhausted():
        return "budget"
    return "guard" if segment.refused is not None and segment.refused.guarded else "step"


def _limit_near(newton: Newton, state: State, load: float) -> Limit | None:
    """The limit point that explains why no step from a state succeeds, if there is one.

    A stable state may lie beyond the bifurcation of a body that bends away before it.
    """
    step = StepControl.of_loads(newton.options).smallest_at(load)
    limit = limit_ahead(newton, state, load, step, LIMIT_STEPS)
    if limit is not None and -1e-6 * load <= limit.point.load - load <= LIMIT_DISTANCE * load:
        return limit
    limit = bifurcation_near(newton, state, load)
    near = limit is not None and abs(limit.point.load - load) <= LIMIT_DISTANCE * load
    return limit if near else None


def corrected(newton: Newton, better: Attempt, load: float, points: Points) -> Points:
    """Points with the last one replaced by that of a corrected state at the same load."""
    if not points:
        return points
    spent = points[-1].iterations + better.iterations
    return (*points[:-1], newton.point(better.state, load, spent, newton.system.stable))
