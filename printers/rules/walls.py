"""Walls must be whole numbers of lines (standing) or layers (floors and roofs).

1.5 lines give broken paths and voids (Justino Netto 2024); a whole number of beads seals. Each
declared wall is judged by its number, and the mesh is measured to see that it says the same.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np

from printers.measure.boundary import Boundary
from printers.measure.slabs import STEADY_SPREAD, Flags, Floats, Slabs, flat, measure_slabs, steady
from printers.model import DeclaredWall, WallKind
from printers.profile import PrinterProfile
from printers.report import RuleResult, place

FACET_TOLERANCE = 0.02  # mm: the chord error allowed to the STL
SMALLEST_WALL = 1.0  # mm²: a smaller measured area is no wall
LINKED = 0.03  # mm: measured thicknesses closer than this belong together
LEVEL = float(np.cos(np.radians(10.0)))  # floors and roofs, whose thickness is counted in layers
WHOLE = 0.02  # a declared thickness may miss a whole number by this part of a line or layer


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
    parallel = slabs.chosen(slabs.parallel)
    plane = flat(surface, parallel, profile.line_width)
    constant = steady(slabs)[slabs.parallel]
    level = np.abs(parallel.normal[:, 2]) >= LEVEL
    standing = parallel.vertical & (parallel.thickness <= profile.thickest_wall_of_lines + 1e-6)
    walls = [
        *_groups(parallel, standing & (plane | constant), "lines"),
        *_groups(parallel, level & plane, "layers"),
    ]
    return WallSurvey(slabs, tuple(walls))


def check_declared_walls(
    walls: Iterable[DeclaredWall], profile: PrinterProfile
) -> Iterator[RuleResult]:
    """One result for every declared wall, from its number alone."""
    for wall in walls:
        count = wall.thickness / _unit(wall.kind, profile)
        whole = abs(count - round(count)) <= WHOLE and round(count) >= 1
        message = (
            f"{wall.name} {wall.thickness:g} mm is {count:.4g} {wall.kind} of "
            f"{_unit(wall.kind, profile):g} mm" + ("" if whole else ", not a whole number")
        )
        yield RuleResult(
            "wall_multiple",
            "pass" if whole else "fail",
            round(count, 4),
            "whole number",
            wall.kind,
            wall.name,
            message,
        )


def check_measured_walls(survey: WallSurvey, profile: PrinterProfile) -> Iterator[RuleResult]:
    """One result for every thickness found on the mesh."""
    for wall in survey.walls:
        unit = _unit(wall.kind, profile)
        count = wall.thickness / unit
        # Half a layer would be lost in a fixed tolerance where layers are very thin.
        tolerance = min(FACET_TOLERANCE, unit / 4)
        off = abs(wall.thickness - max(round(count), 1) * unit) > tolerance
        yield RuleResult(
            "wall_multiple_measured",
            "fail" if off or wall.tapered else "pass",
            round(count, 2),
            "whole number",
            wall.kind,
            place(wall.place),
            _describe(wall, count, off, tolerance),
        )


def check_declared_against_measured(
    walls: Iterable[DeclaredWall], survey: WallSurvey
) -> Iterator[RuleResult]:
    """A declared wall must be found on the mesh, between parallel faces, as thick as declared."""
    for wall in walls:
        area = survey.area_of(wall)
        found = area >= SMALLEST_WALL
        alike = [other for other in survey.walls if other.kind == wall.kind]
        nearest = min(alike, key=lambda other: abs(other.thickness - wall.thickness), default=None)
        measured: float | str = round(wall.thickness, 4)
        message = f"{wall.name} {wall.thickness:g} mm was measured on {area:.0f} mm²"
        if not found:
            measured = round(nearest.thickness, 4) if nearest else "none"
            message = f"{wall.name} {wall.thickness:g} mm was found nowhere on the mesh"
        if not found and nearest:
            message += f"; the nearest is {nearest.thickness:.3f} mm at {place(nearest.place)}"
        yield RuleResult(
            "wall_as_declared",
            "pass" if found else "fail",
            measured,
            round(wall.thickness, 4),
            "mm",
            wall.name,
            message,
        )


def group_by_thickness(thickness: Floats, area: float) -> Iterator[Flags]:
    """Split (k,) values wherever sorted neighbours lie further apart than `LINKED`; skip specks."""
    order = np.argsort(thickness, kind="stable")
    breaks = np.flatnonzero(np.diff(thickness[order]) > LINKED) + 1
    for members in np.split(order, breaks):
        if len(members) * area >= SMALLEST_WALL:
            flags = np.zeros(len(thickness), dtype=bool)
            flags[members] = True
            yield flags


def _groups(slabs: Slabs, which: Flags, kind: WallKind) -> Iterator[MeasuredWall]:
    walls = slabs.chosen(which)
    for members in group_by_thickness(walls.thickness, walls.area):
        yield _measured(walls.chosen(members), kind)


def _measured(slabs: Slabs, kind: WallKind) -> MeasuredWall:
    low, median, high = np.quantile(slabs.thickness, [0.01, 0.5, 0.99])
    typical = np.abs(slabs.thickness - median) <= max(FACET_TOLERANCE, (high - low) / 4)
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


def _describe(wall: MeasuredWall, count: float, off: bool, tolerance: float) -> str:
    lies = "standing wall" if wall.kind == "lines" else "floor or roof"
    where = f"{lies} at {place(wall.place)}, {wall.area:.0f} mm²"
    if wall.tapered:
        return f"{where}, tapers from {wall.low:.2f} to {wall.high:.2f} mm"
    verdict = "not a whole number" if off else f"whole within {tolerance:g} mm"
    return f"{where}, measures {wall.thickness:.3f} mm = {count:.2f} {wall.kind}, {verdict}"


def _unit(kind: WallKind, profile: PrinterProfile) -> float:
    return profile.line_width if kind == "lines" else profile.layer_height
