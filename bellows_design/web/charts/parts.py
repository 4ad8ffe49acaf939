"""What charts are made of, and where it lies."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from bellows_design.web.charts.scales import ChartError, Scale
from bellows_design.web.charts.svg import tag

WIDTH = 480.0
LEFT, RIGHT, TOP, BOTTOM = 62.0, 16.0, 14.0, 46.0
LINE_OF_TEXT = 18.0
LETTER = 6.9
"""Pixels of a letter on the average, rather too many."""
SERIES = 6
"""Colours there are."""


@dataclass(frozen=True)
class Line:
    """A curve.

    Attributes:
        name: In the key.
        x, y: Its points; a break where one is not finite.
        low, high: Ends of the band of error about it; empty for none.
        points: Whether its points are marked.
        joined: Whether they are joined.
        dashed: Whether the line is.
        labels: What each point says when pointed at; empty for its numbers.
    """

    name: str
    x: Sequence[float]
    y: Sequence[float]
    low: Sequence[float] = ()
    high: Sequence[float] = ()
    points: bool = False
    joined: bool = True
    dashed: bool = False
    labels: Sequence[str] = ()


@dataclass(frozen=True)
class Limit:
    """A value that is drawn across the chart.

    Attributes:
        value: On its axis.
        text: Beside it.
        axis: "y" for a horizontal line, "x" for a vertical one.
    """

    value: float
    text: str
    axis: Literal["x", "y"] = "y"


@dataclass(frozen=True)
class Mark:
    """A point that is named in the chart."""

    x: float
    y: float
    text: str


@dataclass(frozen=True)
class Bar:
    """A signed bar.

    Attributes:
        name: Beside it.
        value: Its length.
        error: Half the length of its whisker; None for none.
        note: Behind the value.
    """

    name: str
    value: float
    error: float | None = None
    note: str = ""


@dataclass(frozen=True)
class Area:
    """Where the curves of a chart are, and their scales."""

    x: Scale
    y: Scale
    width: float
    height: float


def require_pairs(line: Line) -> None:
    for name in ("y", "low", "high", "labels"):
        count = len(getattr(line, name))
        if count != len(line.x) and (name == "y" or count):
            raise ChartError(f"“{line.name}” has {len(line.x)} numbers of x and {count} of {name}.")
    if bool(len(line.low)) != bool(len(line.high)):
        raise ChartError(f"“{line.name}” has one end of a band of error, not both.")


def runs_of(x: Sequence[float], y: Sequence[float], area: Area) -> list[list[tuple[float, float]]]:
    """Pixels of a curve's points, parted where one is not finite."""
    runs: list[list[tuple[float, float]]] = [[]]
    for one, other in zip(x, y, strict=True):
        positive = (one > 0 or not area.x.log) and (other > 0 or not area.y.log)
        if math.isfinite(one) and math.isfinite(other) and positive:
            runs[-1].append((area.x(one), area.y(other)))
        elif runs[-1]:
            runs.append([])
    return [run for run in runs if run]


def segment(x1: float, y1: float, x2: float, y2: float, class_: str) -> str:
    return tag("line", x1=x1, y1=y1, x2=x2, y2=y2, class_=class_)


def series_class(number: int) -> str:
    return f"series-{number % SERIES + 1}"
