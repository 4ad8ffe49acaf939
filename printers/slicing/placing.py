"""Where the part stands on the bed: from its coordinates to those of the G-code, and back."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from printers.arrays import Floats
from printers.errors import PrintersError
from printers.gcode.beads import Beads
from printers.profile import PrinterProfile

LARGEST_ROTATION = 36_000.0
"""Degrees: beyond a hundred turns a degree loses its digits."""


@dataclass(frozen=True, eq=False)
class Placement:
    """A turn about z, then a shift: onto the middle of the bed, the part's lowest point on it.

    Attributes:
        rotation: Degrees, anticlockwise seen from above.
        shift: mm, after the turn.
            *Shape:* `(3,)`
    """

    rotation: float
    shift: Floats

    def to_gcode(self, points: Floats) -> Floats:
        """(n, 3) points of the part, mm, as they lie on the bed."""
        return points @ _turn(self.rotation).T + self.shift

    def to_part(self, points: Floats) -> Floats:
        """(n, 3) points on the bed, mm, in the part's own coordinates."""
        return (points - self.shift) @ _turn(self.rotation)


def placed(vertices: Floats, rotation: float, profile: PrinterProfile) -> Placement:
    """The placement with the middle of the turned part's box in the middle of the bed.

    Raises:
        PrintersError: The part does not fit the printer, or the rotation is no number.
    """
    if not abs(rotation) <= LARGEST_ROTATION:
        raise PrintersError(f"rotation is {rotation:g}°; it must lie within ±{LARGEST_ROTATION:g}°")
    turned = vertices @ _turn(rotation).T
    lower, upper = turned.min(axis=0), turned.max(axis=0)
    build = np.array(profile.build_volume)
    for axis, size in enumerate(upper - lower):
        if size > build[axis]:
            raise PrintersError(
                f"the part, turned by {rotation:g}°, is {size:.1f} mm long in {'xyz'[axis]}; "
                f"{profile.name} prints at most {build[axis]:g} mm"
            )
    middle = (lower + upper) / 2
    shift = [build[0] / 2 - middle[0], build[1] / 2 - middle[1], -lower[2]]
    return Placement(rotation, np.array(shift))


def turned_to_fit(vertices: Floats, profile: PrinterProfile) -> bool:
    """Whether the part fits the bed by a quarter turn alone.

    `vertices` are (n, 3) mm, as it stands.
    """
    length, width = np.ptp(vertices[:, :2], axis=0)
    room_x, room_y, _ = profile.build_volume
    fits, fits_turned = length <= room_x and width <= room_y, width <= room_x and length <= room_y
    return bool(fits_turned and not fits)


def misplaced(beads: Beads, on_bed: Floats, line_width: float) -> list[str]:
    """Sides of the part's box where no bead of it ends within a line, as sentences.

    `on_bed` are the part's vertices, (n, 3) mm, as they were placed.

    Raises:
        PrintersError: Opposite sides are off by the same: the slicer moved the part.
    """
    least, greatest = beads.part_box
    lower, upper = least - on_bed.min(axis=0), greatest - on_bed.max(axis=0)
    for axis in range(3):
        shift = (lower[axis] + upper[axis]) / 2
        if min(abs(lower[axis]), abs(upper[axis])) > line_width and lower[axis] * upper[axis] > 0:
            raise PrintersError(
                f"the slicer moved the part by {shift:.2f} mm in {'xyz'[axis]}: what its G-code "
                f"lays down cannot be compared with the part"
            )
    return list(_open_sides(lower, upper, line_width))


def _open_sides(lower: Floats, upper: Floats, line_width: float) -> list[str]:
    off = [(f"-{'xyz'[axis]}", lower[axis]) for axis in range(3)]
    off += [(f"+{'xyz'[axis]}", -upper[axis]) for axis in range(3)]
    return [
        f"nothing is laid down on the last {gap:.2f} mm towards {side}: something is thinner there "
        f"than the slicer prints"
        for side, gap in off
        if gap > line_width
    ]


def _turn(degrees: float) -> Floats:
    """(3, 3); exact for quarter turns."""
    quarters = degrees / 90
    if quarters == int(quarters):
        cosine, sine = ((1, 0), (0, 1), (-1, 0), (0, -1))[int(quarters) % 4]
    else:
        cosine, sine = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return np.array([[cosine, -sine, 0], [sine, cosine, 0], [0, 0, 1]], dtype=float)
