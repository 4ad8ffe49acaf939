"""Indents as a picture: change of stress over change of angle, and the front."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from bellows_design.reports.plots import COLOURS, two_axes

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from bellows_design.study.indent.search import IndentStudy
    from bellows_design.study.indent.trial import Trial

KINDS = (("outside", "arc"), ("outside", "rectangular"), ("inside", "rectangular"))
MARKERS = ("o", "s", "^")


def plot_indents(study: IndentStudy, path: Path) -> None:
    """Every trial and the front on the left; stress over the indent's depth on the right.

    As PNG, written completely or not at all. Raises ``DesignError`` without matplotlib.
    """
    title = f"Indents in the bottom wall of {study.design.name}, against none"
    with two_axes(title, path) as (left, right):
        _kinds(left, study.trials, "angle")
        _kinds(right, study.trials, "depth")
        front, paper = study.front, study.in_the_paper
        left.plot(*_points(front), "-", color="black", linewidth=1, label="front")
        left.plot(
            paper.bending_angle_percent, paper.max_von_mises_percent, "*", color="black",
            markersize=14, label="the paper’s indent",
        )  # fmt: skip
        left.plot(0, 0, "+", color="black", markersize=12, label="no indent")
        left.set(xlabel="change of the bending angle, %", ylabel="change of the highest stress, %")
        right.set(xlabel="depth of the indent, mm", ylabel="change of the highest stress, %")
        left.legend(fontsize=8)


def _points(trials: Sequence[Trial]) -> tuple[list[float], list[float]]:
    changes = [trial.changes for trial in trials]
    return (
        [each.bending_angle_percent for each in changes],
        [each.max_von_mises_percent for each in changes],
    )


def _kinds(axes: Axes, trials: Sequence[Trial], over: str) -> None:
    """Each kind with a colour and a marker of its own."""
    axes.grid(True, linewidth=0.4, alpha=0.4)
    for (side, shape), marker, colour in zip(KINDS, MARKERS, COLOURS, strict=False):
        own = [
            trial
            for trial in trials
            if trial.indent is not None and (trial.indent.side, trial.indent.shape) == (side, shape)
        ]
        angle, stress = _points(own)
        x = angle if over == "angle" else [trial.indent.depth for trial in own if trial.indent]
        axes.plot(x, stress, marker, color=colour, alpha=0.7, label=f"{shape}, {side}")
