"""Dimension lines beside each other and in rows, so that no label lies on another or on a line."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from bellows_design.reports.page.drawing.marks import CHARACTER

APART = 7.0
"""px between labels in a row."""

MOST_ROWS = 12


@dataclass(frozen=True)
class Span:
    """A dimension line from ``low`` to ``high`` (px along its row) with its ``label``."""

    low: float
    high: float
    label: str

    @property
    def length(self) -> float:
        """Of the label, px."""
        return CHARACTER * len(self.label)


@dataclass(frozen=True)
class Placed:
    """A span in its ``row``, 0 next to the part, with its label from ``start`` to ``end``."""

    span: Span
    row: int
    start: float
    end: float

    @property
    def low(self) -> float:
        """Where line and label begin."""
        return min(self.start, self.span.low)

    @property
    def high(self) -> float:
        """Where line and label end."""
        return max(self.end, self.span.high)


def placed(spans: Sequence[Span]) -> tuple[Placed, ...]:
    """Every span in a row, in the order given; short ones are next to the part."""
    order = sorted(range(len(spans)), key=lambda each: spans[each].high - spans[each].low)
    found: dict[int, Placed] = {}
    for number in order:
        found[number] = _best(spans[number], list(found.values()))
    return tuple(found[number] for number in range(len(spans)))


def _best(span: Span, others: Sequence[Placed]) -> Placed:
    """The nearest row in which nothing is crossed; else the nearest in which nothing is covered."""
    free = [each for each in _candidates(span) if not _covers(each, others)]
    clean = [each for each in free if not _crosses(each, others)]
    return (clean or free)[0]


def _candidates(span: Span) -> Iterator[Placed]:
    """Row by row, with the label on its line if it fits there, else behind or before it."""
    middle, half = (span.low + span.high) / 2, span.length / 2
    fits = span.length + APART < span.high - span.low
    behind = (span.high + APART, span.high + APART + span.length)
    before = (span.low - APART - span.length, span.low - APART)
    ways = ((middle - half, middle + half),) if fits else (behind, before)
    for row in range(MOST_ROWS):
        yield from (Placed(span, row, *way) for way in ways)


def _covers(one: Placed, others: Sequence[Placed]) -> bool:
    """Whether it lies on another of its row."""
    return any(
        one.row == each.row and one.low - APART < each.high and each.low < one.high + APART
        for each in others
    )


def _crosses(one: Placed, others: Sequence[Placed]) -> bool:
    """Whether lines that lead to an outer row pass through a label of an inner one."""
    return any(
        _passes(one, each) if one.row > each.row else _passes(each, one)
        for each in others
        if one.row != each.row
    )


def _passes(outer: Placed, inner: Placed) -> bool:
    ends = (outer.span.low, outer.span.high)
    return any(inner.start - 2 < each < inner.end + 2 for each in ends)
