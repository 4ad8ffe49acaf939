"""Speed against error: one design on a sequence of meshes of one or more models.

Times are those of a warm process: a first evaluation, which is not timed, has compiled the kernels.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import asdict, astuple, dataclass, field
from functools import cache
from importlib.resources.abc import Traversable
from itertools import pairwise
from typing import TYPE_CHECKING, Any

from bellows_design.analysis.budget import DEFAULT, Budget
from bellows_design.analysis.evaluate import refined, started
from bellows_design.analysis.evaluation import ErrorEstimate, Evaluation
from bellows_design.analysis.models import HALF, UNIT_CELL, Model, choose
from bellows_design.benchmark.machine import machine, peak_memory_mib
from bellows_design.benchmark.reference import STORED, Reference, reference_of
from bellows_design.design.design import Design, load_design
from bellows_design.progress import Progress, Silence

if TYPE_CHECKING:
    from solver import Solution

SILENCE = Silence()

DEFAULT_MODELS = (UNIT_CELL.name, HALF.name)
MOST_MESHES = 9
"""More meshes than that no sequence has."""


@dataclass(frozen=True)
class Work:
    """What one solve took."""

    elements: int
    unknowns: int
    newton_iterations: int
    factorizations: int
    solver_seconds: float

    @property
    def seconds_per_factorization(self) -> float:
        """Seconds of the solve for each factorization in it."""
        return self.solver_seconds / max(self.factorizations, 1)


@dataclass(frozen=True)
class Stages:
    """Seconds spent on each stage."""

    geometry: float = 0.0
    mesh: float = 0.0
    solve: float = 0.0

    @property
    def total(self) -> float:
        """All of them, s."""
        return self.geometry + self.mesh + self.solve

    def since(self, before: Stages) -> Stages:
        """What was added to ``before``."""
        return Stages(
            self.geometry - before.geometry, self.mesh - before.mesh, self.solve - before.solve
        )

    def to_dict(self) -> dict[str, float]:
        """Plain values for JSON."""
        return asdict(self) | {"total": self.total}


@dataclass(frozen=True)
class Level:
    """One mesh: its work, what its solution says, and how far off it is said to be.

    ``so_far`` is what it takes to get to this answer, the coarser meshes included; what the
    ends of a unit cell take is counted with the first mesh. ``peak_memory_mib`` is the process's,
    None where unknown; angle in degrees, stress in MPa, those of the last good state if the load
    was not reached.
    """

    work: Work
    stages: Stages
    so_far: Stages
    peak_memory_mib: float | None
    bending_angle_deg: float
    max_von_mises_mpa: float
    estimate: ErrorEstimate = field(default_factory=ErrorEstimate)
    converged: bool = True

    def errors(self, model: str, reference: Reference) -> ErrorEstimate:
        """True errors in percent of ``reference``; None where it cannot judge a mesh so fine."""
        if not self.converged or not reference.judges(model, self.work.elements):
            return ErrorEstimate()
        return ErrorEstimate(
            _off(self.bending_angle_deg, reference.bending_angle_deg),
            _off(self.max_von_mises_mpa, reference.max_von_mises_mpa),
        )


@dataclass(frozen=True)
class Series:
    """A model's meshes from coarse to fine, and the reference they are measured against.

    ``note`` says why there are fewer meshes than asked for, or what went wrong.
    """

    model: str
    reason: str
    converged: bool
    levels: tuple[Level, ...]
    reference: Reference
    note: str = ""
    ends: Work | None = None

    @property
    def errors(self) -> tuple[ErrorEstimate, ...]:
        """True errors of every mesh in percent."""
        return self.errors_against(self.reference)

    def errors_against(self, reference: Reference) -> tuple[ErrorEstimate, ...]:
        """True errors of every mesh in percent of ``reference``."""
        return tuple(level.errors(self.model, reference) for level in self.levels)

    @property
    def ratios(self) -> tuple[tuple[float | None, float | None], ...]:
        """Estimated over true error of every mesh, for angle and stress."""
        return tuple(
            (
                _ratio(level.estimate.bending_angle_percent, error.bending_angle_percent),
                _ratio(level.estimate.max_von_mises_percent, error.max_von_mises_percent),
            )
            for level, error in zip(self.levels, self.errors, strict=True)
        )

    @property
    def orders(self) -> tuple[tuple[float | None, ...], tuple[float | None, ...]]:
        """Observed orders of angle and stress from each mesh to the next.

        A half actuator is compared with the finest half where there is one: what another model
        differs by is no error of a mesh.
        """
        own = self.reference.finest_half if self.model == HALF.name else None
        sizes = [level.work.elements for level in self.levels]
        angles, stresses = zip(
            *(astuple(e) for e in self.errors_against(own or self.reference)), strict=True
        )
        return observed_orders(sizes, angles), observed_orders(sizes, stresses)

    @property
    def exponent(self) -> float | None:
        """Seconds per factorization grow with this power of the unknowns."""
        return fitted_exponent(
            [level.work.unknowns for level in self.levels],
            [level.work.seconds_per_factorization for level in self.levels],
        )

    @property
    def solve_exponent(self) -> float | None:
        """All seconds of solving up to a mesh grow with this power of its unknowns."""
        return fitted_exponent(
            [level.work.unknowns for level in self.levels],
            [level.so_far.solve for level in self.levels],
        )

    def to_dict(self) -> dict[str, Any]:
        """Plain values for JSON."""
        angle, stress = self.orders
        return {
            "model": self.model,
            "model_reason": self.reason,
            "converged": self.converged,
            "note": self.note,
            "reference": asdict(self.reference),
            "ends": None if self.ends is None else asdict(self.ends),
            "meshes": [self._row(number) for number in range(len(self.levels))],
            "orders": {"bending_angle": list(angle), "max_von_mises": list(stress)},
            "exponent": self.exponent,
            "solve_exponent": self.solve_exponent,
        }

    def _row(self, number: int) -> dict[str, Any]:
        level, half = self.levels[number], self.reference.finest_half
        angle, stress = self.ratios[number]
        against_half = None if half is None else asdict(level.errors(self.model, half))
        return {
            **asdict(level.work),
            "seconds": level.stages.to_dict(),
            "seconds_per_factorization": level.work.seconds_per_factorization,
            "seconds_so_far": level.so_far.to_dict(),
            "converged": level.converged,
            "peak_memory_mib": level.peak_memory_mib,
            "bending_angle_deg": level.bending_angle_deg,
            "max_von_mises_mpa": level.max_von_mises_mpa,
            "error": asdict(self.errors[number]),
            "error_against_finest_half": against_half,
            "error_estimate": asdict(level.estimate),
            "estimate_over_error": {"bending_angle": angle, "max_von_mises": stress},
        }


@dataclass(frozen=True)
class Study:
    """A design's series, one for each model, and the machine they were timed on."""

    design: Design
    series: tuple[Series, ...]
    machine: dict[str, Any]

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
            "machine": self.machine,
        }


def study(
    design: Design,
    models: Sequence[str] = DEFAULT_MODELS,
    meshes: int | None = None,
    progress: Progress = SILENCE,
    references: Traversable = STORED,
    budget: Budget = DEFAULT,
) -> Study:
    """Evaluate ``design`` with each of the ``models`` on up to ``meshes`` meshes.

    Without ``meshes`` it is one more than an evaluation of that model uses. A sequence ends early
    where the next mesh would exceed the ``budget``, or where the load is not reached.

    Raises:
        ValueError: unknown model, number of meshes out of bounds, a geometry the CAD kernel
            refuses, or a first mesh that exceeds the budget.
        MeshingError: no usable first mesh.
    """
    if meshes is not None and not 1 <= meshes <= MOST_MESHES:
        raise ValueError(f"meshes = {meshes} must lie between 1 and {MOST_MESHES}.")
    chosen = {model.name: (model, why) for model, why in (choose(design, m) for m in models)}
    described, reference = machine(), reference_of(design, references)
    progress.stage("warm-up, not timed")
    warm_up()
    series = tuple(
        _series(design, model, why, meshes or model.levels + 1, reference, progress, budget)
        for model, why in chosen.values()
    )
    return Study(design, series, described)


@cache
def warm_up() -> None:
    """Compile or load every kernel, once: two small meshes of a shipped design, and its ends."""
    for evaluation in evaluations(load_design("prototype_1"), UNIT_CELL, "warm-up", 2):
        _ = evaluation.error_estimate


def evaluations(
    design: Design,
    model: Model,
    reason: str,
    meshes: int,
    progress: Progress = SILENCE,
    budget: Budget = DEFAULT,
) -> Iterator[Evaluation]:
    """What ``evaluate`` would return after each of so many meshes."""
    evaluation = started(design, model, reason, progress=progress, budget=budget)
    yield evaluation
    while len(evaluation.solutions) < meshes and evaluation.can_refine:
        evaluation = refined(evaluation, progress)
        yield evaluation


def observed_orders(
    elements: Sequence[int], errors: Sequence[float | None]
) -> tuple[float | None, ...]:
    """Slopes of log(error) over log(1 / elements) from each mesh to the next.

    In terms of the elements' size the order is three times that. None where an error is unknown
    or zero, or where the mesh did not change.
    """
    pairs = pairwise(zip(elements, errors, strict=True))
    return tuple(
        math.log(coarse / fine) / math.log(more / few) if coarse and fine and more != few else None
        for (few, coarse), (more, fine) in pairs
    )


def fitted_exponent(sizes: Sequence[float], seconds: Sequence[float]) -> float | None:
    """Least-squares p in seconds = c sizes^p; None without two different sizes."""
    x, y = [math.log(size) for size in sizes], [math.log(max(s, 1e-9)) for s in seconds]
    middle, level = sum(x) / max(len(x), 1), sum(y) / max(len(y), 1)
    spread = sum((a - middle) ** 2 for a in x)
    shared = sum((a - middle) * (b - level) for a, b in zip(x, y, strict=True))
    return shared / spread if spread > 0 else None


def finest_of(model: str, levels: Sequence[Level]) -> Reference:
    """The finest of a model's own meshes as the reference of the coarser ones."""
    finest = ([level for level in levels if level.converged] or levels)[-1]
    elements = finest.work.elements
    return Reference(
        finest.bending_angle_deg,
        finest.max_von_mises_mpa,
        model,
        elements,
        elements - 1,
        f"its own finest mesh, {elements} tetrahedra, for want of stored values of this design",
    )


def _series(
    design: Design,
    model: Model,
    reason: str,
    meshes: int,
    reference: Reference | None,
    progress: Progress,
    budget: Budget,
) -> Series:
    """Follow a model's meshes to the end."""
    found, note = _collected(evaluations(design, model, reason, meshes, progress, budget))
    levels, last = tuple(level for _, level in found), found[-1][0]
    if not last.converged:
        note = last.message
    elif not note and len(levels) < meshes:
        note = f"the next mesh would have {last.next_mesh.told}, above {budget.memory:.3g} GiB."
    ends = None if last.ends is None else work_of(last.ends)
    measured_by = reference or finest_of(model.name, levels)
    return Series(model.name, reason, last.converged, levels, measured_by, note, ends)


def _collected(sequence: Iterable[Evaluation]) -> tuple[list[tuple[Evaluation, Level]], str]:
    """Every evaluation with its level; and why there is no next mesh, if meshing fails."""
    from solver.errors import MeshingError

    found: list[tuple[Evaluation, Level]] = []
    try:
        for evaluation in sequence:
            found.append((evaluation, _level(evaluation, found[-1][1] if found else None)))
    except MeshingError as error:
        if not found:
            raise
        return found, str(error)
    return found, ""


def _level(evaluation: Evaluation, before: Level | None) -> Level:
    """What the finest mesh of ``evaluation`` adds to the level ``before`` it."""
    memory = peak_memory_mib()
    so_far = Stages(**evaluation.seconds)
    return Level(
        work_of(evaluation.finest),
        so_far.since(before.so_far if before else Stages()),
        so_far,
        memory,
        evaluation.bending_angle_deg,
        evaluation.max_von_mises_mpa,
        evaluation.error_estimate,
        evaluation.converged,
    )


def work_of(solution: Solution) -> Work:
    """Size and effort of a solve."""
    from solver.problem.unknowns import number_unknowns

    problem = solution.problem
    return Work(
        len(problem.mesh.tets),
        number_unknowns(problem.mesh, problem.supports, problem.moving_plane).size,
        solution.newton_iterations,
        solution.factorizations,
        solution.seconds,
    )


def _off(value: float, exact: float) -> float | None:
    return 100 * abs(value / exact - 1) if exact else None


def _ratio(estimate: float | None, error: float | None) -> float | None:
    return estimate / error if estimate is not None and error else None
