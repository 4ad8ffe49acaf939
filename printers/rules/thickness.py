"""No place of the part may be thinner than what is printed at once: a line, or a layer.

Slicers leave thinner walls out without a word. The rule looks at all of the surface, inside and
outside, curved and plain, and warns of what will be missing; whether the walls of the cavity are
thick enough to seal, other rules ask, and these refuse.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from printers.measure.part import MeasuredPart
from printers.measure.thickness.local_thickness import LocalThickness
from printers.profile import PrinterProfile
from printers.report import RuleResult, against, at_least, place
from printers.tolerances import FACET_TOLERANCE, SMALLEST_AREA

MOST_COUNTS = 6
"""Whole numbers of lines or layers that a message lists."""


def check_thickness(part: MeasuredPart) -> Iterator[RuleResult]:
    """The rule `thinnest_place`: one result for standing walls and one for floors and roofs."""
    profile, measured = part.profile, part.thickness
    standing = np.abs(measured.samples.normals[:, 2]) <= np.sqrt(0.5)
    yield _thinnest(measured.chosen(standing), profile.line_width, "standing wall", profile)
    yield _thinnest(measured.chosen(~standing), profile.layer_height, "floor or roof", profile)


def _thinnest(
    measured: LocalThickness, unit: float, what: str, profile: PrinterProfile
) -> RuleResult:
    """The thickness that is not exceeded on `SMALLEST_AREA` of surface."""
    made_of = "line" if what == "standing wall" else "layer"
    chosen = measured.of_area(SMALLEST_AREA)
    if chosen is None:
        message = f"no {what} is thinner than {profile.thickest_wall_of_lines:g} mm"
        return RuleResult("thinnest_place", "pass", "none", unit, "mm", "whole part", message)
    thickness, where = float(measured.thickness[chosen]), place(measured.samples.points[chosen])
    tolerance = min(FACET_TOLERANCE, unit / 4)
    message = (
        f"the thinnest {what}, {thickness:.3f} mm at {where}, is {thickness / unit:.2f} {made_of}s "
        f"of {unit:g} mm thick: {against(thickness, unit, tolerance)}"
        f"{_spread(measured, unit, tolerance)}"
    )
    result = at_least("thinnest_place", thickness, unit, tolerance, where, message)
    return result.at(measured.samples.points[chosen])


def _spread(measured: LocalThickness, unit: float, tolerance: float) -> str:
    """Of the surface: how much lies on how many whole lines or layers."""
    areas = measured.area_by_units(unit, tolerance)
    shown = [f"{count}: {area:.0f}" for count, area in areas.items() if area >= SMALLEST_AREA]
    more = ", …" if len(shown) > MOST_COUNTS else ""
    return f" (mm² of surface by their whole number: {', '.join(shown[:MOST_COUNTS])}{more})"
