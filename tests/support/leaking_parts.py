"""The finger and its deliberately leaking copies, as solids: what a virtual leak test must find.

The cuts lie in the middle bubble, x = 27.4 to 31.8 mm, whose chamber is 28.6 to 30.6 mm long; its
side wall is y = 8.8 to 10 mm, its roof z = 18.8 to 20 mm at x = 29.6 mm.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cache

import numpy as np
from manifold3d import Manifold, Mesh64
from numpy.typing import NDArray
from small_solids import arrays, block, bore

from bellows_design.design import load_design, with_overrides
from bellows_design.geometry.actuator import printed_part
from bellows_design.geometry.tessellation import tessellate
from bellows_design.printability import port_opening
from printers import Opening

Box = tuple[tuple[float, float, float], tuple[float, float, float]]
MIDDLE = 29.6


@dataclass(frozen=True, eq=False)
class LeakingPart:
    """A solid, its port, and the box that its fault lies in; none for a sound part."""

    solid: Manifold
    opening: Opening
    place: Box | None = None

    @property
    def mesh(self) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
        """Vertices and triangles."""
        return arrays(self.solid)

    def distance(self, point: Iterable[float] | None) -> float | None:
        """mm from a point to the fault."""
        if self.place is None or point is None:
            return None
        at = np.asarray(list(point))
        return float(np.linalg.norm(at - np.clip(at, *np.asarray(self.place))))


@cache
def shipped(name: str, *changes: str) -> LeakingPart:
    """A shipped design, with changed parameters."""
    design = with_overrides(load_design(name), changes)
    mesh = tessellate(printed_part(design.bellows, design.indent, design.port).solid)
    solid = Manifold(Mesh64(mesh.vertices, mesh.triangles.astype(np.uint64)))
    return LeakingPart(solid, port_opening(design))


def pin_in_wall(diameter: float) -> LeakingPart:
    """A round hole across the side wall."""
    hole = bore(diameter / 2, (MIDDLE, 8.5, 9.0), 2.0, axis=1)
    return _cut(hole, ((MIDDLE, 8.8, 9.0), (MIDDLE, 10.0, 9.0)))


def pin_in_roof(diameter: float) -> LeakingPart:
    """A round hole up through the roof."""
    hole = bore(diameter / 2, (MIDDLE, 0.0, 18.5), 2.0, axis=2)
    return _cut(hole, ((MIDDLE, 0.0, 18.8), (MIDDLE, 0.0, 20.0)))


def slit(width: float) -> LeakingPart:
    """An upright slit of 4 mm in the wall to the gap behind the bubble."""
    tool = block((1.6, width, 4.0), (30.4, -width / 2, 9.0))
    return _cut(tool, ((30.6, 0.0, 9.0), (31.8, 0.0, 13.0)))


def dent(remaining: float) -> LeakingPart:
    """A round dent of 1.6 mm inside, in the side wall."""
    depth, radius = 1.2 - remaining, 0.8
    ball = Manifold.sphere(1.0, 64).scale((radius, depth, radius))
    place = ((MIDDLE, 10.0 - remaining, 9.0), (MIDDLE, 10.0, 9.0))
    return _cut(ball.translate((MIDDLE, 8.8, 9.0)), place)


def thin_wall(remaining: float) -> LeakingPart:
    """A pocket of 1.5 × 1.5 mm outside, in the side wall."""
    pocket = block((1.5, 2.0, 1.5), (MIDDLE - 0.75, 8.8 + remaining, 8.25))
    place = ((MIDDLE - 0.75, 8.8, 8.25), (MIDDLE + 0.75, 8.8 + remaining, 9.75))
    return _cut(pocket, place)


def thin_roof(remaining: float) -> LeakingPart:
    """A pocket of 1.5 × 1.5 mm in the roof, from outside."""
    pocket = block((1.5, 1.5, 2.0), (MIDDLE - 0.75, -0.75, 18.8 + remaining))
    low, high = (MIDDLE - 0.75, -0.75, 18.5), (MIDDLE + 0.75, 0.75, 18.8 + remaining)
    return _cut(pocket, (low, high))


def _cut(tool: Manifold, place: Box) -> LeakingPart:
    finger = shipped("finger")
    return LeakingPart(finger.solid - tool, finger.opening, place)
