"""Force over pressure and over distance, with the band of its estimated error."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from bellows_design.reports.plots import COLOURS, one_axes, two_axes

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from bellows_design.force.result import ForceCurve, ForceReading

ROOM = 1.4
"""Of the highest force: as far as a plot reaches."""

Abscissa = Callable[["ForceReading"], float]


def plot_force(found: ForceCurve, path: Path) -> None:
    """Both curves, or that over pressure alone where there is no other, as PNG.

    Written completely or not at all. Raises ``DesignError`` without matplotlib.
    """
    title = f"{found.design.name}: {found.scene}"
    if not found.by_distance:
        with one_axes(title, path) as axes:
            _over_pressure(axes, found)
        return
    with two_axes(title, path) as (left, right):
        _over_pressure(left, found)
        _draw(right, found.by_distance, lambda each: each.distance_mm or 0.0)
        right.set(
            xlabel=f"distance of the support, mm, at {found.last.pressure_mpa:g} MPa",
            ylabel="force, N",
        )


def _over_pressure(axes: Axes, found: ForceCurve) -> None:
    _draw(axes, found.curve, lambda each: each.pressure_mpa)
    axes.set(xlabel="pressure, MPa", ylabel="force, N")


def _share(reading: ForceReading) -> float:
    """The error by the force; where a tip snaps away it grows without bound."""
    return 0.0 if reading.error is None else min(1.0, reading.error.total / 100)


def _draw(axes: Axes, readings: Sequence[ForceReading], abscissa: Abscissa) -> None:
    """The curve, its band, and marks where neighbouring bubbles touch."""
    across = [abscissa(each) for each in readings]
    forces = [each.force_n for each in readings]
    errors = [each.force_n * _share(each) for each in readings]
    low = [force - error for force, error in zip(forces, errors, strict=True)]
    high = [force + error for force, error in zip(forces, errors, strict=True)]
    axes.fill_between(
        across, low, high, alpha=0.2, color=COLOURS[0], linewidth=0, label="± estimate"
    )
    axes.plot(across, forces, "o-", markersize=4, color=COLOURS[0], label="force")
    touching = [(x, each.force_n) for x, each in zip(across, readings, strict=True) if each.contact]
    if touching:
        axes.plot(
            *zip(*touching, strict=True), "o", markersize=5, color=COLOURS[1],
            label="neighbouring bubbles touch",
        )  # fmt: skip
    axes.set_ylim(0.0, ROOM * max(forces) or 1.0)
    axes.grid(True, linewidth=0.4, alpha=0.4)
    axes.legend()
