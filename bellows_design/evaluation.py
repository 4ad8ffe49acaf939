"""A design under pressure: bending angle, highest stress, and how far off they may be.

The load is walked on a coarse mesh; a finer mesh starts from its solution at full load and needs
a handful of iterations. The difference between the two is the error estimate.
"""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from dataclasses import asdict, astuple, dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

from bellows_design.design import Design
from bellows_design.progress import Progress, Silence

if TYPE_CHECKING:
    from bellows_design.contact import Contact
    from bellows_design.solids import NamedSolid
    from solver import Event, PathPoint, Peak, Solution

MODELS = ("auto", "half")
SILENCE = Silence()
LEVELS = 2
"""Meshes used unless more accuracy is asked for."""

ANGLE_SAFETY, LEAST_ANGLE_ERROR = 2.0, 0.01
"""Factors of the angle's error estimate; see ``Evaluation.error_estimate``."""

REASON = "half of the actuator answers for all of it: body and load are symmetric about y = 0"


@dataclass(frozen=True)
class ErrorEstimate:
    """Estimated errors in percent of the values; None where there was but one mesh."""

    bending_angle_percent: float | None = None
    max_von_mises_percent: float | None = None


@dataclass(frozen=True)
class Evaluation:
    """What the solver found for a design at ``pressure_mpa``, the pressure it reached.

    ``solutions`` holds one solution for each mesh, the finest last; ``seconds`` the time spent on
    geometry, mesh and solve. Without convergence all numbers are those of the last good state.
    """

    design: Design
    solid: NamedSolid
    solutions: tuple[Solution, ...]
    seconds: Mapping[str, float]
    model: str = "half"
    reason: str = REASON

    @property
    def finest(self) -> Solution:
        """The solution on the finest mesh."""
        return self.solutions[-1]

    @property
    def converged(self) -> bool:
        """True if every mesh reached the design pressure."""
        return all(solution.converged for solution in self.solutions)

    @property
    def can_refine(self) -> bool:
        """True if there is a finer mesh to go to."""
        from bellows_design.analysis import LADDER

        return self.converged and len(self.solutions) < len(LADDER)

    @property
    def message(self) -> str:
        """How far the load came and why it stopped."""
        return self.finest.message

    @property
    def pressure_mpa(self) -> float:
        """Pressure reached, MPa."""
        return self.finest.pressure

    @property
    def bending_angle_deg(self) -> float:
        """Rotation of the tip against the root, degrees; past 360 where it curls on."""
        return self.finest.rotation

    @cached_property
    def peaks(self) -> tuple[Peak, ...]:
        """Highest von Mises Cauchy stress on each mesh, with its place."""
        from solver import peak_von_mises

        return tuple(peak_von_mises(solution) for solution in self.solutions)

    @property
    def max_von_mises_mpa(self) -> float:
        """Highest von Mises Cauchy stress, MPa."""
        return self.peaks[-1].value

    @property
    def error_estimate(self) -> ErrorEstimate:
        """From the difference between the last two meshes, in percent of the finest.

        The angle takes twice the difference, for it can change as much again on the next mesh (by
        1.7 times, measured on Prototype 1). Two meshes can also agree by chance: so the angle's
        estimate never falls below 1 %, and the stress is taken no better than half of how much
        the elements around its place disagree.
        """
        if len(self.solutions) < 2 or not self.converged:
            return ErrorEstimate()
        (coarse, fine), (before, peak) = self.solutions[-2:], self.peaks[-2:]
        stress_error = max(abs(before.value - peak.value), peak.scatter / 2)
        angle_error = max(
            ANGLE_SAFETY * abs(coarse.rotation - fine.rotation),
            LEAST_ANGLE_ERROR * abs(fine.rotation),
        )
        return ErrorEstimate(
            _percent(angle_error, fine.rotation), _percent(stress_error, peak.value)
        )

    @cached_property
    def cavity_volume_mm3(self) -> float:
        """Air inside the whole deformed actuator, mm³."""
        from bellows_design.geometry import CAVITY
        from solver import cavity_volume

        solution = self.finest
        return 2 * cavity_volume(solution.problem.mesh, solution.displacement, (CAVITY,))

    @cached_property
    def contact(self) -> Contact:
        """Whether bubbles touch, and how near they come."""
        from bellows_design.contact import contact_of

        return contact_of(self.design.bellows, self.finest)

    def to_dict(self) -> dict[str, Any]:
        """Plain values for JSON; the README says what they mean."""
        from bellows_design.versions import versions

        return {
            "design": self.design.name,
            "digest": self.design.digest,
            "model": self.model,
            "model_reason": self.reason,
            "pressure_mpa": self.pressure_mpa,
            "converged": self.converged,
            "message": self.message,
            "bending_angle_deg": self.bending_angle_deg,
            "max_von_mises_mpa": self.max_von_mises_mpa,
            "max_von_mises_position_mm": list(self.peaks[-1].position),
            "cavity_volume_mm3": self.cavity_volume_mm3,
            "contact": asdict(self.contact),
            "error_estimate": asdict(self.error_estimate),
            "mesh": _size(self.finest),
            "meshes": [_size(s) | _point(s.path[-1]) for s in self.solutions],
            "solver": _effort(self.solutions),
            "seconds": {**self.seconds, "total": sum(self.seconds.values())},
            "path": [_point(point) for point in self._path()],
            "versions": versions(),
        }

    def _path(self) -> tuple[PathPoint, ...]:
        """The load path of the coarsest mesh, with its end on the finest."""
        return (*self.solutions[0].path[:-1], self.finest.path[-1])


def evaluate(
    design: Design,
    model: str = "auto",
    accuracy_percent: float | None = None,
    progress: Progress = SILENCE,
) -> Evaluation:
    """Evaluate ``design`` at its design pressure.

    ``model`` is ``auto`` or ``half``. With ``accuracy_percent`` the mesh is refined until both
    error estimates keep it, or the ladder of meshes ends: the estimates then say what was reached.
    A load that cannot be reached gives an evaluation with ``converged`` False.

    Raises:
        ValueError: unknown model, accuracy out of bounds, or a geometry the CAD kernel refuses.
        MeshingError: no usable mesh.
    """
    from bellows_design.analysis import half_solid

    _check(model, accuracy_percent)
    progress.stage("geometry of the half")
    start = time.perf_counter()
    solid = half_solid(design)
    spent = {"geometry": time.perf_counter() - start, "mesh": 0.0, "solve": 0.0}
    evaluation = refined(Evaluation(design, solid, (), spent), progress)
    while evaluation.can_refine and not _enough(evaluation, accuracy_percent):
        evaluation = refined(evaluation, progress)
    return evaluation


def refined(evaluation: Evaluation, progress: Progress = SILENCE) -> Evaluation:
    """The same evaluation on one finer mesh, started from the finest solution at hand."""
    from bellows_design.analysis import LADDER, half_problem, mesh_of
    from solver import solve, transfer

    def report(event: Event) -> None:
        progress.load(event.load, event.rotation)

    design, level = evaluation.design, len(evaluation.solutions)
    progress.stage(f"mesh {level + 1}")
    began = time.perf_counter()
    mesh = mesh_of(evaluation.solid, design, LADDER[level])
    meshed = time.perf_counter()
    progress.stage(f"solve {level + 1}, {len(mesh.tets)} tetrahedra")
    initial = transfer(evaluation.finest, mesh) if level else None
    solution = solve(
        half_problem(design, mesh), design.load.pressure, listener=report, initial=initial
    )
    spent = {
        "geometry": evaluation.seconds["geometry"],
        "mesh": evaluation.seconds["mesh"] + meshed - began,
        "solve": evaluation.seconds["solve"] + time.perf_counter() - meshed,
    }
    return replace(evaluation, solutions=(*evaluation.solutions, solution), seconds=spent)


def write_vtu(evaluation: Evaluation, path: Path) -> None:
    """Write the finest solution for ParaView, completely or not at all."""
    from bellows_design.atomic import replacing
    from solver import write_vtu as write

    with replacing(path) as temporary:
        write(temporary, evaluation.finest)


def _check(model: str, accuracy_percent: float | None) -> None:
    if model not in MODELS:
        raise ValueError(f"model = {model!r} must be one of {', '.join(MODELS)}.")
    if accuracy_percent is not None and not 0.01 <= accuracy_percent <= 100:
        raise ValueError(f"accuracy = {accuracy_percent:g} % must lie between 0.01 and 100 %.")


def _enough(evaluation: Evaluation, accuracy_percent: float | None) -> bool:
    if len(evaluation.solutions) < LEVELS or accuracy_percent is None:
        return len(evaluation.solutions) >= LEVELS
    estimates = astuple(evaluation.error_estimate)
    return all(error is not None and error <= accuracy_percent for error in estimates)


def _percent(error: float, value: float) -> float | None:
    return 100 * abs(error / value) if value else None


def _size(solution: Solution) -> dict[str, int]:
    from solver.constraints import number_unknowns

    mesh, supports = solution.problem.mesh, solution.problem.supports
    unknowns = number_unknowns(mesh, supports).size
    return {"elements": len(mesh.tets), "nodes": len(mesh.nodes), "unknowns": unknowns}


def _effort(solutions: Sequence[Solution]) -> dict[str, int | str]:
    return {
        "load_steps": sum(solution.load_steps for solution in solutions),
        "newton_iterations": sum(solution.newton_iterations for solution in solutions),
        "factorizations": sum(solution.factorizations for solution in solutions),
        "linear_solver": solutions[-1].linear_solver,
    }


def _point(point: PathPoint) -> dict[str, float]:
    return {
        "pressure_mpa": point.pressure,
        "bending_angle_deg": point.rotation,
        "max_von_mises_mpa": point.max_von_mises,
    }
