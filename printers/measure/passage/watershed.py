"""Where the regions of a field meet: points are taken from the highest value down, and where two
regions meet they become one. The point at which that happens is the pass between them: every path
from the one to the other goes as low as that.
"""

from __future__ import annotations

import numpy as np

from printers.arrays import Floats, Ints
from printers.compilation import njit

NOTHING, FIRST, SECOND, BOTH = 0, 1, 2, 3
"""Marks of points, which may be added: a region has the marks of all its points."""


def passes(field: Floats, marks: Ints, least: int, floor: float) -> Ints:
    """Passes between regions of at least `least` points, highest first.

    Args:
        field: Value of every point.
            *Shape:* `(nx, ny, nz)`
        marks: `FIRST` where a region counts whatever its size.
            *Shape:* `(nx, ny, nz)`
        least: Points above the pass that a region must have to count.
        floor: Points below it are no way.

    Returns:
        Numbers of the points at the passes, in the flattened field.
    """
    order = _downwards(field, floor)
    found = np.empty(len(order), dtype=np.int64)
    count = _flood(order, np.array(field.shape), marks.ravel().astype(np.int8), least, found)
    return found[:count]


def regions_before(field: Floats, point: int) -> Ints:
    """(nx, ny, nz): number of the region, from 1, of points that were taken before the `point`."""
    from scipy.ndimage import label

    flat = field.ravel()
    earlier = np.arange(len(flat)) < point  # among equals, as the sort is stable
    taken = (flat > flat[point]) | ((flat == flat[point]) & earlier)
    return np.asarray(label(taken.reshape(field.shape), np.ones((3, 3, 3)))[0], dtype=np.int64)


def pass_between(field: Floats, marks: Ints, floor: float) -> int | None:
    """Number of the point at which points marked `FIRST` and `SECOND` meet; None if they do not."""
    order = _downwards(field, floor)
    found = np.empty(1, dtype=np.int64)
    count = _flood(order, np.array(field.shape), marks.ravel().astype(np.int8), -1, found)
    return int(found[0]) if count else None


def _downwards(field: Floats, floor: float) -> Ints:
    flat = np.ascontiguousarray(field).ravel()
    kept = np.flatnonzero(flat > floor)
    return np.asarray(kept[np.argsort(-flat[kept], kind="stable")])


@njit(cache=True)
def _flood(order: Ints, shape: Ints, marks: Ints, least: int, found: Ints) -> int:
    """Write the passes into `found` and return their number.

    With `least` below 0 only the first meeting of the two marks counts.
    """
    nx, ny, nz = shape
    parent = np.full(nx * ny * nz, -1)
    size = np.zeros(nx * ny * nz, dtype=np.int64)
    count = 0
    for point in order:
        parent[point], size[point] = point, 1
        here = point
        x, y, z = point // (ny * nz), point // nz % ny, point % nz
        is_pass = False
        for step in range(27):
            a, b, c = x + step // 9 - 1, y + step // 3 % 3 - 1, z + step % 3 - 1
            if not (0 <= a < nx and 0 <= b < ny and 0 <= c < nz):
                continue
            other = (a * ny + b) * nz + c
            if parent[other] < 0:
                continue
            while parent[other] != other:
                parent[other] = parent[parent[other]]
                other = parent[other]
            if other == here:
                continue
            if least < 0:
                is_pass |= marks[other] | marks[here] == BOTH
            else:
                large = size[other] >= least or marks[other] == FIRST
                is_pass |= (
                    large
                    and (size[here] >= least or marks[here] == FIRST)
                    and not (marks[other] == FIRST and marks[here] == FIRST)
                )
            if size[other] > size[here]:
                other, here = here, other
            parent[other] = here
            size[here] += size[other]
            marks[here] |= marks[other]
        if is_pass:
            found[count] = point
            count += 1
            if least < 0:
                return count
    return count
