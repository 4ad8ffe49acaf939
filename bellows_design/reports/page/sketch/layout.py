"""A view with its dimensions as a drawing."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from bellows_design.reports.page.drawing.marks import (
    TEXT_HEIGHT,
    Area,
    Drawing,
    Line,
    Mark,
    Point,
    Text,
)
from bellows_design.reports.page.sketch.dimension import Callout, Dimension, Place, Side, View
from bellows_design.reports.page.sketch.placing import Placed, Span, placed

ROW = 21.0
"""px, from dimension line to dimension line."""

FIRST_ROW = 21.0
"""px, from the part to the first."""

ARROW = 4.0
"""px."""

MARGIN = 8.0

_SIDES: tuple[Side, ...] = ("above", "below", "left", "right")


@dataclass(frozen=True)
class Sheet:
    """Where mm of a view lie on its drawing: ``scale`` px/mm; the origin's place, px."""

    scale: float
    x: float
    y: float

    def at(self, place: Place) -> Point:
        """px of a place in mm."""
        return self.x + self.scale * place[0], self.y - self.scale * place[1]


def drawn(view: View, scale: float) -> Drawing:
    """The view at ``scale`` px/mm, as large as its dimensions need."""
    rough = Sheet(scale, 0.0, 0.0)
    box = _box(view, rough)
    rows = {side: _rows(view, rough, side) for side in _SIDES}
    marks = [
        *_part(view, rough),
        *_dimensions(rows, rough, box),
        *_callouts(view, rough, box, rows),
    ]
    return _fitted(view, marks, box)


def _fitted(view: View, marks: Sequence[Mark], box: tuple[float, float, float, float]) -> Drawing:
    """The marks moved onto a sheet that holds them all."""
    boxes = [_extent(each) for each in marks if not (view.across and _is_part(each))]
    lefts, tops, rights, bottoms = zip(box, *boxes, strict=True)
    left, top = min(lefts) - MARGIN, min(tops) - MARGIN
    width, height = max(rights) + MARGIN - left, max(bottoms) + MARGIN - top
    clip = None
    if view.across is not None:
        clip = (box[0] - left, -top + box[1], box[2] - left, box[3] - top)
    moved = tuple(_moved(each, -left, -top) for each in marks)
    return Drawing(width, height, moved, view.title, clip)


def _box(view: View, sheet: Sheet) -> tuple[float, float, float, float]:
    """Left, top, right and bottom of what is shown of the part, px."""
    points = [point for loop in view.loops for point in loop]
    xs, ys = [point[0] for point in points], [point[1] for point in points]
    low, high = (min(xs), max(xs)) if view.across is None else view.across
    bottom, top = min(ys), max(ys)
    if view.frame is not None:
        low, bottom = min(low, view.frame[0]), min(bottom, view.frame[1])
        high, top = max(high, view.frame[2]), max(top, view.frame[3])
    return (*sheet.at((low, top)), *sheet.at((high, bottom)))


def _part(view: View, sheet: Sheet) -> Iterator[Mark]:
    yield Area(tuple(tuple(map(sheet.at, loop)) for loop in view.loops))
    for loop in view.behind:
        yield Line(tuple(map(sheet.at, (*loop, loop[0]))), "hidden")
    if view.frame is not None:
        left, bottom, right, top = view.frame
        corners = (left, bottom), (right, bottom), (right, top), (left, top), (left, bottom)
        yield Line(tuple(map(sheet.at, corners)), "frame")


def _rows(view: View, sheet: Sheet, side: Side) -> tuple[tuple[Dimension, Placed], ...]:
    """Dimensions of one side with their rows."""
    chosen = [each for each in view.dimensions if each.side == side]
    spans = [Span(*_ends(each, sheet), each.label) for each in chosen]
    return tuple(zip(chosen, placed(spans), strict=True))


def _ends(dimension: Dimension, sheet: Sheet) -> tuple[float, float]:
    """Where the dimension begins and ends along its row, px; rows at the sides run upwards."""
    places = sheet.at(dimension.start), sheet.at(dimension.end)
    along = [x if dimension.side in ("above", "below") else -y for x, y in places]
    return min(along), max(along)


def _dimensions(
    rows: dict[Side, tuple[tuple[Dimension, Placed], ...]],
    sheet: Sheet,
    box: tuple[float, float, float, float],
) -> Iterator[Mark]:
    left, top, right, bottom = box
    edges = {"above": (top, -1), "below": (bottom, 1), "left": (left, -1), "right": (right, 1)}
    for side, found in rows.items():
        edge, out = edges[side]
        for dimension, place in found:
            yield from _dimension(dimension, place, sheet, edge + out * _depth(place), out)


def _depth(place: Placed) -> float:
    return FIRST_ROW + ROW * place.row


def _dimension(
    dimension: Dimension, place: Placed, sheet: Sheet, at: float, out: int
) -> Iterator[Mark]:
    """Two lines that lead out of the part, the line with its arrows, and the label."""
    upright = dimension.side in ("left", "right")

    def point(along: float, across: float) -> Point:
        return (across, -along) if upright else (along, across)

    for end in (dimension.start, dimension.end):
        x, y = sheet.at(end)
        along = -y if upright else x
        yield Line((sheet.at(end), point(along, at + 3 * out)), "leader")
    low, high = place.span.low, place.span.high
    inside = high - low > 4 * ARROW
    reach = 0.0 if inside else 2 * ARROW
    yield Line((point(low - reach, at), point(high + reach, at)), "dimension")
    if place.start > high or place.end < low:
        behind = place.start > high
        yield Line(
            (point(high if behind else low, at), point(place.start if behind else place.end, at)),
            "dimension",
        )
    for tip, towards in ((low, 1 if inside else -1), (high, -1 if inside else 1)):
        tips = [point(tip + towards * ARROW * 1.6, at + side * ARROW * 0.6) for side in (-1, 1)]
        yield Area(((point(tip, at), *tips),), "arrow")
    yield _label(dimension, place, point, at, upright)


def _label(dimension: Dimension, place: Placed, point: object, at: float, upright: bool) -> Text:
    middle = (place.start + place.end) / 2
    on_line = place.span.low <= middle <= place.span.high
    lift = -4.5 if on_line else 0.33 * TEXT_HEIGHT
    if upright:
        return Text((at + lift, -middle), dimension.label, "middle", True)
    return Text((middle, at + lift), dimension.label)


def _callouts(
    view: View,
    sheet: Sheet,
    box: tuple[float, float, float, float],
    rows: dict[Side, tuple[tuple[Dimension, Placed], ...]],
) -> Iterator[Mark]:
    """Labels in a column at the right, the highest point's first, each with a line to its point."""
    beyond = max((_depth(place) for _, place in rows["right"]), default=0.0) + ROW + MARGIN
    x, before = box[2] + beyond, box[1]
    for callout in sorted(view.callouts, key=lambda each: -each.at[1]):
        there = sheet.at(callout.at)
        y = max(there[1] - ROW, before)
        before = y + 1.2 * TEXT_HEIGHT + 4
        yield from _callout(callout, there, x, y)


def _callout(callout: Callout, there: Point, x: float, y: float) -> Iterator[Mark]:
    level = y - 0.3 * TEXT_HEIGHT
    yield Line((there, (x - 14, level), (x - 4, level)), "callout")
    yield Text((x, y), callout.label, "start")


def _extent(mark: Mark) -> tuple[float, float, float, float]:
    if isinstance(mark, Text):
        return mark.box
    points = _points(mark)
    xs, ys = [each[0] for each in points], [each[1] for each in points]
    return min(xs), min(ys), max(xs), max(ys)


def _points(mark: Mark) -> list[Point]:
    match mark:
        case Area(loops):
            return [point for loop in loops for point in loop]
        case Line(points):
            return list(points)
        case Text(place) | Text(place=place):
            return [place]
        case _:
            return [mark.centre]


def _moved(mark: Mark, x: float, y: float) -> Mark:
    def there(point: Point) -> Point:
        return point[0] + x, point[1] + y

    match mark:
        case Area(loops):
            return replace(mark, loops=tuple(tuple(map(there, loop)) for loop in loops))
        case Line(points):
            return replace(mark, points=tuple(map(there, points)))
        case Text(place):
            return replace(mark, place=there(place))
        case _:
            return replace(mark, centre=there(mark.centre))


def _is_part(mark: Mark) -> bool:
    return isinstance(mark, Area) and mark.kind == "material"
