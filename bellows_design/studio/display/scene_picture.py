"""A scene as a drawing: the finger's lower side at every pressure, and what stands around it.

SVG by presentation attributes alone, so that it needs no styles of the page.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from html import escape
from typing import TYPE_CHECKING

from bellows_design.design.scenes.blocked import Blocked
from bellows_design.design.scenes.grip import Grip

if TYPE_CHECKING:
    from bellows_design.force.result import ForceCurve, ForceReading

FINGER, PRESSED, AROUND, REST = "#2b7bba", "#d1495b", "#b8bcc2", "#8a8f98"
MARGIN = 0.08
"""Of the picture's longer side, on each side."""

Point = tuple[float, float]


def scene_picture(found: ForceCurve) -> str:
    """The drawing; x to the right and z up, in mm."""
    low, high = _bounds(found)
    margin = MARGIN * max(high[0] - low[0], high[1] - low[1], 1.0)
    width, height = high[0] - low[0] + 2 * margin, high[1] - low[1] + 2 * margin
    box = f"{low[0] - margin:.2f} {-high[1] - margin:.2f} {width:.2f} {height:.2f}"
    line = max(width, height) / 250
    title = escape(f"{found.design.name}: {found.scene} at {found.last.pressure_mpa:.3g} MPa")
    return "\n".join(
        (
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{box}" role="img">',
            f"<title>{title}</title>",
            *_surroundings(found, low[0] - margin, width, line),
            *_shapes(found, line),
            "</svg>",
        )
    )


def scene_caption(found: ForceCurve) -> str:
    """What the drawing shows, in sentences."""
    *lower, highest = (f"{reading.pressure_mpa:.3g}" for reading in found.curve)
    pressures = " and ".join(filter(None, (", ".join(lower), highest)))
    parts = [
        f"The finger's lower side at {pressures} MPa, darker the higher; dashed: without load."
    ]
    if found.last.touched:
        parts.append("Red: where it presses.")
    if isinstance(found.content, Grip):
        parts.append(f"One of {found.content.fingers} fingers; thinly dashed: the gripper's axis.")
    return " ".join(parts)


def _bounds(found: ForceCurve) -> tuple[Point, Point]:
    """Lowest and highest x and z of all that is drawn, mm."""
    points = [(0.0, 0.0), (found.design.finger_length, 0.0), *_around(found)]
    points += [(float(x), float(z)) for reading in found.curve for x, z in reading.shape]
    xs, zs = zip(*points, strict=True)
    return (min(xs), min(zs)), (max(xs), max(zs))


def _around(found: ForceCurve) -> Iterator[Point]:
    scene = found.content
    if isinstance(scene, Blocked):
        yield 0.0, -scene.distance - 2.0
    if isinstance(scene, Grip):
        half = scene.size / 2
        yield scene.place - half, -scene.distance - half
        yield scene.place + half, -scene.distance + half


def _surroundings(found: ForceCurve, left: float, width: float, line: float) -> Iterator[str]:
    scene, length = found.content, found.design.finger_length
    if isinstance(scene, Blocked) and scene.support != "held":
        yield _rectangle(left, -scene.distance, width, 2.0, AROUND)
    if isinstance(scene, Grip):
        yield _object(scene)
        yield _path(
            [(left, -scene.distance), (left + width, -scene.distance)], REST, line / 2, "1 2"
        )
    yield _path([(0.0, 0.0), (length, 0.0)], REST, line, "2 2")


def _object(scene: Grip) -> str:
    half = scene.size / 2
    if scene.object == "box":
        height = scene.size if scene.height is None else scene.height
        return _rectangle(
            scene.place - height / 2, half - scene.distance, height, scene.size, AROUND
        )
    return (
        f'<circle cx="{scene.place:.3f}" cy="{scene.distance:.3f}" r="{half:.3f}" fill="{AROUND}"/>'
    )


def _shapes(found: ForceCurve, line: float) -> Iterator[str]:
    """The lower sides, stronger the higher the pressure; dots where objects press."""
    count = len(found.curve)
    for number, reading in enumerate(found.curve):
        opacity = 0.25 + 0.75 * (number + 1) / count
        yield _path(reading.shape, FINGER, 2 * line, opacity=opacity)
    yield from _dots(found.last, line)


def _dots(reading: ForceReading, line: float) -> Iterator[str]:
    for x, z in reading.touched:
        yield f'<circle cx="{x:.3f}" cy="{-z:.3f}" r="{2 * line:.3f}" fill="{PRESSED}"/>'


def _rectangle(x: float, top: float, width: float, height: float, colour: str) -> str:
    return (
        f'<rect x="{x:.3f}" y="{-top:.3f}" width="{width:.3f}" height="{height:.3f}" '
        f'fill="{colour}"/>'
    )


def _path(
    points: Iterable[Point], colour: str, width: float, dashes: str = "", opacity: float = 1.0
) -> str:
    text = " ".join(f"{x:.3f},{-z:.3f}" for x, z in points)
    dashed = f' stroke-dasharray="{dashes}"' if dashes else ""
    return (
        f'<polyline points="{text}" fill="none" stroke="{colour}" stroke-width="{width:.3f}" '
        f'stroke-opacity="{opacity:.2f}"{dashed}/>'
    )
