"""Volume control: the pressure in a cavity of given volume.

Beyond a limit point of the pressure a body may have no stable equilibrium at constant pressure, but
still one at constant volume, as with a syringe instead of a pressure regulator.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from solver.input_types import check_number, numbers
from solver.nonlinear.call_checks import check_call
from solver.nonlinear.checkpoint import Effort
from solver.nonlinear.events import Listener
from solver.nonlinear.loading import Loading
from solver.nonlinear.newton import Newton
from solver.nonlinear.options import FIRST_STEP, SolverOptions
from solver.paths.bordering import equilibrium_point
from solver.paths.load_stepping import solve
from solver.paths.outcome import AtStop, Path, Points, figures, solution_of
from solver.paths.step_control import Segment, StepControl, follow
from solver.paths.volume.changes import Change, ChangeKind, changes_between, turning
from solver.paths.volume.checks import (
    check_changeable,
    check_closed,
    check_volumes,
    seen_sign,
    signed_targets,
    volume_at_start,
)
from solver.paths.volume.held import HeldVolume, at_volume
from solver.problem.contacts import bodies_move
from solver.problem.problem import Problem
from solver.results.solution import PathPoint, Solution


def inflate(
    problem: Problem,
    volume: float,
    options: SolverOptions | None = None,
    listener: Listener | None = None,
    stops: Sequence[float] = (),
    after: Solution | None = None,
) -> Solution:
    """Equilibrium of ``problem`` at a given volume inside its pressurised surfaces.

    The pressure is an unknown. Dead loads and prescribed motions are applied first, wholly and at
    no pressure, as ``solve(problem)`` does; they stay while the volume changes from what it is
    then. Points of that part of the path have a ``load`` of 1.

    They need not be stable at constant pressure (their ``stable``), nor at a held volume (their
    ``stable_at_volume``): where other shapes branch off, the path may follow any of them. The
    message names the pressure at which stability at constant pressure is lost, which is found and
    has a point, and so is ``limit``; and the first place where another branch begins. Such places
    are the ``bifurcations``. One counts as such where the number of unstable modes at the held
    volume changes, or where the path turns sharply (not looked for where surfaces may touch or
    films may wrinkle, which turns a path too).

    Args:
        problem: body, supports, loads; at least one surface is pressurised.
        volume: inside the pressurised surfaces, mm^3; of a symmetric part as ``enclosed_volume``
            defines it. Of surfaces that face outwards, under pressure from outside, the volume of
            the body within them, with holes in it: ``cavity_volume`` gives it with a minus sign;
            either sign is taken, and points of the path have the same.
        options: tolerances and sizes of steps, which are fractions of the change of volume.
        listener: is called with an ``Event`` after each correction.
        stops: volumes before ``volume``, mm^3, at each of which the path has a point and
            ``at_stops`` a solution.
        after: an equilibrium of a stage before, to start from at its pressure, as for ``solve``.
            Other loads and supports than those of that stage are applied first, at that pressure.

    Returns:
        The last equilibrium found; ``pressure`` is the one that the volume takes.

    Raises:
        SolverError: no pressurised surface, a free rim of it or an opening that slides in a plane
            normal to y elsewhere than at y = 0, a volume inside that cannot change, volumes of the
            wrong sign, or not in order between the one at no pressure and ``volume``.

    Examples:
        >>> from solver import Ogden, Problem, Supports, inflate
        >>> from solver.mesh import block
        >>> shell = block((5, 5, 5), (3, 3, 3), hollow=((0, 0, 0), (2, 2, 2)))  # 37 mm^3 of air
        >>> held = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2})
        >>> blown = inflate(Problem(shell, Ogden.neo_hooke(0.5), held, ("cavity",)), 300.0)
        >>> highest = max(point.pressure for point in blown.path)
        >>> print(f"{blown.pressure:.2f} MPa, before {highest:.2f} MPa")
        0.19 MPa, before 0.20 MPa
    """
    start = time.perf_counter()
    check_call(problem, options, listener, after)
    check_number("inflate: volume", volume)
    volumes = (*numbers("inflate: stops", stops), float(volume))
    check_volumes(volumes)
    check_closed(problem)
    options = options or SolverOptions()
    loaded = _loaded(problem, options, listener, after)
    if loaded is not None and not loaded.converged:
        return replace(loaded, message=f"the loads before the volume: {loaded.message}")
    newton = _newton(problem, loaded, options, listener, after)
    walk = _walked(newton, volumes, loaded)
    return replace(_solution(newton, walk), seconds=time.perf_counter() - start)


def _loaded(
    problem: Problem, options: SolverOptions, listener: Listener | None, after: Solution | None
) -> Solution | None:
    """The body under its dead loads and motions before its volume changes; None if unloaded."""
    if after is not None and _goes_on(problem, after.problem):
        start = replace(after, path=after.path[-1:], converged=True, seconds=0.0)
        return replace(start, newton_iterations=0, factorizations=0, load_steps=0, refused_steps=0)
    led = problem.supports.prescribed or bodies_move(problem.contacts)
    if problem.loads or led or after is not None:
        pressure = Loading.of(problem, 0.0, after).pressures[0]
        return solve(problem, pressure, options, listener, after=after)
    return None


def _goes_on(problem: Problem, former: Problem) -> bool:
    """Whether a stage is in equilibrium where the one before ended, and leads nothing on."""
    ours, theirs = (
        (
            each.material,
            each.materials,
            each.loads,
            each.supports,
            set(each.pressurised),
            each.contacts,
            each.springs,
            each.membranes,
        )
        for each in (problem, former)
    )
    return ours == theirs and not problem.supports.prescribed and not bodies_move(problem.contacts)


def _newton(
    problem: Problem,
    loaded: Solution | None,
    options: SolverOptions,
    listener: Listener | None,
    after: Solution | None,
) -> Newton:
    """For a load that is the pressure in MPa, from a loaded body on, whose effort counts."""
    loading = replace(Loading.of(problem, 1.0, after), constant=True, pressures=(0.0, 1.0))
    if loaded is None:
        return Newton(problem, loading, options, listener)
    counts = (loaded.newton_iterations, loaded.factorizations)
    effort = Effort(*counts, loaded.load_steps, loaded.refused_steps)
    newton = Newton(problem, replace(loading, start=loaded.state), options, listener, effort)
    newton.budget.began -= loaded.seconds
    return newton


@dataclass(frozen=True)
class Passed:
    """A change that a path has passed, at a ``point`` of it."""

    kind: ChangeKind
    point: PathPoint


@dataclass(frozen=True)
class Step:
    """The outcome of a step: an equilibrium ``held``, with the ``changes`` on the way to it.

    ``turning``: of the path on that way, rad/mm^3; None if there was none.
    """

    held: HeldVolume
    changes: tuple[Change, ...] = ()
    turning: float | None = None

    @property
    def failure(self) -> str:
        """Why there is no equilibrium."""
        return self.held.failure


@dataclass
class VolumeStepper:
    """Steps of the volume (mm^3, signed) for ``follow``.

    ``sign``: of volumes that a user sees against signed ones; ``passed``: the changes so far, in
    the order of the path, and their points.
    """

    newton: Newton
    sign: float
    passed: list[Passed] = field(default_factory=list)

    def attempt(self, segment: Segment[Step], target: float) -> Step:
        """The equilibrium with the ``target`` volume, counted."""
        before = segment.reached
        held = self._not_passed(before.held, at_volume(self.newton, before.held, target))
        if held.failure:
            self.newton.effort.refused_steps += 1
            return Step(held)
        self.newton.effort.load_steps += 1
        changes = changes_between(self.newton, before.held, held, before.turning)
        return Step(held, changes, turning(before.held, held))

    def _not_passed(self, before: HeldVolume, held: HeldVolume) -> HeldVolume:
        """``held``, failed if bodies have passed through each other on the way to it."""
        here, there = before.found, held.found
        failure = there.failure or self.newton.passed(
            here.state, here.load, there.state, there.load
        )
        return replace(held, found=replace(there, failure=failure))

    def accepted(self, segment: Segment[Step]) -> Segment[Step]:
        """The segment with points for its end and for the changes before it."""
        step = segment.reached
        end, points = self.point(step.held), list[PathPoint]()
        for change in step.changes:
            points.append(end if change.at is step.held else self.point(change.at))
            self.passed.append(Passed(change.kind, points[-1]))
        inner = [point for point in points if point is not end]
        return replace(segment, points=(*segment.points, *inner, end))

    def refused(self, segment: Segment[Step], refusals: int) -> Segment[Step]:
        """The segment unchanged."""
        return segment

    def exhausted(self) -> str:
        """Why no further step may be tried: the solve's budget is spent."""
        return self.newton.exhausted()

    def point(self, held: HeldVolume) -> PathPoint:
        """Describe an equilibrium; all loads but the pressure act wholly."""
        found = held.found
        point = self.newton.point(found.state, found.load, found.iterations, found.stable)
        return replace(self.seen(point), load=1.0, stable_at_volume=held.stable)

    def seen(self, point: PathPoint) -> PathPoint:
        """A point with the user's sign of volumes."""
        return replace(point, volume=self.sign * point.volume)


@dataclass(frozen=True)
class Walk:
    """A volume-controlled path of ``stepper`` as far as its last ``segment``.

    ``end``: where it goes, mm^3, signed; ``at_stops``: what it reached, the end included.
    """

    stepper: VolumeStepper
    segment: Segment[Step]
    end: float
    points: Points
    at_stops: tuple[AtStop, ...] = ()


def _walked(newton: Newton, volumes: tuple[float, ...], loaded: Solution | None) -> Walk:
    """From the volume of the ``loaded`` or unloaded body through ``volumes``."""
    state, rest, options = newton.loading.start, volume_at_start(newton), newton.options
    stepper = VolumeStepper(newton, seen_sign(rest, volumes[-1]))
    targets = signed_targets(rest, stepper.sign, volumes)
    pressure = loaded.pressure if loaded else 0.0
    held = HeldVolume.of(newton, equilibrium_point(newton, state, pressure), rest)
    check_changeable(newton, held)
    step = (options.first_step or FIRST_STEP) * abs(targets[-1] - rest)
    segment = Segment(Step(held), rest, step)
    before = [stepper.seen(point) for point in loaded.path] if loaded else [stepper.point(held)]
    walk = Walk(stepper, segment, targets[-1], tuple(before))
    for target in targets:
        walk = _extended(walk, target, options)
        if walk.segment.failure:
            break
    return walk


def _extended(walk: Walk, target: float, options: SolverOptions) -> Walk:
    """A path followed on to a volume, as far as steps succeed."""
    smallest = options.smallest_step * _scale(walk.segment.position, target)
    control = StepControl(options.growth, options.cut, smallest)
    segment = follow(walk.stepper, replace(walk.segment, points=()), target, control)
    points = (*walk.points, *segment.points)
    reached = () if segment.failure else (AtStop(segment.reached.held.found.state, points),)
    return replace(walk, segment=segment, points=points, at_stops=(*walk.at_stops, *reached))


def _scale(here: float, target: float) -> float:
    """Of steps from a volume to another: a goal far off does not make the smallest one coarse."""
    return min(abs(target - here), abs(here) or np.inf)


def _solution(newton: Newton, walk: Walk) -> Solution:
    """The solution at a path's end."""
    segment, stepper = walk.segment, walk.stepper
    state, failure = segment.reached.held.found.state, segment.failure
    inner = walk.at_stops if failure else walk.at_stops[:-1]
    end = solution_of(newton, Path(state, walk.points, failure, at_stops=inner), 0.0)
    share = f"{stepper.sign * segment.position:.6g} of {stepper.sign * walk.end:.6g} mm³"
    at_stops = tuple(
        _told(stop, stepper.passed, f"reached {stop.path[-1].volume:.6g} mm³")
        for stop in end.at_stops
    )
    reached = "stopped at" if failure else "reached"
    return replace(_told(end, stepper.passed, f"{reached} {share}", failure), at_stops=at_stops)


def _told(
    solution: Solution, passed: Sequence[Passed], reached: str, failure: str = ""
) -> Solution:
    """A solution that says, in its message too, what its path has passed."""
    passed = [each for each in passed if each.point in solution.path]
    lost = next((each.point for each in passed if each.kind != "turn"), None)
    branches = [each for each in passed if each.kind != "extremum"]
    message = f"{reached}, at {figures(solution.pressure)} MPa"
    message += f": {failure}" if failure else ""
    if lost is not None:
        at = f"{figures(lost.pressure)} MPa, at {lost.volume:.6g} mm³"
        message += f"; at constant pressure it is unstable beyond {at}"
    message += _of_branch(branches[0]) if branches else ""
    return replace(
        solution,
        message=f"{message}.",
        load=1.0,
        limit=None if lost is None else lost.pressure,
        bifurcations=tuple(each.point for each in branches),
    )


def _of_branch(passed: Passed) -> str:
    """That another branch begins on the path, as text."""
    point = passed.point
    at = f"{point.volume:.6g} mm³ and {figures(point.pressure)} MPa"
    if passed.kind == "bifurcation" and point.stable_at_volume is False:
        return f"; from {at} on it is unstable at a held volume too: another branch begins there"
    return f"; at {at} it turns onto another branch"
