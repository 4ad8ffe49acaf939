"""Which walls a part has: faces opposite each other, grouped by the thickness between them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np

from printers.arrays import Flags, Floats
from printers.measure.boundary import Boundary
from printers.measure.curved_walls import curved_walls, on_flat_faces
from printers.measure.slabs import (
    STEADY_SPREAD,
    Slabs,
    flat,
    measure_slabs,
    steady,
)
from printers.measure.surface import Surface
from printers.model import DeclaredWall, WallKind
from printers.profile import PrinterProfile
from printers.tolerances import FACET_TOLERANCE, SMALLEST_AREA

LINKED = 0.03  # mm: measured thicknesses closer than this belong together
OPPOSITE = float(np.cos(np.radians(30.0)))  # plane faces that open up more widely are no wall
LEVEL = float(np.cos(np.radians(10.0)))  # floors and roofs, whose thickness is counted in layers


@dataclass(frozen=True)
class MeasuredWall:
    """Walls of one thickness: `thickness` (median), `low`, `high` in mm, `area` in mm², a `place`
    (3,) mm in the middle of one such wall and its `normal` (3,)."""

    kind: WallKind
    thickness: float
    low: float
    high: float
    area: float
    place: Floats
    normal: Floats

    @property
    def tapered(self) -> bool:
        """Whether its thickness varies by more than facets explain."""
        return self.high - self.low > STEADY_SPREAD


@dataclass(frozen=True)
class WallSurvey:
    """Everything measured through the material: `slabs`, and which of them are parts of `walls`."""

    slabs: Slabs
    walls: tuple[MeasuredWall, ...]

    def area_of(self, wall: DeclaredWall) -> float:
        """Area in mm² on which the declared thickness was found between parallel faces."""
        slabs = self.slabs
        standing = slabs.vertical if wall.kind == "lines" else ~slabs.vertical
        alike = np.abs(slabs.thickness - wall.thickness) <= FACET_TOLERANCE + 1e-6
        return float((standing & alike & slabs.parallel).sum() * slabs.area)


def survey_walls(
    boundary: Boundary, declared: Iterable[DeclaredWall], profile: PrinterProfile
) -> WallSurvey:
    """Measure every wall of the cavity, up to the thickest declared or made of perimeters alone.

    Without a closed cavity every wall of the part is measured, from both of its sides.
    """
    surface = boundary.surface
    samples = boundary.inside if boundary.has_cavity else boundary.samples
    reach = max([profile.thickest_wall_of_lines, *(wall.thickness for wall in declared)]) + 0.1
    slabs = measure_slabs(surface, samples, "material", reach)
    slabs = slabs.chosen(~boundary.at_leaks(slabs.far))
    return WallSurvey(slabs, tuple(_walls(surface, slabs, profile)))


def _walls(surface: Surface, slabs: Slabs, profile: PrinterProfile) -> Iterator[MeasuredWall]:
    plane = _plane(surface, slabs, profile.line_width)
    counted = slabs.vertical & profile.counts_lines(slabs.thickness)
    on_flat, constant = on_flat_faces(surface)[slabs.triangle], steady(slabs)
    straight = on_flat & (plane | (constant & slabs.parallel))
    yield from _groups(slabs, counted & straight, "lines")
    yield from _curved(slabs, curved_walls(surface, slabs, counted & ~on_flat, straight, constant))
    level = np.abs(slabs.normal[:, 2]) >= LEVEL
    yield from _groups(slabs, level & plane & slabs.parallel, "layers")


def _plane(surface: Surface, slabs: Slabs, radius: float) -> Flags:
    """(k,): slabs between plane faces that lie opposite each other, parallel or tapering."""
    result = slabs.facing >= OPPOSITE
    result[result] = flat(surface, slabs.chosen(result), radius)
    return result


def _curved(slabs: Slabs, found: Iterator[Flags]) -> Iterator[MeasuredWall]:
    """Curved walls: those of one thickness together, every one that tapers by itself."""
    even = np.zeros(len(slabs.thickness), dtype=bool)
    for members in found:
        wall = _measured(slabs.chosen(members), "lines")
        if wall.tapered:
            yield wall
        else:
            even |= members
    yield from _groups(slabs, even, "lines")


def group_by_thickness(thickness: Floats, area: float) -> Iterator[Flags]:
    """Split values (k,), each found on `area` mm², where sorted neighbours differ by over `LINKED`.

    Yields flags (k,); groups on less than `SMALLEST_AREA` are left out.
    """
    order = np.argsort(thickness, kind="stable")
    breaks = np.flatnonzero(np.diff(thickness[order]) > LINKED) + 1
    for members in np.split(order, breaks):
        if len(members) * area >= SMALLEST_AREA:
            flags = np.zeros(len(thickness), dtype=bool)
            flags[members] = True
            yield flags


def _groups(slabs: Slabs, which: Flags, kind: WallKind) -> Iterator[MeasuredWall]:
    walls = slabs.chosen(which)
    for members in group_by_thickness(walls.thickness, walls.area):
        yield _measured(walls.chosen(members), kind)


def _measured(slabs: Slabs, kind: WallKind) -> MeasuredWall:
    low, median, high = np.quantile(slabs.thickness, [0.01, 0.5, 0.99])
    off = np.abs(slabs.thickness - median)
    typical = off <= max(FACET_TOLERANCE, (high - low) / 4, float(off.min()))
    # A real point of such a wall, nearest to the middle of them all: the mean of several walls
    # would lie in the air between them.
    middles = slabs.middle[typical]
    chosen = int(np.linalg.norm(middles - np.median(middles, axis=0), axis=1).argmin())
    return MeasuredWall(
        kind,
        float(median),
        float(low),
        float(high),
        len(slabs.thickness) * slabs.area,
        middles[chosen],
        slabs.normal[typical][chosen],
    )
