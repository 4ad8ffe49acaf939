"""The surface of a whole actuator at rest from that of its unit cell, and boxes for its ends."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from bellows_design.design.design import Design
from bellows_design.geometry.face_names import CAVITY, OUTSIDE
from bellows_design.studio.display.declared import CORNERS, FACES

if TYPE_CHECKING:
    from solver import Mesh
    from solver.arrays import Integers, Reals

SPLIT = np.array([[0, 3, 5], [3, 1, 4], [5, 4, 2], [3, 4, 5]])
"""A triangle of six nodes as four of three."""


COPIES = 4
"""Of the cell in a bubble."""

MOST_TRIANGLES = 80_000
"""Of an actuator's bubbles: so many are moved, packed and sent within 50 ms."""


@dataclass(frozen=True)
class Shape:
    """Triangles (m, 3) counter-clockwise from outside, of points (n, 3), mm."""

    points: Reals
    triangles: Integers


def joined(shapes: Iterator[Shape] | list[Shape]) -> Shape:
    """Several as one; points stay apart."""
    parts = list(shapes)
    starts = np.cumsum([0, *(len(each.points) for each in parts[:-1])])
    return Shape(
        np.concatenate([each.points for each in parts]),
        np.concatenate([each.triangles + start for each, start in zip(parts, starts, strict=True)]),
    )


def compacted(shape: Shape) -> Shape:
    """Without the points that no triangle has."""
    used, numbers = np.unique(shape.triangles, return_inverse=True)
    return Shape(shape.points[used], numbers.reshape(shape.triangles.shape).astype(np.int32))


def sides_of(mesh: Mesh) -> Integers:
    """Outside and cavity of a mesh as triangles of six nodes, (m, 6)."""
    return np.concatenate([mesh.surfaces[OUTSIDE], mesh.surfaces[CAVITY]])


def triangles_of(sides: Integers, bubbles: int) -> Integers:
    """Triangles of three points, (k, 3): four of each, or one where there are many bubbles."""
    if COPIES * bubbles * len(SPLIT) * len(sides) > MOST_TRIANGLES:
        return sides[:, :3]
    return np.concatenate([sides[:, corners] for corners in SPLIT])


def chained(cell: Shape, design: Design) -> Shape:
    """The cell's surface mirrored in y, and in x and along it for every bubble, with its ends."""
    whole = joined([cell, _mirrored(cell, 1)])
    bubble = joined([whole, _mirrored(whole, 0)])
    middles = design.bellows.bubble_middles
    bubbles = [Shape(bubble.points + np.array([x, 0.0, 0.0]), bubble.triangles) for x in middles]
    return joined([*bubbles, *_ends(design)])


def _mirrored(shape: Shape, axis: int) -> Shape:
    points = shape.points.copy()
    points[:, axis] *= -1
    return Shape(points, shape.triangles[:, ::-1])


def _ends(design: Design) -> Iterator[Shape]:
    """Root, tip, socket, plate and pad as boxes; without the round corners and holes of the CAD."""
    bellows, port, mount, pad = design.bellows, design.port, design.mount, design.fingertip
    width, height, half = bellows.tendon_width, bellows.tendon_height, bellows.pitch / 2
    first, last = bellows.bubble_middles[0] - half, bellows.bubble_middles[-1] + half
    if first > 0:
        yield _box(0.0, first, width, 0.0, height)
    if last < bellows.length:
        yield _box(last, bellows.length, width, 0.0, height)
    yield _box(-port.depth, 0.0, 2 * port.radius, 0.0, port.height)
    if mount is not None:
        yield _box(-mount.length(port), 0.0, mount.width(bellows, port), 0.0, mount.height(port))
    if pad is not None:
        yield _box(bellows.length, design.finger_length, pad.width, 0.0, pad.thickness)


def _box(start: float, end: float, width: float, low: float, high: float) -> Shape:
    lower, upper = np.array([start, -width / 2, low]), np.array([end, width / 2, high])
    return Shape(lower + CORNERS * (upper - lower), FACES)
