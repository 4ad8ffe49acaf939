"""The solution at the end of a path, and at its stops."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, TypeAlias

from solver.assembly.state import State
from solver.nonlinear.loading import Loading
from solver.nonlinear.newton import Newton
from solver.results.solution import PathPoint, Solution, StopKind

Points: TypeAlias = tuple[PathPoint, ...]


@dataclass(frozen=True)
class AtStop:
    """The state at a stop, and the points of the path up to it."""

    state: State
    points: Points


@dataclass(frozen=True)
class Path:
    """A load path: its last ``state``, the ``points`` up to it, and why it stopped before the end.

    ``limit``: load of the limit point that stopped it; ``stopped_by``: what kind of reason it was.
    ``at_stops``: states at the stops that were reached, each with the points up to it.
    """

    state: State
    points: Points
    failure: str = ""
    limit: float | None = None
    stopped_by: StopKind = ""
    at_stops: tuple[AtStop, ...] = ()


def solution_of(newton: Newton, path: Path, seconds: float) -> Solution:
    """The solution at a path's end."""
    share = _share(newton.loading, path.points[-1].load)
    limit, without_pressure = path.limit, not any(newton.loading.pressures)
    solution = Solution(
        problem=newton.problem,
        converged=not path.failure,
        message=f"stopped at {share}: {path.failure}." if path.failure else f"reached {share}.",
        **_reached(newton, path.state, path.points),
        newton_iterations=newton.effort.iterations,
        factorizations=newton.effort.factorizations,
        load_steps=newton.effort.load_steps,
        refused_steps=newton.effort.refused_steps,
        linear_solver=newton.system.name,
        negative_pivots=newton.system.negative_pivots,
        seconds=seconds,
        limit=limit if limit is None or without_pressure else newton.loading.pressure(limit),
        stopped_by=path.stopped_by,
    )
    return replace(solution, at_stops=tuple(_at(newton, solution, s) for s in path.at_stops))


def _at(newton: Newton, solution: Solution, stop: AtStop) -> Solution:
    """The solution at a stop of the path that ``solution`` ends."""
    reached = f"reached {_share(newton.loading, stop.points[-1].load)}."
    found = replace(solution, converged=True, message=reached, limit=None, stopped_by="")
    return replace(found, **_reached(newton, stop.state, stop.points))


def _reached(newton: Newton, state: State, points: Points) -> dict[str, Any]:
    """The fields of a solution that describe the equilibrium at its end."""
    end = points[-1]
    forces, plane = newton.remaining_force(end.load)
    return {
        "pressure": end.pressure,
        "load": end.load,
        "path": points,
        "displacement": state.displacement,
        "hydrostatic_pressure": state.hydrostatic_pressure,
        "plane": (float(state.plane[0]), float(state.plane[1])),
        "remaining_force": forces,
        "remaining_plane": plane,
    }


def _share(loading: Loading, load: float) -> str:
    """The load reached, relative to the whole one, as text."""
    if any(loading.pressures):
        return f"{figures(loading.pressure(load))} of {figures(loading.pressures[1])} MPa"
    return f"{figures(100 * load)} % of the load"


def figures(value: float) -> str:
    """Four figures of a number as text, zero without a sign."""
    return f"{value + 0.0:.4g}"
