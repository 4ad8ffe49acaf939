"""What a change of one per cent in each number does: elasticities as signed bars."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from bellows_design.neighbours.sensitivities import ANGLE, STRESS
from bellows_design.reports.page.blocks import (
    Block,
    Cell,
    Folded,
    Grid,
    Picture,
    Pictures,
    Section,
    Sentences,
)
from bellows_design.reports.page.curves.chart import BarChart
from bellows_design.reports.page.wording import capitalised, headings, number
from bellows_design.reports.sensitivities import COLUMNS, notes_on, strongest_first
from bellows_design.web.charts import Bar

if TYPE_CHECKING:
    from bellows_design.neighbours.sensitivities import Sensitivities, Sensitivity
    from bellows_design.reports.page.findings import Findings

TOLD = 3
"""Parameters that a sentence names."""


def sensitivities(findings: Findings) -> Section:
    """Bars, a sentence on the strongest, and derivatives per unit; or why there are none."""
    found = findings.sensitivities
    title = "What a change does"
    if isinstance(found, str):
        return Section("sensitivities", title, (Sentences((f"No sensitivities: {found}.",)),))
    return Section("sensitivities", title, tuple(_blocks(found)))


def _blocks(found: Sensitivities) -> Iterator[Block]:
    rows = strongest_first(found)
    yield Sentences(tuple(_sentences(rows)))
    yield Pictures(tuple(_pictures(rows)))
    if found.warnings:
        yield Sentences(tuple(map(capitalised, found.warnings)), "warn")
    yield Sentences((*notes_on(found), f"time: {found.seconds:.1f} s."), "muted")
    yield Folded("Derivatives per unit", (_table(rows),))


def _sentences(rows: list[Sensitivity]) -> Iterator[str]:
    """The strongest, in words."""
    for row in rows[:TOLD]:
        angle, stress = row.elasticities[ANGLE], row.elasticities[STRESS]
        if angle is not None and stress is not None:
            yield (f"{row.parameter} + 1 %: angle {angle:+.2f} %, highest stress {stress:+.2f} %.")


def _pictures(rows: list[Sensitivity]) -> Iterator[Picture]:
    for key, name in ((ANGLE, "bending angle"), (STRESS, "highest stress")):
        known = tuple(_bars(rows, key))
        if known:
            title = f"Change of the {name} for + 1 % of each number"
            yield Picture(BarChart(title, f"{name}, % for + 1 %", known), title)


def _bars(rows: list[Sensitivity], key: str) -> Iterator[Bar]:
    for row in rows:
        value = row.elasticities[key]
        if value is not None:
            yield Bar(row.parameter, value)


def _table(rows: list[Sensitivity]) -> Grid:
    titles = ("parameter", "value", "per", *(f"{name}, {unit}" for _, name, unit in COLUMNS))
    return Grid(headings(*titles, right=titles[1:2] + titles[3:]), tuple(map(_row, rows)))


def _row(row: Sensitivity) -> tuple[Cell, ...]:
    derivatives = (number(f"{row.derivatives[key]:+.4g}") for key, *_ in COLUMNS)
    value = number(f"{row.value:.4g} {row.unit}".strip())
    return Cell(row.parameter), value, Cell(row.unit or "1"), *derivatives
