"""Where on the part rules that did not pass, or passed within their tolerance, were measured."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from bellows_design.reports.page.drawing.marks import Area, Dot, Drawing, Mark, Text
from bellows_design.reports.page.sketch.cut import Loop, cut

if TYPE_CHECKING:
    from bellows_design.design.design import Design
    from bellows_design.geometry.tessellation import ClosedMesh
    from printers.report import Point, RuleResult

LONGEST = 560.0
"""px, of a part on its picture."""

MARGIN = 22.0

NEAR = 0.5
"""mm. Places nearer to each other share a mark."""

_WORST = {"fail": 0, "warn": 1, "info": 2, "pass": 3}


@dataclass(frozen=True)
class Marked:
    """A numbered place (mm) with the rules that were measured there, and the worst verdict."""

    number: int
    place: Point
    rules: tuple[RuleResult, ...]

    @property
    def verdict(self) -> str:
        """The worst of its rules'."""
        return min((rule.verdict for rule in self.rules), key=lambda each: _WORST[each])


def marked_rules(rules: Sequence[RuleResult]) -> tuple[Marked, ...]:
    """The first place of every rule that states one, near ones together."""
    places: list[tuple[Point, list[RuleResult]]] = []
    for rule in rules:
        if not rule.points:
            continue
        place = rule.points[0]
        near = next((own for at, own in places if _distance(at, place) < NEAR), None)
        if near is None:
            places.append((place, [rule]))
        else:
            near.append(rule)
    return tuple(Marked(n, at, tuple(own)) for n, (at, own) in enumerate(places, 1))


def _distance(one: Point, other: Point) -> float:
    return max(abs(a - b) for a, b in zip(one, other, strict=True))


def place_drawings(
    design: Design, mesh: ClosedMesh, marked: Sequence[Marked]
) -> tuple[Drawing, ...]:
    """The marks on a section from the side, and on one from above."""
    side = cut(mesh, 1, 0.0)
    above = cut(mesh, 2, design.bellows.tendon_height / 2)
    return (
        _drawing("Places, from the side", side, marked, (0, 2)),
        _drawing("Places, from above", above, marked, (0, 1)),
    )


def _drawing(
    title: str, loops: Sequence[Loop], marked: Sequence[Marked], axes: tuple[int, int]
) -> Drawing:
    points = [point for loop in loops for point in loop]
    points += [(each.place[axes[0]], each.place[axes[1]]) for each in marked]
    xs, ys = zip(*points, strict=True)
    scale = LONGEST / max(max(xs) - min(xs), 1.0)

    def at(place: tuple[float, float]) -> tuple[float, float]:
        return MARGIN + scale * (place[0] - min(xs)), MARGIN + scale * (max(ys) - place[1])

    marks: list[Mark] = [Area(tuple(tuple(map(at, loop)) for loop in loops))]
    taken: list[tuple[float, float]] = []
    for each in marked:
        spot = at((each.place[axes[0]], each.place[axes[1]]))
        marks.append(Dot(spot, 4.0, f"mark-{each.verdict}"))
        taken.append(_free(spot, taken))
        marks.append(Text(taken[-1], str(each.number), kind="mark"))
    height = 2 * MARGIN + scale * (max(ys) - min(ys))
    return Drawing(2 * MARGIN + LONGEST, height, tuple(marks), title)


def _free(spot: tuple[float, float], taken: Sequence[tuple[float, float]]) -> tuple[float, float]:
    """A place for a number beside its dot that no other number has."""
    x, y = spot
    around = ((9, -6), (-9, -6), (9, 13), (-9, 13), (0, -10), (0, 18), (18, 4), (-18, 4))
    ways = [(x + a * reach, y + b * reach) for reach in (1, 1.8, 2.6) for a, b in around]
    free = [way for way in ways if all(_apart(way, each) for each in taken)]
    return (free or ways)[0]


def _apart(one: tuple[float, float], other: tuple[float, float]) -> bool:
    return abs(one[0] - other[0]) > 14 or abs(one[1] - other[1]) > 12
