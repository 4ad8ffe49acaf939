"""Air between neighbouring walls must stay wider than about one line, or the walls fuse."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from printers.measure.boundary import Boundary
from printers.measure.part import MeasuredPart
from printers.measure.samples import Samples
from printers.measure.slabs import Slabs, measure_slabs
from printers.model import DeclaredGap
from printers.profile import PrinterProfile
from printers.report import RuleResult, at_least, pass_or_fail, place
from printers.tolerances import FACET_TOLERANCE, SMALLEST_AREA

FACING = float(np.cos(np.radians(30.0)))  # walls that open up more widely than this do not fuse
WIDEST = 3.0  # mm: walls further apart are no neighbours, unless a wider gap is declared


def check_declared_gaps(part: MeasuredPart) -> Iterator[RuleResult]:
    """One result for every declared gap, from its number alone."""
    for gap in part.model.gaps:
        open_ = gap.width >= part.profile.minimum_gap - 1e-9
        message = f"{gap.name} {gap.width:g} mm {_against(open_, part.profile)}"
        result = _result("gap", open_, gap.width, part.profile.minimum_gap, gap.name, message)
        yield replace(result, uncertainty=None)


def check_measured_gaps(part: MeasuredPart) -> Iterator[RuleResult]:
    """Narrowest air outside (`gap_measured`) and in the cavity (`cavity_width`), and every declared
    gap found between parallel walls outside (`gap_as_declared`)."""
    boundary, declared, profile = part.boundary, part.model.gaps, part.profile
    reach = max([WIDEST, *(gap.width + 0.5 for gap in declared)])
    outside = _air(boundary, boundary.outside, reach)
    yield _narrowest("gap_measured", "outside", outside, profile)
    if boundary.has_cavity:
        inside = _air(boundary, boundary.inside, reach)
        yield _narrowest("cavity_width", "the cavity", inside, profile)
    for gap in declared:
        yield _as_declared(gap, outside)


def _air(boundary: Boundary, samples: Samples, reach: float) -> Slabs:
    slabs = measure_slabs(boundary.surface, samples, "air", reach)
    return slabs.chosen((slabs.facing >= FACING) & ~boundary.at_openings(slabs.middle))


def _narrowest(rule: str, scope: str, slabs: Slabs, profile: PrinterProfile) -> RuleResult:
    """The width that is not exceeded on `SMALLEST_AREA` of wall."""
    needed = max(1, int(np.ceil(SMALLEST_AREA / slabs.area)))
    if len(slabs.thickness) < needed:
        message = f"no walls stand close to each other {_inside(scope)}"
        return _result(rule, True, "none", profile.minimum_gap, "whole part", message)
    chosen = int(np.argsort(slabs.thickness, kind="stable")[needed - 1])
    width, where = float(slabs.thickness[chosen]), place(slabs.middle[chosen])
    open_ = width >= profile.minimum_gap - FACET_TOLERANCE
    message = (
        f"the narrowest gap {_inside(scope)}, {width:.3f} mm at {where}, {_against(open_, profile)}"
    )
    result = at_least(rule, width, profile.minimum_gap, FACET_TOLERANCE, where, message)
    return result.at(slabs.middle[chosen])


def _as_declared(gap: DeclaredGap, slabs: Slabs) -> RuleResult:
    widths = slabs.thickness[slabs.parallel]
    alike = np.abs(widths - gap.width) <= FACET_TOLERANCE + 1e-6
    area = float(alike.sum() * slabs.area)
    found = area >= SMALLEST_AREA
    measured: float | str = gap.width
    message = f"{gap.name} {gap.width:g} mm was measured on {area:.0f} mm²"
    if not found:
        measured = round(float(np.median(widths)), 3) if len(widths) else "none"
        other = f"the median gap is {measured} mm" if len(widths) else "no walls face each other"
        message = f"{gap.name} {gap.width:g} mm was found nowhere outside, where {other}"
    return _result("gap_as_declared", found, measured, gap.width, gap.name, message)


def _result(
    rule: str, good: bool, measured: float | str, required: float, where: str, message: str
) -> RuleResult:
    verdict = pass_or_fail(good)
    return RuleResult(rule, verdict, measured, required, "mm", where, message, FACET_TOLERANCE)


def _inside(scope: str) -> str:
    return scope if scope == "outside" else f"in {scope}"


def _against(open_: bool, profile: PrinterProfile) -> str:
    if open_:
        return f"stays open (at least {profile.minimum_gap:g} mm)"
    return f"is below {profile.minimum_gap:g} mm: its walls fuse"
