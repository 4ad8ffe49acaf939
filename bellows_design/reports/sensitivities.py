"""Sensitivities as tables for people."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from rich.box import SIMPLE
from rich.console import RenderableType
from rich.table import Table
from rich.text import Text

from bellows_design.neighbours.sensitivities import ANGLE, STRESS, VOLUME

if TYPE_CHECKING:
    from bellows_design.neighbours.jumps import CountChange
    from bellows_design.neighbours.sensitivities import Sensitivities, Sensitivity

COLUMNS = ((ANGLE, "angle", "°"), (STRESS, "stress", "MPa"), (VOLUME, "volume", "mm³"))


def sensitivities_table(found: Sensitivities | str) -> Sequence[RenderableType]:
    """Elasticities, then derivatives, the strongest parameter of the angle on top.

    Or one line, if ``found`` is why there are none.
    """
    if isinstance(found, str):
        return [Text(f"no sensitivities: {found}")]
    elasticities, *notes = elasticities_table(found)
    return [elasticities, _derivatives(found), *notes]


def elasticities_table(found: Sensitivities) -> Sequence[RenderableType]:
    """Elasticities, the strongest parameter of the angle on top, and what they mean."""
    table = _empty(
        "sensitivities, % per % of the parameter", "value", *(name for _, name, _ in COLUMNS)
    )
    for row in strongest_first(found):
        relative = (_elasticity(row.elasticities[name]) for name, *_ in COLUMNS)
        table.add_row(row.parameter, f"{row.value:.4g} {row.unit}".strip(), *relative)
    warnings = [Text(f"warning: {warning}", style="yellow") for warning in found.warnings]
    return [table, *(Text(note) for note in notes_on(found)), *warnings]


def _derivatives(found: Sensitivities) -> Table:
    table = _empty(
        "sensitivities per unit of the parameter",
        "per",
        *(f"{name}, {unit}" for _, name, unit in COLUMNS),
    )
    for row in strongest_first(found):
        absolute = (f"{row.derivatives[name]:+.4g}" for name, *_ in COLUMNS)
        table.add_row(row.parameter, row.unit or "1", *absolute)
    return table


def strongest_first(found: Sensitivities) -> list[Sensitivity]:
    """The parameters, that which changes the angle most on top."""
    return sorted(found.parameters, key=_strength, reverse=True)


def _empty(title: str, *headings: str) -> Table:
    """A table without rows; narrow enough for 80 columns, where every name shall show in full."""
    table = Table(title=title, title_justify="left", box=SIMPLE)
    table.add_column("parameter", no_wrap=True)
    for heading in headings:
        table.add_column(heading, justify="right", no_wrap=True)
    return table


def _strength(row: Sensitivity) -> float:
    return abs(row.elasticities[ANGLE] or 0.0)


def _elasticity(value: float | None) -> str:
    return "" if value is None else f"{value:+.3f}"


def notes_on(found: Sensitivities) -> list[str]:
    """What the numbers mean, one line each."""
    percent = 100 * (found.smooth_peak_ratio - 1)
    notes = [f"stress: a smooth maximum, {percent:.2g} % above the highest one."]
    notes += [
        f"{fillet} is a full round and follows {' and '.join(leaders)}."
        for fillet, leaders in found.led_along.items()
    ]
    if found.kinked:
        notes.append(
            f"{' and '.join(found.kinked)}: one-sided derivatives differ; their mean is given."
        )
    if found.ends_bound:
        notes.append(
            f"The ends are kept as they are; they may add ±{found.ends_bound:g} to an elasticity "
            "of the angle."
        )
    return notes + [_jump(found, change) for change in found.count_changes]


def _jump(found: Sensitivities, change: CountChange) -> str:
    """What another number of bubbles does to the angle, about."""
    count = found.design.bellows.bubble_count
    turned = found.responses[ANGLE] * (change.bubbles - count) / count
    return (
        f"{change.parameter} = {change.value:.4g} mm: {change.bubbles} bubbles instead of {count}, "
        f"about {turned:+.0f}°."
    )
