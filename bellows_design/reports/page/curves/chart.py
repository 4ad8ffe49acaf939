"""Charts: what they show, for SVG in a page and for pictures alike."""

from __future__ import annotations

from dataclasses import dataclass

from bellows_design.web.charts import Bar, Limit, Line, Mark, bar_chart, line_chart

ROOM = 1.2
"""Of the largest value: as far as an axis reaches."""


@dataclass(frozen=True)
class Chart:
    """Curves over common axes; ``shaded`` are ranges of x."""

    title: str
    x_label: str
    y_label: str
    lines: tuple[Line, ...]
    limits: tuple[Limit, ...] = ()
    marks: tuple[Mark, ...] = ()
    shaded: tuple[tuple[float, float], ...] = ()
    y_bounds: tuple[float, float] | None = None

    def svg(self) -> str:
        """As an element of a page."""
        return line_chart(
            self.lines,
            x_label=self.x_label,
            y_label=self.y_label,
            title=self.title,
            limits=self.limits,
            marks=self.marks,
            shaded=self.shaded,
            y_bounds=self.y_bounds,
        )


def from_zero(*values: float) -> tuple[float, float]:
    """Bounds of an axis from zero to a little above the largest value, with room for a label."""
    return 0.0, ROOM * max((value for value in values if value > 0), default=1.0)


@dataclass(frozen=True)
class BarChart:
    """Signed bars by names."""

    title: str
    label: str
    bars: tuple[Bar, ...]

    def svg(self) -> str:
        """As an element of a page."""
        return bar_chart(self.bars, label=self.label, title=self.title)
