"""Load steps: adaptive from zero, or a start at the whole load, along stable equilibria."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import astuple, dataclass, replace

import numpy as np

from solver.arrays import Reals
from solver.assembly.state import State
from solver.errors import SolverError
from solver.input_types import check_function, check_number, numbers, shown
from solver.nonlinear.attempts import Attempt
from solver.nonlinear.call_checks import check_call, check_initial
from solver.nonlinear.checkpoint import Checkpoint, Effort
from solver.nonlinear.events import Guard, Listener
from solver.nonlinear.loading import Loading
from solver.nonlinear.newton import Newton
from solver.nonlinear.options import FIRST_STEP, SolverOptions
from solver.numerics.first_run import compilation_clock
from solver.paths.outcome import AtStop, Path, Points, solution_of
from solver.paths.step_control import Segment, StepControl, follow
from solver.paths.stopping import corrected, stopped
from solver.problem.problem import Problem
from solver.results.solution import PathPoint, Solution

SHORT_STEP = 0.03
"""Fraction of the load; a shorter step is solved to the full tolerance."""

UNLOADING = (0.97, 0.9, 0.8, 0.65, 0.5)
"""Fractions of the load at which the guard is asked again after it refused the whole load."""

JUMP_RATIO = 4.0
"""Ratio of actual to predicted displacement beyond which a state lies on another branch."""

SHORTEST_JUMP = 0.02
"""Displacement, in body diagonals, to which the ratio may be exceeded on the same branch."""


def solve(
    problem: Problem,
    pressure: float = 0.0,
    options: SolverOptions | None = None,
    listener: Listener | None = None,
    initial: tuple[Reals, Reals] | None = None,
    stops: Sequence[float] = (),
    resume: Checkpoint | None = None,
    guard: Guard | None = None,
    after: Solution | None = None,
    keep: Callable[[Newton], None] | None = None,
) -> Solution:
    """Equilibrium of ``problem`` under ``pressure``, reached from zero load.

    Dead loads and prescribed motions of the problem grow with the pressure. A load that cannot be
    reached gives the last equilibrium found, with ``converged`` False and a ``message``, never a
    diverged state; ``limit`` is the pressure of a limit point that caused it.

    Args:
        problem: body, supports and loads.
        pressure: on the pressurised surfaces, MPa.
        options: sizes of steps and tolerances.
        listener: is called with an ``Event`` after each correction and each load step.
        initial: displacement and hydrostatic pressure, for instance from ``transfer``. Newton's
            method starts there at the whole load; should that fail, the load is applied in steps.

            *Shape:* (n, 3) in mm, (v,) in MPa.
        stops: pressures in MPa (fractions of the load where there is no pressure) before
            ``pressure`` at which the path has a point: reached with increasing load, or with
            decreasing load after a start at the whole load.
        resume: a checkpoint that a listener was given on an earlier run of the same problem,
            pressure, options and stops. The path continues from there, with the same bits (unless
            the first run corrected the checkpoint's state once more, to the full tolerance; with
            ``SurfaceContact`` to rounding).
        guard: is asked for every equilibrium whether it is accepted. The path stops before the
            first that is not, located to the options' ``smallest_step``, for the reason that the
            guard gives; ``stopped_by`` is then ``guard``.
        after: an equilibrium of a stage before, on the same mesh, from which this path starts in
            place of the undeformed body. Along the path the loads change from those of that stage
            to those of ``problem``, in proportion; its supports hold nodes where they are at the
            start, and lead them on from there; supports that it does not have let go step by step.
        keep: is given at the end what the solve leaves, the last factorization with it, for
            derivatives (``gradients``) or a neighbouring solve; it takes memory.

    Returns:
        The last equilibrium found, with the path to it.

    Raises:
        SolverError: invalid input, or numbers that are not finite.

    Examples:
        >>> from solver import Ogden, Problem, Supports, rotation, solve
        >>> from solver.mesh import block
        >>> beam = block((40, 8, 8), (10, 4, 4), hollow=((1, 1, 2), (9, 3, 3)))  # above the middle
        >>> rubber = Ogden.neo_hooke(0.5)
        >>> problem = Problem(beam, rubber, Supports(clamped=("x0",)), pressurised=("cavity",))
        >>> solution = solve(problem, pressure=0.1)
        >>> print(f"{rotation(beam, solution.displacement, 'x1'):.2f} degrees")
        0.78 degrees
    """
    check_call(problem, options, listener, after, resume)
    check_initial(initial)
    check_function("guard", guard, "a State")
    check_function("keep", keep, "what a solve leaves")
    check_number("pressure", pressure)
    if not np.isfinite(pressure):
        raise SolverError(f"pressure must be a finite number of MPa, got {pressure}.")
    start = time.perf_counter()
    with compilation_clock() as compiling:
        newton, path = _solved(
            problem, float(pressure), options, listener, initial, stops, resume, guard, after
        )
    if keep is not None:
        keep(newton)
    return solution_of(newton, path, time.perf_counter() - start - compiling.seconds)


def _solved(
    problem: Problem,
    pressure: float,
    options: SolverOptions | None,
    listener: Listener | None,
    initial: tuple[Reals, Reals] | None,
    stops: Sequence[float],
    resume: Checkpoint | None,
    guard: Guard | None,
    after: Solution | None,
) -> tuple[Newton, Path]:
    """The path of a solve, and what it was found with."""
    loading = Loading.of(problem, pressure, after)
    loads = _stops(stops, loading)
    newton = Newton(problem, loading, options or SolverOptions(), listener)
    path = None
    if resume is not None:
        path = _loaded(newton, loads, *_resumed(newton, resume), guard)
    elif initial is not None:
        path = _from_whole_load(newton, newton.kinematics.start(*initial), loads, guard)
    if path is None:
        path = _loaded(newton, loads, *_from_zero(newton), guard)
    return newton, path


@dataclass(frozen=True)
class LoadStepper:
    """Steps of the load for ``follow``; ``end``: the final load, ``before``: the path so far."""

    newton: Newton
    end: float
    before: Points = ()
    guard: Guard | None = None

    def attempt(self, segment: Segment[Attempt], target: float) -> Attempt:
        """One step to a load, counted, and reported if it is rejected."""
        newton, reached, load = self.newton, segment.reached, segment.position
        if reached.direction is None:
            reached = newton.departing(reached.state, load)
        exact = target == self.end or abs(target - load) < SHORT_STEP
        tolerance = newton.options.tolerance if exact else newton.loose_tolerance
        guess = newton.predicted(reached, load, target)
        attempt = newton.correct(guess, target, tolerance, onward=target != 1.0)
        led = newton.led_by_bodies(load, target)
        failure = attempt.failure or _jumped(newton, reached.state, guess, attempt.state, led)
        failure = failure or newton.passed(reached.state, load, attempt.state, target)
        attempt = guarded(replace(attempt, failure=failure), self.guard)
        if attempt.failure:
            newton.effort.refused_steps += 1
            newton.notify("refused", target, reached.state, attempt.iterations, np.inf)
            return attempt
        newton.effort.load_steps += 1
        return attempt

    def accepted(self, segment: Segment[Attempt]) -> Segment[Attempt]:
        """The segment with a point; the listener gets a checkpoint."""
        newton, reached, load = self.newton, segment.reached, segment.position
        point = newton.point(reached.state, load, reached.iterations, newton.system.stable)
        segment = replace(segment, points=(*segment.points, point))
        _report(newton, segment, (*self.before, *segment.points))
        return segment

    def refused(self, segment: Segment[Attempt], refusals: int) -> Segment[Attempt]:
        """After two rejections the start may be too inaccurate: it is corrected once more."""
        return _recorrected(self.newton, segment) if refusals == 2 else segment

    def exhausted(self) -> str:
        """Why no further step may be tried: the solve's budget is spent."""
        return self.newton.exhausted()


def guarded(attempt: Attempt, guard: Guard | None) -> Attempt:
    """An attempt, failed if ``guard`` does not accept its equilibrium."""
    reason = "" if attempt.failure or guard is None else guard(attempt.state)
    if reason is not None and not isinstance(reason, str):
        raise SolverError(
            "guard must return why a state is not accepted, as text, or an empty text; "
            f"got {shown(reason)}."
        )
    return replace(attempt, failure=reason, guarded=True) if reason else attempt


def _stops(pressures: Sequence[float], loading: Loading) -> tuple[float, ...]:
    """Pressures, or without one fractions of the load, as ascending fractions within (0, 1)."""
    (start, pressure), rate = loading.pressures, loading.pressure_rate
    stops = numbers("stops", pressures)
    loads = sorted({(stop - start) / rate if rate else stop for stop in stops})
    if not all(0 < load <= 1 + 1e-12 for load in loads):
        end = (
            f"{start:g} and the pressure of {pressure:g} MPa" if rate else "0 and the whole load, 1"
        )
        raise SolverError(f"stops must lie between {end}, got {[*stops]}.")
    return tuple(load for load in loads if load < 1 - 1e-12)


def _from_whole_load(
    newton: Newton, initial: State, stops: tuple[float, ...], guard: Guard | None
) -> Path | None:
    """Newton's method at the whole load, then down through ``stops``; None if that fails."""
    attempt = newton.correct(initial, 1.0, newton.options.tolerance)
    failure = attempt.failure or newton.passed(initial, 1.0, attempt.state, 1.0)
    attempt = guarded(replace(attempt, failure=failure), guard)
    if attempt.guarded:
        return _up_to_guard(newton, attempt.state, stops, guard)
    if attempt.failure:
        newton.effort.refused_steps += 1
        newton.notify("refused", 1.0, initial, attempt.iterations, np.inf)
        return None
    newton.effort.load_steps += 1
    points: Points = (newton.point(attempt.state, 1.0, attempt.iterations, newton.system.stable),)
    segment = Segment(attempt, 1.0, 1.0)
    reached: tuple[AtStop, ...] = ()
    for stop in reversed(stops):
        segment = _followed(newton, replace(segment, points=()), stop, guard=guard)
        if segment.failure:
            return None
        points = (*reversed(segment.points), *points)
        reached = (AtStop(segment.reached.state, points[:1]), *reached)
    return Path(attempt.state, (_unloaded(newton), *points), at_stops=reached)


def _up_to_guard(
    newton: Newton, state: State, stops: tuple[float, ...], guard: Guard | None
) -> Path | None:
    """From the whole load down to an equilibrium that the guard accepts, and up to the last one."""
    start = _unloaded(newton)
    for load in UNLOADING:
        found = newton.correct(state, load, newton.options.tolerance, onward=True)
        if found.failure:
            return None
        state = found.state
        if not guarded(found, guard).failure:
            point = newton.point(state, load, found.iterations, newton.system.stable)
            return _loaded(newton, stops, Segment(found, load, SHORT_STEP), (start, point), guard)
    return None


def _unloaded(newton: Newton) -> PathPoint:
    """The point at no load; whether another stage ended stable is not known here."""
    undeformed = not len(newton.loading.supports_from)
    return newton.point(newton.loading.start, 0.0, 0, True if undeformed else None)


def _from_zero(newton: Newton) -> tuple[Segment[Attempt], Points]:
    """Before the first step: the unloaded body."""
    start = newton.departing(newton.loading.start, 0.0)
    points = (newton.point(start.state, 0.0, 0, newton.system.stable),)
    return Segment(start, 0.0, _first_step(newton, start)), points


def _first_step(newton: Newton, start: Attempt) -> float:
    """The first step by the options, or by the body's motion, as a fraction of the load."""
    if newton.options.first_step is not None or not newton.extrapolation.slender:
        return newton.options.first_step or FIRST_STEP
    assert start.direction is not None
    speed = newton.kinematics.longest(start.state, start.direction)
    return min(1.0, newton.problem.mesh.size / speed) if speed else 1.0


def _resumed(newton: Newton, checkpoint: Checkpoint) -> tuple[Segment[Attempt], Points]:
    """After the step of a checkpoint."""
    reached = checkpoint.reached
    newton.kinematics.check_shapes(reached.displacement, reached.hydrostatic_pressure)
    newton.effort = Effort(*checkpoint.effort)
    attempt = Attempt(reached, 0, direction=checkpoint.direction)
    return Segment(attempt, checkpoint.load, checkpoint.step), checkpoint.points


def _loaded(
    newton: Newton,
    stops: tuple[float, ...],
    segment: Segment[Attempt],
    points: Points,
    guard: Guard | None,
) -> Path:
    """Load increased from a segment's end through ``stops``; ``points``: the path so far."""
    reached: tuple[AtStop, ...] = ()
    for stop in (*(stop for stop in stops if stop > segment.position), 1.0):
        segment = _followed(newton, replace(segment, points=()), stop, points, guard)
        points += segment.points
        if segment.failure:
            return replace(stopped(newton, segment, points), at_stops=reached)
        reached += (AtStop(segment.reached.state, points),)
    return Path(segment.reached.state, points, at_stops=reached[:-1])


def _followed(
    newton: Newton,
    segment: Segment[Attempt],
    end: float,
    before: Points = (),
    guard: Guard | None = None,
) -> Segment[Attempt]:
    """Adaptive load steps to ``end``: predict along the tangent, correct, grow or cut the step."""
    stepper = LoadStepper(newton, end, before, guard)
    return follow(stepper, segment, end, StepControl.of_loads(newton.options))


def _recorrected(newton: Newton, segment: Segment[Attempt]) -> Segment[Attempt]:
    """The segment with its end corrected to the full tolerance, if that succeeds."""
    state, load = segment.reached.state, segment.position
    better = newton.correct(state, load, newton.options.tolerance, onward=True)
    if better.failure:
        return segment
    points = corrected(newton, better, load, segment.points)
    return replace(segment, reached=better, points=points)


def _jumped(newton: Newton, before: State, predicted: State, found: State, led: float) -> str:
    """Why a state is not the continuation of the path, as after a snap-through; else empty.

    ``led``: how far rigid bodies move, mm, which no prediction knows before they touch.
    """
    expected = max(float(np.abs(predicted.displacement - before.displacement).max()), led)
    moved = np.abs(found.displacement - before.displacement).max()
    size = newton.problem.mesh.size
    if moved > JUMP_RATIO * expected + SHORTEST_JUMP * size:
        return "the next stable state is far away"
    return ""


def _report(newton: Newton, segment: Segment[Attempt], points: Points) -> None:
    """Notify the listener of a step, with a checkpoint to resume from."""
    if newton.listener is None:
        return
    reached, load = segment.reached, segment.position
    direction = reached.direction or State.zero(newton.problem)  # none at the whole load
    effort = astuple(newton.effort)
    checkpoint = Checkpoint(reached.state, load, segment.step, direction, points, effort)
    newton.notify("step", load, reached.state, points[-1].iterations, 0.0, checkpoint)
