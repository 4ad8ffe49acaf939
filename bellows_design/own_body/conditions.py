"""What holds an own body and acts on it, what is read of it, and how it is meshed."""

from __future__ import annotations

from typing import Literal

from pydantic import Field, field_validator, model_validator

from bellows_design.design.conditions import ATMOSPHERE
from bellows_design.own_body.record import BodyRecord, Names, Vector
from bellows_design.validation.parameters import require

Axis = Literal["x", "y", "z"]

AXES = {"x": 0, "y": 1, "z": 2}
"""Their numbers."""

HIGHEST_PRESSURE = 2.0
"""MPa."""

MOST_POINTS = 200


class BodySupports(BodyRecord):
    """Surfaces that are held.

    Attributes:
        clamped: Surfaces that do not move at all.
        symmetry: Plane surface -> the axis normal to it, along which it does not move. The body is
            half of the whole for one, a quarter for two, an eighth for three axes.
    """

    clamped: Names = ("root",)
    symmetry: dict[str, Axis] = Field(default_factory=dict)

    @property
    def share(self) -> int:
        """So many bodies make up the whole."""
        return 2 ** len(set(self.symmetry.values()))


class BodyLoad(BodyRecord):
    """The whole load: a pressure, or a volume of the cavity where a body balloons.

    Attributes:
        pressure: On the pressurised surfaces, MPa; negative for a vacuum, 0 for dead loads only.
        largest_volume: Instead of a pressure, in multiples of the undeformed cavity's volume; the
            pressure is then found, also where it falls again.
        points: How many volumes on the way to the largest one are read.
    """

    pressure: float | None = Field(
        default=None, ge=-ATMOSPHERE, le=HIGHEST_PRESSURE, json_schema_extra={"unit": "MPa"}
    )
    largest_volume: float | None = Field(default=None, gt=0, le=1000)
    points: int = Field(default=12, ge=1, le=MOST_POINTS)

    @model_validator(mode="after")
    def _is_one_load(self) -> BodyLoad:
        require(
            self.pressure is None or self.largest_volume is None,
            "load.pressure and load.largest_volume exclude each other: give one",
        )
        require(self.largest_volume != 1, "load.largest_volume is 1 but must differ from 1")
        return self

    @property
    def by_volume(self) -> bool:
        """Whether the cavity's volume is given, not its pressure."""
        return self.largest_volume is not None


class Film(BodyRecord):
    """A thin film glued to a surface: it resists stretching, and bends freely.

    Attributes:
        surface: Name of the surface, or of that between two parts, "first|second".
        young_modulus: MPa.
        poisson_ratio: Below 0.5, or 0.5 of an incompressible film.
        thickness: mm.
        wrinkles: Whether it wrinkles where it is pressed together, instead of bearing compression.
    """

    surface: str
    young_modulus: float = Field(gt=0, le=1e7, json_schema_extra={"unit": "MPa"})
    poisson_ratio: float = Field(default=0.3, gt=-1, le=0.5)
    thickness: float = Field(gt=0, le=100, json_schema_extra={"unit": "mm"})
    wrinkles: bool = True


class Gravity(BodyRecord):
    """Weight, which acts before any pressure does.

    Attributes:
        direction: Which way things fall; of any length but zero.
        acceleration: m/s².
    """

    direction: Vector = (0.0, 0.0, -1.0)
    acceleration: float = Field(default=9.80665, gt=0, le=1000, json_schema_extra={"unit": "m/s²"})

    @field_validator("direction")
    @classmethod
    def _has_a_length(cls, direction: Vector) -> Vector:
        require(any(direction), "gravity.direction must not be of length zero")
        return direction


class Obstacle(BodyRecord):
    """A rigid plane without friction, which stands still.

    Attributes:
        surface: Of the body, which may not pass the plane.
        point: On the plane, mm.
        normal: Of the plane, to the side on which the body is; of any length but zero.
    """

    surface: str
    point: Vector
    normal: Vector

    @field_validator("normal")
    @classmethod
    def _has_a_length(cls, normal: Vector) -> Vector:
        require(any(normal), "the normal of an obstacle must not be of length zero")
        return normal


class Tip(BodyRecord):
    """What is read at the tip. The bending angle is the rotation of the surface ``tip`` about y.

    Attributes:
        point: Whose displacement is read, in the undeformed body, mm; without it the mean of the
            surface ``tip``.
        base: Where the chord to the tip begins, mm; without it the mean of the first clamped
            surface.
    """

    point: Vector | None = None
    base: Vector | None = None


class BodyMesh(BodyRecord):
    """Sizes of the first mesh, mm; refined ones follow from it.

    Attributes:
        size: Longest edge; without it four thirds of the mean thickness, twice volume over area.
        sharp_edge_radius: How near to sharp edges no stress is reported; without it three
            sixteenths of the size, at most 0.4.
    """

    size: float | None = Field(default=None, gt=0, le=1000, json_schema_extra={"unit": "mm"})
    sharp_edge_radius: float | None = Field(
        default=None, ge=0, le=100, json_schema_extra={"unit": "mm"}
    )
