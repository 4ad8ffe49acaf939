"""What was found for a design under pressure, and how far off it may be.

The difference between the last two meshes is the error estimate.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from bellows_design.analysis.budget import DEFAULT, Budget
from bellows_design.analysis.models import HALF, UNIT_CELL, Model
from bellows_design.design.design import Design

if TYPE_CHECKING:
    from bellows_design.analysis.material_range import ReachedStrain
    from bellows_design.analysis.mesh_plan import PlannedMesh
    from bellows_design.analysis.wall_contact import Contact
    from bellows_design.geometry.named_solids import NamedSolid
    from solver import PathPoint, Peak, Solution

LEAST_ANGLE_ERROR, LEAST_STRESS_ERROR, ENDS_ERROR, TWO_MESHES = 0.005, 0.02, 0.15, 2.0
"""Floors and factors of the error estimates; see ``Evaluation.error_estimate``."""


@dataclass(frozen=True)
class ErrorEstimate:
    """Estimated errors in percent of the values; None where there was but one mesh."""

    bending_angle_percent: float | None = None
    max_von_mises_percent: float | None = None


@dataclass(frozen=True)
class Reading:
    """What one equilibrium says about the whole actuator."""

    pressure_mpa: float
    bending_angle_deg: float
    max_von_mises_mpa: float
    cavity_volume_mm3: float


@dataclass(frozen=True)
class Evaluation:
    """What the solver found for a design at ``pressure_mpa``, the pressure it reached.

    ``solutions`` holds one solution for each mesh, the finest last; ``ends`` that of a short
    actuator of one bubble, on the unit cell's coarsest mesh size; ``pressures`` (MPa) those asked
    for besides the design's; ``seconds`` the time spent on geometry, mesh and solve. Without
    convergence all numbers are those of the last good state.
    """

    design: Design
    model: Model
    reason: str
    solid: NamedSolid
    solutions: tuple[Solution, ...]
    seconds: Mapping[str, float]
    pressures: tuple[float, ...] = ()
    ends: Solution | None = None
    budget: Budget = DEFAULT

    @property
    def finest(self) -> Solution:
        """The solution on the finest mesh."""
        return self.solutions[-1]

    @property
    def converged(self) -> bool:
        """True if every mesh reached the design pressure."""
        return all(solution.converged for solution in self._all)

    @property
    def _all(self) -> tuple[Solution, ...]:
        return self.solutions if self.ends is None else (*self.solutions, self.ends)

    @property
    def can_refine(self) -> bool:
        """True if there is a finer mesh to go to, and memory for it."""
        return self.converged and self.next_mesh.fits(self.budget)

    @cached_property
    def next_mesh(self) -> PlannedMesh:
        """The mesh after the finest."""
        from bellows_design.analysis.mesh_plan import finer_plan, first_plan

        if not self.solutions:
            return first_plan(self.solid, self.design)
        return finer_plan(self.solid, self.design, self.finest, self.model.refinement)

    @property
    def message(self) -> str:
        """How far the load came and why it stopped."""
        if self.ends is not None and not self.ends.converged:
            return f"the ends: {self.ends.message}"
        return self.finest.message

    @property
    def stable(self) -> bool | None:
        """Whether the state found is stable under its pressure; None if that is unknown."""
        known = {solution.stable for solution in self._all}
        return False if False in known else None if None in known else True

    @property
    def limit_pressure_mpa(self) -> float | None:
        """Pressure at which the walls give way, MPa, if that was met on the way."""
        limits = [solution.limit for solution in self._all if solution.limit is not None]
        return min(limits, key=abs, default=None)

    @property
    def pressure_mpa(self) -> float:
        """Pressure reached, MPa."""
        return min((solution.pressure for solution in self._all), key=abs)

    @property
    def bending_angle_deg(self) -> float:
        """Rotation of the tip against the root, degrees; past 360 where it curls on."""
        return self._reading(self.finest.path[-1]).bending_angle_deg

    @property
    def cavity_volume_mm3(self) -> float:
        """Air inside the whole deformed actuator, mm³."""
        return self._reading(self.finest.path[-1]).cavity_volume_mm3

    @property
    def curve(self) -> tuple[Reading, ...]:
        """Readings at the pressures asked for, on the finest mesh; the design's is the last."""
        path = self.finest.path
        wanted = [p for p in path if np.isclose(p.pressure, self.pressures, atol=1e-12).any()]
        return tuple(self._reading(point) for point in wanted)

    def _reading(self, point: PathPoint) -> Reading:
        """The whole actuator, from a point on the path of one of the solutions."""
        angle, volume = point.rotation, self.model.share * point.volume
        if self.model is UNIT_CELL:
            count = self.design.bellows.bubble_count
            turned, more = self._added_by_ends(point)
            angle, volume = count * 2 * angle + turned, count * volume + more
        return Reading(point.pressure + 0.0, angle, point.max_von_mises, volume)  # never -0

    def _added_by_ends(self, point: PathPoint) -> tuple[float, float]:
        """Rotation (°) and volume (mm³) by which both ends differ from one bubble more.

        They are a short actuator's, or a bubble's without neighbours (``_with_ends``). Cell and
        ends have meshes of the same size, so that the mesh's own error drops out. Exact at the
        pressures asked for; between them in proportion to the cell's rotation.
        """
        if self.ends is None:
            return 0.0, 0.0
        short, cell = _at(self.ends, point.pressure), _at(self.solutions[0], point.pressure)
        if not np.isclose(short.pressure, point.pressure):
            short, cell = self.ends.path[-1], self.solutions[0].path[-1]
        part = point.rotation / cell.rotation if short.pressure != point.pressure else 1.0
        if self.ends.problem.moving_plane is not None:  # a quarter of a bubble as well
            turned, more = 2 * short.rotation, UNIT_CELL.share * short.volume
        else:
            turned, more = short.rotation, HALF.share * short.volume
        return part * (turned - 2 * cell.rotation), more - UNIT_CELL.share * cell.volume

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
    def max_von_mises_position_mm(self) -> tuple[float, float, float]:
        """Where it is in the undeformed actuator, mm; of all bubbles alike, in the middle one."""
        x, y, z = self.peaks[-1].position
        middles = self.design.bellows.bubble_middles
        return (x + middles[len(middles) // 2] if self.model is UNIT_CELL else x), y, z

    @property
    def error_estimate(self) -> ErrorEstimate:
        """From the difference between the last two meshes, in percent of the finest.

        That difference is about the error of the coarser one, so for the angle it is a careful
        guess at the finer one's; but the first mesh is so coarse that all of it counts twice as
        long as there are only two. What the ends add is known to 15 % (a short actuator of two
        bubbles instead of one moves it by that much). The stress takes half of the difference, or
        how much the elements around its place disagree if that is more. Two meshes can agree by
        chance, and the bubbles next to the ends are stressed a little more (4 % on Prototype 1):
        so no estimate falls below 0.5 % (angle) or 2 % (stress). Calibrated on the designs of the
        paper, see the README.
        """
        if len(self.solutions) < 2 or not self.converged:
            return ErrorEstimate()
        (coarse, fine), (before, peak) = self.solutions[-2:], self.peaks[-2:]
        angle = self.bending_angle_deg
        change = abs(angle - self._reading(coarse.path[-1]).bending_angle_deg)
        ends, _ = self._added_by_ends(fine.path[-1])
        careful = TWO_MESHES if len(self.solutions) == 2 else 1.0
        angle_error = careful * max(change, LEAST_ANGLE_ERROR * abs(angle))
        angle_error += ENDS_ERROR * abs(ends)
        stress_error = max(
            abs(before.value - peak.value) / 2, peak.scatter, LEAST_STRESS_ERROR * peak.value
        )
        return ErrorEstimate(_percent(angle_error, angle), _percent(stress_error, peak.value))

    @cached_property
    def contact(self) -> Contact:
        """Which walls touch, and how near they come."""
        from bellows_design.analysis.wall_contact import contact_in_cell, contact_of

        bellows, solution = self.design.bellows, self.finest
        if self.model is UNIT_CELL:
            return contact_in_cell(bellows, solution)
        return contact_of(bellows, solution.problem.mesh, solution.displacement)

    @cached_property
    def strain(self) -> ReachedStrain:
        """How far the material is strained on the finest mesh, and whether it is known there."""
        from bellows_design.analysis.material_range import reached_strain

        return reached_strain(self.design.material, self.finest)

    @property
    def warnings(self) -> tuple[str, ...]:
        """Sentences on what makes the numbers less than they seem."""
        return self.strain.warnings

    def to_dict(self) -> dict[str, Any]:
        """Plain values for JSON; the README says what they mean."""
        from bellows_design.versions import versions

        return {
            "design": self.design.name,
            "digest": self.design.digest,
            "model": self.model.name,
            "model_reason": self.reason,
            "pressure_mpa": self.pressure_mpa,
            "converged": self.converged,
            "message": self.message,
            "stable": self.stable,
            "limit_pressure_mpa": self.limit_pressure_mpa,
            "bending_angle_deg": self.bending_angle_deg,
            "max_von_mises_mpa": self.max_von_mises_mpa,
            "max_von_mises_position_mm": list(self.max_von_mises_position_mm),
            "cavity_volume_mm3": self.cavity_volume_mm3,
            "strain": self.strain.to_dict(),
            "warnings": list(self.warnings),
            "contact": asdict(self.contact),
            "error_estimate": asdict(self.error_estimate),
            "mesh": _size(self.finest),
            "meshes": [_size(s) | asdict(self._reading(s.path[-1])) for s in self.solutions],
            "solver": _effort(self._all),
            "seconds": {**self.seconds, "total": sum(self.seconds.values())},
            "path": [asdict(self._reading(point)) for point in self._path()],
            "curve": [asdict(reading) for reading in self.curve],
            "versions": versions(),
        }

    def _path(self) -> tuple[PathPoint, ...]:
        """The load path of the coarsest mesh, with its end on the finest."""
        return (*self.solutions[0].path[:-1], self.finest.path[-1])


def _at(solution: Solution, pressure: float) -> PathPoint:
    """The point of a solution's path nearest to a pressure."""
    return min(solution.path, key=lambda point: abs(point.pressure - pressure))


def _percent(error: float, value: float) -> float | None:
    return 100 * abs(error / value) if value else None


def _size(solution: Solution) -> dict[str, int]:
    from solver.problem.unknowns import number_unknowns

    problem = solution.problem
    unknowns = number_unknowns(problem.mesh, problem.supports, problem.moving_plane).size
    return {
        "elements": len(problem.mesh.tets),
        "nodes": len(problem.mesh.nodes),
        "unknowns": unknowns,
    }


def _effort(solutions: Sequence[Solution]) -> dict[str, int | str]:
    return {
        "load_steps": sum(solution.load_steps for solution in solutions),
        "newton_iterations": sum(solution.newton_iterations for solution in solutions),
        "factorizations": sum(solution.factorizations for solution in solutions),
        "linear_solver": solutions[-1].linear_solver,
    }
