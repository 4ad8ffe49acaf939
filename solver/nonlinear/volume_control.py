"""Volume control: how much pressure a cavity of a given volume takes.

A syringe instead of a regulator: past a limit point, where no pressure holds the body any more, a
volume still does.
"""

from __future__ import annotations

import math
import time
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from solver.arrays import Reals
from solver.assembly.assembly import Equilibrium
from solver.assembly.pressure import enclosed_volume
from solver.assembly.state import State
from solver.errors import SolverError
from solver.nonlinear.bordering import Station, corrected, station
from solver.nonlinear.load_stepping import Walk, solution_of
from solver.nonlinear.newton import FIRST_STEP, Listener, Newton, SolverOptions
from solver.problem.problem import Problem
from solver.results.solution import PathPoint, Solution


def inflate(
    problem: Problem,
    volume: float,
    options: SolverOptions | None = None,
    listener: Listener | None = None,
    stops: Sequence[float] = (),
) -> Solution:
    """Equilibrium of ``problem`` with ``volume`` (mm^3) inside its pressurised surfaces.

    ``Solution.pressure`` is the pressure that takes. Steps are fractions of the change of volume;
    the path has a point at each of the volumes ``stops`` on the way. Its points need not be stable
    while the pressure is held: each says so. For the volume of a symmetric part see
    ``enclosed_volume``. Raises ``SolverError`` for a problem with other loads than
    pressure, and for volumes out of order.
    """
    start = time.perf_counter()
    if problem.loads or problem.supports.prescribed or not problem.pressurised:
        raise SolverError("inflate: the problem's only load must be the pressure in a cavity.")
    newton = Newton(problem, 1.0, options or SolverOptions(), listener)
    leg = _Leg(station(newton, State.zero(problem), 0.0), _volume(newton, State.zero(problem)))
    path: tuple[PathPoint, ...] = (newton.point(leg.reached.state, 0.0, 0, True),)
    leg = replace(leg, step=(newton.options.first_step or FIRST_STEP) * abs(volume - leg.volume))
    for target in _targets(leg.volume, volume, stops):
        leg = _to(newton, target, leg)
        path += leg.points
        if leg.failure:
            break
    solution = solution_of(newton, Walk(leg.reached.state, path, leg.failure), 0.0)
    share = f"{leg.volume:.6g} of {volume:.6g} mm³, at {leg.reached.load:.4g} MPa"
    told = f"stopped at {share}: {leg.failure}" if leg.failure else f"reached {share}"
    told += _stability(path)
    return replace(solution, message=told, load=1.0, seconds=time.perf_counter() - start)


def _stability(path: tuple[PathPoint, ...]) -> str:
    """Up to where the body would have stayed under a pressure that is held."""
    lost = next((number for number, point in enumerate(path) if point.stable is False), None)
    if lost is None:
        return "."
    return f"; a held pressure would have lost it beyond {path[lost - 1].pressure:.4g} MPa."


@dataclass(frozen=True)
class _Leg:
    """Part of a way: the ``volume`` (mm^3) reached, the next step, points on it, why it stopped."""

    reached: Station
    volume: float
    step: float = 0.0
    points: tuple[PathPoint, ...] = ()
    failure: str = ""


def _to(newton: Newton, target: float, leg: _Leg) -> _Leg:
    """Adaptive steps of the volume to ``target``: predict, correct, grow or cut the step."""
    options, smallest = newton.options, newton.options.smallest_step * abs(target - leg.volume)
    reached, volume, step = leg.reached, leg.volume, leg.step
    points: tuple[PathPoint, ...] = ()
    while volume != target:
        last = abs(target - volume) <= step * (1 + 1e-9)
        wanted = target if last else volume + math.copysign(step, target - volume)
        found = _step(newton, reached, volume, wanted)
        if found.failure:
            newton.effort.refused_steps += 1
            step = options.cut * abs(wanted - volume)
            if step < smallest:
                return _Leg(reached, volume, step, points, found.failure)
            continue
        step = max(step, options.growth * abs(wanted - volume))
        reached, volume = found, wanted
        newton.effort.load_steps += 1
        points += (newton.point(found.state, found.load, found.iterations, found.stable),)
    return _Leg(reached, volume, step, points)


def _step(newton: Newton, here: Station, volume: float, wanted: float) -> Station:
    """From an equilibrium to the one with the ``wanted`` volume.

    The volume's derivative is minus ``force``: the residual is that of Pi - p V.
    """
    assert here.direction is not None and here.force is not None
    change = (volume - wanted) / float(here.force @ here.direction)
    guess = newton.advance(here.state, newton.expanded(here.direction), change)

    def row(state: State, equilibrium: Equilibrium, r: Reals, d: Reals) -> float:
        excess = _volume(newton, state) - wanted
        return (excess - float(equilibrium.force @ r)) / float(equilibrium.force @ d)

    return corrected(newton, guess, here.load + change, row)


def _volume(newton: Newton, state: State) -> float:
    problem = newton.problem
    return enclosed_volume(problem.mesh, state.displacement, problem.pressurised)


def _targets(rest: float, volume: float, stops: Sequence[float]) -> list[float]:
    """Volumes to visit, in order from that at rest."""
    down = volume < rest
    targets = sorted({float(v) for v in (*stops, volume)}, reverse=down)
    finite = all(np.isfinite(targets)) and all(target > 0 for target in targets)
    if not finite or targets[-1] != volume or (targets[0] - rest) * (volume - rest) < 0:
        raise SolverError(
            f"inflate: volumes must be positive and lie between the {rest:.6g} mm³ at rest and "
            f"the last one, got {list(stops)} and {volume:g} mm³."
        )
    return targets
