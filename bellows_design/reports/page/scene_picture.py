"""The finger's shapes in a scene, with what stands around it, as a drawing."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

from bellows_design.design.scenes.blocked import Blocked
from bellows_design.design.scenes.grip import Grip
from bellows_design.reports.page.drawing.marks import Area, Dot, Drawing, Line, Mark, Point, Text

if TYPE_CHECKING:
    from bellows_design.force.result import ForceCurve, ForceReading

SIZE = 460.0
"""px, of the longer side of what is shown."""

MARGIN = 14.0

Place = tuple[float, float]
"""x and z in the finger's plane, mm."""


@dataclass(frozen=True)
class _Outline:
    """A closed line or one from point to point, mm; ``strength`` as of a ``Line``."""

    points: tuple[Place, ...]
    kind: str
    closed: bool = False
    strength: float = 1.0


def scene_drawing(found: ForceCurve) -> Drawing:
    """The lower side at every pressure, objects, and dots where they press."""
    outlines = (*_surroundings(found), *_shapes(found))
    xs, zs = zip(*(point for each in outlines for point in each.points), strict=True)
    extent = max(max(xs) - min(xs), max(zs) - min(zs)) or 1.0
    scale = SIZE / extent

    def at(place: Place) -> Point:
        return MARGIN + scale * (place[0] - min(xs)), MARGIN + scale * (max(zs) - place[1])

    marks: list[Mark] = [_mark(each, at) for each in outlines]
    marks += [Dot(at(place), 3.0, "contact") for place in found.last.touched]
    width = 2 * MARGIN + scale * (max(xs) - min(xs))
    height = 2 * MARGIN + scale * (max(zs) - min(zs))
    marks += list(_scale_bar(scale, extent, height))
    title = f"{found.design.name} in the scene {found.scene}"
    return Drawing(max(width, 200.0), height + 2 * MARGIN, tuple(marks), title)


def _mark(outline: _Outline, at: Callable[[Place], Point]) -> Mark:
    points = tuple(at(place) for place in outline.points)
    if outline.closed:
        return Area((points,), outline.kind)
    return Line(points, outline.kind, outline.strength)


def _scale_bar(scale: float, extent: float, height: float) -> Iterator[Mark]:
    """A length of 1, 2 or 5 times a power of ten, about a fifth of what is shown."""
    power = 10.0 ** math.floor(math.log10(extent / 5))
    length = max(each * power for each in (1, 2, 5) if each * power <= extent / 5)
    y = height + MARGIN / 2
    yield Line(((MARGIN, y), (MARGIN + length * scale, y)), "dimension")
    yield Text((MARGIN + length * scale + 8, y + 4), f"{length:g} mm", "start")


def _shapes(found: ForceCurve) -> Iterator[_Outline]:
    count = len(found.curve)
    for number, reading in enumerate(found.curve):
        strength = 0.25 + 0.75 * (number + 1) / count
        yield _Outline(tuple(reading.shape), "finger", strength=strength)
        if found.design.fingertip is not None and number == count - 1:
            pad = found.design.fingertip
            yield _Outline(_turned_box(reading, pad.length, pad.thickness), "pad", closed=True)


def _turned_box(reading: ForceReading, length: float, thickness: float) -> tuple[Place, ...]:
    """The side of the fingertip, whose lower edge ends the lower side."""
    angle = math.radians(180 - reading.tip_angle_deg)
    along = math.cos(angle), math.sin(angle)
    up = math.sin(angle), -math.cos(angle)
    x, z = reading.tip_position_mm
    corners = ((0.0, 0.0), (length, 0.0), (length, thickness), (0.0, thickness))
    return tuple((x + a * along[0] + b * up[0], z + a * along[1] + b * up[1]) for a, b in corners)


def _surroundings(found: ForceCurve) -> Iterator[_Outline]:
    """What stands around the finger, its mount, and its lower side at rest."""
    scene, design = found.content, found.design
    length = design.finger_length
    if isinstance(scene, Blocked) and scene.support != "held":
        yield _box(-0.1 * length, -scene.distance - 0.03 * length, 1.1 * length, -scene.distance)
    if isinstance(scene, Grip):
        yield _object(scene)
        yield _Outline(((0.0, -scene.distance), (1.2 * length, -scene.distance)), "hidden")
    if design.mount is not None:
        plate = design.mount
        yield _box(-plate.length(design.port), 0.0, 0.0, plate.height(design.port), "pad")
    yield _Outline(((0.0, 0.0), (length, 0.0)), "hidden")


def _object(scene: Grip) -> _Outline:
    """What is gripped: round, or a box."""
    half, x, z = scene.size / 2, scene.place, -scene.distance
    if scene.object == "box":
        along = (scene.size if scene.height is None else scene.height) / 2
        return _box(x - along, z - half, x + along, z + half)
    turns = (2 * math.pi * step / 72 for step in range(72))
    rim = tuple((x + half * math.cos(turn), z + half * math.sin(turn)) for turn in turns)
    return _Outline(rim, "object", closed=True)


def _box(left: float, bottom: float, right: float, top: float, kind: str = "object") -> _Outline:
    corners = ((left, bottom), (right, bottom), (right, top), (left, top))
    return _Outline(corners, kind, closed=True)
