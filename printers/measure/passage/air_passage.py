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
from printers.measure.distance.nearest import nearest_distances
from printers.measure.passage.grid import (
    Grid,
    coarse_distances,
    grid_around,
    inside,
)
from printers.measure.passage.watershed import (
    FIRST,
    NOTHING,
    SECOND,
    pass_between,
    passes,
    regions_before,
)
from printers.measure.surface import Surface
from printers.model import Opening

STEP = 0.25
"""mm between the points of the first grid."""

MOST_POINTS = 4_000_000
"""Of the first grid; a larger cavity has longer steps."""

LEAST_VOLUME = 5.0
"""mm³. A part of the cavity that holds less may be as narrow as it likes."""

FEWEST_POINTS = 64
"""Of a part of the cavity that counts, where the steps are long."""

MOST_PASSES = 40
"""That are measured closely: more than a part has bubbles."""

REFINEMENT = 4
"""A grid's step over that of the next finer one."""

LEVELS = 2
"""Finer grids: steps of a sixteenth of the first one's."""

AROUND = 3
"""Steps that a finer grid reaches around its pass."""

BESIDE = 1.8
"""Steps that the axis of a passage may lie beside the points that show it: to a corner."""

MOST_JOINTS = 6
"""Places that join two regions of which the widest is looked for."""

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
        """Distance to the wall in the air; in the material negative that to the cavity, so that
        what lies under the outside is no way; -inf outside."""
        within = self.within(grid)
        material = ~within & inside(self.part, grid)
        field = np.full(grid.shape, -np.inf)
        field[within] = nearest_distances(self.part.tree, grid.points(within))
        field[material] = -nearest_distances(self.cavity.tree, grid.points(material))
        return field


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
    least = max(FEWEST_POINTS, int(LEAST_VOLUME / grid.step**3))
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
    return np.asarray((beside < opening.radius**2) & (np.abs(along) <= opening.radius + grid.step))


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


def _narrowest(air: _Air, grid: Grid, field: Floats, found: Ints, wide: float) -> AirPassage | None:
    """The narrowest of the passes, measured closely where it may be narrower than `wide`."""
    best: AirPassage | None = None
    lowest = found[np.argsort(field.ravel()[found], kind="stable")]
    for number in lowest[:MOST_PASSES]:
        rough = _rough(grid, field, int(number))
        at_least = rough.width - rough.uncertainty
        if best is not None and at_least >= best.width:
            break  # and so are all that follow
        close = rough if at_least > wide else _widest_joint(air, grid, field, int(number))
        if best is None or close.width < best.width:
            best = close
    return best


def _rough(grid: Grid, field: Floats, number: int) -> AirPassage:
    """The pass as the grid shows it."""
    index = tuple(int(i) for i in np.unravel_index(number, field.shape))
    width = max(0.0, 2 * float(field[index]))
    return AirPassage(width, grid.point(index), float(np.sqrt(3)) * grid.step)


def _widest_joint(air: _Air, grid: Grid, field: Floats, number: int) -> AirPassage:
    """Of all the places that join the two regions which meet at the pass, the widest.

    On the first grid a narrow joint may show as wide as another; so one after the other is
    measured and closed, until none is left.
    """
    sides = _meeting(field, number)
    joints = [_refined(air, grid, field, number, sides, LEVELS)]
    for _ in range(MOST_JOINTS - 1):
        near = np.linalg.norm(_points(grid) - joints[-1].place, axis=-1) <= 2 * grid.step
        field = np.where(near, -np.inf, field)
        following = pass_between(field, np.where(near, 0, sides), -THICKEST_SKIN)
        if following is None or field.ravel()[following] <= -grid.step:
            break
        joints.append(_refined(air, grid, field, following, sides, LEVELS))
    return max(joints, key=lambda joint: joint.width)


def _refined(
    air: _Air, grid: Grid, field: Floats, number: int, sides: Ints, levels: int
) -> AirPassage:
    """The pass between two `sides` measured on finer grids around it."""
    rough = _rough(grid, field, number)
    if not levels:
        return rough
    reach = AROUND * grid.step
    finer = grid_around(rough.place - reach, rough.place + reach, grid.step / REFINEMENT)
    marks = _grown(field, number, sides)[_nearest(grid, finer)]
    exact = air.exact(finer)
    better = pass_between(exact, marks, -THICKEST_SKIN)
    if better is None:
        return rough
    return _refined(air, finer, exact, better, marks, levels - 1)


def _meeting(field: Floats, number: int) -> Ints:
    """Marks of the two largest regions that meet at a pass."""
    regions = regions_before(field, number)
    index = np.unravel_index(number, field.shape)
    around = tuple(slice(max(0, int(i) - 1), int(i) + 2) for i in index)
    sizes = np.bincount(regions.ravel())
    touching = np.unique(regions[around])
    marks = np.zeros(len(sizes), dtype=np.int64)
    ranked = sorted(touching[touching > 0], key=lambda region: -sizes[region])
    for mark, region in zip((FIRST, SECOND), ranked, strict=False):
        marks[region] = mark
    return marks[regions]


def _grown(field: Floats, number: int, sides: Ints) -> Ints:
    """The marks of the sides on all of the regions that they had become before the pass."""
    regions = regions_before(field, number)
    marks = np.zeros(int(regions.max()) + 1, dtype=np.int64)
    np.maximum.at(marks, regions.ravel(), sides.ravel())
    marks[0] = NOTHING
    return _widened(np.where(sides > 0, sides, marks[regions]), field.shape, number)


def _widened(marks: Ints, shape: tuple[int, ...], number: int) -> Ints:
    """Around a pass, the marks on all points near to one side and nearer than to the other.

    The axis of a passage may lie beside the points that show it.
    """
    from scipy.ndimage import distance_transform_edt

    index = np.unravel_index(number, shape)
    around = tuple(slice(max(0, int(i) - AROUND - 1), int(i) + AROUND + 2) for i in index)
    near = marks[around]
    to_first, to_second = (
        distance_transform_edt(near != mark)
        if (near == mark).any()
        else np.full(near.shape, np.inf)
        for mark in (FIRST, SECOND)
    )
    widened = marks.copy()
    widened[around] = np.where((to_first < to_second) & (to_first <= BESIDE), FIRST, NOTHING)
    widened[around] += np.where((to_second < to_first) & (to_second <= BESIDE), SECOND, NOTHING)
    return widened


def _nearest(grid: Grid, finer: Grid) -> tuple[Ints, ...]:
    """Numbers of the points of a grid that lie nearest to those of a finer one."""
    index = np.rint((_points(finer) - grid.origin) / grid.step).astype(np.int64)
    return tuple(np.moveaxis(index.clip(0, np.array(grid.shape) - 1), -1, 0))


def _points(grid: Grid) -> Floats:
    """(nx, ny, nz, 3) mm."""
    return grid.points(np.ones(grid.shape, dtype=bool)).reshape(*grid.shape, 3)
