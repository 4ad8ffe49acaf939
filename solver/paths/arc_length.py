"""The equilibrium path by arc length, through limit points of the load.

Each step is predicted along the unit tangent of the path and corrected at a right angle to it (Riks
1979, in Ramm's form with a linear constraint). Where the slope of the load changes its sign and the
load turns, there is a limit point; where the inertia of the tangent changes without that, a
bifurcation.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import islice

import numpy as np

from solver.assembly.state import State
from solver.errors import SolverError
from solver.input_types import check_function, check_number, shown
from solver.nonlinear.call_checks import check_call
from solver.nonlinear.events import Listener
from solver.nonlinear.loading import Loading
from solver.nonlinear.newton import Newton
from solver.nonlinear.options import FIRST_STEP, SolverOptions
from solver.paths.arcs import IMMOBILE, Arc, Arcs
from solver.paths.kinks import over_kink
from solver.paths.limits import Limit, LimitArc, limit_between
from solver.paths.outcome import figures
from solver.problem.problem import Problem
from solver.results.solution import PathPoint, Solution

LONGEST_STEP = 0.05
"""Longest step, root mean square over the nodes, in units of the body's diagonal."""

BEFORE, BEHIND = (0.95, 0.9, 0.8, 0.0), (1.05, 1.2)
"""Fractions of a load between which a bifurcation near it is looked for, in this order."""


@dataclass(frozen=True)
class Trace:
    """An equilibrium path.

    Attributes:
        points: its equilibria, with those of ``limits``.
        states: fields of each of the points.
        limits: the limit points and bifurcations found on it.
        message: why it ends.

    Examples:
        >>> from solver import Ogden, Problem, Supports, trace
        >>> from solver.mesh import block
        >>> shell = block((5, 5, 5), (3, 3, 3), hollow=((0, 0, 0), (2, 2, 2)))  # an eighth
        >>> held = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2})
        >>> rubber = Ogden.neo_hooke(0.5)
        >>> path = trace(Problem(shell, rubber, held, ("cavity",)), 1.0, steps=40, longest_step=0.1)
        >>> print(path.points[1].stable, path.points[-1].stable)  # before and behind the limit
        True False
    """

    points: tuple[PathPoint, ...]
    states: tuple[State, ...]
    limits: tuple[Limit, ...]
    message: str


def trace(
    problem: Problem,
    pressure: float = 0.0,
    options: SolverOptions | None = None,
    listener: Listener | None = None,
    steps: int = 60,
    longest_step: float = LONGEST_STEP,
    until: Callable[[PathPoint], bool] | None = None,
    after: Solution | None = None,
) -> Trace:
    """Follow the equilibria of ``problem`` from zero load by arc length, stable or not.

    The path ends where the whole load is passed, where ``until`` holds, after ``steps`` steps, or
    where no step succeeds.

    Args:
        problem: body, supports and loads; its loads and prescribed motions belong to the whole
            load, 1.
        pressure: on the pressurised surfaces at the whole load, MPa.
        options: tolerances, and the ``first_step``: a fraction of the load, a tenth by default.
        listener: is called with an ``Event`` after each correction.
        steps: largest number of steps.
        longest_step: upper bound of the nodes' displacement in a step, root mean square, in units
            of the body's diagonal.
        until: condition on a point that ends the path there.
        after: an equilibrium of a stage before, to start from, as for ``solve``.

    Returns:
        The path.

    Raises:
        SolverError: a pressure that is not finite, no steps, steps of no length, or no load.

    Examples:
        >>> from solver import Ogden, Problem, Supports, trace
        >>> from solver.mesh import block
        >>> shell = block((5, 5, 5), (3, 3, 3), hollow=((0, 0, 0), (2, 2, 2)))  # an eighth
        >>> held = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2})
        >>> problem = Problem(shell, Ogden.neo_hooke(0.5), held, ("cavity",))
        >>> path = trace(problem, 1.0, longest_step=0.1, until=lambda point: point.volume > 100)
        >>> highest = max(point.pressure for point in path.points)
        >>> print(f"{highest:.2f} MPa")  # more than that the shell does not hold
        0.20 MPa
    """
    check_call(problem, options, listener, after)
    check_function("trace: until", until, "a PathPoint")
    check_number("trace: steps", steps)
    check_number("trace: longest_step", longest_step)
    check_number("pressure", pressure)
    if not np.isfinite(pressure):
        raise SolverError(f"pressure must be a finite number of MPa, got {pressure}.")
    if not (0 < longest_step < np.inf and steps >= 1):
        raise SolverError(
            f"trace: longest_step = {longest_step} must be a number above 0 and steps = {steps} "
            "at least 1."
        )
    loading = Loading.of(problem, float(pressure), after)
    newton = Newton(problem, loading, options or SolverOptions(), listener)
    follower = PathFollower(Arcs.of(newton, longest_step))
    points: list[PathPoint] = []
    states: list[State] = []
    limits: list[Limit] = []
    message = ""
    first = _first(follower.arcs, newton)
    for number, (arc, limit) in enumerate(follower.along(first)):
        points.append(limit.point if limit else follower.point(arc))
        states.append(arc.equilibrium.state)
        limits += [limit] if limit else []
        message = _reason_to_end(arc, points[-1], until, number, steps)
        if message:
            break
    message = message or "no further step succeeds."
    return Trace(tuple(points), tuple(states), tuple(limits), message)


def _first(arcs: Arcs, newton: Newton) -> Arc:
    """The start of the path. Raises ``SolverError`` if nothing moves with the load."""
    first = arcs.start(newton.loading.start, 0.0, newton.options.first_step or FIRST_STEP)
    if first.failure == IMMOBILE:
        pressure = newton.loading.pressures[1]
        raise SolverError(
            f"trace: no load moves the body: pressure = {figures(pressure)} MPa, "
            f"{len(newton.problem.loads)} dead loads, 0 prescribed motions; one must."
        )
    return first


def _reason_to_end(
    arc: Arc,
    point: PathPoint,
    until: Callable[[PathPoint], bool] | None,
    number: int,
    steps: int,
) -> str:
    """Why a traced path ends at its point ``number``; empty if it continues."""
    if arc.equilibrium.load >= 1:
        return "the asked load is reached."
    if until is not None and _holds(until(point)):
        return "it ends where it was asked to."
    return f"it ends after {steps} steps." if number >= steps else ""


def _holds(answer: object) -> bool:
    """Whether a condition holds; ``SolverError`` for an answer that is no truth value."""
    if answer is not None and not isinstance(answer, bool | np.bool_):
        raise SolverError(f"trace: until must return True or False, got {shown(answer)}.")
    return bool(answer)


def limit_ahead(
    newton: Newton, state: State, load: float, first_step: float, steps: int
) -> Limit | None:
    """The first limit after a state, if it is within so many steps; the first one is of the load.

    Ends without one where the solve's budget is spent.
    """
    follower = PathFollower(Arcs.of(newton, LONGEST_STEP))
    arcs = follower.along(follower.arcs.start(state, load, first_step))
    return next((limit for _, limit in islice(arcs, steps + 1) if limit), None)


def bifurcation_near(newton: Newton, state: State, load: float) -> Limit | None:
    """The bifurcation near a state that may have begun to bend away, as an imperfect body does.

    There the path points along the mode that buckles. Without the imperfection the body would go
    straight on, to where it is unstable: a step from a lower load finds that branch.
    """
    arcs = Arcs.of(newton, LONGEST_STEP)
    for share in BEFORE:
        before = _straight(arcs, state, share * load)
        if before is None:
            continue
        for beyond in BEHIND:
            behind = arcs.at_load(before, beyond * load)
            if not behind.failure and behind.unstable_modes:
                found = limit_between(arcs, before, behind)
                return found.limit if found else None
    return None


def _straight(arcs: Arcs, bent: State, load: float) -> Arc | None:
    """The arc at a lower load than that of a ``bent`` state; at no load the path's start.

    None where it is known to be unstable.
    """
    state = arcs.newton.loading.start
    if load:
        found = arcs.newton.correct(bent, load, arcs.newton.options.tolerance)
        if found.failure:
            return None
        state = found.state
    arc = arcs.start(state, load, FIRST_STEP)
    return None if arc.failure or arc.unstable_modes else arc


@dataclass(frozen=True)
class PathFollower:
    """The path from an arc on, by steps of ``arcs`` that are cut until they make sense."""

    arcs: Arcs

    def along(self, arc: Arc) -> Iterator[tuple[Arc, Limit | None]]:
        """The path from ``arc``, with the limits on it; ends where no step succeeds."""
        yield arc, None
        while not arc.failure:
            follows, between = self._next(arc)
            if follows.failure:
                return
            if between is not None:
                yield between.arc, between.limit
            if between is None or between.arc is not follows:
                yield follows, None
            arc = follows

    def point(self, arc: Arc) -> PathPoint:
        """Describe an equilibrium."""
        there = arc.equilibrium
        return self.arcs.newton.point(there.state, there.load, there.iterations, there.stable)

    def _next(self, arc: Arc) -> tuple[Arc, LimitArc | None]:
        """The next arc, and the limit on the way to it.

        Lengths grow where Newton converges fast. They are cut where a step fails, or where there
        must be a limit point within it that is not found: a path that leads back to lower loads
        passes one.
        """
        newton, length = self.arcs.newton, arc.length
        for _ in range(MOST_CUTS):
            follows = self.arcs.step(arc, length)
            between = None if follows.failure else limit_between(self.arcs, arc, follows)
            if not follows.failure and not (between and between.unresolved):
                return follows, between
            behind = over_kink(self.arcs, arc, length)
            if behind is not None:
                return behind, None
            newton.effort.refused_steps += 1
            length *= newton.options.cut
        return follows.failed(follows.failure or "a limit point is not resolved"), None


MOST_CUTS = 8
