"""The paper's designs beside ours as a picture."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from bellows_design.reports.plots import COLOURS, two_axes

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from bellows_design.study.comparison import Comparison


def plot_paper(comparison: Comparison, path: Path) -> None:
    """Angles and stresses, the paper's and ours with estimated errors, as PNG.

    Written completely or not at all. Raises ``DesignError`` without matplotlib.
    """
    rows = comparison.rows
    with two_axes("Ćurković & Jambrečić (2020), Table 4, under 0.1 MPa", path) as (left, right):
        _draw(
            left,
            [row.result.bending_angle_deg for row in rows],
            [row.evaluation.bending_angle_deg for row in rows],
            [row.evaluation.error_estimate.bending_angle_percent for row in rows],
        )
        _draw(
            right,
            [row.result.max_stress_mpa for row in rows],
            [row.evaluation.max_von_mises_mpa for row in rows],
            [row.evaluation.error_estimate.max_von_mises_percent for row in rows],
        )
        left.set(xlabel="bending angle, °")
        left.set_yticks(range(len(rows)), [row.result.label for row in rows])
        right.set(xlabel="highest von Mises stress, MPa")
        right.set_yticks(range(len(rows)), [""] * len(rows))
        left.legend(loc="upper right")


def _draw(
    axes: Axes,
    printed: Sequence[float],
    ours: Sequence[float],
    percents: Sequence[float | None],
) -> None:
    """A line for each design, the first on top; a bar of the estimated error about ours."""
    places = range(len(printed))
    pairs = zip(ours, percents, strict=True)
    bars = [value * (percent or 0.0) / 100 for value, percent in pairs]
    axes.plot(printed, places, "D", color=COLOURS[1], label="paper")
    axes.errorbar(
        ours, places, xerr=bars, fmt="o", capsize=3, color=COLOURS[0], label="ours, ± estimate"
    )
    axes.grid(True, linewidth=0.4, alpha=0.4)
    axes.set_xlim(left=0)
    axes.invert_yaxis()
