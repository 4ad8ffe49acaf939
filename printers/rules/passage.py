"""Air must reach every part of the cavity through passages that stay open when printed."""

from __future__ import annotations

from collections.abc import Iterator

from printers.measure.part import MeasuredPart
from printers.measure.passage.air_passage import LEAST_VOLUME
from printers.report import RuleResult, at_least, place


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
    unsure = round(narrowest.uncertainty, 3)
    stays = width >= needed - unsure
    message = (
        f"the narrowest passage that air takes to {LEAST_VOLUME:g} mm³ or more, {width:.2f} mm at "
        f"{where}, {'stays open' if stays else 'closes'} (at least {needed:g} mm)"
    )
    yield at_least("air_passage", width, needed, unsure, where, message)
