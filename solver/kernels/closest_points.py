"""The points of a surface of six-node triangles that are closest to given points."""

from __future__ import annotations

from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from solver.arrays import Integers, Reals
from solver.numerics.compiled import compiled

Numbers: TypeAlias = NDArray[np.int64]
Flags: TypeAlias = NDArray[np.bool_]

ITERATIONS = 20
"""Of Newton's method for the closest point of a triangle or an edge; a few suffice."""

SETTLED = 1e-14
"""Largest last correction of a parameter of the triangle."""

INSIDE = 1e-10
"""By how much a parameter may lie outside the triangle."""

LONGEST = 0.5
"""Correction of the parameters in one iteration."""

BEHIND = 0.5
"""Cosine, at least, between a triangle's normal and the way from its edge to a point behind it."""

INTERIOR, EDGE, CORNER = 0, 1, 2
"""Where the closest point of a triangle is."""


class Feet(NamedTuple):
    """The closest points of a surface to points (p,).

    ``gaps`` (p,): signed distances, mm, infinite where nothing is near; ``triangles`` (p,): which
    of the surface, -1 for none; ``parameters`` (p, 2) in it; ``kinds`` (p,): ``INTERIOR``, ``EDGE``
    or ``CORNER``; ``edges`` (p,): number of the edge; ``normals`` (p, 3): direction in which the
    gap grows.
    """

    gaps: Reals
    triangles: Numbers
    parameters: Reals
    kinds: Numbers
    edges: Numbers
    normals: Reals


class Surface(NamedTuple):
    """Triangles that points may not be behind.

    ``triangles`` (k, 6), their ``neighbours`` (k, 3) across the edges, -1 for none, and ``rim``
    (k, 3): which of their corners lie on the rim, where triangles end without a neighbour.
    """

    triangles: Integers
    neighbours: Numbers
    rim: Flags


@compiled()
def shapes_at(r: float, s: float, shapes: Reals, slopes: Reals) -> None:
    """Quadratic shape functions (6,) of a triangle and their derivatives (6, 2) by r and s."""
    q = 1.0 - r - s
    shapes[0], shapes[1], shapes[2] = q * (2 * q - 1), r * (2 * r - 1), s * (2 * s - 1)
    shapes[3], shapes[4], shapes[5] = 4 * q * r, 4 * r * s, 4 * s * q
    slopes[0, 0] = slopes[0, 1] = 1 - 4 * q
    slopes[1, 0], slopes[1, 1] = 4 * r - 1, 0.0
    slopes[2, 0], slopes[2, 1] = 0.0, 4 * s - 1
    slopes[3, 0], slopes[3, 1] = 4 * (q - r), -4 * r
    slopes[4, 0], slopes[4, 1] = 4 * s, 4 * r
    slopes[5, 0], slopes[5, 1] = -4 * s, 4 * (q - s)


@compiled()
def position(x: Reals, shapes: Reals, slopes: Reals, place: Reals, along: Reals) -> None:
    """Point (3,) and tangents (2, 3) of a triangle with nodes x (6, 3)."""
    for i in range(3):
        place[i] = along[0, i] = along[1, i] = 0.0
        for a in range(6):
            place[i] += shapes[a] * x[a, i]
            along[0, i] += slopes[a, 0] * x[a, i]
            along[1, i] += slopes[a, 1] * x[a, i]


@compiled()
def second_derivatives(x: Reals, curved: Reals) -> None:
    """Second derivatives (3, 3) of a triangle's points: by rr, rs and ss, constant in it."""
    for i in range(3):
        curved[0, i] = 4 * (x[0, i] + x[1, i] - 2 * x[3, i])
        curved[1, i] = 4 * (x[0, i] - x[3, i] + x[4, i] - x[5, i])
        curved[2, i] = 4 * (x[0, i] + x[2, i] - 2 * x[5, i])


@compiled()
def dot(a: Reals, b: Reals) -> float:
    """Scalar product of vectors (3,)."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@compiled()
def unit_normal(along: Reals, normal: Reals) -> None:
    """Unit normal (3,) of tangents (2, 3)."""
    a, b = along[0], along[1]
    normal[0] = a[1] * b[2] - a[2] * b[1]
    normal[1] = a[2] * b[0] - a[0] * b[2]
    normal[2] = a[0] * b[1] - a[1] * b[0]
    length = np.sqrt(dot(normal, normal))
    for i in range(3):
        normal[i] /= length


@compiled()
def interior_foot(x: Reals, point: Reals, curved: Reals, found: Reals) -> bool:
    """Parameters (2,) of the closest point of a triangle, by Newton; False if it has none inside.

    Where the distance is not convex, without the curvature.
    """
    shapes, slopes, place, along = np.empty(6), np.empty((6, 2)), np.empty(3), np.empty((2, 3))
    r = s = 1.0 / 3.0
    for _ in range(ITERATIONS):
        shapes_at(r, s, shapes, slopes)
        position(x, shapes, slopes, place, along)
        for i in range(3):
            place[i] -= point[i]
        first, second = dot(along[0], place), dot(along[1], place)
        rr, rs, ss = dot(along[0], along[0]), dot(along[0], along[1]), dot(along[1], along[1])
        bent = rr + dot(curved[0], place), rs + dot(curved[1], place), ss + dot(curved[2], place)
        if bent[0] > 0 and bent[0] * bent[2] - bent[1] * bent[1] > 0.1 * (rr * ss - rs * rs):
            rr, rs, ss = bent
        determinant = rr * ss - rs * rs
        dr = -(ss * first - rs * second) / determinant
        ds = -(rr * second - rs * first) / determinant
        size = max(abs(dr), abs(ds))
        if not size < np.inf:
            return False
        share = min(1.0, LONGEST / size) if size > 0 else 1.0
        r = min(max(r + share * dr, -1.0), 2.0)
        s = min(max(s + share * ds, -1.0), 2.0)
        if size <= SETTLED:
            break
    found[0], found[1] = r, s
    return bool(size <= 1e-9 and r >= -INSIDE and s >= -INSIDE and r + s <= 1 + INSIDE)


@compiled()
def edge_foot(x: Reals, edge: int, point: Reals) -> float:
    """Parameter from 0 to 1 of the closest point of a triangle's edge, by Newton."""
    first, last, middle = x[edge], x[(edge + 1) % 3], x[3 + edge]
    slope, curve = 4 * middle - 3 * first - last, 4 * (first + last - 2 * middle)
    t = 0.5
    for _ in range(ITERATIONS):
        away = first + t * (slope + 0.5 * t * curve) - point
        tangent = slope + t * curve
        convexity, gauss = dot(tangent, tangent) + dot(curve, away), dot(tangent, tangent)
        step = -dot(tangent, away) / (convexity if convexity > 0.1 * gauss else gauss)
        moved = min(max(t + step, 0.0), 1.0)
        change, t = abs(moved - t), moved
        if change <= SETTLED:
            break
    return t


@compiled()
def edge_parameters(edge: int, t: float) -> tuple[float, float]:
    """r and s at a place from 0 to 1 along an edge."""
    if edge == 0:
        return t, 0.0
    if edge == 1:
        return 1.0 - t, t
    return 0.0, 1.0 - t


@compiled()
def squared_distance(x: Reals, r: float, s: float, point: Reals) -> float:
    """Of a point from the place r, s of a triangle, mm^2."""
    shapes, slopes, place, along = np.empty(6), np.empty((6, 2)), np.empty(3), np.empty((2, 3))
    shapes_at(r, s, shapes, slopes)
    position(x, shapes, slopes, place, along)
    place -= point
    return dot(place, place)


@compiled()
def foot(x: Reals, point: Reals, found: Reals) -> tuple[float, int, int]:
    """Squared distance, kind and edge of the closest point of a triangle; ``found``: r and s."""
    curved = np.empty((3, 3))
    second_derivatives(x, curved)
    if interior_foot(x, point, curved, found):
        return squared_distance(x, found[0], found[1], point), INTERIOR, 0
    least, kind, at = np.inf, EDGE, 0
    for edge in range(3):
        t = edge_foot(x, edge, point)
        r, s = edge_parameters(edge, t)
        distance = squared_distance(x, r, s, point)
        if distance < least:
            least, at = distance, edge
            kind = CORNER if t == 0.0 or t == 1.0 else EDGE
            found[0], found[1] = r, s
    return least, kind, at


@compiled()
def signed_gap(x: Reals, point: Reals, r: float, s: float, kind: int, normal: Reals) -> float:
    """Signed distance of a point from its foot and the direction (3,) in which it grows.

    From an edge or corner between triangles it counts only if the point is behind both, about.
    """
    shapes, slopes, place, along = np.empty(6), np.empty((6, 2)), np.empty(3), np.empty((2, 3))
    shapes_at(r, s, shapes, slopes)
    position(x, shapes, slopes, place, along)
    unit_normal(along, normal)
    away = point - place
    gap = dot(away, normal)
    if kind == INTERIOR:
        return gap
    distance = np.sqrt(dot(away, away))
    if distance == 0.0:
        return 0.0
    if abs(gap) < BEHIND * distance:
        return np.inf
    signed = distance if gap > 0 else -distance
    for i in range(3):
        normal[i] = away[i] / signed
    return signed


@compiled()
def closest(
    point: Reals, candidates: Numbers, nodes: Reals, surface: Surface, found: Reals
) -> tuple[int, int, int]:
    """Triangle (-1 for none), kind and edge of a point's foot, a search from ``candidates`` (c,).

    ``found``: its parameters (2,). From an edge the search goes on beyond it as long as that is
    nearer.
    """
    least, chosen, kind, edge, tried = np.inf, -1, INTERIOR, 0, np.empty(2)
    for triangle in candidates:
        for _ in range(ITERATIONS):
            if triangle < 0:
                break
            distance, this, beyond = foot(nodes[surface.triangles[triangle]], point, tried)
            if distance >= least:
                break
            least, chosen, kind, edge = distance, triangle, this, beyond
            found[0], found[1] = tried[0], tried[1]
            triangle = surface.neighbours[triangle, beyond] if this != INTERIOR else -1
    return chosen, kind, edge


@compiled()
def on_rim(surface: Surface, triangle: int, kind: int, edge: int, r: float, s: float) -> bool:
    """Whether a foot is on the rim of the surface."""
    if kind == INTERIOR:
        return False
    if kind == EDGE:
        return bool(surface.neighbours[triangle, edge] < 0)
    return bool(surface.rim[triangle, 1 if r > 0.5 else 2 if s > 0.5 else 0])


@compiled()
def find_feet(
    points: Reals, candidates: Numbers, nodes: Reals, surface: Surface, reach: float
) -> Feet:
    """Closest points of a surface to points (p, 3).

    ``candidates`` (p, c): triangles where the search begins, -1 for none; ``nodes`` (n, 3) of the
    deformed body. Points beyond the rim, or deeper than ``reach``, do not count.
    """
    count = len(points)
    gaps, normals = np.full(count, np.inf), np.zeros((count, 3))
    chosen, kinds, edges = np.full(count, -1), np.zeros(count, np.int64), np.zeros(count, np.int64)
    parameters = np.zeros((count, 2))
    for p in range(count):
        chosen[p], kinds[p], edges[p] = closest(
            points[p], candidates[p], nodes, surface, parameters[p]
        )
        r, s = parameters[p]
        if chosen[p] >= 0 and not on_rim(surface, chosen[p], kinds[p], edges[p], r, s):
            x = nodes[surface.triangles[chosen[p]]]
            gaps[p] = signed_gap(x, points[p], r, s, kinds[p], normals[p])
        if not gaps[p] >= -reach or gaps[p] == np.inf:
            gaps[p], chosen[p] = np.inf, -1
            normals[p] = 0.0
    return Feet(gaps, chosen, parameters, kinds, edges, normals)
