"""Air must reach every part of the cavity through passages that stay open when printed."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from printers.measure.part import MeasuredPart
from printers.measure.passage.air_passage import LEAST_VOLUME
from printers.report import RuleResult, at_least, place
from printers.tolerances import FACET_TOLERANCE

TOLERANCE = 2 * FACET_TOLERANCE  # mm: the facets of either wall


def check_air_passage(part: MeasuredPart) -> Iterator[RuleResult]:
    """The rule `air_passage`, where one cavity closes: the narrowest place of the widest ways.

    Cavities that are not joined at all are for the rule `airtightness`.
    """
    if len(part.sealing.closed.voids) != 1 or not part.boundary.openings:
        return
    narrowest, needed = part.passage, part.profile.minimum_gap
    if narrowest is None:
        message = "the cavity is one space without passages"
        yield RuleResult("air_passage", "pass", "none", needed, "mm", "cavity", message)
        return
    width, where = narrowest.width, place(narrowest.place)
    stays = width >= needed - TOLERANCE
    message = (
        f"the narrowest passage that air takes to {LEAST_VOLUME:g} mm³ or more, {width:.2f} mm at "
        f"{where}, {'stays open' if stays else 'closes'} (at least {needed:g} mm)"
    )
    result = at_least("air_passage", width, needed, TOLERANCE, where, message)
    yield replace(result, uncertainty=round(narrowest.uncertainty, 3)).at(narrowest.place)
