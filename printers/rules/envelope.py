"""The part must fit the printer and its cross-section limit, and stand on the bed."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from printers.arrays import Floats
from printers.measure.part import MeasuredPart
from printers.report import RuleResult, pass_or_fail, place
from printers.tolerances import FACET_TOLERANCE, ROUNDING

EXACT = 1e-9
_EXTENT = 2 * FACET_TOLERANCE  # mm: on either side a round may stand out of its facets


def check_build_volume(part: MeasuredPart) -> Iterator[RuleResult]:
    """The part must fit, standing as it is, with its length along either side of the bed."""
    extent, room = np.ptp(part.surface.bounds, axis=0), part.profile.build_volume
    lying = np.sort(extent[:2]) <= np.sort(room[:2]) + ROUNDING
    fits = bool(lying.all() and extent[2] <= room[2] + ROUNDING)
    size, volume = _size(extent), _size(room)
    message = f"the part, {size} mm, {'fits' if fits else 'does not fit'} the printer's {volume} mm"
    yield RuleResult(
        "build_volume", pass_or_fail(fits), size, volume, "mm", "whole part", message, _EXTENT
    )


def check_cross_section(part: MeasuredPart) -> Iterator[RuleResult]:
    """The extents in y and z must stay within the model's limit, if it has one.

    Where the limit counts from a place on, what begins and ends before it is left out.
    """
    limit = part.model.cross_section_limit
    if limit is None:
        return
    extent = _limited_extent(part)
    fits = bool((extent <= np.asarray(limit) + ROUNDING).all())
    excess = ", ".join(
        f"{axis} by {over:.2f} mm"
        for axis, over in zip("yz", extent - limit, strict=True)
        if over > ROUNDING
    )
    message = "the cross-section keeps its limit" if fits else f"the cross-section exceeds {excess}"
    yield RuleResult(
        "cross_section",
        pass_or_fail(fits),
        _size(extent),
        _size(limit),
        "mm",
        "y × z",
        message,
        _EXTENT,
    )


def _limited_extent(part: MeasuredPart) -> Floats:
    """Extents in y and z of what the limit of the cross-section counts for, mm."""
    corners, start = part.surface.corners.reshape(-1, 3), part.model.cross_section_start
    if start is not None:
        corners = corners[corners[:, 0] > start + ROUNDING]
    return np.asarray(np.ptp(corners[:, 1:], axis=0)) if len(corners) else np.zeros(2)


def check_bed_contact(part: MeasuredPart) -> Iterator[RuleResult]:
    """Enough of the part's footprint must lie flat on the bed."""
    surface, share = part.surface, part.profile.minimum_bed_contact
    area = float(np.abs(surface.area_vectors[part.on_bed, 2]).sum())
    footprint = float(np.prod(np.ptp(surface.bounds[:, :2], axis=0)))
    required, lies = share * footprint, area / footprint if footprint else 0.0
    stands = area > 0 and area >= required * (1 - EXACT)
    message = (
        f"{area:.1f} mm² lie on the bed at z = {round(surface.bounds[0, 2], 2) + 0.0:.2f} mm, "
        f"{lies:.0%} of the footprint; "
        f"at least {share:.0%} {'do' if stands else 'must'}"
    )
    contact = surface.corners[part.on_bed]
    middle = [contact.mean(axis=(0, 1))] if len(contact) else []
    where = place(middle[0]) if middle else "nowhere"
    measured, needed = round(area, 1), round(required, 1)
    verdict, hidden = pass_or_fail(stands), round(FACET_TOLERANCE * part.bed_rim, 2)
    result = RuleResult("bed_contact", verdict, measured, needed, "mm²", where, message, hidden)
    yield result.at(*middle)


def _size(extent: np.typing.ArrayLike) -> str:
    return " × ".join(f"{value:.2f}" for value in np.asarray(extent))
