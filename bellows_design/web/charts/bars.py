"""Signed bars."""

from __future__ import annotations

import math
from collections.abc import Sequence

from bellows_design.web.charts.parts import LETTER, RIGHT, WIDTH, Bar, segment
from bellows_design.web.charts.scales import ChartError, Scale, scale, short
from bellows_design.web.charts.svg import picture, tag, text


def bar_chart(
    bars: Sequence[Bar], *, label: str, title: str, description: str = "", signed: bool = True
) -> str:
    """Horizontal bars from zero to the left and right, as `<svg>`.

    Args:
        bars: From top to bottom; those whose value is not finite are left out.
        label: Of the values, with their unit.
        title: For those who do not see the chart.
        description: Likewise; empty for all values.
        signed: Whether positive values are written with a plus.

    Raises:
        ChartError: No value is finite.
    """
    shown = [bar for bar in bars if math.isfinite(bar.value)]
    if not shown:
        raise ChartError("there is no finite value to draw.")
    name_width = min(max(len(bar.name) for bar in shown) * LETTER + 12, 190.0)
    said = [_amount(bar, shown, signed) for bar in shown]
    value_width = max(map(len, said)) * LETTER + 10
    ends = [bar.value + sign * (bar.error or 0.0) for bar in shown for sign in (-1, 1)]
    room_left = value_width if min(bar.value for bar in shown) < 0 else 4.0
    room_right = value_width if max(bar.value for bar in shown) >= 0 else 4.0
    bounds = (min(*ends, 0.0), max(*ends, 0.0))
    bounds = bounds if bounds[0] < bounds[1] else (-1.0, 1.0)
    along = scale(ends, name_width + room_left, WIDTH - RIGHT - room_right, bounds=bounds)
    body = [text(label, name_width, 13, class_="tick")]
    for number, (bar, amount) in enumerate(zip(shown, said, strict=True)):
        body.append(_bar(bar, amount, along, 24.0 + 25.0 * number))
    bottom = 24.0 + 25.0 * len(shown)
    body.append(segment(along(0), 20, along(0), bottom, "axis"))
    everything = "; ".join(f"{bar.name}: {amount}" for bar, amount in zip(shown, said, strict=True))
    return picture(
        title, description or f"{label}. {everything}.", (WIDTH, bottom + 4), "".join(body)
    )


def _bar(bar: Bar, amount: str, along: Scale, top: float) -> str:
    zero, end = along(0), along(bar.value)
    error = bar.error or 0.0
    outer = along(bar.value + math.copysign(error, bar.value))
    series = "series-1" if bar.value >= 0 else "series-2"
    parts = [
        text(bar.name, 0, top + 15),
        tag(
            "rect",
            class_="bar",
            x=min(zero, end),
            y=top + 3,
            width=max(abs(end - zero), 0.5),
            height=16,
            rx=2,
        ),
    ]
    if bar.error:
        inner = along(bar.value - math.copysign(error, bar.value))
        parts.append(segment(inner, top + 11, outer, top + 11, "axis"))
    beyond = max(end, outer) + 6 if bar.value >= 0 else min(end, outer) - 6
    anchor = "start" if bar.value >= 0 else "end"
    parts.append(text(amount, beyond, top + 15, text_anchor=anchor))
    return tag("g", *parts, class_=series)


def _amount(bar: Bar, bars: Sequence[Bar], signed: bool) -> str:
    largest = max(abs(other.value) for other in bars)
    written = short(bar.value, 10.0 ** math.floor(math.log10(largest)) / 100 if largest else 1.0)
    sign = "+" if signed and bar.value > 0 else ""
    return f"{sign}{written}{f' {bar.note}' if bar.note else ''}"
