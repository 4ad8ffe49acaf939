"""A grid of points over a cavity, which of them lie in the air, and how far from its wall."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from printers.arrays import Flags, Floats
from printers.measure.box_tree import crossings
from printers.measure.surface import Surface

_OFF_CENTRE = np.array([1.2345e-5, 2.3456e-5])
"""mm. Upright rays pass beside the edges that lie on round coordinates."""


@dataclass(frozen=True)
class Grid:
    """Points at equal steps in a box: `origin` (3,) mm, `step` mm, `shape` their numbers."""

    origin: Floats
    step: float
    shape: tuple[int, int, int]

    def points(self, which: Flags) -> Floats:
        """(k, 3) mm of the points picked by flags of the grid's shape."""
        return self.origin + self.step * np.argwhere(which)

    def point(self, index: tuple[int, ...]) -> Floats:
        """(3,) mm of the point with these numbers."""
        return np.asarray(self.origin + self.step * np.asarray(index, dtype=float))


def grid_around(lower: Floats, upper: Floats, step: float) -> Grid:
    """The grid that covers a box, with one step to spare on every side."""
    counts = np.ceil((upper - lower) / step).astype(int) + 3
    middle = (lower + upper) / 2
    nx, ny, nz = (int(count) for count in counts)
    return Grid(middle - step * (counts - 1) / 2, step, (nx, ny, nz))


def inside(surface: Surface, grid: Grid) -> Flags:
    """Which points of the grid (nx, ny, nz) lie within a closed surface: crossings above count."""
    nx, ny, nz = grid.shape
    columns = np.stack(np.meshgrid(np.arange(nx), np.arange(ny), indexing="ij"), axis=-1)
    start = np.empty((nx * ny, 3))
    start[:, :2] = grid.origin[:2] + grid.step * columns.reshape(-1, 2) + _OFF_CENTRE
    start[:, 2] = surface.bounds[0, 2] - 1.0
    end = start.copy()
    end[:, 2] = surface.bounds[1, 2] + 1.0
    found = crossings(surface.tree, start, end)
    height = start[0, 2] + found.fraction * (end[0, 2] - start[0, 2])
    first = np.ceil((height - grid.origin[2]) / grid.step).clip(0, nz).astype(np.int64)
    flips = np.bincount(found.segment * (nz + 1) + first, minlength=nx * ny * (nz + 1))
    return np.asarray(np.cumsum(flips.reshape(nx, ny, nz + 1), axis=2)[:, :, :nz] % 2 == 1)


def coarse_distances(within: Flags, step: float) -> Floats:
    """Distance, mm, of the points `within` the air to the wall, within a step; others have -inf."""
    from scipy.ndimage import distance_transform_edt

    return np.where(within, distance_transform_edt(within) * step - step / 2, -np.inf)
