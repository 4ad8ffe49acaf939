"""The thinnest seal: of all paths from the cavity to the outside the one through least plastic.

A wall that is closed but too thin has no leak, and still little that keeps it closed. Its depth is
the length of the shortest path of which only what lies within beads counts, in lines. Three things
make that number one to judge by:

- Voids. Where infill ends at a perimeter, voids remain in any sound part: a path along them
  crosses little plastic, though each is closed by the next layer. So depth is measured twice, with
  every void open, and over voids narrower than two thirds of a line, as if melt had closed them.
  The first tells parts whose voids join up, the second walls that are too thin.
- Direction. A profile asks for more plastic in a standing wall than in a floor. Heights count so
  many times that floors and walls fail at the same depth (`rules.py`).
- Cells. The path is found on cells of a quarter of a line, each with the share of plastic in it.
  Steps go to all 26 neighbours; the length of a slanting path, up to 13 % too long that way, is
  corrected to that of the straight way between both ends of every wall it crosses.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from printers.arrays import Flags, Floats, Ints
from printers.compilation import njit
from printers.leak_test.field import Field, ratio_of
from printers.leak_test.flood import CAVITY, CLOSED, OUTSIDE
from printers.leak_test.painting import AIR, Levels

CELLS_A_LINE = 4
UNITS = 10
"""Whole units of length a side of a cell."""

FULL = 16
"""Units of the share of a cell that lies within beads."""

FARTHEST = 65_000

SOURCE, DRAIN, SHUT = 1, 2, 3
"""Of coarse cells: air of the cavity, air outside, plugs."""

CLOSED_VOID = 1.66
"""F up to which a void counts as closed by melt."""


@dataclass(frozen=True, eq=False)
class Crossing:
    """A path through the thinnest seal.

    Attributes:
        length: Of plastic that is crossed, mm, heights counting `stretch` times; infinite where
            nothing leads to the outside.
        millimetres: The same with heights as they are.
        points: Of the path, mm, from the outside to the cavity.
            *Shape:* `(n, 3)`
        middle: Point of the path with as much plastic before as behind it.
    """

    length: float
    millimetres: float
    points: Floats
    middle: Floats


def thinnest_seal(field: Field, marks: Levels, open_from: int, stretch: float) -> Crossing:
    """The path of least plastic between the airs that are marked (flat).

    Args:
        field: Scaled distances.
        marks: Of the air from the level `open_from` on.
        open_from: Voids count as plastic unless they hold a cell of that level.
        stretch: How many times heights count.
    """
    factor = max(1, round(field.line_width / CELLS_A_LINE / field.voxel))
    side = factor * field.voxel
    sharpness = field.line_width / 2 / field.voxel
    plastic = _plastic_of_levels(sharpness)
    steps = round((float(ratio_of(open_from)) - 1) * sharpness)
    grid = marks.reshape(field.levels.shape)
    kinds = (CAVITY, OUTSIDE, CLOSED, AIR)
    share, ends = _pooled(field.levels, grid, factor, plastic, open_from, steps, kinds)
    thickness = np.diff(field.heights) * stretch / side
    cells = _least_plastic(share.ravel(), ends.ravel(), thickness, *share.shape[1:])
    if not len(cells):
        return Crossing(math.inf, math.inf, np.zeros((0, 3)), np.full(3, np.nan))
    points = _places(field, cells, share.shape, side)
    return _straightened(points, share.ravel()[cells] / FULL, stretch, side)


def _plastic_of_levels(sharpness: float) -> Levels:
    """(256,) share of plastic, up to `FULL`, in a cell whose centre has the level.

    A bead's side crosses the cell where F is within half a cell of 1.
    """
    ratio = ratio_of(np.arange(256))
    share = np.clip((1 - ratio) * sharpness + 0.5, 0.0, 1.0)
    return np.round(FULL * share).astype(np.uint8)


@njit(cache=True, nogil=True)
def _plastic(levels: Levels, air: NDArray[np.int16], b: int, a: int, plastic: Levels) -> int:
    """Plastic in a cell: part of it if it is air or beside air, else all."""
    side = air[b, a] > 0
    for row, column in ((b - 1, a), (b + 1, a), (b, a - 1), (b, a + 1)):
        if 0 <= row < air.shape[0] and 0 <= column < air.shape[1]:
            side |= air[row, column] > 0
    return plastic[levels[b, a]] if side else plastic[0]


@njit(cache=True, nogil=True)
def _pooled(
    levels: Levels,
    marks: Levels,
    factor: int,
    plastic: Levels,
    open_from: int,
    steps: int,
    kinds: tuple[int, int, int, int],
) -> tuple[Levels, Levels]:
    """Share of plastic and mark of cells of `factor` x `factor` finer ones.

    A cell has the mark that half of them have, by their middles. Air are the cells from the level
    `open_from` on, and those beyond the beads' sides that are `steps` from one; other voids are
    closed. `kinds` are the marks of cavity, outside and plugs, and the level of a bead's side.
    """
    in_cavity, out_of_it, in_plug, bead_side = kinds
    nz, ny, nx = levels.shape
    shape = nz, (ny + factor - 1) // factor, (nx + factor - 1) // factor
    share = np.zeros(shape, dtype=np.uint8)
    ends = np.zeros(shape, dtype=np.uint8)
    air = np.zeros((ny, nx), dtype=np.int16)
    for k in range(nz):
        for j in range(ny):
            for i in range(nx):
                air[j, i] = levels[k, j, i] >= open_from
        for step in range(steps):
            for j in range(1, ny - 1):
                for i in range(1, nx - 1):
                    if air[j, i] == 0 and levels[k, j, i] >= bead_side:
                        for near in (air[j, i - 1], air[j, i + 1], air[j - 1, i], air[j + 1, i]):
                            if 0 < near <= step + 1:
                                air[j, i] = step + 2
        for j in range(shape[1]):
            for i in range(shape[2]):
                total, count = 0, 0
                cavity, outside, plug = 0, 0, 0
                for b in range(j * factor, min((j + 1) * factor, ny)):
                    for a in range(i * factor, min((i + 1) * factor, nx)):
                        total += _plastic(levels[k], air, b, a, plastic)
                        count += 1
                        own = marks[k, b, a]
                        reaches = levels[k, b, a] >= open_from
                        cavity += own == in_cavity and reaches
                        outside += own == out_of_it and reaches
                        plug += own == in_plug
                share[k, j, i] = int(total / count + 0.5)
                if plug:
                    ends[k, j, i] = SHUT
                elif 2 * cavity >= count:
                    ends[k, j, i] = SOURCE
                elif 2 * outside >= count:
                    ends[k, j, i] = DRAIN
    return share, ends


@njit(cache=True, nogil=True)
def _least_plastic(share: Levels, ends: Levels, thickness: Floats, ny: int, nx: int) -> Ints:
    """Cells of the path of least plastic, from the outside to the cavity; empty if there is none.

    Dijkstra's algorithm with whole costs in a ring of buckets. `thickness` of the layers in sides
    of a cell.
    """
    layer = ny * nx
    offsets = np.zeros(27, dtype=np.int64)
    flats = np.zeros(27)
    for number in range(27):
        dy, dx = number // 3 % 3 - 1, number % 3 - 1
        offsets[number] = (number // 9 - 1) * layer + dy * nx + dx
        flats[number] = dx * dx + dy * dy
    most = math.ceil(UNITS * FULL * (2 + 2 * thickness.max())) + 2
    head = np.full(most, -1, dtype=np.int64)
    cells = np.empty(1 << 16, dtype=np.int32)
    after = np.empty(1 << 16, dtype=np.int32)
    used, free, waiting = 0, -1, 0
    distance = np.full(len(share), FARTHEST, dtype=np.uint16)
    origin = np.full(len(share), 255, dtype=np.uint8)
    for cell in range(len(share)):
        if ends[cell] == SOURCE:
            distance[cell] = 0
    scanned, now, cell = 0, 0, 0
    while scanned < len(share) or waiting:
        if scanned < len(share):  # the rim of the cavity first, then the buckets
            cell = scanned
            scanned += 1
            if ends[cell] != SOURCE:
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
            if ends[cell] == DRAIN:
                break
        k = cell // layer
        for number in range(27):
            beside = cell + offsets[number]
            if beside < 0 or beside >= len(share) or distance[beside] <= now:
                continue
            if ends[beside] == SHUT:
                continue
            dz, flat = number // 9 - 1, flats[number]
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
    if ends[cell] != DRAIN:
        path.clear()
        return np.array([0])[:0]
    while origin[cell] != 255:
        cell -= offsets[origin[cell]]
        path.append(np.int64(cell))
    return np.array(path)


def _places(field: Field, cells: Ints, shape: tuple[int, ...], side: float) -> Floats:
    """Centres (n, 3), mm, of pooled cells."""
    k, j, i = np.unravel_index(cells, shape)
    middle = (field.heights[:-1] + field.heights[1:]) / 2
    x, y = np.asarray(field.corner) + (side - field.voxel) / 2
    return np.column_stack([x + i * side, y + j * side, middle[k]])


def _straightened(points: Floats, share: Floats, stretch: float, side: float) -> Crossing:
    """The path with what it crosses of every wall shortened to the straight way.

    Of all ways through a wall the one is found whose first and last cell hold least. That is made
    good by half a `side` of a cell sideways; heights are whole layers.
    """
    crossed = []
    for scale in (stretch, 1.0):
        legs = np.diff(points, axis=0) * [1, 1, scale]
        steps = np.linalg.norm(legs, axis=1)
        plastic = steps * (share[:-1] + share[1:]) / 2
        for first, last in _runs(plastic > 0):
            chord = legs[first:last].sum(axis=0)
            length = max(float(np.linalg.norm(chord)), 1e-9)
            plastic[first:last] *= length / steps[first:last].sum()
            missing = side / 2 * float(np.linalg.norm(chord[:2])) / length
            plastic[first:last] *= 1 + missing / plastic[first:last].sum()
        crossed.append(plastic)
    before = np.concatenate([[0.0], np.cumsum(crossed[0])])
    half = before[-1] / 2
    middle = np.array([np.interp(half, before, points[:, axis]) for axis in range(3)])
    return Crossing(float(before[-1]), float(crossed[1].sum()), points, middle)


def _runs(flags: Flags) -> Ints:
    """(m, 2): first and behind the last of every run of true flags."""
    bounded = np.concatenate([[0], flags.astype(int), [0]])
    return np.flatnonzero(np.diff(bounded)).reshape(-1, 2)
