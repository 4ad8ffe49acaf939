"""Indents that were found, and the front of all that were tried, as tables for people."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from rich.box import SIMPLE
from rich.console import RenderableType
from rich.table import Table
from rich.text import Text

if TYPE_CHECKING:
    from bellows_design.study.indent.search import Found, IndentStudy
    from bellows_design.study.indent.trial import Trial


def indent_tables(study: IndentStudy) -> Sequence[RenderableType]:
    """What was found for each aim, then the front, then notes."""
    plain = study.plain
    title = (
        f"{study.design.name} without indent: {plain.bending_angle_deg:.0f}°, "
        f"{plain.max_von_mises_mpa:.2f} MPa"
    )
    front = _empty(f"the front of {len(study.trials)} trials: no other bends more at less stress")
    for trial in study.front:
        front.add_row(*_cells(trial))
    found = [Text(line) for each in study.found for line in _found(each)]
    return [Text(title), *found, front]


def _found(found: Found) -> Iterator[str]:
    """An aim, the indent that was found for it, and whether it may be printed."""
    printable = f"not printable: {', '.join(found.refused_by)}" if found.refused_by else "printable"
    yield f"{found.aim.name}:"
    yield f"  {_line(found.trial)}; {printable}"


def _line(trial: Trial) -> str:
    label, angle, angle_change, stress, stress_change = _cells(trial)
    return f"{label}: {angle} ({angle_change}), {stress} ({stress_change})"


def _empty(title: str) -> Table:
    table = Table(title=title, title_justify="left", box=SIMPLE, pad_edge=False)
    table.add_column("indent, mm")
    for heading in ("angle", "change", "stress", "change"):
        table.add_column(heading, justify="right", no_wrap=True)
    return table


def _cells(trial: Trial) -> tuple[str, ...]:
    error, changes = trial.error_estimate, trial.changes
    return (
        trial.label,
        f"{trial.bending_angle_deg:.0f}°{_error(error.bending_angle_percent)}",
        f"{changes.bending_angle_percent:+.1f} %",
        f"{trial.max_von_mises_mpa:.2f} MPa{_error(error.max_von_mises_percent)}",
        f"{changes.max_von_mises_percent:+.1f} %",
    )


def _error(percent: float | None) -> str:
    return "" if percent is None else f" ± {percent:.1f} %"
