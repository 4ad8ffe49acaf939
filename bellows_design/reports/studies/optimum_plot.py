"""The front of an optimization as a picture."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

from bellows_design.reports.plots import COLOURS, one_axes

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from bellows_design.study.optimize.point import Point
    from bellows_design.study.optimize.run import Optimum


def plot_optimum(optimum: Optimum, path: Path) -> None:
    """Angle over stress of all designs evaluated, and the front, as PNG.

    Written completely or not at all. Raises ``DesignError`` without matplotlib.
    """
    base = optimum.optimization.base
    with one_axes(f"{base.name}: angle against stress at {base.load.pressure:g} MPa", path) as axes:
        _dots(axes, (p for p in optimum.points if not p.ordinary), "neighbours", COLOURS[3])
        _dots(axes, (p for p in optimum.points if p.ordinary), "by themselves", COLOURS[0])
        _front(axes, optimum)
        limit = optimum.optimization.goal.most_stress_mpa
        axes.axvline(limit, color="0.4", linestyle="--", linewidth=1)
        axes.annotate("limit", (limit, 0.02), xycoords=("data", "axes fraction"), color="0.4")
        axes.set(xlabel="highest von Mises stress, MPa", ylabel="bending angle, °")
        axes.set_xlim(0, 1.4 * limit)
        axes.grid(True, linewidth=0.4, alpha=0.4)
        axes.legend(loc="upper left")


def _dots(axes: Axes, points: Iterable[Point], label: str, colour: str) -> None:
    pairs = [(point.values["stress"], point.values["angle"]) for point in points]
    if pairs:
        axes.plot(*zip(*pairs, strict=True), ".", markersize=4, color=colour, label=label)


def _front(axes: Axes, optimum: Optimum) -> None:
    found = optimum.front
    stresses = [point.values["stress"] for point in found]
    errors = [
        point.values["stress"] * (point.answer.max_von_mises_error_percent or 0) / 100
        for point in found
    ]
    axes.errorbar(
        stresses,
        [point.values["angle"] for point in found],
        xerr=errors,
        fmt="o-",
        capsize=3,
        markersize=4,
        color=COLOURS[1],
        label="front, ± estimate",
    )
