"""Painting the beads of one layer: how far each cell is from the nearest bead, scaled.

`F` is the distance from a bead's axis over half its width, smallest over all beads: 1 on a bead's
side, below 1 within. Two things decide whether the field is true to the beads:

- Turns. Plastic that a turn's inner side has twice is missing on its outer side, and the two areas
  are equal: the outer side is filled up to the mitre. With round joins a right angle in touching
  lines is a void of its own. Mitres are cut at sqrt(2) of half a width, the tip of a right angle;
  turns of more than 120°, where the nozzle comes back on its own line, and free ends are round.
- Ridges. Half-way between two beads F has a ridge, which is what air would pass along. A cell's
  centre misses it by up to half a cell, an eighth of F at eight cells a line, and that is the
  difference between sealed and open. So each cell holds the largest F *within* it: from its centre,
  F rises along the direction away from the nearest bead until the nearest bead on the other side is
  as near. What is found depends little on cells and on how the part is turned.

The compiled functions use the short symbols of these formulas.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from printers.arrays import Floats
from printers.compilation import njit

Grid = NDArray[np.float32]
Levels = NDArray[np.uint8]

PAINTED = 1.6
"""F up to which cells are computed from beads; beyond, distances are summed from cell to cell."""

SHALLOWEST = 0.5
"""F below which no ridge is looked for: beads that overlap by half have nothing between them."""

WITHIN = 0.75
"""A line crosses a cell if its foot is no farther from the middle than half the cell's extent
towards it, and cells that a line crosses are connected by their sides. Half more, since at round
ends the way to the ridge is not the shortest."""

MITRE = math.sqrt(2.0)
SHARPEST = -0.5  # cosine of the turn: 120°

# Columns of the table of beads.
AX, AY, TX, TY, LENGTH, HALF, PX, PY, QX, QY = range(10)
COLUMNS = 10

FINE = 125.0
"""Levels a unit of F, up to F = COARSE_FROM; beyond they grow by a constant factor."""

COARSE_FROM = 1.5
COARSE_START = FINE * COARSE_FROM
FARTHEST = 12.0
GROWTH = math.log(FARTHEST / COARSE_FROM) / (254.0 - COARSE_START)
AIR = 125
"""The level of F = 1."""


@njit(cache=True, nogil=True)
def _scaled(bead: Floats, x: float, y: float) -> tuple[float, float, float]:
    """F and its gradient times half the width at (x, y)."""
    half, tx, ty = bead[HALF], bead[TX], bead[TY]
    rx, ry = x - bead[AX], y - bead[AY]
    along = rx * tx + ry * ty
    across = ry * tx - rx * ty
    if 0.0 <= along <= bead[LENGTH]:
        sign = 1.0 if across >= 0 else -1.0
        return abs(across) / half, -ty * sign, tx * sign
    if along < 0.0:
        ox, oy = bead[PX], bead[PY]
    else:
        rx -= bead[LENGTH] * tx
        ry -= bead[LENGTH] * ty
        ox, oy = -bead[QX], -bead[QY]
    d = math.sqrt(rx * rx + ry * ry)
    if d == 0.0:
        return 0.0, tx, ty
    if rx * ox + ry * oy <= 0.0:  # no neighbour (0, 0), or it covers the point itself
        return d / half, rx / d, ry / d
    other = ry * ox - rx * oy
    if d > (1 + 1e-9) * MITRE * max(abs(across), abs(other)):
        return d / MITRE / half, rx / d / MITRE, ry / d / MITRE
    if abs(across) >= abs(other):
        sign = 1.0 if across >= 0 else -1.0
        return abs(across) / half, -ty * sign, tx * sign
    sign = 1.0 if other >= 0 else -1.0
    return abs(other) / half, -oy * sign, ox * sign


@njit(cache=True, nogil=True)
def _rows(bead: Floats, y0: float, voxel: float, reach: float, ny: int) -> tuple[int, int]:
    """First and last row of cells within reach of a bead."""
    ay, by = bead[AY], bead[AY] + bead[LENGTH] * bead[TY]
    first = math.ceil((min(ay, by) - reach - y0) / voxel)
    last = math.floor((max(ay, by) + reach - y0) / voxel)
    return max(first, 0), min(last, ny - 1)


@njit(cache=True, nogil=True)
def _columns(
    bead: Floats, y: float, x0: float, voxel: float, reach: float, nx: int
) -> tuple[int, int]:
    """First and last cell of a row within reach of the piece of the axis that is near the row."""
    length, tx, ty = bead[LENGTH], bead[TX], bead[TY]
    low, high = 0.0, length
    if abs(ty) > 1e-9:
        one, two = (y - reach - bead[AY]) / ty, (y + reach - bead[AY]) / ty
        low, high = max(low, min(one, two)), min(high, max(one, two))
    one, two = bead[AX] + low * tx, bead[AX] + high * tx
    first = math.ceil((min(one, two) - reach - x0) / voxel)
    last = math.floor((max(one, two) + reach - x0) / voxel)
    return max(first, 0), min(last, nx - 1)


@njit(cache=True, nogil=True)
def _paint_nearest(
    table: Floats,
    x0: float,
    y0: float,
    voxel: float,
    nearest: Grid,
    gx: Grid,
    gy: Grid,
    slope: Grid,
) -> None:
    ny, nx = nearest.shape
    for b in range(len(table)):
        bead = table[b]
        reach = PAINTED * bead[HALF]
        first, last = _rows(bead, y0, voxel, reach, ny)
        for j in range(first, last + 1):
            y = y0 + j * voxel
            left, right = _columns(bead, y, x0, voxel, reach, nx)
            for i in range(left, right + 1):
                f, ux, uy = _scaled(bead, x0 + i * voxel, y)
                if f < nearest[j, i] and f <= PAINTED:
                    nearest[j, i] = f
                    gx[j, i] = ux
                    gy[j, i] = uy
                    slope[j, i] = 1.0 / bead[HALF]


@njit(cache=True, nogil=True)
def _find_ridges(
    table: Floats,
    x0: float,
    y0: float,
    voxel: float,
    nearest: Grid,
    gx: Grid,
    gy: Grid,
    slope: Grid,
    rise: Grid,
) -> None:
    """`rise`: way, mm, from a cell's centre until a bead on the other side is as near."""
    ny, nx = nearest.shape
    for b in range(len(table)):
        bead = table[b]
        own = 1.0 / bead[HALF]
        reach = PAINTED * bead[HALF] + 2 * voxel
        first, last = _rows(bead, y0, voxel, reach, ny)
        for j in range(first, last + 1):
            y = y0 + j * voxel
            left, right = _columns(bead, y, x0, voxel, reach, nx)
            for i in range(left, right + 1):
                if nearest[j, i] < SHALLOWEST or nearest[j, i] > PAINTED:
                    continue
                f, ux, uy = _scaled(bead, x0 + i * voxel, y)
                facing = ux * gx[j, i] + uy * gy[j, i]
                if facing < 0.0:
                    size = math.sqrt(gx[j, i] ** 2 + gy[j, i] ** 2)
                    way = (f - nearest[j, i]) / (slope[j, i] * size - facing / size * own)
                    rise[j, i] = min(rise[j, i], max(way, 0.0))


@njit(cache=True, nogil=True)
def _spread(nearest: Grid, step: float) -> None:
    """Distances beyond what is painted, by two sweeps from cell to cell."""
    ny, nx = nearest.shape
    slant = step * math.sqrt(2.0)
    for j in range(ny):
        for i in range(nx):
            f = nearest[j, i]
            if i > 0:
                f = min(f, nearest[j, i - 1] + step)
            if j > 0:
                f = min(f, nearest[j - 1, i] + step)
                if i > 0:
                    f = min(f, nearest[j - 1, i - 1] + slant)
                if i < nx - 1:
                    f = min(f, nearest[j - 1, i + 1] + slant)
            nearest[j, i] = f
    for j in range(ny - 1, -1, -1):
        for i in range(nx - 1, -1, -1):
            f = nearest[j, i]
            if i < nx - 1:
                f = min(f, nearest[j, i + 1] + step)
            if j < ny - 1:
                f = min(f, nearest[j + 1, i] + step)
                if i < nx - 1:
                    f = min(f, nearest[j + 1, i + 1] + slant)
                if i > 0:
                    f = min(f, nearest[j + 1, i - 1] + slant)
            nearest[j, i] = f


@njit(cache=True, nogil=True)
def _to_levels(
    nearest: Grid, gx: Grid, gy: Grid, slope: Grid, rise: Grid, voxel: float, levels: Levels
) -> None:
    ny, nx = nearest.shape
    for j in range(ny):
        for i in range(nx):
            f = nearest[j, i]
            size = math.sqrt(gx[j, i] ** 2 + gy[j, i] ** 2)
            if rise[j, i] * size <= WITHIN * voxel * (abs(gx[j, i]) + abs(gy[j, i])):
                f += slope[j, i] * size * rise[j, i]
            if f <= COARSE_FROM:
                levels[j, i] = int(f * FINE + 0.5)
            else:
                level = COARSE_START + math.log(f / COARSE_FROM) / GROWTH
                levels[j, i] = int(min(level + 0.5, 255.0))


@njit(cache=True, nogil=True)
def paint_layer(
    table: Floats, x0: float, y0: float, voxel: float, step: float, scratch: Grid, levels: Levels
) -> None:
    """Write the levels (ny, nx) of one layer from its beads (n, 10).

    `x0`, `y0` is the centre of the first cell; `step` the F of a cell's side beyond the painted
    band, 0 for none; `scratch` (5, ny, nx) floats that are written over.
    """
    nearest, gx, gy, slope, rise = scratch[0], scratch[1], scratch[2], scratch[3], scratch[4]
    scratch[:] = 0.0
    nearest[:] = np.inf
    rise[:] = np.inf
    _paint_nearest(table, x0, y0, voxel, nearest, gx, gy, slope)
    _find_ridges(table, x0, y0, voxel, nearest, gx, gy, slope, rise)
    if step > 0:
        _spread(nearest, step)
    _to_levels(nearest, gx, gy, slope, rise, voxel, levels)
