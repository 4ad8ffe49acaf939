"""Angle, stress and volume against pressure, with limits and where something happens."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from bellows_design.reports.evaluation import contact_text, place_text, strains_text
from bellows_design.reports.page.blocks import (
    Block,
    Fact,
    Facts,
    Folded,
    Grid,
    Picture,
    Pictures,
    Section,
    Sentences,
)
from bellows_design.reports.page.curves.pressure_charts import angle_chart, stress_chart
from bellows_design.reports.page.wording import (
    capitalised,
    headings,
    number,
    plus_minus,
    pressure_text,
)

if TYPE_CHECKING:
    from bellows_design.analysis.evaluation import Evaluation
    from bellows_design.reports.page.findings import Findings


def pressure(findings: Findings) -> Section:
    """Curves along the load path, what was reached, and warnings."""
    found = findings.outcome.evaluation
    title = "Angle and stress against pressure"
    if found is None:
        why = Sentences(("There is no curve: the design was refused before the evaluation.",))
        return Section("pressure", title, (why,))
    told = findings.outcome.verdict.warnings
    return Section("pressure", title, tuple(_blocks(found, told)))


def _blocks(found: Evaluation, told: Sequence[str]) -> Iterator[Block]:
    """What was found; warnings that were ``told`` on top are not repeated."""
    if not found.converged:
        yield Sentences((capitalised(found.message or "the load was not reached"),), "bad")
    if len(found.path) > 1:
        yield from _curves(found)
    yield Facts(tuple(_facts(found)))
    warnings = tuple(capitalised(each) for each in found.warnings if each not in told)
    if warnings:
        yield Sentences(warnings, "warn")
    if len(found.path) > 1:
        yield Folded("The numbers", (_table(found),))


def _curves(found: Evaluation) -> Iterator[Block]:
    """Both charts, and what their bands are; one mesh alone gives no error."""
    angle, stress = angle_chart(found), stress_chart(found)
    band = "The band is the estimated error of mesh and model."
    if not any(len(line.low) for line in angle.lines):
        band = "Without a band, as its error is not estimated."
    yield Pictures(
        (Picture(angle, band), Picture(stress, "The highest von Mises stress anywhere."))
    )
    if len(found.meshes) > 1:
        told = (
            "The path is that of the coarsest mesh, its end that of the finest; the band of the "
            "path is widened by their difference."
        )
        yield Sentences((told,), "muted")


def _facts(found: Evaluation) -> Iterator[Fact]:
    error = found.error_estimate
    angle, stress = found.bending_angle_deg, found.max_von_mises_mpa
    yield Fact("pressure reached", pressure_text(found.pressure_mpa))
    yield Fact(
        "bending angle", f"{angle:.1f}°", plus_minus(angle, error.bending_angle_percent, "°")
    )
    yield Fact(
        "highest von Mises stress",
        f"{stress:.3f} MPa",
        plus_minus(stress, error.max_von_mises_percent, " MPa", 3),
        f"limit {found.design.max_von_mises:g} MPa",
    )
    yield Fact("its place (x, y, z)", place_text(found.max_von_mises_position_mm))
    yield Fact("air inside under pressure", f"{found.cavity_volume_mm3 / 1000:.2f} cm³")
    yield Fact("principal strains", strains_text(found.strain))
    yield Fact("contact", contact_text(found.contact))
    stable = {True: "yes", False: "no", None: "not known"}[found.stable]
    yield Fact("stable under its pressure", stable, tone="bad" if found.stable is False else "")
    if found.touch_pressure_mpa is not None:
        yield Fact("walls first touch at", pressure_text(found.touch_pressure_mpa), tone="bad")
    if found.limit_pressure_mpa is not None:
        yield Fact("limit point at", pressure_text(found.limit_pressure_mpa), tone="bad")


def _table(found: Evaluation) -> Grid:
    titles = ("pressure, MPa", "angle, °", "stress, MPa", "air inside, mm³")
    rows = tuple(
        (
            number(f"{each.pressure_mpa:.4g}"),
            number(f"{each.bending_angle_deg:.2f}"),
            number(f"{each.max_von_mises_mpa:.3f}"),
            number(f"{each.cavity_volume_mm3:.0f}"),
        )
        for each in found.path
    )
    return Grid(headings(*titles, right=titles), rows)
