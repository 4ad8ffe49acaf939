"""What was found for an own body under its load, as plain values."""

from __future__ import annotations

from dataclasses import asdict, dataclass, field
from typing import TYPE_CHECKING, Any

from bellows_design.analysis.evaluation import MeshSize, SolverEffort
from bellows_design.own_body.analysis.error_estimate import BodyErrorEstimate
from bellows_design.own_body.analysis.readings import BodyReading, PathReading
from bellows_design.own_body.symmetry import against_symmetry

if TYPE_CHECKING:
    from bellows_design.analysis.computation import Computation, Seconds
    from bellows_design.analysis.material_range import ReachedStrain
    from bellows_design.analysis.wall_contact import WallContact
    from bellows_design.analysis.whole_actuator import FoldedElements
    from bellows_design.own_body.body import OwnBody


@dataclass(frozen=True)
class PartState:
    """How far one part is stressed and strained.

    Attributes:
        name: Of the part.
        material: Name of its material.
        max_von_mises_mpa: Highest von Mises Cauchy stress in it.
        max_von_mises_position_mm: Its place (x, y, z) in the undeformed body.
        yield_strength_mpa: What its material bears.
        strain: How far it is strained, and whether the material is known there.
    """

    name: str
    material: str
    max_von_mises_mpa: float
    max_von_mises_position_mm: tuple[float, float, float]
    yield_strength_mpa: float
    strain: ReachedStrain

    @property
    def warnings(self) -> tuple[str, ...]:
        """Sentences on strains that the material is not known at, and on a stress beyond it."""
        strained = tuple(f"{self.name}: {text}" for text in self.strain.warnings)
        if self.max_von_mises_mpa <= self.yield_strength_mpa:
            return strained
        return (
            *strained,
            f"{self.name}: the stress of {self.max_von_mises_mpa:.3g} MPa exceeds the "
            f"{self.yield_strength_mpa:g} MPa that {self.material} bears.",
        )

    def to_dict(self) -> dict[str, Any]:
        """Plain values for JSON."""
        return {
            "name": self.name,
            "material": self.material,
            "max_von_mises_mpa": self.max_von_mises_mpa,
            "max_von_mises_position_mm": list(self.max_von_mises_position_mm),
            "yield_strength_mpa": self.yield_strength_mpa,
            "strain": self.strain.to_dict(),
        }


@dataclass(frozen=True)
class BodyMeshReading:
    """One mesh and what it says about the whole body."""

    size: MeshSize
    reading: BodyReading


@dataclass(frozen=True, kw_only=True)
class BodyEvaluation:
    """What the solver found for an own body at the load it reached.

    Attributes:
        body: The body evaluated.
        reason: How much of the body was computed.
        converged: True if every solution reached the whole load.
        message: How far the load came and why it stopped.
        stable: Whether the state is stable under its pressure; None if that is unknown.
        limit_pressure_mpa: Pressure of the first limit point of the path, MPa; None without one.
        touch_pressure_mpa: Pressure at which walls touch that nothing keeps apart, where the path
            ended for that reason.
        end: The whole body at the load reached, on the finest mesh.
        parts: Stress and strain of each part.
        error_estimate: Estimated errors, percent.
        contact: Whether walls touch each other, and how near they come.
        folded: Elements that the deformation folds.
        meshes: Every mesh and its reading, the finest last.
        solver: Load steps, iterations and factorizations of all solves.
        seconds: Time spent on geometry, meshes and solves, s.
        path: Readings along the path: of the coarsest mesh with the end on the finest, or, where
            the volume is given, of the finest.
        curve: Readings at the pressures or volumes asked for, on the finest mesh.
        computation: The solutions these values were taken from.

    Examples:
        >>> import cadquery as cq
        >>> from bellows_design import OwnBody, evaluate
        >>> hollow = cq.Solid.makeBox(30, 3, 4, cq.Vector(5, 1, 4))
        >>> bar = cq.Solid.makeBox(40, 5, 10).cut(hollow)
        >>> body = OwnBody(
        ...     name="bar",
        ...     parts=[{"name": "bar", "solid": bar, "material": "ecoflex_00_30"}],
        ...     surfaces={"root": "<X", "tip": ">X", "cavity": {"inner": True}},
        ...     load={"pressure": 0.002},  # MPa
        ... )
        >>> found = evaluate(body)
        >>> print(found.converged, found.end.cavity_volume_mm3 > 360)  # mm³, the volume at rest
        True True
        >>> print([part.name for part in found.parts])
        ['bar']
    """

    body: OwnBody
    reason: str
    converged: bool
    message: str
    stable: bool | None
    limit_pressure_mpa: float | None
    touch_pressure_mpa: float | None
    end: BodyReading
    parts: tuple[PartState, ...]
    error_estimate: BodyErrorEstimate
    contact: WallContact
    folded: FoldedElements
    meshes: tuple[BodyMeshReading, ...]
    solver: SolverEffort
    seconds: Seconds
    path: tuple[PathReading, ...]
    curve: tuple[BodyReading, ...]
    computation: Computation[OwnBody] = field(repr=False, compare=False)

    @property
    def pressure_mpa(self) -> float:
        """Pressure reached, MPa."""
        return self.end.pressure_mpa

    @property
    def bending_angle_deg(self) -> float | None:
        """Rotation of the surface ``tip`` about y, degrees; None without one."""
        return self.end.bending_angle_deg

    @property
    def most_stressed(self) -> PartState:
        """The part with the highest von Mises stress."""
        return max(self.parts, key=lambda part: part.max_von_mises_mpa)

    @property
    def max_von_mises_mpa(self) -> float:
        """Highest von Mises Cauchy stress, MPa."""
        return self.most_stressed.max_von_mises_mpa

    @property
    def warnings(self) -> tuple[str, ...]:
        """Sentences on what makes the numbers less reliable than they look."""
        materials = {part.material.name: part.material for part in self.body.parts}
        known = (text for each in materials.values() for text in each.warnings)
        parts = (text for part in self.parts for text in part.warnings)
        across = against_symmetry(self.body.gravity, self.body.supports.symmetry)
        found = (*self.contact.warnings, *self.folded.warnings, *self._beyond)
        return (*known, *across, *parts, *found)

    @property
    def _beyond(self) -> tuple[str, ...]:
        """How a body is followed that does not bear its pressure; empty where it does."""
        limit = self.limit_pressure_mpa
        if self.converged or limit is None or self.body.load.by_volume:
            return ()
        return (
            f"no equilibrium is near beyond {limit:.4g} MPa: load.largest_volume in place of "
            "load.pressure follows the body there.",
        )

    @property
    def mesh(self) -> MeshSize:
        """The size of the finest mesh."""
        return self.meshes[-1].size

    def to_dict(self) -> dict[str, Any]:
        """Plain values for JSON; docs/json.md says what they mean."""
        from bellows_design.versions import versions

        return {
            "body": self.body.name,
            "digest": self.body.digest,
            "model": self.computation.model.name,
            "model_reason": self.reason,
            **asdict(self.end),
            "max_von_mises_mpa": self.max_von_mises_mpa,
            "max_von_mises_position_mm": list(self.most_stressed.max_von_mises_position_mm),
            "converged": self.converged,
            "message": self.message,
            "stable": self.stable,
            "limit_pressure_mpa": self.limit_pressure_mpa,
            "touch_pressure_mpa": self.touch_pressure_mpa,
            "parts": [part.to_dict() for part in self.parts],
            "warnings": list(self.warnings),
            "contact": asdict(self.contact),
            "folded_elements": asdict(self.folded),
            "error_estimate": asdict(self.error_estimate),
            "mesh": asdict(self.mesh),
            "meshes": [asdict(mesh.size) | asdict(mesh.reading) for mesh in self.meshes],
            "solver": asdict(self.solver),
            "seconds": self.seconds.to_dict(),
            "path": [asdict(reading) for reading in self.path],
            "curve": [asdict(reading) for reading in self.curve],
            "versions": versions(),
        }
