"""A bounding-box tree over triangles.

It answers one question, *which segments cross which triangles*, in double precision, so that
thickness, gaps and self-intersection all rest on the same arithmetic. All compiled code of the
package is in this file: numba's cache does not see changes in another one.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from printers.arrays import Flags, Floats, Ints
from printers.compilation import njit

LEAF_SIZE = 4
BARYCENTRIC_SLACK = 1e-9
BOX_SLACK = 1e-9  # mm
DEEPEST_TREE = 64


@dataclass(frozen=True)
class BoxTree:
    """A complete binary tree of axis-aligned boxes; node i has the children 2i + 1 and 2i + 2.

    `corners` (m, 3, 3) are the triangles; `order` (m,) lists them leaf by leaf; leaf number k holds
    `order[starts[k]:starts[k + 1]]`; `lower` and `upper` (nodes, 3) are the boxes in mm.
    """

    corners: Floats
    order: Ints
    starts: Ints
    lower: Floats
    upper: Floats

    @property
    def depth(self) -> int:
        return (len(self.starts) - 1).bit_length() - 1


@dataclass(frozen=True)
class Crossings:
    """Where segments cross triangles: equal-length arrays, in no particular order.

    `fraction` is the place along the segment in [0, 1], `inside` the smallest barycentric
    coordinate of the crossing (0 on the triangle's rim).
    """

    segment: Ints
    triangle: Ints
    fraction: Floats
    inside: Floats

    def chosen(self, which: Flags | Ints) -> Crossings:
        """The crossings picked by flags or by number."""
        return Crossings(
            self.segment[which], self.triangle[which], self.fraction[which], self.inside[which]
        )


def build_tree(corners: Floats) -> BoxTree:
    """Halve the triangles (m, 3, 3) along the longest side of their box, level by level."""
    count = len(corners)
    depth = max(0, int(np.ceil(np.log2(max(count, 1) / LEAF_SIZE))))
    centres = corners.mean(axis=1)
    order = np.arange(count)
    for level in range(depth):
        starts = _starts(count, level)
        order = _sorted_within_nodes(centres, order, starts)
    return _with_boxes(corners, order, _starts(count, depth), depth)


def _starts(count: int, level: int) -> Ints:
    return np.asarray((np.arange(2**level + 1) * count) // 2**level, dtype=np.int64)


def _sorted_within_nodes(centres: Floats, order: Ints, starts: Ints) -> Ints:
    placed = centres[order]
    extent = np.maximum.reduceat(placed, starts[:-1]) - np.minimum.reduceat(placed, starts[:-1])
    node = np.repeat(np.arange(len(starts) - 1), np.diff(starts))
    key = np.take_along_axis(placed, extent.argmax(axis=1)[node][:, None], axis=1)[:, 0]
    return order[np.lexsort((key, node))]


def _with_boxes(corners: Floats, order: Ints, starts: Ints, depth: int) -> BoxTree:
    lower = np.empty((2 ** (depth + 1) - 1, 3))
    upper = np.empty_like(lower)
    first_leaf = 2**depth - 1
    lower[first_leaf:] = np.minimum.reduceat(corners.min(axis=1)[order], starts[:-1])
    upper[first_leaf:] = np.maximum.reduceat(corners.max(axis=1)[order], starts[:-1])
    for level in range(depth - 1, -1, -1):
        here = slice(2**level - 1, 2 ** (level + 1) - 1)
        below = slice(2 ** (level + 1) - 1, 2 ** (level + 2) - 1)
        lower[here] = lower[below].reshape(-1, 2, 3).min(axis=1)
        upper[here] = upper[below].reshape(-1, 2, 3).max(axis=1)
    return BoxTree(corners, order, starts, lower, upper)


def crossings(tree: BoxTree, start: Floats, end: Floats) -> Crossings:
    """All crossings of the segments `start` (k, 3) to `end` (k, 3), mm, with the tree's triangles.

    They come ordered by segment. Triangles parallel to their segment do not count; a crossing on a
    shared edge counts for both triangles.
    """
    capacity = 16 * len(start) + 64
    while True:
        indices, places = np.empty((capacity, 2), dtype=np.int64), np.empty((capacity, 2))
        count = _cross_all(
            tree.corners, tree.order, tree.starts, tree.lower, tree.upper,
            np.ascontiguousarray(start), np.ascontiguousarray(end), indices, places,
        )  # fmt: skip
        if count <= capacity:
            return Crossings(*indices[:count].T, *places[:count].T)
        capacity = count


def first_hits(
    tree: BoxTree, start: Floats, end: Floats, own: Ints | None = None
) -> tuple[Floats, Ints]:
    """Distance (k,) in mm to the first triangle crossed and its number; inf and -1 without one.

    `own` (k,), if given, is the triangle each segment starts on, which must not count.
    """
    found = crossings(tree, start, end)
    if own is not None:
        found = found.chosen(found.triangle != own[found.segment])
    distance = np.full(len(start), np.inf)
    triangle = np.full(len(start), -1, dtype=np.int64)
    nearest_last = found.chosen(np.argsort(-found.fraction, kind="stable"))
    length = np.linalg.norm(end - start, axis=1)
    # Later assignments win, so the nearest crossing of each segment is what remains.
    distance[nearest_last.segment] = nearest_last.fraction * length[nearest_last.segment]
    triangle[nearest_last.segment] = nearest_last.triangle
    return distance, triangle


@njit(cache=True)
def _cross_all(
    corners: Floats, order: Ints, starts: Ints, lower: Floats, upper: Floats,
    start: Floats, end: Floats, indices: Ints, places: Floats,
) -> int:  # fmt: skip
    """Fill (segment, triangle) and (fraction, inside) as far as they reach; return the count."""
    first_leaf = len(starts) - 2
    stack = np.empty(DEEPEST_TREE, dtype=np.int64)
    count = 0
    for segment in range(len(start)):
        stack[0], height = 0, 1
        while height:
            height -= 1
            node = stack[height]
            if not _touches(start[segment], end[segment], lower[node], upper[node]):
                continue
            if node < first_leaf:
                stack[height], stack[height + 1] = 2 * node + 2, 2 * node + 1
                height += 2
                continue
            leaf = node - first_leaf
            for triangle in order[starts[leaf] : starts[leaf + 1]]:
                fraction, inside = _cross(corners[triangle], start[segment], end[segment])
                if inside < -BARYCENTRIC_SLACK:
                    continue
                if count < len(indices):
                    indices[count, 0], indices[count, 1] = segment, triangle
                    places[count, 0], places[count, 1] = fraction, inside
                count += 1
    return count


@njit(cache=True)
def _touches(start: Floats, end: Floats, lower: Floats, upper: Floats) -> bool:
    """Whether the segment's part between each pair of the box's planes leaves anything over."""
    enter, leave = 0.0, 1.0
    for axis in range(3):
        direction = end[axis] - start[axis]
        near = lower[axis] - BOX_SLACK - start[axis]
        far = upper[axis] + BOX_SLACK - start[axis]
        if abs(direction) < 1e-12:
            if near > 0 or far < 0:
                return False
        else:
            near, far = near / direction, far / direction
            enter = max(enter, min(near, far))
            leave = min(leave, max(near, far))
    return enter <= leave + 1e-12


@njit(cache=True)
def _cross(corners: Floats, start: Floats, end: Floats) -> tuple[float, float]:
    """Möller and Trumbore (1997): fraction along the segment and smallest barycentric coordinate.

    Without a crossing the barycentric coordinate is -inf.
    """
    x, y, z = corners[0, 0], corners[0, 1], corners[0, 2]
    ax, ay, az = corners[1, 0] - x, corners[1, 1] - y, corners[1, 2] - z
    bx, by, bz = corners[2, 0] - x, corners[2, 1] - y, corners[2, 2] - z
    dx, dy, dz = end[0] - start[0], end[1] - start[1], end[2] - start[2]
    px, py, pz = dy * bz - dz * by, dz * bx - dx * bz, dx * by - dy * bx
    determinant = ax * px + ay * py + az * pz
    if determinant == 0:
        return 0.0, -np.inf
    sx, sy, sz = start[0] - x, start[1] - y, start[2] - z
    u = (sx * px + sy * py + sz * pz) / determinant
    qx, qy, qz = sy * az - sz * ay, sz * ax - sx * az, sx * ay - sy * ax
    v = (dx * qx + dy * qy + dz * qz) / determinant
    fraction = (bx * qx + by * qy + bz * qz) / determinant
    if not 0 <= fraction <= 1:
        return fraction, -np.inf
    return fraction, min(u, v, 1 - u - v)
