"""The paper's designs beside ours as tables for people."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from rich.box import SIMPLE
from rich.console import RenderableType
from rich.table import Table
from rich.text import Text

if TYPE_CHECKING:
    from bellows_design.study.comparison import Comparison, Row

HEADINGS = ("paper", "ours", "off", "Δ paper", "Δ ours")
"""``off``: ours against the paper's; Δ: changes against Prototype 1; all in percent."""


def paper_tables(comparison: Comparison) -> Sequence[RenderableType]:
    """Angles, then stresses, each with its change against Prototype 1; then the accounts."""
    angles, stresses = (
        _empty("bending angle, °; off the paper's and Δ against Prototype 1, %", "s"),
        _empty("highest von Mises stress, MPa; likewise", ""),
    )
    for row in comparison.rows:
        angles.add_row(*_angle(row))
        stresses.add_row(*_stress(row))
    return [angles, stresses, *(Text(note) for note in _notes(comparison))]


def _empty(title: str, last: str) -> Table:
    """A table without rows, narrow enough for 80 columns."""
    table = Table(title=title, title_justify="left", box=SIMPLE, pad_edge=False)
    table.add_column("design", no_wrap=True)
    for heading in (*HEADINGS, *([last] if last else [])):
        table.add_column(heading, justify="right", no_wrap=True)
    return table


def _angle(row: Row) -> Iterator[str]:
    ours, error = row.evaluation, row.evaluation.error_estimate.bending_angle_percent
    yield row.result.label + ("" if row.agrees else " *")
    yield f"{row.result.bending_angle_deg:g}"
    yield f"{ours.bending_angle_deg:.0f}{_error(error)}"
    yield f"{row.angle_off_percent:+.1f}"
    yield f"{row.result.angle_change_percent:+.1f}"
    yield f"{row.changes.bending_angle_percent:+.1f}"
    yield f"{ours.seconds.total:.0f}"


def _stress(row: Row) -> Iterator[str]:
    ours, error = row.evaluation, row.evaluation.error_estimate.max_von_mises_percent
    yield row.result.label + ("" if row.agrees else " *")
    yield f"{row.result.max_stress_mpa:.2f}"
    yield f"{ours.max_von_mises_mpa:.2f}{_error(error)}"
    yield f"{row.stress_off_percent:+.1f}"
    yield f"{row.result.stress_change_percent:+.1f}"
    yield f"{row.changes.max_von_mises_percent:+.1f}"


def _error(percent: float | None) -> str:
    return "" if percent is None else f" ± {percent:.0f} %"


def _notes(comparison: Comparison) -> Iterator[str]:
    """One line for each design that does not agree."""
    apart = [row for row in comparison.rows if not row.agrees]
    for row in apart:
        yield f"* {row.result.label}: {row.account or 'not accounted for.'}"
    if apart:
        yield "The evidence is in docs/paper.md."
    for row in comparison.rows:
        if not row.evaluation.converged:
            yield f"{row.result.label} NOT CONVERGED: {row.evaluation.message}"
