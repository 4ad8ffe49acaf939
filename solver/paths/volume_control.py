"""Volume control: the pressure in a cavity of given volume.

Beyond a limit point of the pressure a body may have no stable equilibrium at constant pressure, but
still one at constant volume, as with a syringe instead of a pressure regulator.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from solver.arrays import Reals
from solver.assembly.assembly import Equilibrium
from solver.assembly.pressure import enclosed_volume
from solver.assembly.state import State
from solver.errors import SolverError
from solver.nonlinear.events import Listener
from solver.nonlinear.loading import Loading
from solver.nonlinear.newton import Newton
from solver.nonlinear.options import FIRST_STEP, SolverOptions
from solver.paths.bordering import EquilibriumPoint, corrected, equilibrium_point
from solver.paths.outcome import Path, solution_of
from solver.paths.step_control import Segment, StepControl, follow
from solver.problem.problem import Problem
from solver.results.solution import PathPoint, Solution


def inflate(
    problem: Problem,
    volume: float,
    options: SolverOptions | None = None,
    listener: Listener | None = None,
    stops: Sequence[float] = (),
) -> Solution:
    """Equilibrium of ``problem`` at a given volume inside its pressurised surfaces.

    The pressure is an unknown. Points of the path need not be stable at constant pressure: see
    their ``stable``.

    Args:
        problem: body and supports; its only load is the pressure.
        volume: inside the pressurised surfaces, mm^3; of a symmetric part as ``enclosed_volume``
            defines it.
        options: tolerances and sizes of steps, which are fractions of the change of volume.
        listener: is called with an ``Event`` after each correction.
        stops: volumes before ``volume``, mm^3, at each of which the path has a point.

    Returns:
        The last equilibrium found; ``pressure`` is the one that the volume takes.

    Raises:
        SolverError: other loads than pressure, volumes that are not positive, or not in order
            between the undeformed one and ``volume``.
    """
    start = time.perf_counter()
    if problem.loads or problem.supports.prescribed or not problem.pressurised:
        raise SolverError("inflate: the problem's only load must be the pressure in a cavity.")
    newton = Newton(problem, Loading.of(problem, 1.0), options or SolverOptions(), listener)
    segment, points = _followed(newton, volume, stops)
    end, failure = segment.reached, segment.failure
    solution = solution_of(newton, Path(end.state, points, failure), 0.0)
    share = f"{segment.position:.6g} of {volume:.6g} mm³, at {end.load:.4g} MPa"
    message = f"stopped at {share}: {failure}" if failure else f"reached {share}"
    message += _stability(points)
    return replace(solution, message=message, load=1.0, seconds=time.perf_counter() - start)


def _followed(
    newton: Newton, volume: float, stops: Sequence[float]
) -> tuple[Segment[EquilibriumPoint], tuple[PathPoint, ...]]:
    """From the undeformed volume through ``stops`` to ``volume``: last segment and path."""
    options, still = newton.options, newton.loading.start
    rest = _volume(newton, still)
    points: tuple[PathPoint, ...] = (newton.point(still, 0.0, 0, True),)
    step = (options.first_step or FIRST_STEP) * abs(volume - rest)
    segment = Segment(equilibrium_point(newton, still, 0.0), rest, step)
    for target in _targets(rest, volume, stops):
        smallest = options.smallest_step * abs(target - segment.position)
        control = StepControl(options.growth, options.cut, smallest)
        segment = follow(VolumeStepper(newton), replace(segment, points=()), target, control)
        points += segment.points
        if segment.failure:
            break
    return segment, points


def _stability(points: tuple[PathPoint, ...]) -> str:
    """Up to which pressure the points are stable at constant pressure, as text."""
    lost = next((number for number, point in enumerate(points) if point.stable is False), None)
    if lost is None:
        return "."
    return f"; at constant pressure it is unstable beyond {points[lost - 1].pressure:.4g} MPa."


@dataclass(frozen=True)
class VolumeStepper:
    """Steps of the volume (mm^3) for ``follow``."""

    newton: Newton

    def attempt(self, segment: Segment[EquilibriumPoint], target: float) -> EquilibriumPoint:
        """The equilibrium with the ``target`` volume, counted."""
        found = _step(self.newton, segment.reached, segment.position, target)
        if found.failure:
            self.newton.effort.refused_steps += 1
        else:
            self.newton.effort.load_steps += 1
        return found

    def accepted(self, segment: Segment[EquilibriumPoint]) -> Segment[EquilibriumPoint]:
        """The segment with a point for its end."""
        found = segment.reached
        point = self.newton.point(found.state, found.load, found.iterations, found.stable)
        return replace(segment, points=(*segment.points, point))

    def refused(
        self, segment: Segment[EquilibriumPoint], refusals: int
    ) -> Segment[EquilibriumPoint]:
        """The segment unchanged."""
        return segment

    def exhausted(self) -> str:
        """Why no further step may be tried: the solve's budget is spent."""
        return self.newton.exhausted()


def _step(newton: Newton, here: EquilibriumPoint, volume: float, wanted: float) -> EquilibriumPoint:
    """From an equilibrium to the one with the ``wanted`` volume.

    The volume's derivative is minus ``force``: the residual is that of Pi - p V.
    """
    assert here.direction is not None and here.force is not None
    change = (volume - wanted) / float(here.force @ here.direction)
    guess = newton.kinematics.advanced(here.state, newton.system.expanded(here.direction), change)

    def row(state: State, equilibrium: Equilibrium, r: Reals, d: Reals) -> float:
        excess = _volume(newton, state) - wanted
        return (excess - float(equilibrium.force @ r)) / float(equilibrium.force @ d)

    return corrected(newton, guess, here.load + change, row)


def _volume(newton: Newton, state: State) -> float:
    problem = newton.problem
    return enclosed_volume(problem.mesh, state.displacement, problem.pressurised)


def _targets(rest: float, volume: float, stops: Sequence[float]) -> list[float]:
    """Volumes with points, in order from that of the undeformed body."""
    down = volume < rest
    targets = sorted({float(v) for v in (*stops, volume)}, reverse=down)
    finite = all(np.isfinite(targets)) and all(target > 0 for target in targets)
    if not finite or targets[-1] != volume or (targets[0] - rest) * (volume - rest) < 0:
        raise SolverError(
            f"inflate: volumes must be positive and lie between the {rest:.6g} mm³ at rest and "
            f"the last one, got {list(stops)} and {volume:g} mm³."
        )
    return targets
