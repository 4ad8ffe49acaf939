"""What was read of a file."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from printers.arrays import Floats, Ints
from printers.errors import PrintersError
from printers.reading.limits import FARTHEST, MOST_TRIANGLES

LEAST = 4
"""Triangles, and vertices, of a tetrahedron."""

NOT_STATED = "not stated: taken as mm"


@dataclass(frozen=True, eq=False)
class ReadPart:
    """The surface of a part as its file has it.

    Attributes:
        vertices: mm; repeated as the file repeats them.
            *Shape:* `(n, 3)`
        triangles: Numbers of their vertices, from 0.
            *Shape:* `(m, 3)`
        format: "STL, binary", "STL, text", "3MF" or "STEP".
        units: As the file states them, or `NOT_STATED`.
        notes: What a reader of the report should know: what was left aside, what was supposed.
    """

    vertices: Floats
    triangles: Ints
    format: str
    units: str
    notes: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        if not len(self.triangles):
            raise PrintersError("it holds no triangle")
        require_few(len(self.triangles))
        _require_enough(self.vertices, self.triangles)
        _require_coordinates(self.vertices)


def require_few(triangles: int) -> None:
    """Raise PrintersError if a part has more triangles than can be measured."""
    if triangles > MOST_TRIANGLES:
        raise PrintersError(
            f"it has {triangles} triangles; at most {MOST_TRIANGLES} can be checked"
        )


def _require_enough(vertices: Floats, triangles: Ints) -> None:
    """Raise PrintersError for less than a tetrahedron has."""
    for count, one, several in (
        (len(triangles), "triangle", "triangles"),
        (len(vertices), "vertex", "vertices"),
    ):
        if count < LEAST:
            held = f"{count} {one if count == 1 else several}"
            raise PrintersError(f"it holds {held}; a solid has {LEAST} or more")


def _require_coordinates(vertices: Floats) -> None:
    if not np.isfinite(vertices).all():
        raise PrintersError("it holds a coordinate that is no finite number")
    farthest = float(np.abs(vertices).max())
    if farthest > FARTHEST:
        raise PrintersError(
            f"it holds a coordinate of {farthest:g} mm; they must lie within {FARTHEST:g} mm"
        )
