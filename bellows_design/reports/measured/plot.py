"""A measured curve over the model's, with bands, and what is left of it."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from bellows_design.measured.comparison import Comparison
from bellows_design.reports.plots import COLOURS, two_axes

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from solver.arrays import Reals

DESIGNED, FITTED, MEASURED = COLOURS[0], COLOURS[2], COLOURS[1]


def plot_measured(found: Comparison, path: Path) -> None:
    """Curves and residuals over pressure as PNG; written completely or not at all.

    Raises ``DesignError`` without matplotlib.
    """
    factor = found.factor
    title = f"{found.part} and {found.measured.name}"
    if factor is not None:
        title += f": {factor.value:.3g} times as stiff ({factor.low:.3g} to {factor.high:.3g})"
    with two_axes(title, path) as (left, right):
        _draw_curves(left, found)
        _draw_residuals(right, found)


def _draw_curves(axes: Axes, found: Comparison) -> None:
    start = 0.0 if found.zero_at is None else min(found.zero_at, float(found.pressure[0]))
    line = np.linspace(start, float(found.pressure.max()), 300)
    _band(axes, line, found.band(line), DESIGNED)
    axes.plot(line, found.model.values(line), color=DESIGNED, label="model as designed, its band")
    if found.factor is not None:
        _band(axes, line, found.fitted_band(line), FITTED)
        shift = found.factor.offset or 0.0
        values = found.model.values(line, found.factor.value) + shift
        axes.plot(line, values, color=FITTED, label="model with the factor, its interval")
    _points(axes, found, found.measured.value)
    axes.set(xlabel=_pressure(found), ylabel=found.measured.quantity.label)
    axes.grid(True, linewidth=0.4, alpha=0.4)
    axes.legend()


def _draw_residuals(axes: Axes, found: Comparison) -> None:
    """Measurement less model: as designed pale, with the factor dark."""
    pressure, value = found.pressure, found.measured.value
    low, high = found.fitted_band(pressure)
    middle = found.fitted_values
    _band(axes, pressure, (low - middle, high - middle), FITTED if found.factor else DESIGNED)
    if found.factor is not None:
        axes.plot(
            pressure, value - found.values, "o", markersize=3, alpha=0.35, color=DESIGNED,
            label="model as designed",
        )  # fmt: skip
    _points(axes, found, value - middle, "model with the factor" if found.factor else "measured")
    for each in found.departures:
        axes.axvspan(each.start, each.end, color="black", alpha=0.06, linewidth=0)
    axes.axhline(0, color="black", linewidth=0.8)
    unit = found.measured.quantity.unit
    axes.set(xlabel=_pressure(found), ylabel=f"measurement less model, {unit}")
    axes.grid(True, linewidth=0.4, alpha=0.4)
    if found.factor is not None:
        axes.legend()


def _band(axes: Axes, pressure: Reals, ends: tuple[Reals, Reals], colour: str) -> None:
    axes.fill_between(pressure, *ends, alpha=0.18, color=colour, linewidth=0)


def _points(axes: Axes, found: Comparison, value: Reals, what: str = "measured") -> None:
    """Measured points; open where they tell nothing of a factor that was fitted."""
    spread, told = found.measured.spread, found.fitted.used
    filled = told if found.factor is not None else np.ones(value.size, bool)
    if spread is not None:
        axes.errorbar(
            found.pressure, value, spread, fmt="none", ecolor=MEASURED, alpha=0.5, linewidth=0.8
        )
    for chosen, face, label in ((filled, MEASURED, what), (~filled, "none", "not used")):
        if chosen.any():
            axes.plot(
                found.pressure[chosen], value[chosen], "o", markersize=4, markeredgecolor=MEASURED,
                markerfacecolor=face, linestyle="none", label=label,
            )  # fmt: skip


def _pressure(found: Comparison) -> str:
    vacuum = bool((found.measured.pressure < 0).any())
    return "vacuum, MPa" if vacuum else "pressure, MPa"
