"""The actuator along the pressure path, for pages with a slider."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from bellows_design.analysis.evaluation import Evaluation
from bellows_design.analysis.models import UNIT_CELL
from bellows_design.beside import beside
from bellows_design.deformed.joined.state import ActuatorState
from bellows_design.deformed.pressure_path import same_pressure
from bellows_design.deformed.solved import SolvedBodies
from bellows_design.deformed.surface import SurfaceFrames
from bellows_design.deformed.whole import WholeSurface, whole_of
from bellows_design.errors import DesignError
from bellows_design.progress import SILENCE, Progress
from solver import Solution

MOST_FRAMES = 101


def surface_frames(found: Evaluation, count: int = 11, finest: bool = True) -> SurfaceFrames:
    """The surface from rest to the pressure that was reached, at equally spaced pressures.

    Equilibria that the evaluation kept are taken, where it was asked for these pressures; else the
    path is walked once more, from the state that was found downwards: of a cell and its ends about
    twice as long as the evaluation took, on the coarsest mesh as long.

    Args:
        found: An evaluation.
        count: Of frames; fewer where the path cannot be followed again, and one, at rest, of an
            evaluation that reached no pressure.
        finest: A cell on its finest mesh: the last frame is then that of ``deformed_surface``. Else
            on the coarsest one, whose stress is lower (``found.meshes[0]``); the angle is the
            evaluation's at its pressure in either case. Half and full models are shown on their
            coarsest mesh, with its angle.

    Raises:
        DesignError: A count that is not between 2 and 101.

    Examples:
        >>> from bellows_design import evaluate, load_design
        >>> from bellows_design.deformed import surface_frames
        >>> found = evaluate(load_design("prototype_1"))
        >>> frames = surface_frames(found, count=3, finest=False)
        >>> print(frames.pressures_mpa)  # MPa
        [0.   0.05 0.1 ]
        >>> print(abs(frames.angles_deg[-1] - found.bending_angle_deg) < 0.01)
        True
    """
    if not 2 <= count <= MOST_FRAMES:
        raise DesignError(f"count = {count} frames must lie between 2 and {MOST_FRAMES}.")
    solved = SolvedBodies.of(found, coarsest=not finest or found.model is not UNIT_CELL)
    states = _states(solved, np.linspace(0.0, found.pressure_mpa, count)[1:].tolist())
    return _frames(solved, _to_angle(found, solved, states))


def _frames(solved: SolvedBodies, states: Sequence[_AtPressure]) -> SurfaceFrames:
    ends = None if solved.ends is None else solved.ends.problem.mesh
    bellows, whole = solved.design.bellows, whole_of(solved.design, solved.body.problem.mesh, ends)
    shown, rest = WholeSurface.of(whole, bellows, solved.at_rest), solved.at_rest
    stresses = [shown.von_mises(each.state) for each in states]
    loaded = [shown.loaded(bellows, each.state) for each in states]
    return SurfaceFrames(
        shown.flat.triangles,
        np.stack([shown.at_rest(bellows, rest), *loaded]),
        np.stack([shown.von_mises(rest), *stresses]),
        np.array([0.0, *(each.pressure_mpa for each in states)]),
        np.degrees([0.0, *(each.state.angle for each in states)]),
    )


@dataclass(frozen=True)
class _AtPressure:
    """The actuator at a pressure."""

    pressure_mpa: float
    state: ActuatorState


def _states(solved: SolvedBodies, pressures: Sequence[float]) -> list[_AtPressure]:
    """The actuator at pressures (MPa), as far as body and ends can be followed to them."""
    from solver.linear.threads import may_run_side_by_side, one_thread

    if not pressures[-1]:
        return []
    if solved.ends is None:
        bodies = solved.bodies_at(pressures)
        return [_AtPressure(each.pressure, solved.state(each, None)) for each in bodies]

    def of_ends(_: Progress) -> tuple[Solution, ...]:
        return solved.ends_at(pressures)

    at_once = may_run_side_by_side()
    with beside(one_thread()(of_ends) if at_once else of_ends, at_once) as other:
        bodies = solved.bodies_at(pressures)
        ends, _ = other.result(SILENCE)
    pairs = zip(bodies, ends, strict=False)
    return [_AtPressure(body.pressure, solved.state(body, end)) for body, end in pairs]


def _to_angle(
    found: Evaluation, solved: SolvedBodies, states: list[_AtPressure]
) -> list[_AtPressure]:
    """The states of a cell with the evaluation's angle at its pressure, and in proportion before.

    Of the ends, the evaluation takes only what they add to a cell on a mesh of their own size.
    """
    if solved.ends is None or not states:
        return states
    last = states[-1].state
    if not same_pressure(states[-1].pressure_mpa, solved.body.pressure) or not last.body.tilt:
        return states
    missing = float(np.radians(found.bending_angle_deg)) - last.angle
    return [_turned_on(each, missing * each.state.body.tilt / last.body.tilt) for each in states]


def _turned_on(point: _AtPressure, angle: float) -> _AtPressure:
    return replace(point, state=replace(point.state, angle=point.state.angle + angle))
