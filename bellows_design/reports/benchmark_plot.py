"""A benchmark as a picture: error over seconds."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from bellows_design.reports.plots import COLOURS, two_axes

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from bellows_design.benchmark.study import Study


def plot_benchmark(study: Study, path: Path) -> None:
    """Error over seconds, for angle and stress, as PNG; written completely or not at all.

    Raises ``DesignError`` without matplotlib.
    """
    title = f"{study.design.name} under {study.design.load.pressure:g} MPa"
    with two_axes(title, path) as (left, right):
        _draw(left, study, "bending_angle_percent", "error of the bending angle, %")
        _draw(right, study, "max_von_mises_percent", "error of the highest von Mises stress, %")


def _draw(axes: Axes, study: Study, error: str, label: str) -> None:
    """One line for each model, with the number of elements at each point."""
    axes.set(xscale="log", yscale="log", xlabel="seconds so far, warm process", ylabel=label)
    axes.grid(True, which="both", linewidth=0.4, alpha=0.4)
    for number, series in enumerate(study.series):
        values = [getattr(errors, error) for errors in series.errors]
        known = [pair for pair in zip(series.levels, values, strict=True) if pair[1]]
        points = [(level.so_far.total, value) for level, value in known]
        colour = COLOURS[number % len(COLOURS)]
        x, y = [point[0] for point in points], [point[1] for point in points]
        axes.plot(x, y, "o-", color=colour, label=series.model)
        for (level, _), point in zip(known, points, strict=True):
            _label(axes, str(level.work.elements), point, colour)
    axes.margins(0.15)
    _plain_numbers(axes)
    axes.legend(title="model, with tetrahedra")


def _label(axes: Axes, text: str, point: tuple[float, float], colour: str) -> None:
    """Small, beside its point."""
    axes.annotate(text, point, xytext=(5, 5), textcoords="offset points", fontsize=8, color=colour)


def _plain_numbers(axes: Axes) -> None:
    """0.5, 1, 2, 5 instead of powers of ten."""
    from matplotlib.ticker import LogLocator, NullFormatter

    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_locator(LogLocator(subs=(1, 2, 5)))
        axis.set_major_formatter("{x:g}")
        axis.set_minor_formatter(NullFormatter())
