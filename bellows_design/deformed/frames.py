"""The actuator along the pressure path, for pages with a slider."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from bellows_design.analysis.evaluation import Evaluation
from bellows_design.analysis.models import UNIT_CELL, shortened
from bellows_design.beside import beside
from bellows_design.deformed.joined.state import ActuatorState, BodyState
from bellows_design.deformed.pressure_path import WalkedBody
from bellows_design.deformed.surface import SurfaceFrames
from bellows_design.deformed.whole import WholeSurface, whole_of
from bellows_design.errors import DesignError
from bellows_design.progress import SILENCE, Progress
from solver import Mesh, Solution

MOST_FRAMES = 101


def surface_frames(found: Evaluation, count: int = 11) -> SurfaceFrames:
    """The surface from rest to the pressure that was reached, at equally spaced pressures.

    Equilibria that the evaluation kept are taken, where it was asked for these pressures; else the
    path is walked once more. Of a cell that is on its finest mesh, from the state that was found
    downwards, so that the last frame is that of ``deformed_surface``; of half and full models on
    the coarsest one, whose angle and stress are less accurate (``found.meshes[0]``). The ends stand
    still where their path ended before that of the cell.

    Args:
        found: An evaluation.
        count: Of frames; fewer where the path cannot be followed again, and one, at rest, of an
            evaluation that reached no pressure.

    Raises:
        DesignError: A count that is not between 2 and 101.
    """
    if not 2 <= count <= MOST_FRAMES:
        raise DesignError(f"count = {count} frames must lie between 2 and {MOST_FRAMES}.")
    states = _states(found, np.linspace(0.0, found.pressure_mpa, count)[1:].tolist())
    body, ends = _solutions(found)
    shown = WholeSurface.of(whole_of(found.design, body.problem.mesh, _mesh(ends)))
    return _frames(found, shown, states)


def _frames(found: Evaluation, shown: WholeSurface, states: Sequence[_AtPressure]) -> SurfaceFrames:
    bellows, (body, ends) = found.design.bellows, _solutions(found)
    rest = BodyState.at_rest(body.problem.mesh)
    unloaded = None if ends is None else BodyState.at_rest(ends.problem.mesh)
    first = shown.at_rest(bellows, ActuatorState(rest, unloaded, 0.0))
    stresses = [shown.von_mises(each.state) for each in states]
    return SurfaceFrames(
        shown.flat.triangles,
        np.stack([first, *(shown.loaded(bellows, each.state) for each in states)]),
        np.stack([np.zeros(len(first)), *stresses]),
        np.array([0.0, *(each.pressure_mpa for each in states)]),
        np.degrees([0.0, *(each.state.angle for each in states)]),
    )


def _states(found: Evaluation, pressures: Sequence[float]) -> list[_AtPressure]:
    """The actuator at pressures (MPa), as far as body and ends could be followed to them."""
    from solver.linear.threads import may_run_side_by_side, one_thread

    if not found.pressure_mpa:
        return []
    body, ends = _solutions(found)
    if ends is None:
        return [_at(found, solution, None) for solution in _path(found, body, pressures)]

    def of_ends(_: Progress) -> tuple[Solution, ...]:
        return _path_of_ends(found, ends, pressures)

    at_once = may_run_side_by_side()
    with beside(one_thread()(of_ends) if at_once else of_ends, at_once) as other:
        cells = _path(found, body, pressures)
        short, _ = other.result(SILENCE)
    states = [_at(found, cell, end) for cell, end in zip(cells, short, strict=False)]
    return _to_angle(found, states)


def _solutions(found: Evaluation) -> tuple[Solution, Solution | None]:
    """The body whose path is shown, and its ends."""
    computation = found.computation
    if found.model is UNIT_CELL and computation.ends is not None:
        return computation.finest, computation.ends
    return computation.solutions[0], None


def _path(
    found: Evaluation, solution: Solution, pressures: Sequence[float]
) -> tuple[Solution, ...]:
    return WalkedBody(found.design.bellows, solution).at(pressures)


def _path_of_ends(
    found: Evaluation, ends: Solution, pressures: Sequence[float]
) -> tuple[Solution, ...]:
    free = ends.problem.moving_plane is not None
    design = found.design if free else shortened(found.design)
    return WalkedBody(design.bellows, ends).at(pressures)


@dataclass(frozen=True)
class _AtPressure:
    """The actuator at a pressure."""

    pressure_mpa: float
    state: ActuatorState


def _at(found: Evaluation, body: Solution, ends: Solution | None) -> _AtPressure:
    """With the angle of body and ends alone."""
    state = BodyState.of(body)
    if ends is None:
        return _AtPressure(body.pressure, ActuatorState(state, None, state.turn))
    other = BodyState.of(ends)
    turn = 2 * other.tilt if ends.problem.moving_plane is not None else other.turn
    angle = 2 * (found.design.bellows.bubble_count - 1) * state.tilt + turn
    return _AtPressure(body.pressure, ActuatorState(state, other, angle))


def _to_angle(found: Evaluation, states: list[_AtPressure]) -> list[_AtPressure]:
    """The states with the evaluation's angle at its pressure, and in proportion before.

    Of the ends, the evaluation takes only what they add to a cell on a mesh of their own size.
    """
    if not states or not np.isclose(states[-1].pressure_mpa, found.computation.finest.pressure):
        return states
    last = states[-1].state
    missing = float(np.radians(found.bending_angle_deg)) - last.angle
    part = [each.state.body.tilt / last.body.tilt if last.body.tilt else 0.0 for each in states]
    return [
        replace(each, state=replace(each.state, angle=each.state.angle + share * missing))
        for each, share in zip(states, part, strict=True)
    ]


def _mesh(solution: Solution | None) -> Mesh | None:
    return None if solution is None else solution.problem.mesh
