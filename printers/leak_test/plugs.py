"""Plugs in the openings, and where the floods begin and end.

A plug is a cylinder around the opening's axis. It is half a line wider than the bore, since facets,
layers and the slicer leave the printed bore that uneven, and so deep that the way around its inner
end is no thinner seal than a wall.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from printers.arrays import Floats, Ints
from printers.errors import PrintersError
from printers.leak_test.field import Field
from printers.leak_test.flood import CLOSED, OUTSIDE
from printers.leak_test.painting import AIR, Levels
from printers.model import Opening
from printers.report import place

DEEPEST_IN_LINES = 5.0
"""A plug is at least this deep: more lines than `printed_depth` asks for."""

SURROUNDED = 0.3
"""Share of a ring around the mouth that must be beads for the opening to be one."""


def fresh_marks(
    field: Field, openings: Sequence[Opening], blocked: Sequence[Floats] = ()
) -> Levels:
    """Marks (flat): what lies beyond all beads is outside, the plugs are closed.

    `blocked` are middles of balls, of the radius of `blocked_radius`, that are closed too.
    """
    marks = np.zeros(field.levels.shape, dtype=np.uint8)
    rim = field.rim - 1
    for side in (marks[0], marks[-1], marks[:, :rim], marks[:, -rim:]):
        side[:] = OUTSIDE
    for side in (marks[:, :, :rim], marks[:, :, -rim:]):
        side[:] = OUTSIDE
    for opening in openings:
        for layer, window, along, beside in _around(field, opening):
            inside = (beside <= opening.radius + field.line_width / 2) & (
                np.abs(along + _depth(field, opening) / 2 - field.line_width / 2)
                <= (_depth(field, opening) + field.line_width) / 2
            )
            marks[layer][window][inside] = CLOSED
    flat = marks.ravel()
    for middle in blocked:
        flat[_ball(field, middle, blocked_radius(field))] = CLOSED
    return flat


def cavity_start(field: Field, openings: Sequence[Opening]) -> Ints:
    """One cell of air behind each plug.

    Raises:
        PrintersError: An opening has no beads around its mouth, or no air behind its plug.
    """
    return np.array([_start(field, opening) for opening in openings])


def blocked_radius(field: Field) -> float:
    """mm around a leak in which no second one is looked for."""
    return 2.5 * field.line_width


def _depth(field: Field, opening: Opening) -> float:
    return max(opening.radius, DEEPEST_IN_LINES * field.line_width)


def _start(field: Field, opening: Opening) -> int:
    _require_surrounded(field, opening)
    depth, best, level = _depth(field, opening), -1, AIR
    reach = max(2 * field.voxel, float(np.diff(field.heights[1:-1]).max()))
    for layer, window, along, beside in _around(field, opening):
        behind = (beside <= opening.radius) & (along < -depth) & (along >= -depth - reach)
        rows, columns = np.nonzero(behind)
        if not len(rows):
            continue
        rows, columns = rows + window[0].start, columns + window[1].start
        found = field.levels[layer, rows, columns]
        highest = int(found.argmax())
        if found[highest] > level:
            level = int(found[highest])
            cell = layer, int(rows[highest]), int(columns[highest])
            best = int(np.ravel_multi_index(cell, field.levels.shape))
    if best < 0:
        raise PrintersError(
            f"no air lies {depth:.1f} mm behind the mouth of {opening.name} at "
            f"{place(opening.centre)}: does the opening lie there, and point outwards?"
        )
    return best


def _require_surrounded(field: Field, opening: Opening) -> None:
    """Beads lie around the mouth, one line behind it."""
    beads = cells = 0
    for layer, window, along, beside in _around(field, opening):
        ring = np.abs(beside - opening.radius - field.line_width / 2) <= field.line_width / 2
        ring &= np.abs(along + 1.5 * field.line_width) <= field.line_width / 2
        beads += int((field.levels[layer][window][ring] < AIR).sum())
        cells += int(ring.sum())
    if beads < SURROUNDED * max(cells, 1):
        raise PrintersError(
            f"{opening.name} at {place(opening.centre)} is no opening of the sliced part: "
            f"{beads / max(cells, 1):.0%} of the ring around its mouth are beads"
        )


def _around(
    field: Field, opening: Opening
) -> Iterator[tuple[int, tuple[slice, slice], Floats, Floats]]:
    """Layers near an opening: number, window, and its cells' places along and beside the axis."""
    reach = _depth(field, opening) + opening.radius + 2 * field.line_width
    centre, axis = np.asarray(opening.centre), np.asarray(opening.direction)
    middles = (field.heights[:-1] + field.heights[1:]) / 2
    window, x, y = _window(field, centre, reach)
    for layer in np.flatnonzero(np.abs(middles - centre[2]) <= reach):
        offset = np.stack(
            [x - centre[0], y - centre[1], np.full_like(x, middles[layer] - centre[2])]
        )
        along = np.tensordot(axis, offset, 1)
        square = (offset**2).sum(axis=0) - along**2
        yield int(layer), window, along, np.sqrt(np.maximum(square, 0))


def _window(
    field: Field, centre: Floats, reach: float
) -> tuple[tuple[slice, slice], Floats, Floats]:
    """The part of a layer within reach, and the places (ny, nx) of its cells in mm."""
    slices = []
    for axis, count in ((1, field.levels.shape[1]), (0, field.levels.shape[2])):
        middle = (centre[axis] - field.corner[axis]) / field.voxel
        first = int(np.clip(np.floor(middle - reach / field.voxel), 0, count))
        last = int(np.clip(np.ceil(middle + reach / field.voxel) + 1, first, count))
        slices.append(slice(first, last))
    rows, columns = slices
    y = field.corner[1] + np.arange(rows.start, rows.stop) * field.voxel
    x = field.corner[0] + np.arange(columns.start, columns.stop) * field.voxel
    return (rows, columns), *np.meshgrid(x, y)


def _ball(field: Field, middle: Floats, radius: float) -> Ints:
    """Numbers of the cells within a ball."""
    (rows, columns), x, y = _window(field, middle, radius)
    z = (field.heights[:-1] + field.heights[1:]) / 2
    layers = np.flatnonzero(np.abs(z - middle[2]) <= radius)
    inside = (x - middle[0]) ** 2 + (y - middle[1]) ** 2 + (
        z[layers, None, None] - middle[2]
    ) ** 2 <= radius**2
    k, j, i = np.nonzero(inside)
    cells = (layers[k], j + rows.start, i + columns.start)
    return np.asarray(np.ravel_multi_index(cells, field.levels.shape))
