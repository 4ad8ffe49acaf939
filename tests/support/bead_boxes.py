"""Boxes made of beads by hand, whose widest path and depth are known in closed form.

A box stands on z = 0 around the z axis. Its walls are square loops, one inside the other, its floor
and its roof are loops up to the middle; the roof leaves a square hole for the port.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from printers import Opening
from printers.gcode.beads import EXTERNAL_PERIMETER, Beads

Floats = NDArray[np.float64]
Loop = Callable[[float, float, int], Iterable[Floats]]

WIDTH = 0.42
PITCH = 0.9 * WIDTH
"""Beads overlap by a tenth: half-way between two of them F is 0.9."""

HEIGHT = 0.2
LOOPS_OF_HOLE = 2
LOOPS_OF_CAVITY = 4
"""Loops that would lie inside; their half sides are half a pitch, one and a half, and so on."""

HOLE = (LOOPS_OF_HOLE + 0.5) * PITCH - WIDTH / 2
CAVITY = (LOOPS_OF_CAVITY + 0.5) * PITCH
"""mm from the middle to the port's air and to the axis of the innermost loop of the walls."""


def closed(half: float, z: float, number: int) -> Iterator[Floats]:
    """A loop that begins and ends in a corner, of every layer and loop in another one."""
    corners = half * np.array([[1, 1], [-1, 1], [-1, -1], [1, -1], [1, 1]])
    yield corners @ rotation(90.0 * (number + round(z / HEIGHT))).T


def with_gap(gap: float, where: Callable[[float, int], bool] = lambda z, number: True) -> Loop:
    """Loops with a gap of air in the middle of their side at +x, where the rule holds."""

    def loop(half: float, z: float, number: int) -> Iterator[Floats]:
        if not where(z, number):
            yield from closed(half, z, number)
            return
        free = (gap + WIDTH) / 2  # the bead's ends are round
        corners = half * np.array([[1, 1], [-1, 1], [-1, -1], [1, -1]])
        yield np.array([[half, free], *corners, [half, -free]])

    return loop


def with_seam(angle: Callable[[int], float]) -> Loop:
    """Closed loops that begin in the middle of a side: of that at +x, turned by `angle` degrees."""

    def loop(half: float, z: float, number: int) -> Iterator[Floats]:
        points = half * np.array([[1, 0], [1, 1], [-1, 1], [-1, -1], [1, -1], [1, 0]])
        yield points @ rotation(angle(number)).T

    return loop


def in_pieces(half: float, z: float, number: int) -> Iterator[Floats]:
    """A loop of four paths, which only touch in the corners."""
    corners = next(iter(closed(half, z, number)))
    yield from (corners[side : side + 2] for side in range(4))


@dataclass(frozen=True)
class Box:
    """A box of beads.

    Attributes:
        lines: Loops of the walls.
        floor: Layers of the floor, and of the roof.
        layers: Of the walls between them.
        wall: How a loop of the walls is laid, by its half side, height and number from inside.
        angle: Degrees that the box is turned by.
        height: Of a layer, mm.
    """

    lines: int = 3
    floor: int = 6
    layers: int = 20
    wall: Loop = closed
    angle: float = 0.0
    height: float = HEIGHT

    @property
    def outer(self) -> float:
        """Half side of the outermost loop, mm."""
        return CAVITY + (self.lines - 1) * PITCH

    @property
    def wall_thickness(self) -> float:
        """mm."""
        return (self.lines - 1) * PITCH + WIDTH

    @property
    def beads(self) -> Beads:
        """All layers from the bed up."""
        paths = list(self._paths())
        joined = [
            beads_of(points, z, self.height, number) for number, (points, z) in enumerate(paths)
        ]
        return joined_beads(joined)

    @property
    def opening(self) -> Opening:
        """The port in the roof."""
        top = (2 * self.floor + self.layers) * self.height
        return Opening("port", (0.0, 0.0, top), (0.0, 0.0, 1.0), HOLE * 2**0.5)

    @property
    def volume(self) -> float:
        """Of the beads, mm³."""
        return float(self.beads.volume.sum())

    def _paths(self) -> Iterator[tuple[Floats, float]]:
        turn = rotation(self.angle)
        for layer in range(2 * self.floor + self.layers):
            z = (layer + 1) * self.height
            within = self.floor <= layer < self.floor + self.layers
            left_out = 0 if layer < self.floor else LOOPS_OF_HOLE
            count = self.lines if within else LOOPS_OF_CAVITY + self.lines - left_out
            lay = self.wall if within else closed
            for number in range(count):
                half = self.outer - (count - 1 - number) * PITCH
                for points in lay(half, z, number):
                    yield points @ turn.T, z


def rotation(angle: float) -> Floats:
    """(2, 2) of degrees, anticlockwise."""
    cosine, sine = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    return np.array([[cosine, -sine], [sine, cosine]])


def beads_of(points: Floats, top: float, height: float, path: int, width: float = WIDTH) -> Beads:
    """One path through the points."""
    count = len(points) - 1
    return Beads(
        start=points[:-1],
        end=points[1:],
        top=np.full(count, top),
        height=np.full(count, height),
        width=np.full(count, width),
        nominal_width=np.full(count, np.nan),
        kind=np.full(count, EXTERNAL_PERIMETER),
        path=np.full(count, path),
        layer=np.full(count, round(top / height) - 1),
    )


def joined_beads(parts: Iterable[Beads]) -> Beads:
    """All beads, in order."""
    parts = list(parts)
    names = Beads.__dataclass_fields__
    return Beads(*(np.concatenate([getattr(part, name) for part in parts]) for name in names))
