"""Speed against error: one design on a sequence of meshes of one or more models.

Times are those of a warm process: a first computation, which is not timed, has compiled the
kernels.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cache
from importlib.resources.abc import Traversable
from typing import TYPE_CHECKING, Any

from bellows_design.analysis.computation import Computation, Seconds
from bellows_design.analysis.error_estimate import error_estimate
from bellows_design.analysis.evaluate import mesh_size
from bellows_design.analysis.mesh_sequence import affordable_plan, next_plan, refined, started
from bellows_design.analysis.models import HALF, UNIT_CELL, AnalysisModel, choose
from bellows_design.analysis.whole_actuator import reading
from bellows_design.benchmark.neighbours import Row, neighbour_rows
from bellows_design.benchmark.reference import STORED, Reference, reference_of
from bellows_design.benchmark.series import Level, Series, Work, finest_of
from bellows_design.budget import DEFAULT, LONGEST, Budget
from bellows_design.design.design import Design
from bellows_design.design.shipped import load_design
from bellows_design.errors import DesignError
from bellows_design.machine import Machine, machine, peak_memory_mib
from bellows_design.progress import SILENCE, Progress

if TYPE_CHECKING:
    from solver import Solution

DEFAULT_MODELS = (UNIT_CELL.name, HALF.name)
MOST_MESHES = 9
"""Bound of the meshes of a sequence."""


@dataclass(frozen=True)
class Study:
    """A design's series, one for each model, and the machine they were timed on.

    ``neighbours``: the unit cell once more, from neighbours at several distances.
    """

    design: Design
    series: tuple[Series, ...]
    machine: Machine
    neighbours: tuple[Row, ...] = ()

    @property
    def converged(self) -> bool:
        """True if every mesh reached the design pressure."""
        return all(series.converged for series in self.series)

    def to_dict(self) -> dict[str, Any]:
        """Plain values for JSON."""
        return {
            "design": self.design.name,
            "digest": self.design.digest,
            "pressure_mpa": self.design.load.pressure,
            "converged": self.converged,
            "models": [series.to_dict() for series in self.series],
            "neighbours": [row.to_dict() for row in self.neighbours],
            "machine": self.machine.to_dict(),
        }


def study(
    design: Design,
    models: Sequence[str] = DEFAULT_MODELS,
    meshes: int | None = None,
    progress: Progress = SILENCE,
    references: Traversable = STORED,
    budget: Budget = DEFAULT,
) -> Study:
    """Compute ``design`` with each of the ``models`` on up to ``meshes`` meshes.

    Without ``meshes`` it is one more than an evaluation of that model uses. A sequence ends early
    where the next mesh would exceed the ``budget``, or where the load is not reached. The time of
    all meshes together has no limit.

    Raises:
        BellowsError: unknown model, number of meshes out of bounds, a geometry the CAD kernel
            refuses, or a first mesh that exceeds the budget.
        MeshingError: no usable first mesh.
    """
    if meshes is not None and not 1 <= meshes <= MOST_MESHES:
        raise DesignError(f"meshes = {meshes} must lie between 1 and {MOST_MESHES}.")
    budget = replace(budget, seconds=LONGEST)
    chosen = {model.name: (model, why) for model, why in (choose(design, m) for m in models)}
    described, reference = machine(), reference_of(design, references)
    progress.stage("warm-up, not timed")
    warm_up()
    series = tuple(
        _series(design, model, why, meshes or model.levels + 1, reference, progress, budget)
        for model, why in chosen.values()
    )
    return Study(design, series, described, _neighbours(design, series, progress, budget))


def _neighbours(
    design: Design, series: Sequence[Series], progress: Progress, budget: Budget
) -> tuple[Row, ...]:
    """Rows of the unit cell from its neighbours, where that model is measured."""
    cells = [each for each in series if each.model == UNIT_CELL.name and each.converged]
    return neighbour_rows(design, cells[0].reference, progress, budget) if cells else ()


@cache
def warm_up() -> None:
    """Compile or load every kernel, once: two small meshes of a shipped design, and its ends."""
    for computation in computations(load_design("prototype_1"), UNIT_CELL, "warm-up", 2):
        error_estimate(computation)


def computations(
    design: Design,
    model: AnalysisModel,
    reason: str,
    meshes: int,
    progress: Progress = SILENCE,
    budget: Budget = DEFAULT,
) -> Iterator[Computation]:
    """The computation after each of so many meshes, as ``evaluate`` makes them."""
    computation = started(design, model, reason, progress=progress, budget=budget)
    yield computation
    while len(computation.solved) < meshes and (plan := affordable_plan(computation)):
        computation = refined(computation, progress, plan)
        yield computation


def _series(
    design: Design,
    model: AnalysisModel,
    reason: str,
    meshes: int,
    reference: Reference | None,
    progress: Progress,
    budget: Budget,
) -> Series:
    """Follow a model's meshes to the end."""
    found, failure = _collected(computations(design, model, reason, meshes, progress, budget))
    levels, last = tuple(level for _, level in found), found[-1][0]
    return Series(
        model.name,
        reason,
        last.converged,
        levels,
        reference or finest_of(model.name, levels),
        _note(last, failure, meshes),
        None if last.ends is None else work_of(last.ends),
    )


def _note(last: Computation, failure: str, meshes: int) -> str:
    """What went wrong, or why there are fewer meshes than asked for."""
    if not last.converged:
        return last.message
    if failure or len(last.solved) == meshes:
        return failure
    summary, limit = next_plan(last).summary, last.budget.memory
    return f"the next mesh would have {summary}, above {limit:.3g} GiB."


def _collected(sequence: Iterable[Computation]) -> tuple[list[tuple[Computation, Level]], str]:
    """Every computation with its level; and why there is no next mesh, if meshing fails."""
    from solver.errors import MeshingError

    found: list[tuple[Computation, Level]] = []
    try:
        for computation in sequence:
            found.append((computation, _level(computation, found[-1][1] if found else None)))
    except MeshingError as error:
        if not found:
            raise
        return found, str(error)
    return found, ""


def _level(computation: Computation, before: Level | None) -> Level:
    """What the finest mesh of ``computation`` adds to the level ``before`` it."""
    finest = computation.finest
    return Level(
        work_of(finest),
        computation.seconds - (before.so_far if before else Seconds()),
        computation.seconds,
        peak_memory_mib(),
        reading(computation, finest.path[-1]).bending_angle_deg,
        computation.peaks[-1].value,
        error_estimate(computation),
        computation.converged,
    )


def work_of(solution: Solution) -> Work:
    """Size and effort of a solve."""
    size = mesh_size(solution)
    return Work(
        size.elements,
        size.unknowns,
        solution.newton_iterations,
        solution.factorizations,
        solution.seconds,
    )
