"""What was found for a design under pressure, as plain values."""

from __future__ import annotations

from dataclasses import asdict, dataclass, field
from typing import TYPE_CHECKING, Any, ClassVar

from bellows_design.analysis.error_estimate import ErrorEstimate
from bellows_design.analysis.whole_actuator import NO_FOLDS, FoldedElements, Reading

if TYPE_CHECKING:
    from bellows_design.analysis.computation import Computation, Seconds
    from bellows_design.analysis.material_range import ReachedStrain
    from bellows_design.analysis.models import AnalysisModel
    from bellows_design.analysis.wall_contact import WallContact
    from bellows_design.design.design import Design


@dataclass(frozen=True)
class MeshSize:
    """Tetrahedra, nodes, and unknowns of the system that is solved on a mesh."""

    elements: int
    nodes: int
    unknowns: int


@dataclass(frozen=True)
class MeshReading:
    """One mesh and what it says about the whole actuator."""

    size: MeshSize
    reading: Reading


@dataclass(frozen=True)
class SolverEffort:
    """What all solves of an evaluation took together, and the linear solver they used."""

    load_steps: int
    newton_iterations: int
    factorizations: int
    linear_solver: str


@dataclass(frozen=True, kw_only=True)
class LoadedState:
    """The whole actuator at the highest pressure that was reached, on the finest mesh.

    This is all that a verdict is decided by. Without convergence it is the last good state.

    Attributes:
        ordinary: True of what depends on the design alone. A state that was reached from another
            design's is decided by never.
        converged: True if every solution reached the design pressure.
        message: How far the load came and why it stopped.
        stable: Whether the state is stable under its pressure; None if that is unknown.
        pressure_mpa: Pressure reached, MPa; negative for a vacuum.
        limit_pressure_mpa: Pressure of the limit point that ended the load path, MPa; None if there
            was none.
        touch_pressure_mpa: Pressure at which walls touch that the model does not keep apart, MPa;
            the path ends there, and the design may be judged at less. None if none do.
        bending_angle_deg: Rotation of the tip against the root, degrees; past 360 where it curls
            on.
        max_von_mises_mpa: Highest von Mises Cauchy stress, MPa.
        max_von_mises_position_mm: Its place (x, y, z) in the undeformed actuator, mm; of all
            bubbles alike, in the middle one.
        cavity_volume_mm3: Air inside the whole deformed actuator, mm³.
        error_estimate: Estimated errors of angle and stress, percent.
        strain: How far the material is strained, and whether it is known there.
        contact: Which walls touch, and how near the others come.
        folded: Elements that the deformation folds.

    Examples:
        >>> from bellows_design import Evaluation
        >>> from bellows_design.evaluation import LoadedState, NeighbourEvaluation
        >>> print(issubclass(Evaluation, LoadedState), issubclass(NeighbourEvaluation, LoadedState))
        True True
        >>> print(Evaluation.ordinary, NeighbourEvaluation.ordinary)  # a verdict needs the first
        True False
    """

    ordinary: ClassVar[bool] = True

    converged: bool
    message: str
    stable: bool | None
    pressure_mpa: float
    limit_pressure_mpa: float | None
    touch_pressure_mpa: float | None
    bending_angle_deg: float
    max_von_mises_mpa: float
    max_von_mises_position_mm: tuple[float, float, float]
    cavity_volume_mm3: float
    error_estimate: ErrorEstimate
    strain: ReachedStrain
    contact: WallContact
    folded: FoldedElements = NO_FOLDS

    @property
    def warnings(self) -> tuple[str, ...]:
        """Sentences on what makes the numbers less reliable than they look."""
        return (*self.strain.warnings, *self.contact.warnings, *self.folded.warnings)

    def state_dict(self) -> dict[str, Any]:
        """Plain values of this state for JSON."""
        return {
            "pressure_mpa": self.pressure_mpa,
            "converged": self.converged,
            "message": self.message,
            "stable": self.stable,
            "limit_pressure_mpa": self.limit_pressure_mpa,
            "touch_pressure_mpa": self.touch_pressure_mpa,
            "bending_angle_deg": self.bending_angle_deg,
            "max_von_mises_mpa": self.max_von_mises_mpa,
            "max_von_mises_position_mm": list(self.max_von_mises_position_mm),
            "cavity_volume_mm3": self.cavity_volume_mm3,
            "strain": self.strain.to_dict(),
            "warnings": list(self.warnings),
            "contact": asdict(self.contact),
            "folded_elements": asdict(self.folded),
            "error_estimate": asdict(self.error_estimate),
        }


@dataclass(frozen=True, kw_only=True)
class Evaluation(LoadedState):
    """What the solver found for a design at the pressure it reached.

    Angle, stress, volume, estimated errors and all else that a verdict is decided by are attributes
    of its base, ``LoadedState``.

    Attributes:
        design: The design evaluated.
        model: The body that stands for the actuator, with its supports and its load.
        reason: Why this model was chosen.
        meshes: Every mesh and its reading of the whole actuator, the finest last.
        solver: Load steps, iterations and factorizations of all solves.
        seconds: Time spent on geometry, meshes and solves, s.
        path: Readings along the load path.
        curve: Readings at the pressures asked for.
        computation: The solutions these values were taken from.
        from_cache: When it was computed (UTC), where it comes from the store of results; empty
            where it was computed now.

    Examples:
        >>> from bellows_design import evaluate, load_design
        >>> found = evaluate(load_design("prototype_1"))
        >>> print(found.converged, found.stable, f"{found.cavity_volume_mm3:.3g} mm³ of air")
        True True 9.26e+03 mm³ of air
        >>> print(found.reason)
        7 bubbles deform alike: ...
    """

    design: Design
    model: AnalysisModel
    reason: str
    meshes: tuple[MeshReading, ...]
    solver: SolverEffort
    seconds: Seconds
    path: tuple[Reading, ...]
    curve: tuple[Reading, ...]
    computation: Computation = field(repr=False, compare=False)
    from_cache: str = field(default="", compare=False)

    @property
    def warnings(self) -> tuple[str, ...]:
        """Sentences on what makes the numbers less reliable than they look."""
        return (*self.design.material.warnings, *super().warnings)

    @property
    def mesh(self) -> MeshSize:
        """The size of the finest mesh."""
        return self.meshes[-1].size

    def to_dict(self) -> dict[str, Any]:
        """Plain values for JSON; docs/json.md says what they mean."""
        from bellows_design.versions import versions

        return {
            "design": self.design.name,
            "digest": self.design.digest,
            "model": self.model.name,
            "model_reason": self.reason,
            **self.state_dict(),
            "mesh": asdict(self.mesh),
            "meshes": [asdict(mesh.size) | asdict(mesh.reading) for mesh in self.meshes],
            "solver": asdict(self.solver),
            "seconds": self.seconds.to_dict(),
            "path": [asdict(reading) for reading in self.path],
            "curve": [asdict(reading) for reading in self.curve],
            "versions": versions(),
        }
