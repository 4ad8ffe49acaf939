"""Elasticities as a tornado plot."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from bellows_design.neighbours.sensitivities import ANGLE, STRESS
from bellows_design.reports.plots import COLOURS, two_axes

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from bellows_design.neighbours.sensitivities import Sensitivity
    from bellows_design.study.sensitivity.study import Study

WITHOUT_EFFECT = 5e-4
"""Elasticities below this, which show as 0.000, have no bar."""


def plot_sensitivity(study: Study, path: Path) -> None:
    """Elasticities of angle and highest stress, each with its strongest parameter on top, as PNG.

    Written completely or not at all. Raises ``DesignError`` without matplotlib.
    """
    found, design = study.sensitivities, study.evaluation.design
    title = f"{design.name} under {design.load.pressure:g} MPa: % per % of each parameter"
    with two_axes(title, path) as (left, right):
        _draw(left, found.parameters, ANGLE, "bending angle")
        _draw(right, found.parameters, STRESS, "highest von Mises stress")


def _draw(axes: Axes, rows: Sequence[Sensitivity], response: str, title: str) -> None:
    """A bar for each parameter, upwards in one colour, downwards in another."""
    bars = [(each.elasticities[response] or 0.0, each.parameter) for each in rows]
    bars = [bar for bar in bars if abs(bar[0]) >= WITHOUT_EFFECT]
    bars.sort(key=lambda bar: abs(bar[0]), reverse=True)
    values = [value for value, _ in bars]
    colours = [COLOURS[0] if value > 0 else COLOURS[1] for value in values]
    drawn = axes.barh(range(len(bars)), values, color=colours)
    axes.bar_label(drawn, fmt="%+.3f", padding=3, fontsize=8)
    axes.set_yticks(range(len(bars)), [name for _, name in bars])
    axes.set(title=title, xlabel="elasticity")
    axes.axvline(0, color="black", linewidth=0.8)
    axes.grid(True, axis="x", linewidth=0.4, alpha=0.4)
    axes.set_axisbelow(True)
    axes.margins(x=0.2)
    axes.invert_yaxis()
