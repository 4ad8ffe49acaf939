"""Between the cavity and the outside there must be enough material to seal, everywhere.

The thickness at a point of the cavity's wall is its distance to the outside. That is what air has
to cross, whatever the fillets and edges around, and it does not depend on the triangulation.
Sideways the air crosses lines, upright layers, and obliquely both: lengths are counted in
`minimum_wall` along the bed and in `minimum_floor` across it, and the nearest outside in that count
must be at least 1 away. Where cavity and outside touch, the way has no direction but that in which the
outside looks.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from printers.arrays import Flags, Floats, Ints
from printers.measure.boundary import Boundary
from printers.measure.closest_point import closest_on_triangles
from printers.measure.part import MeasuredPart
from printers.profile import PrinterProfile
from printers.report import RuleResult, against, at_least, place
from printers.tolerances import FACET_TOLERANCE, ROUNDING

TOUCHING = 1e-6  # mm: a shorter way is rounding, and so is its direction
CANDIDATES = 8  # triangles looked at for the nearest one
UPRIGHT = float(np.cos(np.radians(30.0)))  # ways out this close to the vertical cross layers


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


@dataclass(frozen=True)
class Thinnest:
    """The weakest way out: `thickness` mm from `point` (3,) mm, of the `required` mm that way."""

    thickness: float
    required: float
    point: Floats


def check_sealing_walls(part: MeasuredPart) -> Iterator[RuleResult]:
    """The rules `minimum_lines`, and `minimum_layers` for ways out nearly upright."""
    profile = part.profile
    ways, scale = ways_out(part), _scale(profile)
    sideways = np.abs(ways.direction[:, 2]) <= UPRIGHT
    lines = f"{profile.minimum_lines} lines of {profile.line_width:g} mm"
    layers = f"{profile.minimum_solid_layers} layers of {profile.layer_height:g} mm"
    for rule, which, made_of in (
        ("minimum_lines", sideways, lines),
        ("minimum_layers", ~sideways, layers),
    ):
        thinnest = _thinnest(ways.chosen(which), scale)
        yield _judge(rule, thinnest, part.boundary.has_cavity, made_of)


def ways_out(part: MeasuredPart) -> WaysOut:
    """From every sampled point of the cavity's wall.

    Without a cavity only the parallel walls of the survey are left, each crossed at its middle.
    """
    if part.boundary.has_cavity:
        return _nearest_outside(part.boundary, _scale(part.profile))
    slabs = part.walls.slabs.chosen(part.walls.slabs.parallel)
    return WaysOut(slabs.middle, slabs.thickness, slabs.normal)


def _scale(profile: PrinterProfile) -> Floats:
    return np.array([profile.minimum_wall, profile.minimum_wall, profile.minimum_floor])


def _thinnest(ways: WaysOut, scale: Floats) -> Thinnest | None:
    if not len(ways.points):
        return None
    required = 1 / np.linalg.norm(ways.direction / scale, axis=1)
    weakest = int((ways.thickness / required).argmin())
    thickness = float(ways.thickness[weakest])
    return Thinnest(thickness, float(required[weakest]), ways.points[weakest])


def _judge(rule: str, thinnest: Thinnest | None, has_cavity: bool, made_of: str) -> RuleResult:
    scope = "" if has_cavity else "; only parallel walls, as no cavity closes"
    if thinnest is None:
        message = "no wall lies this way" + scope
        return RuleResult(rule, "pass", "none", made_of, "mm", "whole part", message)
    thickness, required = thinnest.thickness, thinnest.required
    tolerance, where = FACET_TOLERANCE + ROUNDING, place(thinnest.point)
    enough = thickness >= required - tolerance
    message = (
        f"the weakest place, {thickness:.3f} mm at {where}, "
        f"{'has' if enough else 'has less than'} the {made_of} that seal, {required:.3f} mm "
        f"that way: {against(thickness, required, tolerance)}{scope}"
    )
    return at_least(rule, thickness, required, tolerance, where, message)


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
    direction[touching] = outwards[touching]
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
