"""Indents as a picture: change of stress over change of angle, and the front."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from bellows_design.reports.plots import COLOURS, two_axes

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from bellows_design.study.indent.search import IndentStudy
    from bellows_design.study.indent.trial import Trial

KINDS = (("outside", "arc"), ("outside", "rectangular"), ("inside", "rectangular"))
MARKERS = ("o", "s", "^")
SMALL: dict[str, Any] = {"markersize": 4, "alpha": 0.5}
LARGE: dict[str, Any] = {"markersize": 8, "markeredgecolor": "black"}


def plot_indents(study: IndentStudy, path: Path, verified: Sequence[Trial] = ()) -> None:
    """Every trial and the front on the left; stress over the indent's depth on the right.

    Where some are ``verified`` on finer meshes, these are drawn larger, and the front is theirs. As
    PNG, written completely or not at all. Raises ``DesignError`` without matplotlib.
    """
    title = f"Indents in the bottom wall of {study.design.name}, against none"
    best = study.front_of(verified) if verified else study.front
    with two_axes(title, path) as (left, right):
        for axes, over in ((left, _angle), (right, _depth)):
            _kinds(axes, study.trials, over, large=False)
            _kinds(axes, verified, over, large=True)
            axes.set(ylabel="change of the highest stress, %")
            axes.grid(True, linewidth=0.4, alpha=0.4)
        left.plot([_angle(trial) for trial in best], _stresses(best), "k.-", lw=1, label="front")
        reported = study.in_the_paper
        left.plot(
            reported.bending_angle_percent, reported.max_von_mises_percent, "k*", markersize=14,
            label="the paper’s indent",
        )  # fmt: skip
        left.plot(0, 0, "k+", markersize=12, label="no indent")
        left.set(xlabel="change of the bending angle, %")
        right.set(xlabel="depth of the indent, mm")
        left.legend(fontsize=8)


def _angle(trial: Trial) -> float:
    return trial.changes.bending_angle_percent


def _depth(trial: Trial) -> float:
    return 0.0 if trial.indent is None else trial.indent.depth


def _stresses(trials: Sequence[Trial]) -> list[float]:
    return [trial.changes.max_von_mises_percent for trial in trials]


def _kinds(
    axes: Axes, trials: Sequence[Trial], over: Callable[[Trial], float], large: bool
) -> None:
    """Each kind with a colour and a marker of its own; large ones with a black edge."""
    for kind, marker, colour in zip(KINDS, MARKERS, COLOURS, strict=False):
        own = [
            trial
            for trial in trials
            if trial.indent is not None and (trial.indent.side, trial.indent.shape) == kind
        ]
        look = LARGE if large else SMALL
        name = f"verified: {', '.join(kind)}" if large else ", ".join(kind)
        if own:
            places = [over(trial) for trial in own]
            axes.plot(places, _stresses(own), marker, color=colour, label=name, **look)
