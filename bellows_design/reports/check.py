"""A printability report as a table for people."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from rich.box import SIMPLE
from rich.console import RenderableType
from rich.table import Table
from rich.text import Text

if TYPE_CHECKING:
    from bellows_design.design.design import Design
    from printers.orientation.compare import JudgedStance
    from printers.report import PrintabilityReport, RuleResult

_STYLES = {"pass": "green", "info": "cyan", "warn": "yellow", "fail": "bold red"}


def check_table(design: Design, report: PrintabilityReport) -> Sequence[RenderableType]:
    """The report on a design's part."""
    return report_table(design.name, report)


def report_table(
    title: str,
    report: PrintabilityReport,
    notes: Sequence[str] = (),
    compared: Sequence[JudgedStance] = (),
) -> Sequence[RenderableType]:
    """Notes, the orientations that were compared, a row for every rule, and the sentences of those
    that did not pass, or only within their tolerance."""
    table = Table(title=f"{title} on {report.printer}", title_justify="left", box=SIMPLE)
    table.add_column("", no_wrap=True)
    table.add_column("rule", no_wrap=True)
    for heading in ("measured", "required", "where"):
        table.add_column(heading)
    for rule in report.rules:
        table.add_row(*_row(rule))
    against = [f"{rule.verdict}: {rule.message}" for rule in report.rules if _tells(rule)]
    said = [f"note: {note}" for note in notes]
    orientations = [_orientations(compared)] if compared else []
    return [*orientations, table, *said, *against, f"printability: {report.verdict}"]


def _tells(rule: RuleResult) -> bool:
    """Whether its sentence says more than its row: also of a pass that needed its tolerance."""
    return rule.verdict != "pass" or (rule.margin is not None and rule.margin < 0)


def _orientations(compared: Sequence[JudgedStance]) -> Table:
    """A row for each way to stand, the best first."""
    table = Table(title="orientations, the best first", title_justify="left", box=SIMPLE)
    for heading in ("up", "on the bed", "height", "layers", "fails", "what speaks against it"):
        table.add_column(heading, no_wrap=heading in ("up", "on the bed", "height"))
    for each in compared:
        alike = f" (+{each.stance.alike} alike)" if each.stance.alike else ""
        cells = (
            f"{each.stance.turning.name}{alike}",
            f"{each.stance.contact:.0f} mm²",
            f"{each.stance.height:.1f} mm",
            str(each.layers),
            str(len(each.report.failures)),
            each.reason if each.is_whole else f"{each.reason} (other rules not applied)",
        )
        table.add_row(*(Text(cell) for cell in cells))
    return table


def _row(rule: RuleResult) -> tuple[Text, ...]:
    measured = _short(rule.measured)
    if any(sign.isdigit() for sign in measured):  # words have no unit
        measured = f"{measured} {rule.unit}"
    cells = (rule.rule, measured, _short(rule.required), rule.where)
    return Text(rule.verdict, style=_STYLES[rule.verdict]), *(Text(cell) for cell in cells)


def _short(value: float | int | str) -> str:
    return f"{value:.4g}" if isinstance(value, float) else str(value)
