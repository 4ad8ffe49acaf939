"""A drawing as SVG that takes its colours from the style of the page: classes ``d-KIND``."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from markupsafe import Markup, escape

from bellows_design.reports.page.drawing.marks import Area, Dot, Drawing, Line, Mark, Point, Text

_FRAME = Markup(
    '<svg xmlns="http://www.w3.org/2000/svg" class="drawing" role="img" viewBox="0 0 {} {}" '
    'style="max-width:{}px"><title>{}</title>{}</svg>'
)


def as_svg(drawing: Drawing) -> Markup:
    """The drawing as an element of a page; all text in it is escaped."""
    size = f"{drawing.width:.0f}", f"{drawing.height:.0f}"
    marks = Markup("").join(_marks(drawing))
    return _FRAME.format(*size, f"{drawing.width:.0f}", drawing.title, marks)


def _marks(drawing: Drawing) -> Iterator[Markup]:
    """Clipped areas first, where there is something to clip."""
    if drawing.clip is None:
        yield from map(_mark, drawing.marks)
        return
    left, top, right, bottom = drawing.clip
    clipped = [isinstance(each, Area) and each.kind == "material" for each in drawing.marks]
    pairs = list(zip(drawing.marks, clipped, strict=True))
    inner = Markup("").join(_mark(each) for each, within in pairs if within)
    box = f"{left:.1f} {top:.1f} {right - left:.1f} {bottom - top:.1f}"
    size = f"{right - left:.1f}", f"{bottom - top:.1f}"
    yield Markup('<svg x="{}" y="{}" width="{}" height="{}" viewBox="{}">{}</svg>').format(
        f"{left:.1f}", f"{top:.1f}", *size, box, inner
    )
    yield from (_mark(each) for each, within in pairs if not within)


def _mark(mark: Mark) -> Markup:
    match mark:
        case Area(loops, kind):
            path = "".join(f"M{_points(loop)}Z" for loop in loops)
            return Markup('<path class="d-{}" fill-rule="evenodd" d="{}"/>').format(kind, path)
        case Line(points, kind, strength):
            opacity = Markup("") if strength == 1 else Markup(f' opacity="{strength:.2f}"')
            return Markup('<polyline class="d-{}" points="{}"{}/>').format(
                kind, _points(points), opacity
            )
        case Dot((x, y), radius, kind):
            return Markup('<circle class="d-{}" cx="{}" cy="{}" r="{}"/>').format(
                kind, f"{x:.1f}", f"{y:.1f}", f"{radius:g}"
            )
        case Text():
            return _text(mark)


def _text(text: Text) -> Markup:
    x, y = (f"{each:.1f}" for each in text.place)
    turn = Markup(f' transform="rotate(-90 {x} {y})"') if text.turned else Markup("")
    return Markup('<text class="d-{}" x="{}" y="{}" text-anchor="{}"{}>{}</text>').format(
        text.kind, x, y, text.anchor, turn, escape(text.text)
    )


def _points(points: Iterable[Point]) -> str:
    return " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
