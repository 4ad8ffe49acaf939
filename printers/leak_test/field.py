"""The field of scaled distances to the beads, layer by layer, two bytes a cell.

Layers are the intervals between the heights at which beads begin or end, so that beads of different
heights (a first layer, thick bridges, layers that vary) stand beside each other as they are
printed. A bead fills its whole interval: what lies between beads of one layer is seen, a bad bond
between layers is not.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil, sqrt
from typing import Any

import numpy as np

from printers.arrays import Floats, Ints
from printers.errors import PrintersError
from printers.gcode.beads import Beads
from printers.leak_test import painting
from printers.leak_test.painting import COLUMNS, Levels, link_layers, paint_layer

CELLS_A_LINE = 8
FEWEST_CELLS_A_LINE = 3
MOST_CELLS = 300_000_000
"""With marks, the coarser cells of the depth and the fronts of the floods they take 1.8 GB."""

SAME_HEIGHT = 0.02
"""mm. Beads that begin or end so near each other do so at the same height."""


@dataclass(frozen=True, eq=False)
class Field:
    """Scaled distances to the nearest bead.

    Attributes:
        levels: F as a byte, see `ratio_of`. The lowest and the highest layer are air.
            *Shape:* `(nz, ny, nx)`
        links: The largest F, as a byte, that a cell and the one above it have at one point.
            *Shape:* `(nz, ny, nx)`, the last layer 0
        heights: Of the layers' lower sides and the last one's upper side, mm.
            *Shape:* `(nz + 1,)`
        corner: Centre of the first cell in the plane, mm.
        voxel: Side of a cell, mm.
        line_width: mm.
        rim: Cells on each side in the plane that lie beyond every bead.
    """

    levels: Levels
    links: Levels
    heights: Floats
    corner: tuple[float, float]
    voxel: float
    line_width: float
    rim: int

    def place_of(self, cells: Ints) -> Floats:
        """Centres (n, 3), mm, of cells given by their numbers in `levels.ravel()`."""
        k, j, i = np.unravel_index(cells, self.levels.shape)
        middle = (self.heights[:-1] + self.heights[1:]) / 2
        x, y = self.corner
        return np.column_stack([x + i * self.voxel, y + j * self.voxel, middle[k]])

    def layer_at(self, z: float) -> int:
        """Number of the layer at a height, mm."""
        found = int(np.searchsorted(self.heights, z, side="right")) - 1
        return min(max(found, 0), len(self.heights) - 2)


def ratio_of(level: Any) -> Any:
    """F of a level, or of an array of them; 255 stands for all from 12 on."""
    far = painting.COARSE_FROM * np.exp((level - painting.COARSE_START) * painting.GROWTH)
    return np.where(np.less_equal(level, painting.COARSE_START), level / painting.FINE, far)


def level_of(ratio: float) -> int:
    """The lowest level of at least an F."""
    return int(np.searchsorted(ratio_of(np.arange(256)), ratio - 1e-9))


def grid_for(beads: Beads, voxel: float | None, line_width: float) -> tuple[float, list[str]]:
    """Side of the cells, mm, and a sentence where it had to be coarser than asked.

    Raises:
        PrintersError: There are no beads, the cells are too coarse for the lines, or the part is
            too large for any grid that tells lines apart.
    """
    if not len(beads):
        raise PrintersError("there are no beads of a part in the G-code")
    asked = line_width / CELLS_A_LINE if voxel is None else voxel
    coarsest = line_width / FEWEST_CELLS_A_LINE
    if not 0 < asked <= coarsest * (1 + 1e-9):
        raise PrintersError(
            f"voxel is {asked:g} mm; it must lie above 0 and up to {coarsest:.3g} mm, a third of "
            f"a line of {line_width:g} mm"
        )
    low, high = _outline(beads)
    area, layers = float(np.prod(high - low + line_width)), len(_heights(beads)) + 1
    needed = sqrt(area * layers / MOST_CELLS)
    if needed > coarsest:
        raise PrintersError(
            f"the part is too large for the leak test: {MOST_CELLS} cells in {layers} layers are "
            f"{needed:.3g} mm wide, more than a third of a line of {line_width:g} mm"
        )
    if needed <= asked:
        return asked, []
    return needed, [f"the part is large: cells of {needed:.3g} mm instead of {asked:.3g} mm"]


def paint(beads: Beads, voxel: float, line_width: float, far: bool = True) -> Field:
    """The field of the beads on cells of the side `voxel`, mm.

    Where `far` distances are not asked for, all from `painting.PAINTED` on are the largest.
    """
    (low, high), rim = _outline(beads), ceil(line_width / 2 / voxel) + 1
    corner = low - rim * voxel
    nx, ny = (np.ceil((high - low) / voxel).astype(int) + 2 * rim).tolist()
    heights = _heights(beads)
    levels = np.full((len(heights) + 1, ny, nx), 255, dtype=np.uint8)
    links = np.zeros_like(levels)
    below, planes = (np.full((7, ny, nx), np.inf, dtype=np.float32) for _ in range(2))
    below[[1, 2, 4, 5]], rise = 0.0, np.empty((ny, nx), dtype=np.float32)
    table, step = _table(beads), 2 * voxel / line_width if far else 0.0
    for layer, members in enumerate([*_members(beads, heights), np.zeros(0, dtype=int)], start=1):
        rows = table[members]
        paint_layer(rows, corner[0], corner[1], voxel, step, planes, rise, levels[layer])
        link_layers(below, planes, voxel, levels[layer - 1], levels[layer], links[layer - 1])
        below, planes = planes, below
    ends = 2 * heights[0] - heights[1], 2 * heights[-1] - heights[-2]
    around = np.concatenate([ends[:1], heights, ends[1:]])
    x, y = corner.tolist()
    return Field(levels, links, around, (x, y), voxel, line_width, rim)


def _outline(beads: Beads) -> tuple[Floats, Floats]:
    """Lowest and highest (x, y) of the beads' sides."""
    half = beads.width[:, None] / 2
    low = np.minimum(beads.start, beads.end) - half
    high = np.maximum(beads.start, beads.end) + half
    return low.min(axis=0), high.max(axis=0)


def _heights(beads: Beads) -> Floats:
    """Where beads begin or end, mm, ascending."""
    ends = np.unique(np.concatenate([beads.top, beads.top - beads.height]))
    apart = np.concatenate([[True], np.diff(ends) > SAME_HEIGHT])
    return np.asarray(ends[apart])


def _members(beads: Beads, heights: Floats) -> list[Ints]:
    """Of each layer the numbers of the beads that fill it."""
    middle = (heights[:-1] + heights[1:]) / 2
    first = np.searchsorted(middle, beads.top - beads.height)
    last = np.searchsorted(middle, beads.top)
    count = last - first
    bead = np.repeat(np.arange(len(beads)), count)
    place = np.arange(len(bead)) - np.repeat(np.cumsum(count) - count, count)
    layer = np.repeat(first, count) + place
    order = np.argsort(layer, kind="stable")
    return np.split(bead[order], np.searchsorted(layer[order], np.arange(1, len(middle))))


def _table(beads: Beads) -> Floats:
    """(n, 10): start, direction, length, half width, directions before and after (0 for none)."""
    length = np.maximum(beads.length, 1e-9)
    along = (beads.end - beads.start) / length[:, None]
    before = previous_in_path(beads)
    table = np.zeros((len(beads), COLUMNS))
    table[:, :2], table[:, 2:4] = beads.start, along
    table[:, 4], table[:, 5] = beads.length, beads.width / 2
    turn = np.einsum("ij,ij->i", along, along[before])
    joined = (before >= 0) & (turn >= painting.SHARPEST)
    table[joined, 6:8] = along[before[joined]]
    table[before[joined], 8:10] = along[joined]
    return table


def previous_in_path(beads: Beads) -> Ints:
    """(n,): the bead that ends where this one starts, of the same path; -1 where it starts freely.

    The first bead of a closed path follows its last one.
    """
    number = np.arange(len(beads))
    before = number - 1
    first = np.concatenate([[True], np.diff(beads.path) != 0])
    last = np.concatenate([first[1:], [True]])
    before[first] = number[last]
    away = np.abs(beads.start - beads.end[before]).max(axis=1) > 1e-3
    away |= before == number
    before[away] = -1
    return before
