"""Does the part fit the printer, its cross-section limit and the bed?"""

from __future__ import annotations

import numpy as np

from printers.measure.surface import Surface
from printers.profile import PrinterProfile
from printers.report import RuleResult, place

ROUNDING = 1e-3  # mm
EXACT = 1e-9


def check_build_volume(surface: Surface, profile: PrinterProfile) -> RuleResult:
    """The part must fit, standing as it is, with its length along either side of the bed."""
    extent = np.ptp(surface.bounds, axis=0)
    lying = np.sort(extent[:2]) <= np.sort(profile.build_volume[:2]) + ROUNDING
    fits = bool(lying.all() and extent[2] <= profile.build_volume[2] + ROUNDING)
    size, volume = _size(extent), _size(profile.build_volume)
    message = f"the part, {size} mm, {'fits' if fits else 'does not fit'} the printer's {volume} mm"
    return RuleResult(
        "build_volume", "pass" if fits else "fail", size, volume, "mm", "whole part", message
    )


def check_cross_section(surface: Surface, limit: tuple[float, float]) -> RuleResult:
    """The extents in y and z must stay within the limit (y, z) in mm."""
    extent = np.ptp(surface.bounds, axis=0)[1:]
    fits = bool((extent <= np.asarray(limit) + ROUNDING).all())
    excess = ", ".join(
        f"{axis} by {over:.2f} mm"
        for axis, over in zip("yz", extent - limit, strict=True)
        if over > ROUNDING
    )
    message = "the cross-section keeps its limit" if fits else f"the cross-section exceeds {excess}"
    return RuleResult(
        "cross_section",
        "pass" if fits else "fail",
        _size(extent),
        _size(limit),
        "mm",
        "y × z",
        message,
    )


def check_bed_contact(surface: Surface, profile: PrinterProfile) -> RuleResult:
    """Enough of the part's footprint must lie flat on the bed."""
    lowest = surface.bounds[0, 2]
    on_bed = (surface.corners[:, :, 2] <= lowest + ROUNDING).all(axis=1)
    on_bed &= surface.normals[:, 2] < 0
    area = float(-surface.area_vectors[on_bed, 2].sum())
    footprint = float(np.prod(np.ptp(surface.bounds[:, :2], axis=0)))
    required = profile.minimum_bed_contact * footprint
    stands = area >= required * (1 - EXACT)
    message = (
        f"{area:.1f} mm² lie on the bed at z = {lowest:.2f} mm, {area / footprint:.0%} of the "
        f"footprint; at least {profile.minimum_bed_contact:.0%} {'do' if stands else 'must'}"
    )
    where = place(surface.corners[on_bed].mean(axis=(0, 1))) if on_bed.any() else "nowhere"
    return RuleResult(
        "bed_contact",
        "pass" if stands else "fail",
        round(area, 1),
        round(required, 1),
        "mm²",
        where,
        message,
    )


def _size(extent: np.typing.ArrayLike) -> str:
    return " × ".join(f"{value:.2f}" for value in np.asarray(extent))
