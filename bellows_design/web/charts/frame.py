"""What lies about curves: axes, shaded ranges, limits, named points, the key."""

from __future__ import annotations

import math
from collections.abc import Sequence

from bellows_design.web.charts.parts import (
    LETTER,
    LINE_OF_TEXT,
    TOP,
    WIDTH,
    Area,
    Limit,
    Line,
    Mark,
    runs_of,
    segment,
    series_class,
)
from bellows_design.web.charts.svg import tag, text


def axes(area: Area, x_label: str, y_label: str) -> list[str]:
    left, right, bottom, top = area.x.start, area.x.end, area.y.start, area.y.end
    made = []
    for tick in area.y.ticks:
        made.append(segment(left, area.y(tick), right, area.y(tick), "rule"))
        made.append(
            text(area.y.said(tick), left - 8, area.y(tick) + 4, text_anchor="end", class_="tick")
        )
    for tick in area.x.ticks:
        made.append(segment(area.x(tick), bottom, area.x(tick), bottom + 5, "axis"))
        made.append(
            text(
                area.x.said(tick),
                area.x(tick),
                bottom + 18,
                text_anchor="middle",
                class_="tick",
            )
        )
    made.append(segment(left, bottom, right, bottom, "axis"))
    made.append(text(x_label, right, area.height - 8, text_anchor="end"))
    made.append(text(y_label, 0, top - 14))
    return made


def shades(shaded: Sequence[tuple[float, float]], area: Area) -> list[str]:
    made = []
    for low, high in shaded:
        start, end = (area.x(min(max(value, area.x.low), area.x.high)) for value in (low, high))
        height = area.y.start - area.y.end
        made.append(
            tag("rect", class_="region", x=start, y=area.y.end, width=end - start, height=height)
        )
    return made


def limit_lines(limits: Sequence[Limit], lines: Sequence[Line], area: Area) -> list[str]:
    made: list[str] = []
    for limit in limits:
        along = area.y if limit.axis == "y" else area.x
        if not along.shows(limit.value):
            continue
        draw = _level if limit.axis == "y" else _upright
        made.extend(draw(limit, lines, area))
    return made


def _level(limit: Limit, lines: Sequence[Line], area: Area) -> tuple[str, str]:
    """A horizontal line, its text at the end that the curves leave free."""
    at = area.y(limit.value)
    x, anchor = (
        (area.x.end, "end") if _free_on_the_right(limit, lines, area) else (area.x.start, "start")
    )
    inside = x - 4 if anchor == "end" else x + 6
    said = text(limit.text, inside, at - 6, text_anchor=anchor, class_="limit-text")
    return segment(area.x.start, at, area.x.end, at, "limit"), said


def _free_on_the_right(limit: Limit, lines: Sequence[Line], area: Area) -> bool:
    """Whether the curves come nearer to the limit in the left half than in the right one."""
    middle, nearest = (area.x.start + area.x.end) / 2, [math.inf, math.inf]
    for run in (run for line in lines for run in runs_of(line.x, line.y, area)):
        for x, y in run:
            half = int(x > middle)
            nearest[half] = min(nearest[half], abs(y - area.y(limit.value)))
    return nearest[1] >= nearest[0]


def _upright(limit: Limit, _: Sequence[Line], area: Area) -> tuple[str, str]:
    """A vertical line, its text at the top towards the middle."""
    at = area.x(limit.value)
    anchor = "end" if at > (area.x.start + area.x.end) / 2 else "start"
    aside = at - 6 if anchor == "end" else at + 6
    said = text(limit.text, aside, area.y.end + 11, text_anchor=anchor, class_="limit-text")
    return segment(at, area.y.start, at, area.y.end, "limit"), said


def named_points(marks: Sequence[Mark], area: Area) -> list[str]:
    made = []
    for mark in marks:
        if not (area.x.shows(mark.x) and area.y.shows(mark.y)):
            continue
        x, y = area.x(mark.x), area.y(mark.y)
        right = x < (area.x.start + area.x.end) / 2
        made.append(tag("circle", class_="point series-1 marked", cx=x, cy=y, r=5.5))
        anchor = "start" if right else "end"
        aside, below = (x + 10, y + 15) if right else (x - 10, y - 10)
        made.append(text(mark.text, aside, below, text_anchor=anchor))
    return made


def rows_of_keys(names: Sequence[str]) -> list[list[tuple[int, float]]]:
    """Number and place of each key, in as many rows as they need."""
    rows: list[list[tuple[int, float]]] = []
    at = WIDTH
    for number, name in enumerate(names):
        width = 26 + len(name) * LETTER + 14
        if at + width > WIDTH:
            rows.append([])
            at = 0.0
        rows[-1].append((number, at))
        at += width
    return rows


def keys(lines: Sequence[Line], rows: Sequence[Sequence[tuple[int, float]]]) -> list[str]:
    made = []
    for row, keys in enumerate(rows):
        y = TOP + LINE_OF_TEXT * row
        for number, x in keys:
            line = lines[number]
            shape = (
                segment(x, y - 4, x + 18, y - 4, "line dashed" if line.dashed else "line")
                if line.joined
                else tag("circle", class_="point", cx=x + 9, cy=y - 4, r=4)
            )
            made.append(tag("g", shape, text(line.name, x + 24, y), class_=series_class(number)))
    return made
