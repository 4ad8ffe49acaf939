"""The thinnest seal: of all paths from the cavity to the outside the one through least plastic.

A wall that is closed but too thin has no leak, and still nothing that keeps it closed. Its depth is
the length of the shortest path where only what lies within beads (F < 1) counts, in lines. It is
found on cells of a quarter of a line, of which each counts by the share of its finer cells that lie
within beads. Steps go to all 26 neighbours; the length of a slanting path, up to 13 % too long
that way, is corrected to that of the straight way between the ends of every wall it crosses.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from printers.arrays import Floats
from printers.compilation import njit
from printers.leak_test.field import Field, Levels
from printers.leak_test.flood import CAVITY, CLOSED, OUTSIDE
from printers.leak_test.painting import AIR

CELLS_A_LINE = 4
UNITS = 10
"""Whole units of length a side of a cell."""

FULL = 16
"""Units of the share of a cell that lies within beads."""

FARTHEST = 65_000


@dataclass(frozen=True, eq=False)
class Crossing:
    """A path through the thinnest seal.

    Attributes:
        millimetres: Of plastic that is crossed; infinite where nothing leads to the outside.
        points: Of the path, mm.
            *Shape:* `(n, 3)`
        middle: Point of the path with as much plastic before as behind it.
    """

    millimetres: float
    points: Floats
    middle: Floats


def thinnest_seal(field: Field, marks: Levels) -> Crossing:
    """The path of least plastic between the airs that are marked (flat)."""
    grid = marks.reshape(field.levels.shape)
    factor = max(1, round(field.line_width / CELLS_A_LINE / field.voxel))
    share, ends = _pooled(field.levels, grid, factor)
    side = factor * field.voxel
    thickness = np.diff(field.heights) / side
    cells = _least_plastic(share.ravel(), ends.ravel(), thickness, *share.shape[1:])
    if not len(cells):
        return Crossing(math.inf, np.zeros((0, 3)), np.full(3, np.nan))
    points = _places(field, cells, share.shape, side)
    return _straightened(points, _crossed(points, share.ravel()[cells] / FULL))


@njit(cache=True, nogil=True)
def _pooled(levels, marks, factor):  # type: ignore[no-untyped-def]
    """Share of plastic and mark of cells of `factor` x `factor` finer ones."""
    nz, ny, nx = levels.shape
    shape = nz, (ny + factor - 1) // factor, (nx + factor - 1) // factor
    share = np.zeros(shape, dtype=np.uint8)
    ends = np.zeros(shape, dtype=np.uint8)
    for k in range(nz):
        for j in range(shape[1]):
            for i in range(shape[2]):
                plastic, mark = 0, 0
                for b in range(j * factor, min((j + 1) * factor, ny)):
                    for a in range(i * factor, min((i + 1) * factor, nx)):
                        plastic += levels[k, b, a] < AIR
                        own = marks[k, b, a]
                        if own == CLOSED or (own in (CAVITY, OUTSIDE) and mark != CLOSED):
                            mark = own
                share[k, j, i] = int(FULL * plastic / (factor * factor) + 0.5)
                ends[k, j, i] = mark
    return share, ends


@njit(cache=True, nogil=True)
def _least_plastic(share, ends, thickness, ny, nx):  # type: ignore[no-untyped-def]
    """Cells of the path of least plastic, from the outside to the cavity; empty if there is none.

    Dijkstra's algorithm with whole costs in a ring of buckets. `thickness` of the layers in sides
    of a cell.
    """
    layer = ny * nx
    most = int(math.ceil(UNITS * FULL * (2 + 2 * thickness.max()))) + 2
    head = np.full(most, -1, dtype=np.int64)
    cells = np.empty(1 << 16, dtype=np.int32)
    after = np.empty(1 << 16, dtype=np.int32)
    used, free, waiting = 0, -1, 0
    distance = np.full(len(share), FARTHEST, dtype=np.uint16)
    origin = np.full(len(share), 255, dtype=np.uint8)
    for cell in range(len(share)):
        if ends[cell] == CAVITY:
            distance[cell] = 0
    scanned, now, cell = 0, 0, 0
    while scanned < len(share) or waiting:
        if scanned < len(share):  # the rim of the cavity first, then the buckets
            cell = scanned
            scanned += 1
            if ends[cell] != CAVITY:
                continue
        else:
            entry = head[now % most]
            if entry < 0:
                now += 1
                continue
            cell = cells[entry]
            head[now % most] = after[entry]
            after[entry], free = free, entry
            waiting -= 1
            if distance[cell] != now:
                continue
            if ends[cell] == OUTSIDE:
                break
        k = cell // layer
        for number in range(27):
            dz, dy, dx = number // 9 - 1, number // 3 % 3 - 1, number % 3 - 1
            beside = cell + dz * layer + dy * nx + dx
            if beside < 0 or beside >= len(share) or ends[beside] == CLOSED:
                continue
            if distance[beside] <= now:
                continue
            flat = dx * dx + dy * dy
            if dz == 0:
                cost = 0.5 * math.sqrt(flat) * (share[cell] + share[beside])
            else:
                own, other = thickness[k], thickness[k + dz]
                rise = 0.5 * (own + other)
                cost = 0.5 * (own * share[cell] + other * share[beside])
                cost *= math.sqrt(flat + rise * rise) / rise
            total = now + int(UNITS * cost + 0.5)
            if total >= distance[beside]:
                continue
            distance[beside] = total
            origin[beside] = number
            if free >= 0:
                entry, free = free, after[free]
            else:
                if used == len(cells):
                    cells = np.concatenate((cells, np.empty_like(cells)))
                    after = np.concatenate((after, np.empty_like(after)))
                entry = used
                used += 1
            cells[entry], after[entry] = beside, head[total % most]
            head[total % most] = entry
            waiting += 1
    path = [np.int64(cell)]
    if ends[cell] != OUTSIDE:
        path.clear()
        return np.array([0])[:0]
    while origin[cell] != 255:
        number = origin[cell]
        cell -= (number // 9 - 1) * layer + (number // 3 % 3 - 1) * nx + number % 3 - 1
        path.append(np.int64(cell))
    return np.array(path)


def _places(field: Field, cells: Floats, shape: tuple[int, ...], side: float) -> Floats:
    """Centres (n, 3), mm, of pooled cells."""
    k, j, i = np.unravel_index(cells, shape)
    middle = (field.heights[:-1] + field.heights[1:]) / 2
    x, y = np.asarray(field.corner) + (side - field.voxel) / 2
    return np.column_stack([x + i * side, y + j * side, middle[k]])


def _crossed(points: Floats, share: Floats) -> Floats:
    """(n - 1,) mm of plastic on each step of a path."""
    length = np.linalg.norm(np.diff(points, axis=0), axis=1)
    return np.asarray(length * (share[:-1] + share[1:]) / 2)


def _straightened(points: Floats, crossed: Floats) -> Crossing:
    """The path with what it crosses of every wall shortened to the straight way."""
    length = np.linalg.norm(np.diff(points, axis=0), axis=1)
    changes = np.flatnonzero(np.diff(np.concatenate([[0], crossed > 0, [0]]))).reshape(-1, 2)
    crossed = crossed.copy()
    for first, last in changes:
        chord = float(np.linalg.norm(points[last] - points[first]))
        crossed[first:last] *= chord / length[first:last].sum()
    total = crossed.sum()
    before = np.concatenate([[0.0], np.cumsum(crossed)])
    middle = np.array([np.interp(total / 2, before, points[:, axis]) for axis in range(3)])
    return Crossing(float(total), points, middle)
