"""The way to a load: adaptive steps from zero, or a start at full load, along stable states."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from solver.arrays import Reals
from solver.models import Problem
from solver.newton import Attempt, Listener, Newton, SolverOptions
from solver.results import PathPoint, Solution
from solver.state import State


def solve(
    problem: Problem,
    pressure: float,
    options: SolverOptions | None = None,
    listener: Listener | None = None,
    initial: tuple[Reals, Reals] | None = None,
    stops: Sequence[float] = (),
) -> Solution:
    """Equilibrium of ``problem`` under ``pressure`` (MPa), walked from zero load.

    With ``initial`` = (displacement (n, 3), hydrostatic pressure (v,)), for instance from
    ``solver.interpolation``, Newton starts there at full load; should that fail, the load is walked
    as usual. The path has a point at each of the pressures ``stops`` (MPa) between zero and
    ``pressure``: passed on the way up, or visited on the way back down after a start at full load.
    A load that cannot be reached gives the last good state with ``converged`` False
    and a ``message``, never a diverged state. Raises ``ValueError`` for bad input.
    """
    if not np.isfinite(pressure):
        raise ValueError(f"pressure must be a finite number of MPa, got {pressure}.")
    start = time.perf_counter()
    loads = _stops(stops, float(pressure))
    newton = Newton(problem, float(pressure), options or SolverOptions(), listener)
    walk = None if initial is None else _jump(newton, _start(newton, *initial), loads)
    if walk is None:
        walk = _walk(newton, loads)
    return _solution(newton, walk, time.perf_counter() - start)


@dataclass(frozen=True)
class Walk:
    """How far the load came: the last good ``state``, the ``path`` to it, why it stopped."""

    state: State
    path: tuple[PathPoint, ...]
    failure: str = ""


def _stops(pressures: Sequence[float], pressure: float) -> tuple[float, ...]:
    """Pressures to visit as ascending fractions of the asked one, strictly within (0, 1)."""
    loads = sorted({float(stop) / pressure if pressure else np.inf for stop in pressures})
    if not all(0 < load <= 1 + 1e-12 for load in loads):
        raise ValueError(
            f"stops must lie between 0 and the pressure of {pressure:g} MPa, got {list(pressures)}."
        )
    return tuple(load for load in loads if load < 1 - 1e-12)


def _jump(newton: Newton, initial: State, stops: tuple[float, ...]) -> Walk | None:
    """Newton at full load from a given state, then back through ``stops``; None if that fails."""
    attempt = newton.correct(initial, 1.0, newton.options.tolerance)
    if attempt.failure:
        newton.effort.refused_steps += 1
        newton.notify("refused", 1.0, initial, attempt.iterations, np.inf)
        return None
    newton.effort.load_steps += 1
    points: tuple[PathPoint, ...] = (newton.point(attempt.state, 1.0, attempt.iterations),)
    leg = Leg(attempt, 1.0, 1.0)
    for stop in reversed(stops):
        leg = _walk_to(newton, stop, leg)
        if leg.failure:
            return None
        points = (*reversed(leg.points), *points)
    return Walk(attempt.state, (newton.point(State.zero(newton.problem), 0.0, 0), *points))


def _walk(newton: Newton, stops: tuple[float, ...]) -> Walk:
    """Up from zero load, through ``stops``."""
    zero = State.zero(newton.problem)
    equilibrium = newton.assembly.evaluate(zero, 0.0)
    newton.factorize(equilibrium)
    points: tuple[PathPoint, ...] = (newton.point(zero, 0.0, 0),)
    leg = Leg(Attempt(zero, 0, force=equilibrium.force), 0.0, newton.options.first_step)
    for stop in (*stops, 1.0):
        leg = _walk_to(newton, stop, leg)
        points += leg.points
        if leg.failure:
            break
    return Walk(leg.reached.state, points, leg.failure)


@dataclass(frozen=True)
class Leg:
    """Part of a walk: where it ended, the size of the next step, points on it, why it stopped."""

    reached: Attempt
    load: float
    step: float
    points: tuple[PathPoint, ...] = ()
    failure: str = ""


def _walk_to(newton: Newton, end: float, leg: Leg) -> Leg:
    """Adaptive load steps, up or down: predict along the tangent, correct, grow or cut the step.

    Needs a factorization near the state it starts from.
    """
    options = newton.options
    reached, load, step = leg.reached, leg.load, leg.step
    points: tuple[PathPoint, ...] = ()
    direction = newton.direction(reached.force)
    while load != end:
        last = abs(end - load) <= step * (1 + 1e-9)
        target = end if last else load + np.copysign(step, end - load)
        guess = newton.advance(reached.state, direction, target - load)
        attempt = newton.correct(
            guess, target, options.tolerance if last else options.loose_tolerance
        )
        if attempt.failure:
            newton.effort.refused_steps += 1
            newton.notify("refused", target, reached.state, attempt.iterations, np.inf)
            step = options.cut * abs(target - load)
            if step < options.smallest_step:
                return Leg(reached, load, step, points, attempt.failure)
            if step < SHARPENED:
                newton.sharpen()
            continue
        step = max(step, options.growth * abs(target - load))
        reached, load = attempt, target
        points += (newton.point(attempt.state, load, attempt.iterations),)
        newton.effort.load_steps += 1
        newton.notify("step", load, attempt.state, attempt.iterations, 0.0)
        if load != end:
            direction = newton.direction(attempt.force)
    return Leg(reached, load, step, points)


SHARPENED = 0.03
"""A step cut below this fraction of the load asks for double precision."""


def _start(newton: Newton, displacement: Reals, pressure: Reals) -> State:
    """A given state as a start; ``ValueError`` if its shapes do not fit the mesh."""
    expected = State.zero(newton.problem)
    for name, given, wanted in (
        ("displacement", displacement, expected.displacement),
        ("hydrostatic pressure", pressure, expected.hydrostatic_pressure),
    ):
        if np.shape(given) != wanted.shape:
            raise ValueError(
                f"initial: {name} must have the shape {wanted.shape}, got {np.shape(given)}."
            )
    state = newton.supported(displacement, pressure)
    plane = newton.assembly.plane
    return state if plane is None else plane.fitted(state)


def _solution(newton: Newton, walk: Walk, seconds: float) -> Solution:
    """Pack up."""
    reached = walk.path[-1].pressure
    share = f"{reached:.4g} of {newton.pressure:.4g} MPa"
    message = f"stopped at {share}: {walk.failure}." if walk.failure else f"reached {share}."
    effort = newton.effort
    return Solution(
        problem=newton.problem,
        pressure=reached,
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
    )
