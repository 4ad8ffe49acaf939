"""What a finger exerts in a scene, as records."""

from __future__ import annotations

from dataclasses import asdict, dataclass, field
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from bellows_design.design.design import Design
    from bellows_design.design.scenes.scene import Scene
    from bellows_design.force.air import Air

MODEL = "chain"

Point = tuple[float, float]
"""x and z in the finger's plane, mm or N."""


@dataclass(frozen=True)
class ForceError:
    """Estimated errors of a force by their causes, in percent of it; all not negative.

    Attributes:
        interpolation: Of the law between the points of its table.
        mesh: Of the cell's mesh.
        ends: Of root and tip, which differ from the bubbles between them.
        shear: Of shear, which the law knows to first order.
        neighbours: Of contact with a mirror image, while the moment varies along a real finger.
    """

    interpolation: float = 0.0
    mesh: float = 0.0
    ends: float = 0.0
    shear: float = 0.0
    neighbours: float = 0.0

    @property
    def total(self) -> float:
        """All of them at once, percent."""
        return self.interpolation + self.mesh + self.ends + self.shear + self.neighbours

    def to_dict(self) -> dict[str, float]:
        """Plain values for JSON."""
        parts = {f"{name}_percent": value for name, value in asdict(self).items()}
        return {"force_percent": self.total, **parts}


@dataclass(frozen=True)
class ForceReading:
    """An equilibrium of the finger in its scene; forces are those of the full width.

    Attributes:
        pressure_mpa: MPa.
        distance_mm: From the finger's lower side at rest down to what blocks it; None where nothing
            does.
        force_n: Of a blocked finger, what it exerts on its support, without the moment; of a grip,
            the greatest normal force of one finger; else 0.
        components_n: That force along x and z, as the finger exerts it.
        moment_n_mm: That the support exerts on the tip about y, at the tip's lower edge; positive
            from +x towards -z.
        tip_position_mm: x and z of the tip's lower edge.
        tip_angle_deg: Rotation of the tip against the root.
        contact: Whether neighbouring bubbles touch.
        stable: Whether the state is stable under its loads.
        volume_mm3: Air inside.
        max_von_mises_mpa: Highest von Mises stress under this load; None where the law has none.
        max_von_mises_error_percent: Its estimated error; None where it is not known.
        error: Estimated errors of the force; None where there is no force.
        shape: x and z of the lower side, from root to tip, mm.
        touched: x and z of the points where objects press, mm.
        holds: Of a grip, whether it holds the object: the reading is then that of equilibrium with
            its weight. None in other scenes, and where no such equilibrium was found.
        largest_payload_g: Of a grip, the largest mass that is held; else None.
        largest_payload_error_percent: Its estimated error; None without one.
        warnings: Sentences on what makes this reading less reliable than it looks.
    """

    pressure_mpa: float
    distance_mm: float | None
    force_n: float
    components_n: Point
    moment_n_mm: float
    tip_position_mm: Point
    tip_angle_deg: float
    contact: bool
    stable: bool
    volume_mm3: float
    max_von_mises_mpa: float | None
    max_von_mises_error_percent: float | None
    error: ForceError | None
    shape: tuple[Point, ...] = field(repr=False)
    touched: tuple[Point, ...] = ()
    holds: bool | None = None
    largest_payload_g: float | None = None
    largest_payload_error_percent: float | None = None
    warnings: tuple[str, ...] = ()

    def to_dict(self) -> dict[str, Any]:
        """Plain values for JSON."""
        return {
            "pressure_mpa": self.pressure_mpa,
            "distance_mm": self.distance_mm,
            "force_n": self.force_n,
            "components_n": list(self.components_n),
            "moment_n_mm": self.moment_n_mm,
            "tip_position_mm": list(self.tip_position_mm),
            "tip_angle_deg": self.tip_angle_deg,
            "contact": self.contact,
            "stable": self.stable,
            "volume_mm3": self.volume_mm3,
            "max_von_mises_mpa": self.max_von_mises_mpa,
            "max_von_mises_error_percent": self.max_von_mises_error_percent,
            "error_estimate": None if self.error is None else self.error.to_dict(),
            "shape_mm": [list(point) for point in self.shape],
            "touched_mm": [list(point) for point in self.touched],
            "holds": self.holds,
            "largest_payload_g": self.largest_payload_g,
            "largest_payload_error_percent": self.largest_payload_error_percent,
            "warnings": list(self.warnings),
        }


@dataclass(frozen=True)
class Seconds:
    """Time spent on the cell's law and on the chain, s."""

    law: float
    chain: float

    def to_dict(self) -> dict[str, float]:
        """Plain values for JSON."""
        return {"law": self.law, "chain": self.chain, "total": self.law + self.chain}


@dataclass(frozen=True)
class ForceCurve:
    """What a finger exerts in a scene, over pressure and over distance.

    Attributes:
        design: The design.
        scene: Name of the scene.
        content: The scene.
        converged: Whether an equilibrium was found at every pressure asked for.
        message: How far the load came and why it stopped; empty if it did not.
        curve: One reading for each pressure, as far as they were reached.
        by_distance: Of a blocked finger with a load cell or wall, readings at the last pressure
            while that moves from its place to where the tip leaves it; else empty.
        tip_stiffness_n_per_mm: How the last force falls as its support moves away; None without
            one.
        pneumatic_work_mj: Work of the pressure on the air's volume over the curve's stroke, from
            rest, in N mm, which are mJ.
        tip_work_mj: Work of the tip on its support while that moves away at the last pressure;
            None without one.
        air: The air of the stroke.
        warnings: Sentences on what makes the numbers less reliable than they look.
        extrapolated: Whether sections bear moments that the law was not computed for.
        law_complete: Whether the law is as fine as asked for; else its time was over.
        jumped: Whether the finger jumped from one equilibrium to another on its way.
        seconds: Time spent.
        from_cache: When the law was computed (UTC), where it comes from the store; else empty.
    """

    design: Design
    scene: str
    content: Scene
    converged: bool
    message: str
    curve: tuple[ForceReading, ...]
    by_distance: tuple[ForceReading, ...]
    tip_stiffness_n_per_mm: float | None
    pneumatic_work_mj: float
    tip_work_mj: float | None
    air: Air
    warnings: tuple[str, ...]
    seconds: Seconds = field(compare=False)
    extrapolated: bool = False
    law_complete: bool = True
    jumped: bool = False
    from_cache: str = field(default="", compare=False)

    @property
    def last(self) -> ForceReading:
        """The reading at the highest pressure reached."""
        return self.curve[-1]

    def summary(self) -> dict[str, Any]:
        """What depends on the design alone, without the curves: for verdicts and manifests."""
        last = self.last
        return {
            "scene": self.scene,
            "content": self.content.model_dump(mode="json", exclude_none=True),
            "model": MODEL,
            "converged": self.converged,
            "message": self.message,
            "pressure_mpa": last.pressure_mpa,
            "force_n": last.force_n,
            "moment_n_mm": last.moment_n_mm,
            "tip_angle_deg": last.tip_angle_deg,
            "max_von_mises_mpa": last.max_von_mises_mpa,
            "max_von_mises_error_percent": last.max_von_mises_error_percent,
            "contact": last.contact,
            "stable": last.stable,
            "holds": last.holds,
            "largest_payload_g": last.largest_payload_g,
            "largest_payload_error_percent": last.largest_payload_error_percent,
            "error_estimate": None if last.error is None else last.error.to_dict(),
            "extrapolated": self.extrapolated,
            "law_complete": self.law_complete,
            "jumped": self.jumped,
            "warnings": list(self.warnings),
        }

    def to_dict(self) -> dict[str, Any]:
        """Plain values for JSON; docs/json.md says what they mean."""
        from bellows_design.versions import versions

        return {
            "design": self.design.name,
            "digest": self.design.digest,
            **self.summary(),
            "curve": [reading.to_dict() for reading in self.curve],
            "by_distance": [reading.to_dict() for reading in self.by_distance],
            "tip_stiffness_n_per_mm": self.tip_stiffness_n_per_mm,
            "pneumatic_work_mj": self.pneumatic_work_mj,
            "tip_work_mj": self.tip_work_mj,
            "air": self.air.to_dict(),
            "seconds": self.seconds.to_dict(),
            "from_cache": self.from_cache or None,
            "versions": versions(),
        }


@dataclass(frozen=True)
class SceneResult:
    """What became of one of the scenes that approval must hold.

    Attributes:
        scene: Its name.
        found: The force at the design pressure; None if there is none.
        failure: Why there is none; empty if there is.
    """

    scene: str
    found: ForceCurve | None = None
    failure: str = ""

    def to_dict(self) -> dict[str, Any]:
        """Plain values for JSON, without times."""
        if self.found is None:
            return {"scene": self.scene, "converged": False, "message": self.failure}
        return self.found.summary()
