"""Where a mouth is, how wide, and whether it is round: from the rim that was found."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from printers.arrays import Floats, Ints
from printers.errors import PrintersError
from printers.measure.closest_point import closest_on_segments
from printers.measure.plugging import frame_of
from printers.measure.surface import Surface, label
from printers.measure.widths import shown
from printers.model import LARGEST_LENGTH, Opening
from printers.openings.inner_surface import Cavity, rim_of
from printers.report import place
from printers.tolerances import FACET_TOLERANCE, ROUNDING

ENTRY = 0.5  # mm behind the rim over which a pin of the mouth's diameter must find room
LEAST_PIN = 0.05  # mm: where less enters, something stands in the mouth, as `opening_width` says
DIGITS = 6  # of a coordinate in mm: more are noise of single precision
PLANE = 0.05  # mm: a rim this close to a plane is one
LONGEST = 2.5
"""Ratio of reach to radius up to which a mouth is a port, beyond it a slit. A slot twice as long as
it is wide has 2.24, a square 1.41. A convention: what is longer is asked about."""
MOST_HULL_CORNERS = 1000  # of the line around a rim: more are finer than its bays are judged


@dataclass(frozen=True)
class Mouth:
    """A mouth of a cavity.

    Attributes:
        centre: Middle of its rim, mm.
        direction: Unit vector out of the part.
        radius: Of the widest pin that enters, mm.
        reach: Radius around the axis within which the rim lies, mm.
        area: Of the rim as seen along the axis, mm².
        is_round: Whether the rim is a circle, within the tolerance of facets.
        is_plane: Whether it lies in a plane; a hole in a round wall does not.
        bay: How far the rim runs in from the shortest line around it, mm: where a crack, or
            another hole, runs into the mouth. 0 if it is round.
        beyond: How much farther than the rim the cavity's wall lies from the axis, mm: nothing if
            it is a plain hole, such as a screw's.
    """

    centre: tuple[float, float, float]
    direction: tuple[float, float, float]
    radius: float
    reach: float
    area: float
    is_round: bool
    is_plane: bool
    bay: float = 0.0
    beyond: float = 0.0

    @property
    def is_port(self) -> bool:
        """Whether a plug may fill all of it: it is no slit, and nothing runs into it."""
        is_slit = self.reach > LONGEST * self.radius
        return self.is_round or not (is_slit or self.bay > FACET_TOLERANCE)

    @property
    def diameter(self) -> float:
        """Of the circle, or of one with the same area, mm."""
        return 2 * self.radius if self.is_round else 2 * float(np.sqrt(self.area / np.pi))

    def opening(self, name: str) -> Opening:
        """As it is declared. Raises PrintersError if it is wider than an opening can be."""
        reach = None if self.is_round else self.reach
        return Opening(name, self.centre, self.direction, self.radius, reach)

    def require_port(self) -> None:
        """Raise PrintersError if a plug of the whole mouth would hide a crack that runs into it."""
        if not self.is_port:
            raise PrintersError(
                f"the mouth at {self.described()} is a slit, or a crack or another hole runs into "
                "it; name what is meant to be open with --opening X,Y,Z,DIAMETER in mm: what is "
                "open beside that is then a leak"
            )

    def described(self) -> str:
        """Its place and width, for people."""
        width = f"{shown(self.diameter)} mm wide"
        if not self.is_round:
            width = (
                f"not round: {shown(2 * self.radius)} to {shown(2 * self.reach)} mm wide, "
                f"its area that of {shown(self.diameter)} mm"
            )
        return f"{place(self.centre)} ({width})"


def mouths_of(surface: Surface, cavity: Cavity) -> tuple[Mouth, ...]:
    """The mouths of a cavity, the widest first; rims that enclose nothing are none."""
    found = (_mouth(surface, cavity, rim) for rim in cavity.rims)
    mouths = [mouth for mouth in found if mouth is not None]
    return tuple(sorted(mouths, key=lambda mouth: -mouth.radius))


def _mouth(surface: Surface, cavity: Cavity, rim: Ints) -> Mouth | None:
    start, end = rim_of(surface, cavity.triangles, rim)
    middle = start.mean(axis=0)
    vector = -np.cross(start - middle, end - middle).sum(axis=0) / 2  # the fan faces the cavity
    area = float(np.linalg.norm(vector))
    if not area > ROUNDING**2:
        return None
    axis = vector / area
    frame = frame_of(Opening("", tuple(middle), tuple(axis), 1.0))
    flat_start, flat_end = (start - middle) @ frame, (end - middle) @ frame
    across, radius, is_round = _circle(flat_start[:, :2], flat_end[:, :2])
    centre = middle + frame[:, :2] @ across
    distances = np.linalg.norm(flat_start[:, :2] - across, axis=1)
    room = _room(surface, cavity, centre, axis, frame)
    pin = room if LEAST_PIN < room < radius - 2 * FACET_TOLERANCE else radius
    height = float(np.ptp(flat_start[:, 2]))
    return Mouth(
        centre=_triple(centre),
        direction=_triple(axis),
        radius=_rounded(min(pin, LARGEST_LENGTH)),
        reach=float(distances.max()),
        area=area,
        is_round=is_round,
        is_plane=height <= 2 * PLANE,
        bay=0.0 if is_round else _bay(surface, cavity, flat_start, (middle, frame)),
        beyond=_farthest(surface, cavity, centre, frame) - float(distances.max()),
    )


def _triple(vector: Floats) -> tuple[float, float, float]:
    x, y, z = (_rounded(value) for value in vector)
    return x, y, z


def _rounded(value: float) -> float:
    return round(float(value), DIGITS) + 0.0


def _circle(start: Floats, end: Floats) -> tuple[Floats, float, bool]:
    """Centre (2,) and radius of a rim's projection (k, 2), and whether it is a circle.

    A circle through the corners, by least squares (Kåsa, 1976), where that is what they lie on;
    else the middle of the area, and the radius of a pin there.
    """
    system = np.column_stack([2 * start, np.ones(len(start))])
    solution = np.linalg.lstsq(system, (start**2).sum(axis=1), rcond=None)[0]
    centre = solution[:2]
    radius = float(np.sqrt(max(solution[2] + centre @ centre, 0.0)))
    off = np.abs(np.linalg.norm(start - centre, axis=1) - radius)
    if len(start) > 8 and off.max() <= FACET_TOLERANCE:
        return centre, radius, True
    return _middle_of_area(start, end), _pin(start, end), False


def _middle_of_area(start: Floats, end: Floats) -> Floats:
    cross = start[:, 0] * end[:, 1] - start[:, 1] * end[:, 0]
    return np.asarray((cross[:, None] * (start + end)).sum(axis=0) / (3 * cross.sum()))


def _pin(start: Floats, end: Floats) -> float:
    """Radius of the pin that enters in the middle of the area."""
    middle = np.broadcast_to(_middle_of_area(start, end), start.shape)
    return float(np.linalg.norm(closest_on_segments(start, end, middle) - middle, axis=1).min())


def _bay(surface: Surface, cavity: Cavity, rim: Floats, axes: tuple[Floats, Floats]) -> float:
    """How far, mm, the rim (k, 3) runs in.

    Along a fillet a rim steps from facet to facet. So the wall's section right behind it counts
    too, unless that is wider than the rim, as it is of the chamber behind.
    """
    deepest = _deepest_bay(rim[:, :2])
    section = _section(surface, cavity, axes, float(rim[:, 2].min()) - ROUNDING)
    reach = np.linalg.norm(rim[:, :2], axis=1).max() + FACET_TOLERANCE
    within = len(section) > 2 and np.linalg.norm(section, axis=1).max() <= reach
    return min(deepest, _deepest_bay(section)) if within else deepest


def _section(
    surface: Surface, cavity: Cavity, axes: tuple[Floats, Floats], height: float
) -> Floats:
    """Corners (k, 2) of the cavity's wall, cut at a height along the axis: the curve nearest it."""
    middle, frame = axes
    corners = (surface.corners - middle) @ frame
    above = corners[:, :, 2] > height
    cut = cavity.triangles & (above.any(axis=1) != above.all(axis=1))
    first, second, _ = surface.neighbours
    joined = cut[first] & cut[second]
    curve = label(len(cut), first[joined], second[joined])
    at, off = corners[cut], np.full(len(cut), np.inf)
    off[cut] = np.linalg.norm(at[:, :, :2], axis=2).min(axis=1)
    if not cut.any():
        return np.zeros((0, 2))
    chosen = corners[cut & (curve == curve[off.argmin()])]
    start, end = chosen.reshape(-1, 3), np.roll(chosen, -1, axis=1).reshape(-1, 3)
    crosses = (start[:, 2] > height) != (end[:, 2] > height)
    start, end = start[crosses], end[crosses]
    share = (height - start[:, 2]) / (end[:, 2] - start[:, 2])
    return np.asarray(start[:, :2] + share[:, None] * (end - start)[:, :2])


def _deepest_bay(rim: Floats) -> float:
    """How far, mm, a corner of the rim (k, 2) lies within the convex hull of all."""
    from scipy.spatial import ConvexHull

    around = ConvexHull(rim).vertices  # anticlockwise
    start = rim[around[:: 1 + len(around) // MOST_HULL_CORNERS]]
    side = np.roll(start, -1, axis=0) - start
    inwards = np.column_stack([-side[:, 1], side[:, 0]]) / np.linalg.norm(side, axis=1)[:, None]
    within = np.full(len(rim), np.inf)
    for corner, normal in zip(start, inwards, strict=True):
        within = np.minimum(within, (rim - corner) @ normal)
    return float(within.max())


def _farthest(surface: Surface, cavity: Cavity, centre: Floats, frame: Floats) -> float:
    """Greatest distance, mm, of the cavity's wall from the axis."""
    across = (surface.corners[cavity.triangles] - centre) @ frame[:, :2]
    return float(np.linalg.norm(across, axis=2).max())


def _room(surface: Surface, cavity: Cavity, centre: Floats, axis: Floats, frame: Floats) -> float:
    """Least distance, mm, of the wall right behind the rim from the axis; inf without any."""
    corners = (surface.corners[cavity.triangles] - centre) @ frame
    behind = corners[:, :, 2]
    near = (behind.max(axis=1) <= ROUNDING) & (behind.min(axis=1) >= -ENTRY)
    if not near.any():
        return np.inf
    sides = [(corners[near][:, i, :2], corners[near][:, (i + 1) % 3, :2]) for i in range(3)]
    distances = [
        np.linalg.norm(closest_on_segments(a, b, np.zeros_like(a)), axis=1).min() for a, b in sides
    ]
    return float(min(distances))
