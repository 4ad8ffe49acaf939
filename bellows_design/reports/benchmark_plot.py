"""Pictures of results, with matplotlib from the extra ``pictures``."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

from bellows_design.errors import DesignError
from bellows_design.files.atomic import replacing

if TYPE_CHECKING:
    from matplotlib.axes import Axes

COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7")
"""Told apart by colour-blind people too (Okabe and Ito)."""


def require_matplotlib() -> None:
    """Raise ``DesignError`` if it is not installed. Imports nothing."""
    if find_spec("matplotlib") is None:
        raise DesignError(
            "a plot needs matplotlib, which comes with the extra “pictures”: "
            "pip install -e '.[pictures]'."
        )


def plot_benchmark(benchmark: Mapping[str, Any], path: Path) -> None:
    """Error over seconds, for angle and stress, as PNG; written completely or not at all.

    ``benchmark`` is what ``Study.to_dict`` gives. Raises ``DesignError`` without matplotlib.
    """
    require_matplotlib()
    from matplotlib.figure import Figure

    figure = Figure(figsize=(11, 4.8), layout="constrained")
    figure.suptitle(f"{benchmark['design']} under {benchmark['pressure_mpa']:g} MPa")
    left, right = figure.subplots(1, 2)
    _draw(left, benchmark["models"], "bending_angle", "error of the bending angle, %")
    _draw(right, benchmark["models"], "max_von_mises", "error of the highest von Mises stress, %")
    with replacing(path) as temporary:
        figure.savefig(temporary, dpi=130, format="png")


def _draw(axes: Axes, models: Sequence[Mapping[str, Any]], key: str, label: str) -> None:
    """One line for each model, with the number of elements at each point."""
    axes.set(xscale="log", yscale="log", xlabel="seconds so far, warm process", ylabel=label)
    axes.grid(True, which="both", linewidth=0.4, alpha=0.4)
    for number, model in enumerate(models):
        known = [mesh for mesh in model["meshes"] if mesh["error"][f"{key}_percent"]]
        seconds = [mesh["seconds_so_far"]["total"] for mesh in known]
        errors = [mesh["error"][f"{key}_percent"] for mesh in known]
        colour = COLOURS[number % len(COLOURS)]
        axes.plot(seconds, errors, "o-", color=colour, label=model["model"])
        for mesh, x, y in zip(known, seconds, errors, strict=True):
            _label(axes, str(mesh["elements"]), (x, y), colour)
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
