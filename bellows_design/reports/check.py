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
    from printers.report import PrintabilityReport, RuleResult

_STYLES = {"pass": "green", "info": "cyan", "warn": "yellow", "fail": "bold red"}


def check_table(design: Design, report: PrintabilityReport) -> Sequence[RenderableType]:
    """A row for every rule, then the sentences of those that did not pass."""
    table = Table(title=f"{design.name} on {report.printer}", title_justify="left", box=SIMPLE)
    table.add_column("", no_wrap=True)
    table.add_column("rule", no_wrap=True)
    for heading in ("measured", "required", "where"):
        table.add_column(heading)
    for rule in report.rules:
        table.add_row(*_row(rule))
    notes = [f"{rule.verdict}: {rule.message}" for rule in report.rules if rule.verdict != "pass"]
    return [table, *notes, f"printability: {report.verdict}"]


def _row(rule: RuleResult) -> tuple[Text, ...]:
    measured = _short(rule.measured)
    if any(sign.isdigit() for sign in measured):  # words have no unit
        measured = f"{measured} {rule.unit}"
    cells = (rule.rule, measured, _short(rule.required), rule.where)
    return Text(rule.verdict, style=_STYLES[rule.verdict]), *(Text(cell) for cell in cells)


def _short(value: float | int | str) -> str:
    return f"{value:.4g}" if isinstance(value, float) else str(value)
