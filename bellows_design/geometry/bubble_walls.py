"""Named surfaces for the walls of an actuator's bubbles, of which neighbours may touch.

Bubble i, counted from 1 at the root, has two: ``bubble_i_back``, its outside on the side of the
root, and ``bubble_i_front``. The tendon beneath it belongs to them, the tendon between bubbles does
not: surfaces of two bubbles share no node.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from bellows_design.design.bellows_parameters import BellowsParameters
from bellows_design.geometry.face_names import OUTSIDE

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from solver import Mesh

BACK, FRONT = "back", "front"

WIDER = 1e-6
"""mm. By how much a bubble counts as longer than it is, for rounding."""


def wall_name(bubble: int, side: str) -> str:
    """Name of the surface on one side of a bubble, counted from 1 at the root."""
    return f"bubble_{bubble}_{side}"


def facing_walls(bellows: BellowsParameters) -> tuple[tuple[str, str], ...]:
    """Names of the surfaces that face each other in each gap between bubbles, from the root on."""
    gaps = range(1, bellows.bubble_count)
    return tuple((wall_name(gap, FRONT), wall_name(gap + 1, BACK)) for gap in gaps)


def with_bubble_walls(mesh: Mesh, bellows: BellowsParameters) -> Mesh:
    """The mesh of an actuator, half or full, with surfaces for the walls of its bubbles."""
    return mesh.with_surfaces(_walls(mesh, bellows))


def _walls(mesh: Mesh, bellows: BellowsParameters) -> Mapping[str, NDArray[np.int32]]:
    triangles = mesh.triangles(OUTSIDE)
    corners = mesh.nodes[triangles[:, :3], 0]
    bubble = nearest_bubble(bellows, corners.mean(axis=1))
    on = on_bubble(bellows, corners[:, 0]) & on_bubble(bellows, corners[:, 1])
    on &= on_bubble(bellows, corners[:, 2])
    before = corners.mean(axis=1) < np.array(bellows.bubble_middles)[bubble]
    return {
        wall_name(number + 1, side): triangles[on & (bubble == number) & sides]
        for number in range(bellows.bubble_count)
        for side, sides in ((BACK, before), (FRONT, ~before))
    }


def nearest_bubble(bellows: BellowsParameters, x: NDArray[np.float64]) -> NDArray[np.int64]:
    """Number of the bubble, from 0, that each place along the actuator (k,), mm, is nearest to."""
    nearest = np.rint((x - bellows.bubble_middles[0]) / bellows.pitch)
    return np.clip(nearest, 0, bellows.bubble_count - 1).astype(np.int64)


def on_bubble(bellows: BellowsParameters, x: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Whether each place along the actuator (k,), mm, is within a bubble's length."""
    middles = np.array(bellows.bubble_middles)[nearest_bubble(bellows, x)]
    on: NDArray[np.bool_] = np.abs(x - middles) <= bellows.bubble_length / 2 + WIDER
    return on
