"""Charts and drawings by matplotlib: the same records as on the page."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bellows_design.reports.page.curves.chart import BarChart, Chart
from bellows_design.reports.page.drawing.marks import Area, Dot, Drawing, Line, Text

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.patches import PathPatch

SERIES = ("#0b62a8", "#c2570c", "#17805b", "#a13d88")
RED, INK, MUTED = "#b3261e", "#1a222b", "#55616e"

FILLS = {
    "material": ("#c7d9e8", INK),
    "arrow": (MUTED, "none"),
    "object": ("#d5dbe1", MUTED),
    "pad": ("#9cc0de", "none"),
}
LINES = {"finger": (SERIES[0], "-"), "frame": (SERIES[1], "--"), "hidden": (MUTED, "--")}
DOTS = {"mark-fail": RED, "mark-warn": "#7a4b00", "mark-info": SERIES[0], "mark-pass": "#17683a"}


def draw(axes: Axes, content: Chart | BarChart | Drawing) -> None:
    """Whatever a picture of the report holds."""
    if isinstance(content, Drawing):
        _drawing(axes, content)
    elif isinstance(content, BarChart):
        _bars(axes, content)
    else:
        _chart(axes, content)


def _chart(axes: Axes, chart: Chart) -> None:
    for line, colour in zip(chart.lines, SERIES, strict=False):
        if len(line.low):
            axes.fill_between(line.x, line.low, line.high, color=colour, alpha=0.2, linewidth=0)
        style = "--" if line.dashed else "-"
        marker = "o" if line.points else ""
        axes.plot(
            line.x, line.y, style, marker=marker, markersize=3.5, color=colour, label=line.name
        )
    for low, high in chart.shaded:
        axes.axvspan(low, high, color="#e9edf1", zorder=0)
    _limits(axes, chart)
    middle = sum(axes.get_xlim()) / 2
    for mark in chart.marks:
        left = mark.x < middle
        axes.plot([mark.x], [mark.y], "o", color=SERIES[0], markeredgecolor=INK)
        axes.annotate(
            mark.text, (mark.x, mark.y), (7, -9) if left else (-6, 7), textcoords="offset points",
            ha="left" if left else "right", fontsize=8, parse_math=False,
        )  # fmt: skip
    axes.set_xlabel(chart.x_label, fontsize=8)
    axes.set_ylabel(chart.y_label, fontsize=8)
    axes.set_title(chart.title, fontsize=9, parse_math=False)
    axes.tick_params(labelsize=8)
    axes.grid(True, linewidth=0.4, alpha=0.4)
    if chart.y_bounds is not None:
        axes.set_ylim(*chart.y_bounds)
    if len(chart.lines) > 1:
        axes.legend(fontsize=8)


def _limits(axes: Axes, chart: Chart) -> None:
    for limit in chart.limits:
        across = axes.axhline if limit.axis == "y" else axes.axvline
        across(limit.value, color=RED, linestyle="--", linewidth=1.2)
        place = (0.02, limit.value) if limit.axis == "y" else (limit.value, 0.98)
        transform = axes.get_yaxis_transform() if limit.axis == "y" else axes.get_xaxis_transform()
        side = "bottom" if limit.axis == "y" else "top"
        axes.text(
            *place, limit.text, color=RED, fontsize=8, transform=transform, va=side,
            ha="left" if limit.axis == "y" else "right", parse_math=False,
        )  # fmt: skip


def _bars(axes: Axes, chart: BarChart) -> None:
    names = [bar.name for bar in chart.bars]
    values = [bar.value for bar in chart.bars]
    colours = [SERIES[0] if value >= 0 else SERIES[1] for value in values]
    axes.barh(names, values, color=colours)
    axes.invert_yaxis()
    axes.axvline(0, color=INK, linewidth=0.8)
    axes.set_xlabel(chart.label, fontsize=8)
    axes.set_title(chart.title, fontsize=9)
    axes.tick_params(labelsize=7)


def _drawing(axes: Axes, drawing: Drawing) -> None:
    """Pixels as they are, y down."""
    from matplotlib.patches import Rectangle

    box = None
    if drawing.clip is not None:
        left, top, right, bottom = drawing.clip
        box = Rectangle((left, top), right - left, bottom - top, transform=axes.transData)
    for mark in drawing.marks:
        match mark:
            case Area():
                patch = _area(axes, mark)
                if box is not None and mark.kind == "material":
                    patch.set_clip_path(box)
            case Line(points, kind, strength):
                colour, style = LINES.get(kind, (MUTED, "-"))
                width = 1.6 if kind == "finger" else 0.5
                axes.plot(
                    *zip(*points, strict=True), style, color=colour, linewidth=width, alpha=strength
                )
            case Dot((x, y), radius, kind):
                axes.plot([x], [y], "o", markersize=radius, color=DOTS.get(kind, SERIES[1]))
            case Text():
                _text(axes, mark)
    axes.set_xlim(0, drawing.width)
    axes.set_ylim(drawing.height, 0)
    axes.set_aspect("equal")
    axes.axis("off")
    axes.set_title(drawing.title, fontsize=9, parse_math=False)


def _area(axes: Axes, area: Area) -> PathPatch:
    """Loops with their holes, as one path of the even-odd kind would fill them."""
    import numpy as np
    from matplotlib.patches import PathPatch
    from matplotlib.path import Path

    points, codes = [], []
    for loop in _turned(area.loops):
        points += [*loop, loop[0]]
        codes += [Path.MOVETO, *([Path.LINETO] * (len(loop) - 1)), Path.CLOSEPOLY]
    fill, edge = FILLS.get(area.kind, ("#c7d9e8", INK))
    patch = PathPatch(Path(np.array(points), codes), facecolor=fill, edgecolor=edge, linewidth=0.6)
    axes.add_patch(patch)
    return patch


def _turned(loops: tuple[tuple[tuple[float, float], ...], ...]) -> list[list[tuple[float, float]]]:
    """The largest loop one way round, all others the other way, so that they are holes in it."""
    ordered = sorted(loops, key=lambda loop: -abs(_area_of(loop)))
    found = []
    for number, loop in enumerate(ordered):
        forward = _area_of(loop) > 0
        found.append(list(loop) if forward == (number == 0) else list(reversed(loop)))
    return found


def _area_of(loop: tuple[tuple[float, float], ...]) -> float:
    following = (*loop[1:], loop[0])
    return sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(loop, following, strict=True)) / 2


def _text(axes: Axes, text: Text) -> None:
    across = {"start": "left", "middle": "center", "end": "right"}[text.anchor]
    turned = text.turned
    axes.text(
        *text.place, text.text, fontsize=5.5, color=INK, rotation=90 if turned else 0,
        ha="right" if turned else across, va="center" if turned else "baseline", parse_math=False,
    )  # fmt: skip
