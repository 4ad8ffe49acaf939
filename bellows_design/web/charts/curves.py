"""Curves with bands of error, and clouds of points, over common axes."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from html import escape

from bellows_design.web.charts.frame import (
    axes,
    keys,
    limit_lines,
    named_points,
    rows_of_keys,
    shades,
)
from bellows_design.web.charts.parts import (
    BOTTOM,
    LEFT,
    LINE_OF_TEXT,
    RIGHT,
    TOP,
    WIDTH,
    Area,
    Limit,
    Line,
    Mark,
    require_pairs,
    runs_of,
    series_class,
)
from bellows_design.web.charts.scales import scale
from bellows_design.web.charts.svg import path, picture, tag


def line_chart(
    lines: Sequence[Line],
    *,
    x_label: str,
    y_label: str,
    title: str,
    description: str = "",
    limits: Sequence[Limit] = (),
    marks: Sequence[Mark] = (),
    shaded: Sequence[tuple[float, float]] = (),
    x_log: bool = False,
    y_log: bool = False,
    x_bounds: tuple[float, float] | None = None,
    y_bounds: tuple[float, float] | None = None,
    y_zero: bool = False,
    height: float = 300.0,
) -> str:
    """Curves over common axes, as `<svg>`.

    Args:
        lines: At most six have a colour of their own.
        x_label: With its unit.
        y_label: With its unit; it stands above the axis.
        title: For those who do not see the chart.
        description: Likewise; what it says. Empty for the range of each curve.
        limits: Drawn across.
        marks: Named points.
        shaded: Ranges of x that are shaded, such as what was tested.
        x_log, y_log: Whether an axis is logarithmic.
        x_bounds, y_bounds: Ends of an axis; None for round numbers about all values.
        y_zero: Whether the y axis begins at zero in any case.
        height: Pixels, at a width of `WIDTH`.

    Raises:
        ChartError: A curve's numbers are not as many of x as of y, or none is finite.
    """
    for line in lines:
        require_pairs(line)
    names = [line.name for line in lines] if len(lines) > 1 else []
    rows = rows_of_keys(names)
    top = TOP + LINE_OF_TEXT * (1 + len(rows)) + 4
    area = Area(
        scale(_xs(lines, limits, marks), LEFT, WIDTH - RIGHT, log=x_log, bounds=x_bounds),
        scale(
            _ys(lines, limits, marks),
            height - BOTTOM,
            top,
            log=y_log,
            bounds=y_bounds,
            with_zero=y_zero,
        ),
        WIDTH,
        height,
    )
    body = [
        *shades(shaded, area),
        *axes(area, x_label, y_label),
        *(_band(line, number, area) for number, line in enumerate(lines)),
        *limit_lines(limits, lines, area),
        *(_curve(line, number, area) for number, line in enumerate(lines)),
        *named_points(marks, area),
        *keys(lines, rows),
    ]
    said = description or _ranges(lines, x_label, y_label)
    return picture(title, said, (area.width, area.height), "".join(body))


def scatter_chart(
    lines: Sequence[Line],
    *,
    x_label: str,
    y_label: str,
    title: str,
    description: str = "",
    limits: Sequence[Limit] = (),
    marks: Sequence[Mark] = (),
    x_log: bool = False,
    y_log: bool = False,
    height: float = 320.0,
) -> str:
    """Points over common axes, as `<svg>`: each `Line` is a cloud, joined if it says so."""
    clouds = [replace(one, points=True) for one in lines]
    return line_chart(
        clouds,
        x_label=x_label,
        y_label=y_label,
        title=title,
        description=description,
        limits=limits,
        marks=marks,
        x_log=x_log,
        y_log=y_log,
        height=height,
    )


def _xs(lines: Sequence[Line], limits: Sequence[Limit], marks: Sequence[Mark]) -> list[float]:
    of_lines = [float(x) for line in lines for x in line.x]
    return [*of_lines, *(at.value for at in limits if at.axis == "x"), *(at.x for at in marks)]


def _ys(lines: Sequence[Line], limits: Sequence[Limit], marks: Sequence[Mark]) -> list[float]:
    of_lines = [float(y) for line in lines for y in (*line.y, *line.low, *line.high)]
    return [*of_lines, *(at.value for at in limits if at.axis == "y"), *(at.y for at in marks)]


def _band(line: Line, number: int, area: Area) -> str:
    if not len(line.low):
        return ""
    upper, lower = runs_of(line.x, line.high, area), runs_of(line.x, line.low, area)
    shapes = [
        path([*high, *reversed(low)], close=True) for high, low in zip(upper, lower, strict=False)
    ]
    return tag("path", class_=f"band {series_class(number)}", d="".join(shapes))


def _curve(line: Line, number: int, area: Area) -> str:
    made = []
    kind = "line dashed" if line.dashed else "line"
    if line.joined:
        runs = runs_of(line.x, line.y, area)
        made.append(tag("path", class_=kind, d="".join(path(run) for run in runs)))
    if line.points:
        made.extend(_points(line, area))
    return tag("g", *made, class_=series_class(number)) if made else ""


def _points(line: Line, area: Area) -> list[str]:
    made = []
    for place, (x, y) in enumerate(zip(line.x, line.y, strict=True)):
        if not (area.x.shows(x) and area.y.shows(y)):
            continue
        said = line.labels[place] if line.labels else f"{line.name}: {x:.4g}, {y:.4g}"
        about = tag("title", escape(said))
        made.append(tag("circle", about, class_="point", cx=area.x(x), cy=area.y(y), r=4))
    return made


def _ranges(lines: Sequence[Line], x_label: str, y_label: str) -> str:
    """What the curves say, in words."""
    said = [f"{y_label} over {x_label}."]
    for line in lines:
        pairs = zip(line.x, line.y, strict=True)
        known = [(x, y) for x, y in pairs if math.isfinite(x) and math.isfinite(y)]
        if known:
            (x, y), (last_x, last_y) = known[0], known[-1]
            said.append(f"{line.name}: from {y:.3g} at {x:.3g} to {last_y:.3g} at {last_x:.3g}.")
    return " ".join(said)
