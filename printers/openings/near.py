"""An opening that is named by a point, with or without its diameter."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

import numpy as np

from printers.arrays import Floats
from printers.errors import PrintersError
from printers.measure.closest_point import closest_on_triangles
from printers.measure.surface import Surface
from printers.model import Opening
from printers.openings.find import FoundOpenings, Mouths
from printers.openings.mouth import Mouth
from printers.report import place
from printers.tolerances import ROUNDING

SNAP = 2.0
"""mm beyond its rim at which a mouth still counts as the one that a point names."""

FARTHEST = 5.0
"""mm from the surface within which an opening can be made of a point and a diameter."""

Named = tuple[float, float, float, float | None]
"""X, Y, Z and diameter, mm; None where that is not given."""


def named_opening(surface: Surface, mouths: Mouths, named: Named, name: str) -> FoundOpenings:
    """The mouth that was found nearest to a point, or one made of the point and a diameter there.

    A diameter that is given counts, whatever the mouth's is: `opening_width` then holds the mouth
    against it. Of a mouth into which a crack runs, that much around the point is the opening, and
    the crack is left open.

    Raises:
        PrintersError: No diameter is given, and no mouth is near or a crack runs into it; or no
            surface is near.
    """
    point, diameter = np.array(named[:3]), named[3]
    near = min(mouths.all, key=lambda mouth: _distance(mouth, point), default=None)
    if near is not None and _distance(near, point) <= near.reach + SNAP:
        return _snapped(near, point, diameter, name)
    if diameter is None:
        raise PrintersError(
            f"no mouth was found near {place(point)}{_nearest(near, point)}; give its diameter "
            "too, as X,Y,Z,DIAMETER, to declare one there"
        )
    return _made(surface, point, diameter, name)


def _distance(mouth: Mouth, point: Floats) -> float:
    return float(np.linalg.norm(point - mouth.centre))


def _nearest(mouth: Mouth | None, point: Floats) -> str:
    if mouth is None:
        return ""
    return f" (the nearest is {_distance(mouth, point):.1f} mm off at {mouth.described()})"


def _snapped(mouth: Mouth, point: Floats, diameter: float | None, name: str) -> FoundOpenings:
    off = _distance(mouth, point)
    note = f"{name}: the mouth at {mouth.described()}, {off:.2f} mm from the point given"
    if diameter is None:
        mouth.require_port()
        return FoundOpenings((mouth.opening(name),), (note,))
    radius = diameter / 2
    if not mouth.is_port:
        opening = Opening(name, _onto(mouth, point), mouth.direction, radius)
        return FoundOpenings((opening,), (f"{note}; {diameter:g} mm around that are the opening",))
    reach = mouth.reach if mouth.reach > radius else None
    opening = Opening(name, mouth.centre, mouth.direction, radius, reach)
    return FoundOpenings((opening,), (f"{note}; declared as {diameter:g} mm wide",))


def require_apart(openings: Sequence[Opening]) -> None:
    """Raise PrintersError if two openings are one mouth: their pins, side by side, overlap."""
    for one, other in combinations(openings, 2):
        apart = float(np.linalg.norm(np.subtract(one.centre, other.centre)))
        alike = float(np.dot(one.direction, other.direction)) > 0
        if alike and apart < one.radius + other.radius:
            raise PrintersError(
                f"{one.name} at {place(one.centre)} and {other.name} at {place(other.centre)} "
                f"are the same mouth, or overlap; name each mouth once"
            )


def _onto(mouth: Mouth, point: Floats) -> tuple[float, float, float]:
    """The point moved along the mouth's axis into the plane of its centre."""
    axis = np.asarray(mouth.direction)
    x, y, z = (float(value) for value in point - ((point - mouth.centre) @ axis) * axis)
    return x, y, z


def _made(surface: Surface, point: Floats, diameter: float, name: str) -> FoundOpenings:
    """An opening on the surface nearest to the point, along the mean normal around it."""
    distances = _distances(surface, point)
    nearest = float(distances.min())
    if nearest > diameter / 2 + FARTHEST:
        raise PrintersError(
            f"the part's surface is {nearest:.1f} mm from {place(point)}, too far for an opening"
        )
    around = distances <= nearest + ROUNDING
    normal = surface.area_vectors[around].sum(axis=0)
    length = float(np.linalg.norm(normal))
    if not length > 0:
        raise PrintersError(f"the surface at {place(point)} faces no direction")
    x, y, z = (float(value) for value in point)
    nx, ny, nz = (float(value) for value in normal / length)
    note = (
        f"{name}: no mouth was found near {place(point)}; taken there, {diameter:g} mm wide, along "
        f"the surface's normal ({nx:.2f}, {ny:.2f}, {nz:.2f})"
    )
    return FoundOpenings((Opening(name, (x, y, z), (nx, ny, nz), diameter / 2),), (note,))


def _distances(surface: Surface, point: Floats) -> Floats:
    """(m,) mm from each triangle to the point."""
    points = np.broadcast_to(point, (len(surface.triangles), 3))
    return np.asarray(np.linalg.norm(closest_on_triangles(surface.corners, points) - point, axis=1))
