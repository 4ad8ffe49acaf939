"""Floods through the field, from cell to neighbouring cell by their six sides.

`levels`, `links` and `marks` are flat arrays of bytes, `ny` and `nx` the cells of a layer. A step
within a layer is as wide as both of its cells, one to the layer above as the link says. Since a
link is that of the widest common point of two cells, each of them is at least as wide. A flood
enters free cells only and never leaves the grid: its outermost cells must not be free.
"""

from __future__ import annotations

import numpy as np

from printers.arrays import Ints
from printers.compilation import njit
from printers.leak_test.painting import Levels

FREE, CAVITY, OUTSIDE, CLOSED, SEEN = range(5)
"""Marks of cells. CLOSED: plugs, and whatever else no path may pass."""

STEP = 8
"""Marks from here on say by which of the six steps a cell was entered."""


@njit(cache=True, nogil=True)
def _width(levels: Levels, links: Levels, cell: int, layer: int) -> int:
    """The highest level within a cell."""
    return max(levels[cell], links[cell], links[cell - layer])


@njit(cache=True, nogil=True)
def _holds(levels: Levels, links: Levels, cell: int, layer: int, least: int) -> bool:
    """Whether there is at least a level within a cell."""
    return levels[cell] >= least or links[cell] >= least or links[cell - layer] >= least


@njit(cache=True, nogil=True)
def fill(
    levels: Levels,
    links: Levels,
    marks: Levels,
    start: Ints,
    least: int,
    mark: int,
    ny: int,
    nx: int,
) -> bool:
    """Mark all free cells of at least the level `least` that are connected with the `start`.

    Runs of cells along x at a time. Returns whether the outside was touched.
    """
    layer = ny * nx
    stack = np.empty(len(start) + 1024, dtype=np.int32)
    stack[: len(start)] = start
    count, touched = len(start), False
    while count:
        count -= 1
        left = right = stack[count]
        if marks[left] != FREE or not _holds(levels, links, left, layer, least):
            continue
        while marks[left - 1] == FREE and _holds(levels, links, left - 1, layer, least):
            left -= 1
        while marks[right + 1] == FREE and _holds(levels, links, right + 1, layer, least):
            right += 1
        touched |= marks[left - 1] == OUTSIDE or marks[right + 1] == OUTSIDE
        marks[left : right + 1] = mark
        if count + 2 * (right - left) + 8 > len(stack):
            stack = np.concatenate((stack, np.empty(len(stack) + 4 * nx, dtype=np.int32)))
        for beside in (nx, -nx, layer, -layer):
            within = False
            for cell in range(left + beside, right + beside + 1):
                enters = marks[cell] == FREE or marks[cell] == OUTSIDE
                if enters and abs(beside) == layer:
                    enters = links[min(cell, cell - beside)] >= least
                elif marks[cell] == FREE:
                    enters = _holds(levels, links, cell, layer, least)
                touched |= enters and marks[cell] == OUTSIDE
                enters &= marks[cell] == FREE
                if enters and not within:
                    stack[count] = cell
                    count += 1
                within = enters
    return touched


@njit(cache=True, nogil=True)
def widest(levels: Levels, links: Levels, marks: Levels, ny: int, nx: int) -> int:
    """The highest level that lets a path from the cavity reach the outside; -1 for none.

    Cells that are marked as cavity or outside are there already. The front always advances where
    the level is highest. Each level has a queue, first in, first out: a linked list in one pool.
    A cell that is reached as widely as can be is marked as seen; one that is reached through a
    narrow link stays free, for a wider way may be found, and waits with its complement.
    """
    layer = ny * nx
    steps = np.array([1, -1, nx, -nx, layer, -layer])
    head = np.full(256, -1, dtype=np.int64)
    tail = np.full(256, -1, dtype=np.int64)
    cells = np.empty(1 << 16, dtype=np.int32)
    after = np.empty(1 << 16, dtype=np.int32)
    used, free = 0, -1
    cell, level, reached = 0, 255, -1
    scanning = True
    while level > reached:
        if scanning:  # the rim of the cavity first, then the queues
            while cell < len(marks) and marks[cell] != CAVITY:
                cell += 1
            if cell == len(marks):
                scanning, level = False, 255
                continue
            level = _width(levels, links, cell, layer)
        else:
            entry = head[level]
            if entry < 0:
                level -= 1
                continue
            cell = cells[entry]
            head[level] = after[entry]
            after[entry], free = free, entry
            if cell < 0:
                cell = ~cell
                if marks[cell] != FREE:
                    continue
                marks[cell] = SEEN
        for step in steps:
            beside = cell + step
            if marks[beside] != FREE and marks[beside] != OUTSIDE:
                continue
            own = 255 if marks[beside] == OUTSIDE else _width(levels, links, beside, layer)
            best = own = min(level, own)
            if abs(step) == layer:
                own = min(level, links[min(cell, beside)])
            if marks[beside] == OUTSIDE:
                reached = max(reached, own)
                continue
            if own == best:
                marks[beside] = SEEN
            if free >= 0:
                entry, free = free, after[free]
            else:
                if used == len(cells):
                    cells = np.concatenate((cells, np.empty_like(cells)))
                    after = np.concatenate((after, np.empty_like(after)))
                entry = used
                used += 1
            cells[entry], after[entry] = beside if own == best else ~beside, -1
            if head[own] < 0:
                head[own] = entry
            else:
                after[tail[own]] = entry
            tail[own] = entry
        if scanning:
            cell += 1
            level = 255
    return reached


@njit(cache=True, nogil=True)
def shortest_crossing(
    levels: Levels, links: Levels, marks: Levels, least: int, ny: int, nx: int
) -> Ints:
    """Cells of a path of fewest steps from the outside to the cavity, at least `least` high.

    Its ends lie in the air of either. Marks the cells it sees. Empty if there is no path.
    """
    layer = ny * nx
    steps = np.array([1, -1, nx, -nx, layer, -layer])
    queue = np.empty(1 << 16, dtype=np.int32)
    count, done = 0, 0
    scanned = 0
    last, found = -1, -1
    while found < 0:
        if scanned < len(marks):  # the rim of the cavity first, then the queue
            cell = scanned
            scanned += 1
            if marks[cell] != CAVITY:
                continue
        elif done < count:
            cell = queue[done]
            done += 1
        else:
            break
        for number in range(6):
            beside = cell + steps[number]
            if number >= 4 and links[min(cell, beside)] < least:
                continue
            if marks[beside] == OUTSIDE:
                last, found = cell, beside
                break
            if marks[beside] != FREE and marks[beside] != SEEN:
                continue
            if number < 4 and not _holds(levels, links, beside, layer, least):
                continue
            marks[beside] = STEP + number
            if count == len(queue):
                queue = np.concatenate((queue, np.empty_like(queue)))
            queue[count] = beside
            count += 1
    path = [np.int64(found)]
    cell = last
    while cell >= 0:
        path.append(np.int64(cell))
        if marks[cell] < STEP:
            break
        cell -= steps[marks[cell] - STEP]
    return np.array(path) if found >= 0 else np.zeros(0, dtype=np.int64)


@njit(cache=True, nogil=True)
def widths_along(levels: Levels, links: Levels, path: Ints, ny: int, nx: int) -> Levels:
    """The level of every cell of a path, or that of the step to the next one if it is lower."""
    layer = ny * nx
    found = np.empty(len(path), dtype=np.uint8)
    for number in range(len(path)):
        cell = path[number]
        found[number] = _width(levels, links, cell, layer)
        if number + 1 < len(path) and abs(path[number + 1] - cell) == layer:
            link = links[min(cell, path[number + 1])]
            found[number] = min(found[number], link)
    return found
