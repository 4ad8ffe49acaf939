"""From an own body under its load to its evaluation."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from bellows_design.analysis.computation import Computation
from bellows_design.analysis.evaluate import (
    accurate,
    check_accuracy,
    check_pressures,
    effort,
    mesh_size,
)
from bellows_design.analysis.mesh_sequence import begun, refined, refined_until
from bellows_design.analysis.whole_actuator import FoldedElements
from bellows_design.budget import DEFAULT, Budget
from bellows_design.errors import DesignError
from bellows_design.own_body.analysis.error_estimate import error_estimate, least_of
from bellows_design.own_body.analysis.evaluation import BodyEvaluation, BodyMeshReading, PartState
from bellows_design.own_body.analysis.model import model_of
from bellows_design.own_body.analysis.readings import path_reading, reading
from bellows_design.own_body.body import OwnBody
from bellows_design.progress import SILENCE, Progress

if TYPE_CHECKING:
    from solver import Solution

SHARES = {1: "the whole body", 2: "half of the body", 4: "a quarter", 8: "an eighth of the body"}


def evaluate(
    body: OwnBody,
    accuracy_percent: float | None = None,
    pressures: Sequence[float] = (),
    progress: Progress = SILENCE,
    budget: Budget = DEFAULT,
    meshes: int = 2,
) -> BodyEvaluation:
    """Evaluate ``body`` under its whole load, and at ``pressures`` between 0 and that.

    Args:
        body: What is evaluated.
        accuracy_percent: Refine the mesh until all error estimates are this small, percent.
        pressures: Further pressures of the curve, MPa; none where the volume is given.
        progress: Listens to stages and load.
        budget: Memory (GiB) and seconds that a mesh may take.
        meshes: So many meshes, from coarse to fine, where the budget allows it; from a single one
            no error is estimated.

    Returns:
        The evaluation; with ``converged`` False, of the last good state, where the load could not
        be reached.

    Raises:
        BellowsError: Accuracy or pressures out of bounds, or a first mesh that exceeds the budget.
        MeshingError: No usable mesh, or none in time.
        SolverError: The supports leave the body free to move.
    """
    _check(body, accuracy_percent, pressures)
    model = model_of(body, meshes)
    reason = SHARES[body.supports.share]
    blank = begun(body, model, reason, pressures, progress, budget)
    first = refined(blank, progress)

    def enough(computation: Computation[OwnBody]) -> bool:
        return _enough(computation, accuracy_percent)

    return evaluation_of(refined_until(enough, first, progress))


def _check(body: OwnBody, accuracy_percent: float | None, pressures: Sequence[float]) -> None:
    check_accuracy(accuracy_percent)
    if len(pressures) and not body.load.pressure:
        raise DesignError(
            "pressures cannot be asked for where the load is not a pressure: "
            "load.points says how many points of the path are read."
        )
    if len(pressures):
        check_pressures(pressures, body.load.pressure or 0.0)


def _enough(computation: Computation[OwnBody], accuracy_percent: float | None) -> bool:
    if len(computation.solved) < computation.model.levels or accuracy_percent is None:
        return len(computation.solved) >= computation.model.levels
    pairs = least_of(error_estimate(computation))
    errors, least = [error for error, _ in pairs], [bound for _, bound in pairs]
    return bool(pairs) and accurate(errors, least, accuracy_percent)


def evaluation_of(computation: Computation[OwnBody]) -> BodyEvaluation:
    """The record of a computation."""
    from bellows_design.own_body.analysis.touching import contact_of

    body, finest = computation.design, computation.finest
    ways = [reading(body, solution) for solution in computation.solutions]
    sizes = [mesh_size(solution) for solution in computation.solutions]
    coarsest = finest if body.load.by_volume else computation.solutions[0]
    path = (*coarsest.path[:-1], finest.path[-1])
    return BodyEvaluation(
        body=body,
        reason=computation.reason,
        converged=computation.converged,
        message=computation.message,
        stable=computation.stable,
        limit_pressure_mpa=computation.limit_pressure_mpa,
        touch_pressure_mpa=computation.touch_pressure_mpa,
        end=ways[-1],
        parts=_parts(body, finest),
        error_estimate=error_estimate(computation),
        contact=contact_of(body, finest),
        folded=_folded(computation),
        meshes=tuple(BodyMeshReading(*each) for each in zip(sizes, ways, strict=True)),
        solver=effort(computation.solutions),
        seconds=computation.seconds,
        path=tuple(path_reading(body, point) for point in path),
        curve=tuple(reading(body, each) for each in (*finest.at_stops, finest)),
        computation=computation,
    )


def _parts(body: OwnBody, solution: Solution) -> tuple[PartState, ...]:
    """Stress and strain of each part."""
    from bellows_design.analysis.material_range import reached_strain
    from solver import peak_von_mises

    (part,), peak = body.parts, peak_von_mises(solution)
    return (
        PartState(
            part.name,
            part.material.name,
            peak.value,
            peak.position,
            part.material.yield_strength,
            reached_strain(part.material, solution),
        ),
    )


def _folded(computation: Computation[OwnBody]) -> FoldedElements:
    """Elements that the load folds, on the finest mesh."""
    from bellows_design.analysis.whole_actuator import folds_near

    return folds_near(computation.finest, computation.peaks[-1])
