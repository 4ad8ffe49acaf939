"""Is there enough material between the cavity and the outside, everywhere?

The thickness at a point of the cavity's wall is its distance to the outside. That is what air has
to cross, whatever the fillets and edges around, and it does not depend on the triangulation.
Sideways the air crosses lines, upright layers, and obliquely both: lengths are counted in
`minimum_wall` along the bed and in `minimum_floor` across it, and the nearest outside in that count
must be at least 1 away.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from printers.measure.boundary import Boundary
from printers.profile import PrinterProfile
from printers.report import RuleResult, place
from printers.rules.walls import FACET_TOLERANCE, WallSurvey

Floats = NDArray[np.float64]

CANDIDATES = 8  # triangles looked at for the nearest one
ROUNDING = 1e-3  # mm
UPRIGHT = float(np.cos(np.radians(30.0)))  # ways out this close to the vertical cross layers


@dataclass(frozen=True)
class Thinnest:
    """The weakest way out: `thickness` mm from `point` (3,) mm, of the `required` mm that way."""

    thickness: float
    required: float
    point: Floats


def check_sealing_walls(
    boundary: Boundary, survey: WallSurvey, profile: PrinterProfile
) -> Iterator[RuleResult]:
    """The rules `minimum_lines`, and `minimum_layers` for ways out nearly upright."""
    points, way = _ways_out(boundary, survey, profile)
    counts = way / _scale(profile)
    sideways = np.abs(way[:, 2]) <= UPRIGHT * np.linalg.norm(way, axis=1)
    for rule, which, made_of in (
        ("minimum_lines", sideways, f"{profile.minimum_lines} lines of {profile.line_width:g} mm"),
        (
            "minimum_layers",
            ~sideways,
            f"{profile.minimum_solid_layers} layers of {profile.layer_height:g} mm",
        ),
    ):
        thinnest = _thinnest(points[which], way[which], counts[which])
        yield _judge(rule, thinnest, boundary.has_cavity, made_of)


def _ways_out(
    boundary: Boundary, survey: WallSurvey, profile: PrinterProfile
) -> tuple[Floats, Floats]:
    if boundary.has_cavity:
        points = _cavity_points(boundary)
        return points, _nearest_outside(boundary, points, _scale(profile)) - points
    # What is left to judge are the parallel walls seen by the survey.
    slabs = survey.slabs.chosen(survey.slabs.parallel)
    return slabs.middle, slabs.thickness[:, None] * slabs.normal


def _scale(profile: PrinterProfile) -> Floats:
    return np.array([profile.minimum_wall, profile.minimum_wall, profile.minimum_floor])


def _thinnest(points: Floats, way: Floats, counts: Floats) -> Thinnest | None:
    if not len(points):
        return None
    size = np.linalg.norm(counts, axis=1)
    weakest = int(size.argmin())
    thickness = float(np.linalg.norm(way[weakest]))
    return Thinnest(thickness, thickness / float(size[weakest]), points[weakest])


def _judge(rule: str, thinnest: Thinnest | None, has_cavity: bool, made_of: str) -> RuleResult:
    scope = "" if has_cavity else "; only parallel walls, as no cavity closes"
    if thinnest is None:
        message = "no wall lies this way" + scope
        return RuleResult(rule, "pass", "none", made_of, "mm", "whole part", message)
    enough = thinnest.thickness >= thinnest.required - FACET_TOLERANCE - ROUNDING
    where = place(thinnest.point)
    message = (
        f"the weakest place, {thinnest.thickness:.3f} mm at {where}, "
        f"{'has' if enough else 'has less than'} the {made_of} that seal "
        f"(facets may take {FACET_TOLERANCE:g} mm){scope}"
    )
    return RuleResult(
        rule,
        "pass" if enough else "fail",
        round(thinnest.thickness, 3),
        round(thinnest.required, 3),
        "mm",
        where,
        message,
    )


def _cavity_points(boundary: Boundary) -> Floats:
    """Samples and all vertices of the cavity's wall, away from the openings."""
    vertices = boundary.surface.vertices[np.unique(boundary.surface.triangles[boundary.of_cavity])]
    kept = vertices[~boundary.at_openings(vertices)]
    return np.concatenate([boundary.inside.points, kept])


def _nearest_outside(boundary: Boundary, points: Floats, scale: Floats) -> Floats:
    """(k, 3): the outside's nearest point in scaled lengths, on the triangles nearby."""
    from scipy.spatial import cKDTree

    spots, owner = _outside_spots(boundary)
    near = cKDTree(spots / scale).query(points / scale, k=min(CANDIDATES, len(spots)))[1]
    corners = boundary.surface.corners / scale
    best = np.empty_like(points)
    shortest = np.full(len(points), np.inf)
    for column in near.reshape(len(points), -1).T:
        close = closest_on_triangles(corners[owner[column]], points / scale)
        distance = np.linalg.norm(close - points / scale, axis=1)
        nearer = distance < shortest
        best[nearer], shortest[nearer] = close[nearer], distance[nearer]
    return best * scale


def _outside_spots(boundary: Boundary) -> tuple[Floats, NDArray[np.int64]]:
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


def closest_on_triangles(corners: Floats, points: Floats) -> Floats:
    """Nearest point (k, 3) of each triangle (k, 3, 3) to each point (k, 3).

    The foot of the perpendicular if it falls inside the triangle, otherwise the nearest point of
    the three sides.
    """
    inside = _foot(corners, points)
    best, shortest = inside, np.linalg.norm(inside - points, axis=1)
    shortest = np.where(np.isnan(shortest), np.inf, shortest)
    for side in range(3):
        close = _on_segments(corners[:, side], corners[:, (side + 1) % 3], points)
        distance = np.linalg.norm(close - points, axis=1)
        nearer = distance < shortest
        best = np.where(nearer[:, None], close, best)
        shortest = np.where(nearer, distance, shortest)
    return np.asarray(best)


def _foot(corners: Floats, points: Floats) -> Floats:
    """Foot of the perpendicular on the triangle's plane; NaN where it lies outside of it."""
    origin = corners[:, 0]
    first, second = corners[:, 1] - origin, corners[:, 2] - origin
    normal = np.cross(first, second)
    square = np.einsum("ij,ij->i", normal, normal)
    offset = points - origin
    with np.errstate(divide="ignore", invalid="ignore"):
        u = np.einsum("ij,ij->i", np.cross(offset, second), normal) / square
        v = np.einsum("ij,ij->i", np.cross(first, offset), normal) / square
    inside = (u >= 0) & (v >= 0) & (u + v <= 1)
    foot = (
        origin + np.where(inside, u, 0)[:, None] * first + np.where(inside, v, 0)[:, None] * second
    )
    return np.where(inside[:, None], foot, np.nan)


def _on_segments(start: Floats, end: Floats, points: Floats) -> Floats:
    along = end - start
    square = np.maximum(np.einsum("ij,ij->i", along, along), 1e-300)
    fraction = np.clip(np.einsum("ij,ij->i", points - start, along) / square, 0, 1)
    return np.asarray(start + fraction[:, None] * along)
