"""The way to a load: adaptive steps from zero, or a start at full load, along stable states."""

from __future__ import annotations

import math
import time
from collections.abc import Sequence
from dataclasses import astuple, dataclass, replace

import numpy as np

from solver.arrays import Reals
from solver.assembly.state import State
from solver.errors import SolverError
from solver.nonlinear.checkpoint import Checkpoint
from solver.nonlinear.newton import FIRST_STEP, Attempt, Effort, Listener, Newton, SolverOptions
from solver.problem.problem import Problem
from solver.results.solution import PathPoint, Solution


def solve(
    problem: Problem,
    pressure: float = 0.0,
    options: SolverOptions | None = None,
    listener: Listener | None = None,
    initial: tuple[Reals, Reals] | None = None,
    stops: Sequence[float] = (),
    resume: Checkpoint | None = None,
) -> Solution:
    """Equilibrium of ``problem`` under ``pressure`` (MPa), walked from zero load.

    Dead loads and prescribed motions of the problem grow along with the pressure.
    With ``initial`` = (displacement (n, 3), hydrostatic pressure (v,)), for instance from
    ``transfer``, Newton starts there at full load; should that fail, the load is walked
    as usual. The path has a point at each of the pressures ``stops`` (MPa; fractions of the load
    where there is no pressure) before ``pressure``: passed on the way up, or visited on the way
    back down after a start at full load.
    With ``resume``, a checkpoint that a listener was given on an earlier run of the same problem,
    pressure, options and stops, the walk goes on from there, to the same bits (unless the first run
    found the checkpoint's state too poor to go on from).
    A load that cannot be reached gives the last good state with ``converged`` False
    and a ``message``, never a diverged state; if a limit point is why, ``limit`` says at what
    pressure. Raises ``SolverError`` for bad input.
    """
    if not np.isfinite(pressure):
        raise SolverError(f"pressure must be a finite number of MPa, got {pressure}.")
    start = time.perf_counter()
    loads = _stops(stops, float(pressure))
    newton = Newton(problem, float(pressure), options or SolverOptions(), listener)
    walk = None
    if resume is not None:
        walk = _walk(newton, loads, *_resumed(newton, resume))
    elif initial is not None:
        walk = _jump(newton, _start(newton, *initial), loads)
    if walk is None:
        walk = _walk(newton, loads, *_from_zero(newton))
    return solution_of(newton, walk, time.perf_counter() - start)


@dataclass(frozen=True)
class Walk:
    """How far the load came: the last good ``state``, the ``path`` to it, why it stopped.

    ``limit``: the load of the limit point that was in the way.
    """

    state: State
    path: tuple[PathPoint, ...]
    failure: str = ""
    limit: float | None = None


def _stops(pressures: Sequence[float], pressure: float) -> tuple[float, ...]:
    """Pressures, or without one fractions of the load, as ascending fractions within (0, 1)."""
    loads = sorted({float(stop) / (pressure or 1.0) for stop in pressures})
    if not all(0 < load <= 1 + 1e-12 for load in loads):
        end = f"the pressure of {pressure:g} MPa" if pressure else "the whole load, 1"
        raise SolverError(f"stops must lie between 0 and {end}, got {list(pressures)}.")
    return tuple(load for load in loads if load < 1 - 1e-12)


def _jump(newton: Newton, initial: State, stops: tuple[float, ...]) -> Walk | None:
    """Newton at full load from a given state, then back through ``stops``; None if that fails."""
    attempt = newton.correct(initial, 1.0, newton.options.tolerance)
    if attempt.failure:
        newton.effort.refused_steps += 1
        newton.notify("refused", 1.0, initial, attempt.iterations, np.inf)
        return None
    newton.effort.load_steps += 1
    points: tuple[PathPoint, ...] = (
        newton.point(attempt.state, 1.0, attempt.iterations, newton.stable),
    )
    leg = Leg(attempt, 1.0, 1.0)
    for stop in reversed(stops):
        leg = _walk_to(newton, stop, leg)
        if leg.failure:
            return None
        points = (*reversed(leg.points), *points)
    return Walk(attempt.state, (newton.point(State.zero(newton.problem), 0.0, 0, True), *points))


@dataclass(frozen=True)
class Leg:
    """Part of a walk: where it ended, the size of the next step, points on it, why it stopped."""

    reached: Attempt
    load: float
    step: float
    points: tuple[PathPoint, ...] = ()
    failure: str = ""


def _from_zero(newton: Newton) -> tuple[Leg, tuple[PathPoint, ...]]:
    """Before the first step: the unloaded body."""
    start = _departing(newton, State.zero(newton.problem), 0.0)
    path = (newton.point(start.state, 0.0, 0, newton.stable),)
    return Leg(start, 0.0, _first_step(newton, start)), path


def _first_step(newton: Newton, start: Attempt) -> float:
    """The first step asked for, or one that suits the body's motion, as a fraction of the load."""
    if newton.options.first_step is not None or not newton.slender:
        return newton.options.first_step or FIRST_STEP
    assert start.direction is not None
    speed = float(np.abs(newton.linear(start.state, start.direction)).max())
    return min(1.0, newton.problem.mesh.size / speed) if speed else 1.0


def _departing(newton: Newton, state: State, load: float) -> Attempt:
    """A state in equilibrium with the direction in which the walk goes on from it."""
    equilibrium = newton.evaluate(state, load)
    newton.factorize(equilibrium)
    return Attempt(state, 0, direction=newton.direction(state, load, equilibrium))


def _resumed(newton: Newton, checkpoint: Checkpoint) -> tuple[Leg, tuple[PathPoint, ...]]:
    """After the step of a checkpoint."""
    reached = checkpoint.reached
    _check_shapes(newton, reached.displacement, reached.hydrostatic_pressure)
    newton.effort = Effort(*checkpoint.effort)
    attempt = Attempt(reached, 0, direction=checkpoint.direction)
    return Leg(attempt, checkpoint.load, checkpoint.step), checkpoint.points


def _walk(newton: Newton, stops: tuple[float, ...], leg: Leg, points: Sequence[PathPoint]) -> Walk:
    """Up from a leg's end through ``stops``; ``points``: the path so far."""
    path = tuple(points)
    for stop in (*(stop for stop in stops if stop > leg.load), 1.0):
        leg = _walk_to(newton, stop, leg, path)
        path += leg.points
        if leg.failure:
            return _stopped(newton, leg, path)
    return Walk(leg.reached.state, path)


def _stopped(newton: Newton, leg: Leg, path: tuple[PathPoint, ...]) -> Walk:
    """A walk that came no further, and the limit point that was in the way if there is one.

    Its last state may have been good enough for going on only: it is corrected once more.
    """
    from solver.nonlinear.arc_length import limit_ahead

    last = newton.correct(leg.reached.state, leg.load, newton.options.tolerance)
    if last.failure:  # no state on the way bears the full tolerance
        return Walk(State.zero(newton.problem), path[:1], leg.failure)
    state, path = last.state, _corrected(newton, last, leg.load, path)
    limit = limit_ahead(newton, state, leg.load, STEPS_TO_A_LIMIT)
    if limit is None or not -1e-6 <= limit.point.load - leg.load <= NEAR * leg.load:
        return Walk(state, path, leg.failure)
    return Walk(state, path, limit.describe(newton.pressure), limit.point.load)


NEAR = 0.05
"""A limit further ahead, in fractions of the load reached, is not what stopped a walk."""

STEPS_TO_A_LIMIT = 12
"""Steps by arc length that may be spent on finding out what stopped a walk."""


def _walk_to(newton: Newton, end: float, leg: Leg, path: tuple[PathPoint, ...] = ()) -> Leg:
    """Adaptive load steps, up or down: predict along the tangent, correct, grow or cut the step.

    ``path``: what came before, for checkpoints.
    """
    options = newton.options
    reached, load, step = leg.reached, leg.load, leg.step
    points: tuple[PathPoint, ...] = ()
    refusals = 0
    while load != end:
        last = abs(end - load) <= step * (1 + 1e-9)
        target = end if last else load + math.copysign(step, end - load)
        attempt = _step(newton, reached, load, target, last)
        if attempt.failure:
            step = options.cut * abs(target - load)
            if step < options.smallest_step:
                return Leg(reached, load, step, points, attempt.failure)
            refusals += 1
            if refusals == 2:  # the state was not good enough, or the direction from it
                reached, points = _settled(newton, reached, load, points)
            continue
        step, refusals = max(step, options.growth * abs(target - load)), 0
        reached, load = attempt, target
        points += (newton.point(attempt.state, load, attempt.iterations, newton.stable),)
        _report(newton, attempt, load, step, (*path, *points))
    return Leg(reached, load, step, points)


def _step(newton: Newton, reached: Attempt, load: float, target: float, last: bool) -> Attempt:
    """One step from a state to a load, counted and told of if it is refused."""
    if reached.direction is None:
        reached = _departing(newton, reached.state, load)
    exact = last or abs(target - load) < SHORT
    tolerance = newton.options.tolerance if exact else newton.loose_tolerance
    guess = newton.predicted(reached, load, target)
    attempt = newton.correct(guess, target, tolerance, onward=target != 1.0)
    failure = attempt.failure or _leapt(newton, reached.state, guess, attempt.state)
    if failure:
        newton.effort.refused_steps += 1
        newton.notify("refused", target, reached.state, attempt.iterations, np.inf)
        return replace(attempt, failure=failure)
    newton.effort.load_steps += 1
    return attempt


def _settled(
    newton: Newton, reached: Attempt, load: float, points: tuple[PathPoint, ...]
) -> tuple[Attempt, tuple[PathPoint, ...]]:
    """A state corrected to the full tolerance, if it bears that, with the points up to it."""
    better = newton.correct(reached.state, load, newton.options.tolerance, onward=True)
    if better.failure:
        return reached, points
    return better, _corrected(newton, better, load, points)


def _corrected(
    newton: Newton, better: Attempt, load: float, points: tuple[PathPoint, ...]
) -> tuple[PathPoint, ...]:
    """Points of which the last one is that of a better state at the same load."""
    if not points:
        return points
    spent = points[-1].iterations + better.iterations
    return (*points[:-1], newton.point(better.state, load, spent, newton.stable))


SHORT = 0.03
"""A step cut below this fraction of the load asks for the full tolerance."""

LEAP = 4.0
"""A state so many times further away than predicted lies on another branch."""

NOTICEABLE = 0.02
"""Fraction of the body's diagonal; no shorter way is a leap."""


def _leapt(newton: Newton, before: State, predicted: State, found: State) -> str:
    """Why a state is none that the body comes to by a small step: it has snapped through."""
    expected = np.abs(predicted.displacement - before.displacement).max()
    moved = np.abs(found.displacement - before.displacement).max()
    size = newton.problem.mesh.size
    if moved > LEAP * expected + NOTICEABLE * size:
        return "the next stable state is far away"
    return ""


def _report(
    newton: Newton, reached: Attempt, load: float, step: float, path: tuple[PathPoint, ...]
) -> None:
    """Tell the listener of a step, with a checkpoint to go on from."""
    if newton.listener is None:
        return
    direction = reached.direction or State.zero(newton.problem)  # none at the whole load
    effort = astuple(newton.effort)
    checkpoint = Checkpoint(reached.state, load, step, direction, path, effort)
    newton.notify("step", load, reached.state, path[-1].iterations, 0.0, checkpoint)


def _start(newton: Newton, displacement: Reals, pressure: Reals) -> State:
    """A given state as a start; ``SolverError`` if its shapes do not fit the mesh."""
    _check_shapes(newton, displacement, pressure)
    state = newton.placed(State(displacement, pressure), 1.0)
    plane = newton.assembly.plane
    return state if plane is None else plane.fitted(state)


def _check_shapes(newton: Newton, displacement: Reals, pressure: Reals) -> None:
    expected = State.zero(newton.problem)
    for name, given, wanted in (
        ("displacement", displacement, expected.displacement),
        ("hydrostatic pressure", pressure, expected.hydrostatic_pressure),
    ):
        if np.shape(given) != wanted.shape:
            raise SolverError(
                f"initial: {name} must have the shape {wanted.shape}, got {np.shape(given)}."
            )
        if not np.isfinite(given).all():
            raise SolverError(f"initial: {name} must be finite numbers, found NaN or infinity.")


def solution_of(newton: Newton, walk: Walk, seconds: float) -> Solution:
    """Pack up."""
    end = walk.path[-1]
    share = _share(newton.pressure, end.load)
    message = f"stopped at {share}: {walk.failure}." if walk.failure else f"reached {share}."
    effort = newton.effort
    limit = walk.limit
    return Solution(
        problem=newton.problem,
        pressure=end.pressure,
        displacement=walk.state.displacement,
        hydrostatic_pressure=walk.state.hydrostatic_pressure,
        path=walk.path,
        converged=not walk.failure,
        message=message,
        newton_iterations=effort.iterations,
        factorizations=effort.factorizations,
        load_steps=effort.load_steps,
        refused_steps=effort.refused_steps,
        linear_solver=newton.matrix.name,
        negative_pivots=newton.matrix.negative_pivots,
        seconds=seconds,
        plane=(float(walk.state.plane[0]), float(walk.state.plane[1])),
        load=end.load,
        limit=limit if limit is None or not newton.pressure else limit * newton.pressure,
    )


def _share(pressure: float, load: float) -> str:
    """How much of what was asked for."""
    if pressure:
        return f"{load * pressure:.4g} of {pressure:.4g} MPa"
    return f"{100 * load:.4g} % of the load"
