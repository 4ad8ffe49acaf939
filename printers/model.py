"""The part to be printed and what its designer says about it: the input of the printability check.

The part stands as it will be printed: build direction +z, the bed under its lowest point.
All lengths are in mm.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from printers.arrays import Floats, Ints
from printers.errors import PrintersError

WallKind = Literal["lines", "layers"]

SMALLEST_PART = 1.0  # mm: a part in metres or inches read as millimetres falls below or beyond
LARGEST_PART = 2000.0
LARGEST_LENGTH = 100.0


@dataclass(frozen=True)
class DeclaredWall:
    """A wall thickness the designer asks for.

    Attributes:
        name: As it appears in the report.
        thickness: mm.
        kind: What it is made of: "lines" side by side (a standing wall) or "layers" on top of each
            other (a floor or roof).
        around: The opening whose bore it surrounds; such a wall is looked for and measured there
            alone. None for walls that may be anywhere.

    Raises:
        PrintersError: The thickness is not within (0, 100] mm or the kind is unknown.

    Examples:
        >>> from printers import DeclaredWall
        >>> print(DeclaredWall("floor", 1.2, kind="layers"))  # mm
        DeclaredWall(name='floor', thickness=1.2, kind='layers', around=None)
    """

    name: str
    thickness: float
    kind: WallKind = "lines"
    around: Opening | None = None

    def __post_init__(self) -> None:
        _require_length(f"wall {self.name}", self.thickness)
        if self.kind not in ("lines", "layers"):
            raise PrintersError(f"wall {self.name}: kind is {self.kind!r}, not 'lines' or 'layers'")


@dataclass(frozen=True)
class DeclaredGap:
    """A width of air between neighbouring walls on the part's outside.

    Attributes:
        name: As it appears in the report.
        width: mm.

    Raises:
        PrintersError: The width is not within (0, 100] mm.

    Examples:
        >>> from printers import DeclaredGap
        >>> print(DeclaredGap("between bubbles", 1.2))  # mm
        DeclaredGap(name='between bubbles', width=1.2)
    """

    name: str
    width: float

    def __post_init__(self) -> None:
        _require_length(f"gap {self.name}", self.width)


@dataclass(frozen=True)
class Opening:
    """A hole into the cavity that is meant to be there.

    Attributes:
        name: As it appears in the report.
        centre: Middle of its mouth on the outside, mm.
            *Shape:* `(3,)`
        direction: Unit vector out of the part.
            *Shape:* `(3,)`
        radius: Of the bore, mm; of the widest pin that enters, if it is not round.
        reach: Radius around the axis within which a mouth that is not round lies, mm.

    Raises:
        PrintersError: A number is not finite, the radius or the reach not within (0, 100] mm or
            the direction no unit vector.

    Examples:
        >>> from printers import Opening
        >>> port = Opening("port", centre=(0, 0, 5), direction=(-1, 0, 0), radius=2.0)  # mm
        >>> try:
        ...     Opening("port", (0, 0, 5), (-1, 1, 0), 2.0)
        ... except ValueError as error:
        ...     print(error)
        direction of opening port has length 1.41421, not 1
    """

    name: str
    centre: tuple[float, float, float]
    direction: tuple[float, float, float]
    radius: float
    reach: float | None = None

    @property
    def plug_radius(self) -> float:
        """Of a plug that closes it, mm, but for a margin."""
        return max(self.radius, self.reach or 0.0)

    def __post_init__(self) -> None:
        _require_length(f"radius of opening {self.name}", self.radius)
        if self.reach is not None:
            _require_length(f"reach of opening {self.name}", self.reach)
        for label, vector in (("centre", self.centre), ("direction", self.direction)):
            if len(vector) != 3 or not all(math.isfinite(value) for value in vector):
                raise PrintersError(
                    f"{label} of opening {self.name} is {vector}, not three finite numbers"
                )
        length = math.hypot(*self.direction)
        if abs(length - 1) > 1e-3:
            raise PrintersError(f"direction of opening {self.name} has length {length:g}, not 1")


@dataclass(frozen=True, eq=False)
class PrintedModel:
    """The closed triangle mesh of a part with its declared walls, gaps and openings.

    Attributes:
        vertices: mm; they may be repeated as in an STL.
            *Shape:* `(n, 3)`
        triangles: Numbers of their vertices, from 0, anticlockwise seen from outside.
            *Shape:* `(m, 3)`
        walls: Thicknesses the part must have.
        gaps: Widths of air the part must have outside.
        openings: Every hole that is meant to lead into the cavity.
        cross_section_limit: Largest allowed extent in (y, z), mm.
        cross_section_start: x beyond which that limit counts, mm; None where it counts everywhere.

    Raises:
        PrintersError: The arrays are malformed, or the part is smaller than 1 mm or larger than
            2 m, as happens with wrong units.

    Examples:
        >>> import trimesh
        >>> from printers import DeclaredWall, PrintedModel
        >>> plate = trimesh.creation.box((20, 20, 1.2))
        >>> wall = DeclaredWall("plate", 1.2, "layers")  # mm
        >>> model = PrintedModel(plate.vertices, plate.faces, walls=(wall,))
        >>> print(model.vertices.shape, model.triangles.shape)
        (8, 3) (12, 3)
    """

    vertices: Floats
    triangles: Ints
    walls: tuple[DeclaredWall, ...] = ()
    gaps: tuple[DeclaredGap, ...] = ()
    openings: tuple[Opening, ...] = ()
    cross_section_limit: tuple[float, float] | None = None
    cross_section_start: float | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "vertices", _read_only(self.vertices, np.float64))
        object.__setattr__(self, "triangles", _read_only(self.triangles, np.int64))
        _require_mesh(self.vertices, self.triangles)
        if self.cross_section_limit is not None:
            for axis, limit in zip("yz", self.cross_section_limit, strict=True):
                _require_length(f"cross-section limit in {axis}", limit, LARGEST_PART)


def _read_only(values: ArrayLike, kind: type[np.generic]) -> NDArray[Any]:
    array: NDArray[Any] = np.array(values, dtype=kind)
    array.flags.writeable = False
    return array


def _require_length(name: str, value: float, largest: float = LARGEST_LENGTH) -> None:
    if not (math.isfinite(value) and 0 < value <= largest):
        raise PrintersError(f"{name} is {value:g} mm; it must lie above 0 and up to {largest:g} mm")


def _require_mesh(vertices: Floats, triangles: Ints) -> None:
    for name, array in (("vertices", vertices), ("triangles", triangles)):
        if array.ndim != 2 or array.shape[1] != 3 or len(array) < 4:
            raise PrintersError(f"{name} have the shape {array.shape}, not (4 or more, 3)")
    if not np.isfinite(vertices).all():
        raise PrintersError("vertices hold a coordinate that is not a finite number of mm")
    if triangles.min() < 0 or triangles.max() >= len(vertices):
        raise PrintersError(
            f"triangles name the vertex {triangles.min()} or {triangles.max()}, "
            f"but vertices count from 0 to {len(vertices) - 1}"
        )
    largest = float(np.ptp(vertices[np.unique(triangles)], axis=0).max())
    if not SMALLEST_PART <= largest <= LARGEST_PART:
        raise PrintersError(
            f"the part's largest extent is {largest:g} mm; it must lie between {SMALLEST_PART:g} "
            f"and {LARGEST_PART:g} mm (are the units millimetres?)"
        )
