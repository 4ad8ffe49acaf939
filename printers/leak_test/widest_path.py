"""The widest path of air from the cavity to the outside: a bottleneck path through the field.

Of all paths the widest is the one whose smallest F is largest; that F is r*. Below 1 even the best
path crosses plastic and 1 - r* is what closes it; above 1 the path is air, (r* - 1) lines wide.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from printers.arrays import Floats, Ints
from printers.leak_test.field import Field, ratio_of
from printers.leak_test.flood import CAVITY, OUTSIDE, fill, shortest_crossing, widest, widths_along
from printers.leak_test.painting import AIR, Levels
from printers.leak_test.plugs import cavity_start, fresh_marks
from printers.model import Opening


@dataclass(frozen=True, eq=False)
class WidestPath:
    """A bottleneck path.

    Attributes:
        level: Of its narrowest cell; -1 if the plugs leave no path at all.
        marks: Flat, of the air of the cavity and outside that is wider than that, or all air where
            the path is closed.
    """

    level: int
    marks: Levels

    @property
    def is_open(self) -> bool:
        """Whether the path is air."""
        return self.level >= AIR

    @property
    def ratio(self) -> float:
        """r*."""
        return float(ratio_of(max(self.level, 0)))


def widest_path(
    field: Field, openings: Sequence[Opening], blocked: Sequence[Floats] = ()
) -> WidestPath:
    """The widest path that passes no plug and none of the balls around `blocked`."""
    marks, touched = air(field, openings, AIR, blocked)
    if not touched:
        return WidestPath(int(widest(*_flat(field), marks, *field.levels.shape[1:])), marks)
    marks = fresh_marks(field, openings, blocked)
    marks[cavity_start(field, openings)] = CAVITY
    level = int(widest(*_flat(field), marks, *field.levels.shape[1:]))
    return WidestPath(level, air(field, openings, level + 1, blocked)[0])


def crossing(field: Field, path: WidestPath) -> Ints:
    """Cells of the path from the air of the cavity to that outside, in fewest steps."""
    marks, shape = path.marks.copy(), field.levels.shape[1:]
    return np.asarray(shortest_crossing(*_flat(field), marks, path.level, *shape)[::-1])


def narrowest(field: Field, cells: Ints) -> int:
    """The narrowest cell of a path; the middle one if several are as narrow."""
    own = widths_along(*_flat(field), cells, *field.levels.shape[1:])
    narrow = np.flatnonzero(own == own.min())
    return int(cells[narrow[len(narrow) // 2]])


def air(
    field: Field, openings: Sequence[Opening], least: int, blocked: Sequence[Floats] = ()
) -> tuple[Levels, bool]:
    """Marks of the air from the level `least` on, and whether cavity and outside are connected."""
    levels, shape = _flat(field), field.levels.shape[1:]
    start, marks = cavity_start(field, openings), fresh_marks(field, openings, blocked)
    touched = bool(fill(*levels, marks, start, least, CAVITY, *shape))
    marks[start] = CAVITY
    fill(*levels, marks, _beside_outside(field), least, OUTSIDE, *shape)
    return marks, touched


def _flat(field: Field) -> tuple[Levels, Levels]:
    return field.levels.ravel(), field.links.ravel()


def _beside_outside(field: Field) -> Ints:
    """Cells beside those that are marked as outside from the beginning."""
    nz, ny, nx = field.levels.shape
    rim = field.rim - 1
    layer = np.zeros((ny, nx), dtype=bool)
    layer[rim:-rim, rim:-rim] = True
    ends = np.flatnonzero(layer)
    layer[rim + 1 : -rim - 1, rim + 1 : -rim - 1] = False
    ring = np.flatnonzero(layer)
    sides = (ring + ny * nx * np.arange(1, nz - 1)[:, None]).ravel()
    return np.concatenate([ends + ny * nx, ends + (nz - 2) * ny * nx, sides])
