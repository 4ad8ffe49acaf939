"""Signed values by names as horizontal bars about a common zero."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from bellows_design.reports.page.drawing.marks import (
    CHARACTER,
    Area,
    Drawing,
    Line,
    Mark,
    Text,
)

ROW, BAR = 20.0, 12.0
"""px."""

WIDTH = 230.0
"""px, that the bars take."""

GAP = 6.0


def bars(values: Sequence[tuple[str, float]], title: str, kind: str = "first") -> Drawing:
    """A bar for each name and value, in the order given, with the value at its end."""
    names = CHARACTER * max((len(name) for name, _ in values), default=0) + 2 * GAP
    figures = CHARACTER * 7 + 2 * GAP
    largest = max((abs(value) for _, value in values), default=0.0) or 1.0
    low = min(0.0, min((value for _, value in values), default=0.0))
    high = max(0.0, max((value for _, value in values), default=0.0))
    scale = WIDTH / max(high - low, 0.2 * largest)
    zero = names + figures - low * scale
    height = ROW * len(values) + 2 * GAP
    marks = tuple(_rows(values, zero, scale, names, kind))
    axis = Line(((zero, GAP), (zero, height - GAP)), "axis")
    return Drawing(zero + high * scale + figures, height, (*marks, axis), title)


def _rows(
    values: Sequence[tuple[str, float]], zero: float, scale: float, names: float, kind: str
) -> Iterator[Mark]:
    for number, (name, value) in enumerate(values):
        middle = GAP + ROW * (number + 0.5)
        end, top, bottom = zero + value * scale, middle - BAR / 2, middle + BAR / 2
        corners = ((zero, top), (end, top), (end, bottom), (zero, bottom))
        yield Text((names - GAP, middle + 4), name, "end")
        yield Area((corners,), f"{kind}-bar")
        after = value >= 0
        place = (end + (GAP if after else -GAP), middle + 4)
        yield Text(place, f"{value:+.2f}", "start" if after else "end", kind="value")
