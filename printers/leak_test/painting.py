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
- Steps to the next layer. Ridges of two layers that pass the same cell need not meet in it. So a
  step is as wide as the largest F that both layers have at one point of the cell, with F below two
  planes in either layer: that of the nearest bead and that of the one on the other side. Planes
  leave out third beads, so that a step may be too wide, and lie below the cones around round ends,
  by up to an eighth of (a cell's diagonal over half a width)², 0.015 at eight cells a line.

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

SHALLOWEST = 0.75
"""F below which no ridge is looked for: beads that overlap so much have nothing between them."""

WITHIN = 0.75
"""A line crosses a cell if its foot is no farther from the middle than half the cell's extent
towards it, and cells that a line crosses are connected by their sides. Half more, since at round
ends the way to the ridge is not the shortest."""

HALF_A_CELL = 0.5 + 1e-6

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
def _paint_nearest(table: Floats, x0: float, y0: float, voxel: float, planes: Grid) -> None:
    nearest, gx, gy = planes[0], planes[1], planes[2]
    ny, nx = nearest.shape
    for b in range(len(table)):
        bead = table[b]
        slope = 1.0 / bead[HALF]
        reach = PAINTED * bead[HALF]
        first, last = _rows(bead, y0, voxel, reach, ny)
        for j in range(first, last + 1):
            y = y0 + j * voxel
            left, right = _columns(bead, y, x0, voxel, reach, nx)
            for i in range(left, right + 1):
                f, ux, uy = _scaled(bead, x0 + i * voxel, y)
                if f < nearest[j, i] and f <= PAINTED:
                    nearest[j, i] = f
                    gx[j, i] = slope * ux
                    gy[j, i] = slope * uy


@njit(cache=True, nogil=True)
def _below_two(
    f: float, fx: float, fy: float, g: float, gx: float, gy: float, half: float
) -> float:
    """The largest of the lower one of two planes within a square of half the side `half`.

    By duality it is the least that any mean of both has as its largest, which bends at the means
    that do not rise along x, or along y.
    """
    found = min(f + half * (abs(fx) + abs(fy)), g + half * (abs(gx) + abs(gy)))
    for one, two in ((fx, gx), (fy, gy)):
        if one * two < 0.0:
            share = two / (two - one)
            rest = 1.0 - share
            level = abs(share * fx + rest * gx) + abs(share * fy + rest * gy)
            found = min(found, share * f + rest * g + half * level)
    return found


@njit(cache=True, nogil=True)
def _find_ridges(
    table: Floats, x0: float, y0: float, voxel: float, planes: Grid, rise: Grid
) -> None:
    """`rise`: way, mm, from a cell's centre until a bead on the other side is as near.

    The second plane is that of the bead which leaves the least F within the cell, `most`.
    """
    nearest, gx, gy = planes[0], planes[1], planes[2]
    other, ox, oy, most = planes[3], planes[4], planes[5], planes[6]
    ny, nx = nearest.shape
    for b in range(len(table)):
        bead = table[b]
        slope = 1.0 / bead[HALF]
        reach = PAINTED * bead[HALF] + 2 * voxel
        first, last = _rows(bead, y0, voxel, reach, ny)
        for j in range(first, last + 1):
            y = y0 + j * voxel
            left, right = _columns(bead, y, x0, voxel, reach, nx)
            for i in range(left, right + 1):
                extent = WITHIN * voxel * (abs(gx[j, i]) + abs(gy[j, i]))
                if nearest[j, i] + extent < SHALLOWEST or nearest[j, i] > PAINTED:
                    continue
                f, ux, uy = _scaled(bead, x0 + i * voxel, y)
                ux, uy = slope * ux, slope * uy
                facing = ux * gx[j, i] + uy * gy[j, i]
                if facing < 0.0:
                    size = math.sqrt(gx[j, i] ** 2 + gy[j, i] ** 2)
                    way = (f - nearest[j, i]) / (size - facing / size)
                    rise[j, i] = min(rise[j, i], max(way, 0.0))
                if f - voxel / 2 * (abs(ux) + abs(uy)) >= most[j, i]:
                    continue
                summit = _below_two(nearest[j, i], gx[j, i], gy[j, i], f, ux, uy, voxel / 2)
                if summit < most[j, i]:
                    other[j, i], ox[j, i], oy[j, i], most[j, i] = f, ux, uy, summit


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
def _level(f: float) -> int:
    if f <= COARSE_FROM:
        return int(max(f, 0.0) * FINE + 0.5)
    return int(min(COARSE_START + math.log(f / COARSE_FROM) / GROWTH + 0.5, 255.0))


@njit(cache=True, nogil=True)
def _to_levels(planes: Grid, rise: Grid, voxel: float, levels: Levels) -> None:
    nearest, gx, gy = planes[0], planes[1], planes[2]
    ny, nx = nearest.shape
    for j in range(ny):
        for i in range(nx):
            f = nearest[j, i]
            size = math.sqrt(gx[j, i] ** 2 + gy[j, i] ** 2)
            if rise[j, i] * size <= WITHIN * voxel * (abs(gx[j, i]) + abs(gy[j, i])):
                f += size * rise[j, i]
            levels[j, i] = _level(f)
            planes[6, j, i] = nearest[j, i] if planes[6, j, i] == np.inf else planes[6, j, i]


@njit(cache=True, nogil=True)
def paint_layer(
    table: Floats,
    x0: float,
    y0: float,
    voxel: float,
    step: float,
    planes: Grid,
    rise: Grid,
    levels: Levels,
) -> None:
    """Write the levels (ny, nx) of one layer and its planes from its beads (n, 10).

    `x0`, `y0` is the centre of the first cell; `step` the F of a cell's side beyond the painted
    band, 0 for none. `planes` (7, ny, nx): F and its gradient, 1/mm, at the cell's centre, of the
    nearest bead and of a second one, infinite where there is none, and the largest F below both.
    `rise` (ny, nx) floats that are written over.
    """
    planes[:] = 0.0
    planes[0], planes[3] = np.inf, np.inf
    rise[:] = np.inf
    _paint_nearest(table, x0, y0, voxel, planes)
    planes[6] = planes[0] + voxel / 2 * (np.abs(planes[1]) + np.abs(planes[2]))
    _find_ridges(table, x0, y0, voxel, planes, rise)
    if step > 0:
        _spread(planes[0], step)
    _to_levels(planes, rise, voxel, levels)


@njit(cache=True, nogil=True)
def _add(bounds: Floats, count: int, f: float, x: float, y: float) -> int:
    """One more plane, unless it bounds nothing."""
    if f == np.inf:
        return count
    bounds[count, 0], bounds[count, 1], bounds[count, 2] = f, x, y
    return count + 1


@njit(cache=True, nogil=True)
def _lowest(bounds: Floats, count: int, x: float, y: float, least: float) -> float:
    """The lowest plane at (x, y); `least` for a place beyond the cell, or below `least`."""
    if not (abs(x) <= HALF_A_CELL and abs(y) <= HALF_A_CELL):
        return least
    found = np.inf
    for number in range(count):
        found = min(found, bounds[number, 0] + bounds[number, 1] * x + bounds[number, 2] * y)
    return max(found, least)


@njit(cache=True, nogil=True)
def _summit(bounds: Floats, count: int, most: float) -> float:
    """The highest point of the cell's [-1/2, 1/2]² below all planes: a linear programme.

    It lies at a corner, or on a side where two planes meet, or where three meet. No point lies
    above `most`.
    """
    best = -np.inf
    for end in (-0.5, 0.5):
        best = _lowest(bounds, count, end, -0.5, best)
        best = _lowest(bounds, count, end, 0.5, best)
    for m in range(count):
        for n in range(m):
            if best >= most - 0.5 / FINE:
                return best
            f = bounds[m, 0] - bounds[n, 0]
            a, b = bounds[m, 1] - bounds[n, 1], bounds[m, 2] - bounds[n, 2]
            for end in (-0.5, 0.5):
                if b != 0.0:
                    best = _lowest(bounds, count, end, -(f + a * end) / b, best)
                if a != 0.0:
                    best = _lowest(bounds, count, -(f + b * end) / a, end, best)
            for o in range(n):
                g = bounds[m, 0] - bounds[o, 0]
                c, d = bounds[m, 1] - bounds[o, 1], bounds[m, 2] - bounds[o, 2]
                area = a * d - b * c
                if area != 0.0:
                    x, y = (b * g - d * f) / area, (c * f - a * g) / area
                    best = _lowest(bounds, count, x, y, best)
    return best


@njit(cache=True, nogil=True)
def _alike(below: Grid, above: Grid, j: int, i: int) -> bool:
    """Whether two layers have the same planes in a cell."""
    for p in range(6):  # noqa: SIM110
        if below[p, j, i] != above[p, j, i]:
            return False
    return True


@njit(cache=True, nogil=True)
def link_layers(
    below: Grid, above: Grid, voxel: float, low: Levels, high: Levels, links: Levels
) -> None:
    """Write the levels (ny, nx) of the steps between two layers from their planes and levels.

    A step is as wide as the largest min(F below, F above) at one point of the cell. Where that is
    less than `SHALLOWEST` in any case, it may be too large.
    """
    ny, nx = links.shape
    bounds = np.empty((4, 3))
    for j in range(ny):
        for i in range(nx):
            most = min(below[6, j, i], above[6, j, i])
            if most < SHALLOWEST or _alike(below, above, j, i):
                links[j, i] = _level(most)
                continue
            if most > PAINTED + 1:
                links[j, i] = min(low[j, i], high[j, i])
                continue
            count = 0
            for planes in (below, above):
                for p in (0, 3):
                    f, x, y = planes[p, j, i], planes[p + 1, j, i], planes[p + 2, j, i]
                    count = _add(bounds, count, f, voxel * x, voxel * y)
            links[j, i] = _level(_summit(bounds, count, most))
