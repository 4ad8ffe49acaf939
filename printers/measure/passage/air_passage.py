"""The narrowest passage that air must take from the openings to any part of a cavity.

The width of a place is the diameter of the largest ball of air around it that touches no wall. The
narrowest place of the widest path is a pass of that field: found on a grid of a quarter of a
millimetre, then measured exactly around it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from printers.arrays import Flags, Floats, Ints
from printers.measure.passage.grid import (
    Grid,
    coarse_distances,
    exact_distances,
    grid_around,
    inside,
)
from printers.measure.passage.watershed import FIRST, SECOND, pass_between, passes, regions_before
from printers.measure.surface import Surface
from printers.model import Opening

STEP = 0.25
"""mm between the points of the first grid."""

MOST_POINTS = 4_000_000
"""Of the first grid; a larger cavity has longer steps."""

LEAST_VOLUME = 5.0
"""mm³. A part of the cavity that holds less may be as narrow as it likes."""

REFINEMENT = 4
"""A grid's step over that of the next finer one."""

LEVELS = 2
"""Finer grids: steps of a sixteenth of the first one's."""

AROUND = 3
"""Steps that a finer grid reaches around its pass."""

THICKEST_SKIN = 1.0
"""mm. What is narrower than a step shows as material; a way leads through no more than this."""


@dataclass(frozen=True)
class AirPassage:
    """The narrowest passage: `width` mm at a `place` (3,) mm, off by `uncertainty` mm at most."""

    width: float
    place: Floats
    uncertainty: float


@dataclass(frozen=True)
class _Air:
    """Air of a cavity with its openings: `cavity` is closed by plugs, `part` has none."""

    cavity: Surface
    part: Surface
    openings: Sequence[Opening]

    def within(self, grid: Grid) -> Flags:
        """Which points lie in the air."""
        return inside(self.cavity, grid) | self.bores(grid)

    def bores(self, grid: Grid) -> Flags:
        """Which points lie in the plugs, which stand for openings."""
        result = np.zeros(grid.shape, dtype=bool)
        for opening in self.openings:
            result |= _bore(grid, opening)
        return result

    def exact(self, grid: Grid) -> Floats:
        """Distance to the wall of every point."""
        return exact_distances(self.part, grid, self.within(grid))


def narrowest_passage(
    cavity: Surface, part: Surface, openings: Sequence[Opening], wide: float
) -> AirPassage | None:
    """The narrowest of the passages that lead from an opening to `LEAST_VOLUME` of air or more.

    Args:
        cavity: Its wall, closed by plugs in the openings, with normals into it or out of it.
        part: The whole surface, without plugs.
        openings: At least one.
        wide: mm. A passage that is certainly wider is not measured more closely.

    Returns:
        None if no passage is narrower than what lies before and behind it.
    """
    air = _Air(cavity, part, openings)
    grid = _grid_of(air)
    within = air.within(grid)
    marks = np.where(air.bores(grid), FIRST, 0)
    least = int(LEAST_VOLUME / grid.step**3)
    field, floor = coarse_distances(within, grid.step), 0.0
    if _in_pieces(within, marks, least):  # which are joined by less than a step
        field, floor = air.exact(grid), -THICKEST_SKIN
    found = passes(field, marks, least, floor)
    return _narrowest(air, grid, field, found, wide)


def _bore(grid: Grid, opening: Opening) -> Flags:
    """Points of the grid in the plug of an opening, as long on either side as it is wide."""
    x, y, z = (
        grid.origin[axis] + grid.step * np.arange(grid.shape[axis]) - opening.centre[axis]
        for axis in range(3)
    )
    x, y, z = x[:, None, None], y[None, :, None], z[None, None, :]
    a, b, c = opening.direction
    along = a * x + b * y + c * z
    beside = (x - along * a) ** 2 + (y - along * b) ** 2 + (z - along * c) ** 2
    return np.asarray(
        (beside < opening.radius**2) & (np.abs(along) <= opening.radius + grid.step)
    )


def _in_pieces(within: Flags, marks: Ints, least: int) -> bool:
    """Whether the grid shows air of at least `least` points that no opening leads to."""
    from scipy.ndimage import label

    number = label(within, np.ones((3, 3, 3)))[0]
    sizes = np.bincount(number[within], minlength=1)
    sizes[np.unique(number[(marks == FIRST) & within])] = 0
    return bool((sizes >= least).any())


def _grid_of(air: _Air) -> Grid:
    reach = max(opening.radius for opening in air.openings)
    mouths = np.array([opening.centre for opening in air.openings])
    corners = np.concatenate([air.cavity.bounds, mouths - reach, mouths + reach])
    lower, upper = corners.min(axis=0), corners.max(axis=0)
    volume = float(np.prod(upper - lower))
    return grid_around(lower, upper, max(STEP, (volume / MOST_POINTS) ** (1 / 3)))


def _narrowest(
    air: _Air, grid: Grid, field: Floats, found: Ints, wide: float
) -> AirPassage | None:
    """The narrowest of the passes, measured closely where it may be narrower than `wide`."""
    best: AirPassage | None = None
    for number in found[np.argsort(field.ravel()[found], kind="stable")]:
        rough = _refined(air, grid, field, int(number), 0)
        at_least = rough.width - rough.uncertainty
        if best is not None and at_least >= best.width:
            break  # and so are all that follow
        close = rough if at_least > wide else _refined(air, grid, field, int(number), LEVELS)
        if best is None or close.width < best.width:
            best = close
    return best


def _refined(air: _Air, grid: Grid, field: Floats, number: int, levels: int) -> AirPassage:
    """The pass measured on a finer grid around it, which joins the same regions."""
    index = tuple(int(i) for i in np.unravel_index(number, field.shape))
    place, height = grid.point(index), float(field[index])
    if not levels:
        return AirPassage(max(0.0, 2 * height), place, float(np.sqrt(3)) * grid.step)
    finer = grid_around(
        place - AROUND * grid.step, place + AROUND * grid.step, grid.step / REFINEMENT
    )
    marks = _marks_on(finer, grid, regions_before(field, number), index)
    exact = air.exact(finer)
    better = pass_between(exact, marks, -THICKEST_SKIN)
    if better is None:
        return _refined(air, grid, field, number, 0)
    return _refined(air, finer, exact, better, levels - 1)


def _marks_on(finer: Grid, grid: Grid, regions: Ints, index: tuple[int, ...]) -> Ints:
    """Marks of the two largest regions that meet at the pass, on the points of the finer grid."""
    around = tuple(slice(max(0, i - 1), i + 2) for i in index)
    numbers, counts = np.unique(regions[around], return_counts=True)
    sizes = np.bincount(regions.ravel())
    meeting = sorted(numbers[numbers > 0], key=lambda region: -sizes[region])[:2]
    points = finer.points(np.ones(finer.shape, dtype=bool))
    nearest = np.rint((points - grid.origin) / grid.step).astype(int)
    nearest = nearest.clip(0, np.array(grid.shape) - 1)
    region = regions[tuple(nearest.T)].reshape(finer.shape)
    marks = np.zeros(finer.shape, dtype=np.int64)
    for mark, number in zip((FIRST, SECOND), meeting, strict=False):
        marks[region == number] = mark
    return marks
