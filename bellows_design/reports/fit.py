"""A fit as plain values for programs and as a table for people."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from rich.box import SIMPLE
from rich.console import RenderableType
from rich.table import Table
from rich.text import Text

from bellows_design.materials.fitting.fit_result import Choice, Constant, Fit
from bellows_design.materials.fitting.initial_modulus import initial_modulus
from bellows_design.materials.material import Material
from bellows_design.materials.measurements.points import Measurements
from bellows_design.reports.fit_notes import fit_notes, material_notes
from solver.material.stability import StableRange


@dataclass(frozen=True)
class FitReport:
    """A fit, the measurements it was made of, and what was written of it.

    ``requested`` is the model that was asked for; ``refused`` says why the fit is no material, None
    if it can be one; the files are None where none was asked for; ``material`` is what was written.
    """

    data: Measurements
    requested: str
    choice: Choice
    refused: str | None = None
    material_file: Path | None = None
    plot_file: Path | None = None
    material: Material | None = None

    @property
    def fit(self) -> Fit:
        """The fit that answers."""
        return self.choice.fit

    @property
    def notes(self) -> tuple[str, ...]:
        """Sentences on what the fit leaves open."""
        notes = fit_notes(self.data, self.choice)
        return (
            notes if self.material is None else (*notes, *material_notes(self.data, self.material))
        )

    def to_dict(self) -> dict[str, Any]:
        """Plain values for JSON: stresses in MPa, stretches and strains without unit."""
        fit, other = self.fit, self.choice.by_criterion
        return {
            "data": self.data.name,
            "reading": _reading(self.data),
            "requested": self.requested,
            "model": fit.model,
            "points": fit.points,
            "tests": {mode: _test(self.data, mode) for mode in self.data.modes},
            "mu_mpa": list(fit.mu),
            "alpha": list(fit.alpha),
            "higher_mpa": list(fit.higher),
            "shear_modulus_mpa": fit.stability.shear_modulus,
            "constants": [_constant(constant) for constant in fit.constants],
            "r_squared": fit.r_squared,
            "relative_error_percent": 100 * fit.relative_error,
            "initial_shear_modulus_of_tests_mpa": _initial_modulus(self.data),
            "largest_error": {
                "error_mpa": fit.misfit.error,
                "test": fit.misfit.mode,
                "stretch": fit.misfit.stretch,
            },
            "aicc": fit.aicc,
            "stable": fit.stable,
            "determined": fit.determined,
            "unique": fit.unique,
            "valid_strain": list(self.data.valid_strain),
            "stable_stretch": {each.mode: _range(each) for each in fit.stability.ranges},
            "by_criterion": None if other is None else other.model,
            "tried": [_summary(each) for each in self.choice.tried],
            "notes": list(self.notes),
            "material_file": None if self.material_file is None else str(self.material_file),
            "plot_file": None if self.plot_file is None else str(self.plot_file),
            "refused": self.refused,
        }


def fit_table(report: FitReport) -> Sequence[RenderableType]:
    """Constants with intervals, quality, ranges, the models tried, and the notes."""
    reading = report.data.reading
    lines: list[RenderableType] = [Text(f"read: {note}") for note in reading.notes]
    lines += [Text(f"hint: {hint}", style="yellow") for hint in reading.hints]
    lines += [_constants_table(report), _quality_table(report)]
    if len(report.choice.tried) > 1:
        lines.append(_tried_table(report.choice))
    lines += [Text(f"note: {note}", style="yellow") for note in report.notes]
    for path, what in ((report.material_file, "material"), (report.plot_file, "plot")):
        if path is not None:
            lines.append(f"{what}: {path}")
    if report.refused is not None:
        lines.append(Text(f"REFUSED: {report.refused}", style="bold red"))
    return lines


def _constants_table(report: FitReport) -> Table:
    title = f"{report.data.name}: {report.fit.model}"
    table = Table(title=title, title_justify="left", box=SIMPLE)
    table.add_column("constant")
    for heading in ("value", "standard error", "95 % interval"):
        table.add_column(heading, justify="right")
    for each in report.fit.constants:
        name = f"{each.name}, MPa" if each.unit else each.name
        if each.fixed:
            table.add_row(name, f"{each.value:g}", "given", "–")
            continue
        interval = f"{each.low:.4g} … {each.high:.4g}"
        table.add_row(name, f"{each.value:.5g}", f"{each.standard_error:.2g}", interval)
    return table


def _quality_table(report: FitReport) -> Table:
    fit, data = report.fit, report.data
    low, high = data.valid_strain
    rows = {
        "initial shear modulus": f"{fit.stability.shear_modulus:.4g} MPa",
        "R²": f"{fit.r_squared:.6f}",
        "relative error (rms)": f"{100 * fit.relative_error:.2g} %",
        "largest error": f"{fit.misfit.error:.3g} MPa, {fit.misfit.mode} at stretch "
        f"{fit.misfit.stretch:.4g}",
        "points": ", ".join(_points(data, mode) for mode in data.modes),
        "fitted range": f"principal strains {100 * low:.0f} … {100 * high:.0f} %",
    }
    rows |= {f"stable, {each.mode}": _stretches(each) for each in fit.stability.ranges}
    table = Table(box=SIMPLE, show_header=False)
    for name, value in rows.items():
        table.add_row(name, Text(value))
    return table


def _points(data: Measurements, mode: str) -> str:
    stretch, _ = data.of(mode)
    return f"{stretch.size} {mode} (stretch {stretch.min():.4g} … {stretch.max():.4g})"


def _stretches(stable: StableRange) -> str:
    text = f"stretch {stable.lowest:.3g} … {stable.highest:.3g}"
    return f"{text} (no end found)" if stable.complete else text


def _tried_table(choice: Choice) -> Table:
    table = Table(title="models tried", title_justify="left", box=SIMPLE)
    table.add_column("model")
    for heading in ("constants", "error, %", "R²", "AICc", "stable", "determined"):
        table.add_column(heading, justify="right")
    for each in choice.tried:
        table.add_row(
            Text(each.model, style="bold" if each.model == choice.fit.model else ""),
            str(each.free_constants),
            f"{100 * each.relative_error:.2g}",
            f"{each.r_squared:.5f}",
            f"{each.aicc:.1f}",
            "yes" if each.stable else "no",
            "yes" if each.determined else "no",
        )
    return table


def _test(data: Measurements, mode: str) -> dict[str, Any]:
    stretch, stress = data.of(mode)
    low, high = float(stretch.min()), float(stretch.max())
    return {
        "points": int(stretch.size),
        "stretch": [low, high],
        "strain": [low - 1, high - 1],
        "largest_stress_mpa": float(abs(stress).max()),
        "spread_mpa": _spread(data, mode),
    }


def _spread(data: Measurements, mode: str) -> float | None:
    """Median standard deviation of the specimens of a test, MPa; None where it has only one."""
    spread = None if data.spread is None else data.spread[data.chosen(mode)]
    return float(np.median(spread)) if spread is not None and spread.any() else None


def _reading(data: Measurements) -> dict[str, Any]:
    return {"notes": list(data.reading.notes), "hints": list(data.reading.hints)}


def _initial_modulus(data: Measurements) -> float | None:
    start = initial_modulus(data)
    return None if start is None else start.value


def _constant(constant: Constant) -> dict[str, Any]:
    return {
        "name": constant.name,
        "unit": constant.unit,
        "value": constant.value,
        "standard_error": constant.standard_error,
        "low": constant.low,
        "high": constant.high,
        "fixed": constant.fixed,
        "determined": constant.determined,
    }


def _range(stable: StableRange) -> dict[str, Any]:
    return {
        "lowest": stable.lowest,
        "highest": stable.highest,
        "complete": stable.complete,
        "load_rises_to": stable.load_rises_to,
    }


def _summary(fit: Fit) -> dict[str, Any]:
    return {
        "model": fit.model,
        "constants": fit.free_constants,
        "relative_error_percent": 100 * fit.relative_error,
        "r_squared": fit.r_squared,
        "aicc": fit.aicc,
        "stable": fit.stable,
        "determined": fit.determined,
    }
