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

COLUMNS = ((ANGLE, "°"), (STRESS, "MPa"), (VOLUME, "mm³"))


def sensitivities_table(found: Sensitivities) -> Sequence[RenderableType]:
    """Elasticities first, derivatives beside them, the strongest parameter of the angle on top."""
    table = Table(
        title="sensitivities: % per % of the parameter, and per unit of it",
        title_justify="left",
        box=SIMPLE,
    )
    for heading in ("parameter", "value", *(text for _, unit in COLUMNS for text in ("%/%", unit))):
        table.add_column(heading, justify="left" if heading == "parameter" else "right")
    for row in sorted(found.parameters, key=_strength, reverse=True):
        table.add_row(*_cells(row))
    notes = [Text(text) for text in _notes(found)]
    return [table, *notes, *(Text(f"warning: {w}", style="yellow") for w in found.warnings)]


def _strength(row: Sensitivity) -> float:
    return abs(row.elasticities[ANGLE] or 0.0)


def _cells(row: Sensitivity) -> list[str]:
    pairs = [
        (_elasticity(row.elasticities[name]), f"{row.derivatives[name]:+.4g}")
        for name, _ in COLUMNS
    ]
    return [
        row.parameter,
        f"{row.value:.4g} {row.unit}".strip(),
        *(x for pair in pairs for x in pair),
    ]


def _elasticity(value: float | None) -> str:
    return "" if value is None else f"{value:+.3f}"


def _notes(found: Sensitivities) -> list[str]:
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
