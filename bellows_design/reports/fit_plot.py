"""A fit drawn over its measurements."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from bellows_design.materials.fitting.fit_result import Fit
from bellows_design.materials.measurements.points import Measurements
from bellows_design.reports.plots import COLOURS, two_axes
from solver.material.homogeneous import MODES, nominal_stress

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def plot_fit(data: Measurements, fit: Fit, path: Path) -> None:
    """Stress over stretch, and the errors, as PNG; written completely or not at all.

    Raises ``DesignError`` without matplotlib.
    """
    title = f"{data.name}: {fit.model}, R² = {fit.r_squared:.5f}"
    with two_axes(title, path) as (left, right):
        _draw_stress(left, data, fit)
        _draw_errors(right, data, fit)


def _draw_stress(axes: Axes, data: Measurements, fit: Fit) -> None:
    """Points and curves of the tests; dashed, the curves of those that were not made.

    Bands are the standard deviation of specimens.
    """
    first, last = min(1.0, data.stretch.min()), max(1.0, data.stretch.max())
    for (name, mode), colour in zip(MODES.items(), COLOURS, strict=False):
        stretch, stress = data.of(name)
        ends = (stretch.min(), stretch.max()) if stretch.size else (first, last)
        line = np.linspace(min(1.0, ends[0]), max(1.0, ends[1]), 200)
        style = "-" if stretch.size else "--"
        label = name if stretch.size else f"{name}, not measured"
        axes.plot(stretch, stress, "o", markersize=4, alpha=0.5, color=colour)
        if data.spread is not None and stretch.size:
            spread = data.spread[data.chosen(name)]
            order = np.argsort(stretch)
            low, high = (stress - spread)[order], (stress + spread)[order]
            axes.fill_between(stretch[order], low, high, alpha=0.15, color=colour, linewidth=0)
        axes.plot(
            line,
            nominal_stress(mode, line, fit.law),
            style,
            color=colour,
            label=label,
        )
    reach = 1.15 * np.abs(data.stress).max()
    axes.set(xlabel="stretch", ylabel="nominal stress, MPa")
    axes.set_ylim(-reach if data.stress.min() < -0.05 * reach else -0.02 * reach, None)
    axes.set_ylim(top=reach if data.stress.max() > 0.05 * reach else 0.02 * reach)
    axes.grid(True, linewidth=0.4, alpha=0.4)
    axes.legend()


def _draw_errors(axes: Axes, data: Measurements, fit: Fit) -> None:
    """Model less measurement, MPa."""
    for (name, mode), colour in zip(MODES.items(), COLOURS, strict=False):
        stretch, stress = data.of(name)
        if stretch.size:
            error = nominal_stress(mode, stretch, fit.law) - stress
            axes.plot(stretch, error, "o", markersize=4, color=colour, label=name)
    axes.axhline(0, color="black", linewidth=0.8)
    axes.set(xlabel="stretch", ylabel="residual: model less measurement, MPa")
    axes.grid(True, linewidth=0.4, alpha=0.4)
