"""Walls must be whole numbers of lines (standing) or layers (floors and roofs).

1.5 lines give broken paths and voids (Justino Netto 2024); a whole number of beads seals. Each
declared wall is judged by its number, and the mesh is measured to see that it says the same.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from printers.measure.part import MeasuredPart
from printers.measure.wall_survey import MeasuredWall, WallSurvey
from printers.model import DeclaredWall, WallKind
from printers.profile import PrinterProfile
from printers.report import RuleResult, pass_or_fail, place
from printers.tolerances import FACET_TOLERANCE, SMALLEST_AREA

WHOLE = 0.02  # a declared thickness may miss a whole number by this part of a line or layer


def check_declared_walls(part: MeasuredPart) -> Iterator[RuleResult]:
    """One result for every declared wall, from its number alone."""
    for wall in part.model.walls:
        yield _multiple(wall, part.profile)


def check_measured_walls(part: MeasuredPart) -> Iterator[RuleResult]:
    """One result for every thickness found on the mesh."""
    for wall in part.walls.walls:
        yield _multiple_measured(wall, part.profile)


def check_walls_as_declared(part: MeasuredPart) -> Iterator[RuleResult]:
    """A declared wall must be found on the mesh, between parallel faces, as thick as declared."""
    for wall in part.model.walls:
        if wall.around is None:
            yield _as_declared(wall, part.walls)


def _multiple(wall: DeclaredWall, profile: PrinterProfile) -> RuleResult:
    unit = _unit(wall.kind, profile)
    count = wall.thickness / unit
    filled = wall.kind == "lines" and not profile.counts_lines(wall.thickness)
    whole = filled or (abs(count - round(count)) <= WHOLE and round(count) >= 1)
    most = (
        f", more than the {2 * profile.slicer.perimeters} of all perimeters: infill fits the rest"
    )
    message = (
        f"{wall.name} {wall.thickness:g} mm is {count:.4g} {wall.kind} of {unit:g} mm"
        f"{most if filled else '' if whole else ', not a whole number'}"
    )
    return _whole_number("wall_multiple", whole, round(count, 4), wall.kind, wall.name, message)


def _multiple_measured(wall: MeasuredWall, profile: PrinterProfile) -> RuleResult:
    unit = _unit(wall.kind, profile)
    count = wall.thickness / unit
    # Half a layer would be lost in a fixed tolerance where layers are very thin.
    tolerance = min(FACET_TOLERANCE, unit / 4)
    off = abs(wall.thickness - max(round(count), 1) * unit) > tolerance
    good, where = not (off or wall.tapered), place(wall.place)
    message = _describe(wall, count, off, tolerance)
    result = _whole_number(
        "wall_multiple_measured", good, round(count, 2), wall.kind, where, message
    )
    return replace(result, uncertainty=round(tolerance / unit, 3)).at(wall.place)


def _whole_number(
    rule: str, good: bool, count: float, kind: WallKind, where: str, message: str
) -> RuleResult:
    return RuleResult(rule, pass_or_fail(good), count, "whole number", kind, where, message)


def _as_declared(wall: DeclaredWall, survey: WallSurvey) -> RuleResult:
    area = survey.area_of(wall)
    found = area >= SMALLEST_AREA
    required = round(wall.thickness, 4)
    measured: float | str = required
    message = f"was measured on {area:.0f} mm²"
    if not found:
        measured, message = _nearest(wall, survey)
    return RuleResult(
        "wall_as_declared",
        pass_or_fail(found),
        measured,
        required,
        "mm",
        wall.name,
        f"{wall.name} {wall.thickness:g} mm {message}",
        FACET_TOLERANCE,
    ).at(*(other.place for other in survey.walls))


def _nearest(wall: DeclaredWall, survey: WallSurvey) -> tuple[float | str, str]:
    """Thickness of the wall of the same kind that comes nearest, and words on it."""
    alike = [other for other in survey.walls if other.kind == wall.kind]
    if not alike:
        return "none", "was found nowhere on the mesh"
    nearest = min(alike, key=lambda other: abs(other.thickness - wall.thickness))
    where = f"{nearest.thickness:.3f} mm at {place(nearest.place)}"
    return round(nearest.thickness, 4), f"was found nowhere on the mesh; the nearest is {where}"


def _describe(wall: MeasuredWall, count: float, off: bool, tolerance: float) -> str:
    lies = "standing wall" if wall.kind == "lines" else "floor or roof"
    where = f"{lies} at {place(wall.place)}, {wall.area:.0f} mm²"
    if wall.tapered:
        return f"{where}, tapers from {wall.low:.2f} to {wall.high:.2f} mm"
    verdict = "not a whole number" if off else f"whole within {tolerance:g} mm"
    return f"{where}, measures {wall.thickness:.3f} mm = {count:.2f} {wall.kind}, {verdict}"


def _unit(kind: WallKind, profile: PrinterProfile) -> float:
    return profile.line_width if kind == "lines" else profile.layer_height
