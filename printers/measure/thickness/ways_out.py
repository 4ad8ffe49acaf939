"""Ways out of the cavity: from points of its wall, and of the bores into it, to the outside.

The thickness at a point of the cavity's wall is its distance to the outside. That is what air has
to cross, whatever the fillets and edges around, and it does not depend on the triangulation. It is
measured in lengths that count differently along the bed and across it.

A bore behind its mouth is as near to the outside as the mouth is, through air. There the material
counts that a ray crosses at right angles to the bore's face, where it leaves by a face opposite:
faces that open by more than 30 degrees, such as the one around the mouth, are no wall.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from printers.arrays import Flags, Floats, Ints
from printers.measure.boundary import Boundary
from printers.measure.box_tree import first_hits
from printers.measure.closest_point import closest_on_triangles
from printers.measure.plugging import PLUG_MARGIN, near_axis
from printers.measure.samples import sample
from printers.measure.surface import Surface
from printers.model import Opening
from printers.tolerances import ROUNDING

TOUCHING = 1e-6
"""mm. A shorter way is rounding, and so is its direction."""

SIDEWAYS = np.array([1.0, 0.0, 0.0])
CANDIDATES = 8  # triangles looked at for the nearest one
OPPOSITE = float(np.cos(np.radians(30.0)))
ALONG = float(np.sin(np.radians(30.0)))  # faces of a bore lie along its axis as closely as this
SAMPLES_PER_SQUARE_MILLIMETRE = 40.0
SAMPLE_BOUNDS = (1_000, 20_000)


@dataclass(frozen=True)
class WaysOut:
    """From points of the cavity's wall to the nearest outside.

    `points` (k, 3) mm, `thickness` (k,) mm, unit `direction` (k, 3).
    """

    points: Floats
    thickness: Floats
    direction: Floats

    def chosen(self, which: Flags) -> WaysOut:
        """Those of the flags (k,)."""
        return WaysOut(self.points[which], self.thickness[which], self.direction[which])


def ways_out(boundary: Boundary, bare: Surface, scale: Floats) -> WaysOut:
    """From all over the cavity's wall and the bores of its openings.

    Args:
        boundary: Of a part with a cavity.
        bare: The surface of the part without plugs.
        scale: mm that count as 1 along x, y and z.
            *Shape:* `(3,)`
    """
    ways = [_nearest_outside(boundary, scale), *_around_bores(boundary, bare, 2 * scale.max())]
    return WaysOut(
        np.concatenate([each.points for each in ways]),
        np.concatenate([each.thickness for each in ways]),
        np.concatenate([each.direction for each in ways]),
    )


def _around_bores(boundary: Boundary, bare: Surface, reach: float) -> Iterator[WaysOut]:
    """Through the material around each bore, behind its mouth, up to `reach` mm."""
    for opening in boundary.openings:
        faces = np.flatnonzero(_of_bore(bare, opening))
        if not len(faces):
            continue
        bore = Surface(bare.vertices, bare.triangles[faces])
        spots = sample(bore, SAMPLES_PER_SQUARE_MILLIMETRE, SAMPLE_BOUNDS)
        behind = (spots.points - opening.centre) @ np.asarray(opening.direction) <= 0
        left_out = near_axis(spots.points, opening, boundary.bore_depth)
        spots = spots.chosen(behind & left_out & ~boundary.at_leaks(spots.points))
        yield _crossed(boundary, bare, spots.points, -spots.normals, reach)


def _of_bore(surface: Surface, opening: Opening) -> Flags:
    """(m,): faces along the axis of an opening that look at it, of a bore of any shape."""
    axis = np.asarray(opening.direction)
    offset = surface.corners.mean(axis=1) - opening.centre
    across = offset - (offset @ axis)[:, None] * axis
    near = np.linalg.norm(across, axis=1) <= opening.plug_radius + PLUG_MARGIN
    looks_in = np.einsum("ij,ij->i", surface.normals, across) < 0
    return np.asarray(near & looks_in & (np.abs(surface.normals @ axis) <= ALONG))


def _crossed(
    boundary: Boundary, bare: Surface, points: Floats, direction: Floats, reach: float
) -> WaysOut:
    """Ways that leave the material to the outside, through a face opposite."""
    start = points + TOUCHING * direction
    thickness, face = first_hits(bare.tree, start, start + reach * direction)
    facing = np.einsum("ij,ij->i", bare.normals[face], direction)
    ways = WaysOut(points, thickness, direction)
    ways = ways.chosen(np.isfinite(thickness) & (facing >= OPPOSITE))
    return ways.chosen(~_into_cavity(boundary, ways))


def _into_cavity(boundary: Boundary, ways: WaysOut) -> Flags:
    """(k,): which ways end on the cavity's wall; what ends in a plug does not."""
    end, step = ways.points + ways.thickness[:, None] * ways.direction, ROUNDING * ways.direction
    face = first_hits(boundary.surface.tree, end - step, end + step)[1]
    return np.asarray((face >= 0) & boundary.of_cavity[face])


def _cavity_points(boundary: Boundary) -> Floats:
    """Samples and all vertices of the cavity's wall, away from the openings."""
    vertices = boundary.surface.vertices[np.unique(boundary.surface.triangles[boundary.of_cavity])]
    kept = vertices[~boundary.at_openings(vertices)]
    return np.concatenate([boundary.inside.points, kept])


def _nearest_outside(boundary: Boundary, scale: Floats) -> WaysOut:
    """To the outside's nearest point in scaled lengths, on the triangles nearby."""
    from scipy.spatial import cKDTree

    points = _cavity_points(boundary)
    spots, owner = _outside_spots(boundary)
    near = cKDTree(spots / scale).query(points / scale, k=min(CANDIDATES, len(spots)))[1]
    corners = boundary.surface.corners / scale
    best, reached = np.empty_like(points), np.zeros(len(points), dtype=np.int64)
    shortest = np.full(len(points), np.inf)
    for column in near.reshape(len(points), -1).T:
        close = closest_on_triangles(corners[owner[column]], points / scale)
        distance = np.linalg.norm(close - points / scale, axis=1)
        nearer = distance < shortest
        best[nearer], shortest[nearer] = close[nearer], distance[nearer]
        reached[nearer] = owner[column][nearer]
    return _ways(points, best * scale - points, boundary.surface.normals[reached])


def _ways(points: Floats, way: Floats, outwards: Floats) -> WaysOut:
    """Ways (k, 3) mm, which look `outwards` (k, 3) where they are too short to say."""
    thickness = np.linalg.norm(way, axis=1)
    touching = thickness <= TOUCHING
    direction = way / np.where(touching, 1.0, thickness)[:, None]
    looks = np.linalg.norm(outwards, axis=1) > 0  # a triangle without area looks nowhere
    direction[touching] = np.where(looks.reshape(-1, 1), outwards, SIDEWAYS)[touching]
    return WaysOut(points, np.where(touching, 0.0, thickness), direction)


def _outside_spots(boundary: Boundary) -> tuple[Floats, Ints]:
    """Samples and vertices of the outside, each with a triangle it lies on."""
    surface = boundary.surface
    owner = np.full(len(surface.vertices), -1, dtype=np.int64)
    outer = np.flatnonzero(~boundary.of_cavity)
    owner[surface.triangles[outer]] = outer[:, None]
    used = np.flatnonzero(owner >= 0)
    return (
        np.concatenate([boundary.outside.points, surface.vertices[used]]),
        np.concatenate([boundary.outside.triangle, owner[used]]),
    )
