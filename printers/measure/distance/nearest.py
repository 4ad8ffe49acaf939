"""The nearest point of a surface, and the largest balls that fit between its faces.

Compiled in one file, as numba's cache does not see changes in another one.
"""

from __future__ import annotations

import numpy as np

from printers.arrays import Flags, Floats, Ints
from printers.compilation import njit
from printers.measure.box_tree import BoxTree

OPPOSITE = float(np.cos(np.radians(30.0)))
"""A ball lies between two faces that open by less than 30 degrees: seen from its centre, they lie
opposite within that."""

TOWARDS = float(np.cos(np.radians(60.0)))
"""So much must a face look against the first one, so that a ball may touch it, or an edge of it:
the edge of two walls at a right angle is 45 degrees off from straight across."""

DEEPEST_TREE = 64
_MOST_STEPS = 32
_STEADY = 1e-6  # of a diameter: a ball that shrinks by less has found its place


def nearest_distances(tree: BoxTree, points: Floats) -> Floats:
    """(k,): distance, mm, of points (k, 3) to the surface."""
    arguments = tree.corners, tree.order, tree.starts, tree.lower, tree.upper
    return np.asarray(_distances(*arguments, np.ascontiguousarray(points)))


def inscribed_diameters(
    tree: BoxTree, faces: Floats, points: Floats, normals: Floats, across: Floats
) -> tuple[Floats, Flags]:
    """Diameters (k,) mm of the balls that touch the surface from within at `points` (k, 3).

    `faces` (m, 3) are the unit normals of the triangles. A ball lies on the inner side of the
    `normals` (k, 3) and touches an opposite face. It begins with the diameter `across` (k,), which
    must not lead out of the material, and shrinks to the ball through the nearest opposite point
    that it holds, until it holds none: Ma, Bae & Choi, "3D medial axis point approximation using
    nearest neighbors and the normal field", Visual Computer 28 (2012). The flags (k,) tell which
    balls shrank.
    """
    result = np.array(across)
    _shrink(
        tree.corners, tree.order, tree.starts, tree.lower, tree.upper,
        faces, np.ascontiguousarray(points), np.ascontiguousarray(normals), result,
    )  # fmt: skip
    return result, np.asarray(result < across)


@njit(cache=True)
def _distances(
    corners: Floats, order: Ints, starts: Ints, lower: Floats, upper: Floats, points: Floats
) -> Floats:
    result = np.empty(len(points))
    normal = np.zeros(3)
    found = np.empty(3)
    for k in range(len(points)):
        result[k] = np.sqrt(
            _nearest(
                corners, order, starts, lower, upper, corners[0], points[k], np.inf, normal, found
            )
        )  # fmt: skip
    return result


@njit(cache=True)
def _shrink(
    corners: Floats,
    order: Ints,
    starts: Ints,
    lower: Floats,
    upper: Floats,
    faces: Floats,
    points: Floats,
    normals: Floats,
    diameters: Floats,
) -> None:
    found, centre = np.empty(3), np.empty(3)
    for k in range(len(points)):
        point, normal = points[k], normals[k]
        for _step in range(_MOST_STEPS):
            radius = diameters[k] / 2
            for axis in range(3):
                centre[axis] = point[axis] - radius * normal[axis]
            bound = (radius * (1 - _STEADY)) ** 2
            square = _nearest(
                corners, order, starts, lower, upper, faces, centre, bound, normal, found
            )
            if square >= bound:
                break
            way, depth = 0.0, 0.0
            for axis in range(3):
                way += (point[axis] - found[axis]) ** 2
                depth += (point[axis] - found[axis]) * normal[axis]
            diameters[k] = min(diameters[k], way / depth)


@njit(cache=True)
def _nearest(
    corners: Floats,
    order: Ints,
    starts: Ints,
    lower: Floats,
    upper: Floats,
    faces: Floats,
    centre: Floats,
    bound: float,
    normal: Floats,
    found: Floats,
) -> float:
    """Squared distance of the nearest surface below `bound`, at `found`; else the bound.

    With a normal that is not zero only what lies against it, seen from the centre, and looks
    against it, counts.
    """
    first_leaf = len(starts) - 2
    stack = np.empty(DEEPEST_TREE + 2, dtype=np.int64)
    stack[0], size = 0, 1
    close = np.empty(3)
    against = _dot(normal, normal) > 0
    while size:
        size -= 1
        node = stack[size]
        if _box_square(lower[node], upper[node], centre) >= bound:
            continue
        if node < first_leaf:
            left, right = 2 * node + 1, 2 * node + 2
            to_left = _box_square(lower[left], upper[left], centre)
            to_right = _box_square(lower[right], upper[right], centre)
            stack[size] = right if to_left <= to_right else left
            stack[size + 1] = left if to_left <= to_right else right
            size += 2
            continue
        leaf = node - first_leaf
        for place in range(starts[leaf], starts[leaf + 1]):
            triangle = order[place]
            if against and _dot(faces[triangle], normal) > -TOWARDS:
                continue
            _closest(corners[triangle], centre, close)
            square = 0.0
            for axis in range(3):
                square += (close[axis] - centre[axis]) ** 2
            if square < bound and (not against or _opposite(close, centre, square, normal)):
                bound = square
                for axis in range(3):
                    found[axis] = close[axis]
    return bound


@njit(cache=True)
def _opposite(close: Floats, centre: Floats, square: float, normal: Floats) -> bool:
    depth = 0.0
    for axis in range(3):
        depth += (centre[axis] - close[axis]) * normal[axis]
    return depth > 0 and depth * depth >= OPPOSITE * OPPOSITE * square


@njit(cache=True)
def _dot(a: Floats, b: Floats) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@njit(cache=True)
def _box_square(lower: Floats, upper: Floats, point: Floats) -> float:
    square = 0.0
    for axis in range(3):
        off = max(lower[axis] - point[axis], 0.0, point[axis] - upper[axis])
        square += off * off
    return square


@njit(cache=True)
def _closest(corners: Floats, point: Floats, close: Floats) -> None:
    """Nearest point of a triangle: Ericson, Real-Time Collision Detection (2005), 5.1.5.

    Needles lose digits there, so their three sides are asked instead.
    """
    a, b, c = corners[0], corners[1], corners[2]
    d1, d2, d3, d4, d5, d6 = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for i in range(3):
        ab, ac = b[i] - a[i], c[i] - a[i]
        d1 += ab * (point[i] - a[i])
        d2 += ac * (point[i] - a[i])
        d3 += ab * (point[i] - b[i])
        d4 += ac * (point[i] - b[i])
        d5 += ab * (point[i] - c[i])
        d6 += ac * (point[i] - c[i])
    va, vb, vc = d3 * d6 - d5 * d4, d5 * d2 - d1 * d6, d1 * d4 - d3 * d2
    if va > 0 and vb > 0 and vc > 0:
        total = va + vb + vc
        for i in range(3):
            close[i] = a[i] + (b[i] - a[i]) * (vb / total) + (c[i] - a[i]) * (vc / total)
        return
    best = np.inf
    for side in range(3):
        start, end = corners[side], corners[(side + 1) % 3]
        along, length = 0.0, 0.0
        for i in range(3):
            along += (point[i] - start[i]) * (end[i] - start[i])
            length += (end[i] - start[i]) ** 2
        fraction = min(1.0, max(0.0, along / length)) if length > 0 else 0.0
        square = 0.0
        for i in range(3):
            square += (point[i] - start[i] - fraction * (end[i] - start[i])) ** 2
        if square < best:
            best = square
            for i in range(3):
                close[i] = start[i] + fraction * (end[i] - start[i])
