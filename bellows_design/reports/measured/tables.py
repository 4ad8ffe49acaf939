"""A comparison with measurements as plain values for programs and as text for people."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
from rich.box import SIMPLE
from rich.console import RenderableType
from rich.table import Table
from rich.text import Text

from bellows_design.measured.comparison import Comparison
from bellows_design.measured.factor.fit import Factor
from bellows_design.measured.verdict import sentences
from solver.arrays import Reals

MOST_ROWS = 25
"""Of the printed table; ``--json`` has all points."""


@dataclass(frozen=True)
class MeasuredReport:
    """A comparison and the files that were written of it; None where none was."""

    found: Comparison
    material_file: Path | None = None
    plot_file: Path | None = None
    material_refused: str | None = None

    def to_dict(self) -> dict[str, Any]:
        """Plain values for JSON; docs/json.md says what they mean."""
        found = self.found
        measured = found.measured
        return {
            "design": found.part,
            "material": found.material.name,
            "data": measured.name,
            "quantity": measured.quantity.name,
            "unit": measured.quantity.unit,
            "zero_at_mpa": found.zero_at,
            "reading": {
                "notes": list(measured.reading.notes),
                "hints": list(measured.reading.hints),
            },
            "model": {"notes": list(found.model.notes), "ending": found.model.ending or None},
            "material_uncertainty_percent": found.material_percent,
            "points": _points(found),
            "points_reached": found.reached,
            "points_inside_band": int(found.inside.sum()),
            "factor": None if found.factor is None else _factor(found.factor),
            "not_determined": found.fitted.refused or None,
            "departures": [_departure(asdict(each)) for each in found.departures],
            "sentences": list(sentences(found)),
            "material_file": None if self.material_file is None else str(self.material_file),
            "plot_file": None if self.plot_file is None else str(self.plot_file),
            "refused": self.material_refused,
        }


def measured_text(report: MeasuredReport) -> Sequence[RenderableType]:
    """How it was read, the points, the factor, and what that says."""
    found = report.found
    lines: list[RenderableType] = [Text(f"read: {each}") for each in found.measured.reading.notes]
    lines += [Text(f"model: {each}") for each in found.model.notes]
    lines.append(_table(found))
    if found.factor is not None:
        lines.append(_factor_table(found, found.factor))
    verdict, *others = sentences(found)
    lines.append(Text(verdict, style="bold"))
    lines += [Text(each) for each in others]
    for path, what in ((report.material_file, "material"), (report.plot_file, "plot")):
        if path is not None:
            lines.append(f"{what}: {path}")
    if report.material_refused is not None:
        lines.append(Text(f"REFUSED: {report.material_refused}", style="bold red"))
    return lines


def _table(found: Comparison) -> Table:
    """Points over pressure; of many points some, from the first to the last."""
    measured = found.measured
    title = f"{found.part} and {measured.name}: {measured.quantity.label}"
    table = Table(title=title, title_justify="left", box=SIMPLE)
    fitted = ("fitted", "residual") if found.factor is not None else ("residual",)
    for heading in ("MPa", "measured", "model", "lowest", "highest", *fitted):
        table.add_column(heading, justify="right")
    table.add_column("inside")
    count = measured.value.size
    shown = np.unique(np.linspace(0, count - 1, min(count, MOST_ROWS)).round().astype(int))
    low, high = found.band(found.pressure)
    columns = [measured.value, found.values, low, high]
    if found.factor is not None:
        columns.append(found.fitted_values)
    columns.append(measured.value - found.fitted_values)
    for k in shown:
        inside = ("yes" if found.inside[k] else "no") if found.judged[k] else "–"
        cells = [_shown(float(column[k])) for column in columns]
        table.add_row(f"{measured.pressure[k]:.4g}", *cells, inside)
    return table


def _factor_table(found: Comparison, factor: Factor) -> Table:
    unit, (before, after) = found.measured.quantity.unit, factor.difference
    table = Table(box=SIMPLE, show_header=False)
    low, high = factor.scatter
    rows = {
        "factor on the stiffness": f"{factor.value:.4g}",
        "95 % interval": f"{factor.low:.4g} … {factor.high:.4g}",
        "by the scatter alone": f"{low:.4g} … {high:.4g}",
        "by the model's error": f"± {factor.model_percent:.2g} %",
        "points": f"{factor.points}" + (f", {factor.beyond} beyond" if factor.beyond else ""),
        "mean difference, as designed": f"{_shown(before)} {unit}",
        "mean difference, fitted": f"{_shown(after)} {unit}",
    }
    if factor.offset is not None:
        rows["offset"] = f"{_shown(factor.offset)} {unit}"
    for name, value in rows.items():
        table.add_row(name, Text(value))
    return table


def _shown(value: float) -> str:
    return f"{value:.4g}" if np.isfinite(value) else "–"


def _points(found: Comparison) -> list[dict[str, Any]]:
    measured = found.measured
    low, high = found.band(found.pressure)
    columns: dict[str, Reals] = {
        "pressure_mpa": measured.pressure,
        "measured": measured.value,
        "model": found.values,
        "model_error": found.errors,
        "lowest": low,
        "highest": high,
        "fitted": found.fitted_values,
        "residual": measured.value - found.fitted_values,
    }
    if measured.spread is not None:
        columns["spread"] = measured.spread
    plain = {name: [_plain(float(each)) for each in values] for name, values in columns.items()}
    used = [bool(each) for each in found.fitted.used]
    inside = [bool(each) for each in found.inside]
    rows = zip(*plain.values(), used, inside, strict=True)
    return [
        dict(zip((*plain, "tells_the_factor", "inside_band"), row, strict=True)) for row in rows
    ]


def _plain(value: float) -> float | None:
    return value if np.isfinite(value) else None


def _factor(factor: Factor) -> dict[str, Any]:
    before, after = factor.difference
    return {
        "value": factor.value,
        "low": factor.low,
        "high": factor.high,
        "agrees": factor.agrees,
        "low_by_scatter": factor.scatter[0],
        "high_by_scatter": factor.scatter[1],
        "model_error_percent": factor.model_percent,
        "offset": factor.offset,
        "points": factor.points,
        "points_beyond": factor.beyond,
        "mean_difference_as_designed": _plain(before),
        "mean_difference_fitted": _plain(after),
    }


def _departure(each: dict[str, float]) -> dict[str, float]:
    return {
        "from_mpa": each["start"],
        "to_mpa": each["end"],
        "largest": each["largest"],
        "largest_at_mpa": each["pressure"],
    }
