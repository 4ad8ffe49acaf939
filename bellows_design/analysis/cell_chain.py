"""The whole actuator from one cell: copies, every other one mirrored, joined at the gaps' middles.

Where the cell's moving plane went, the mirrored neighbour begins; so bubble after bubble lies end
to end on an arc, as in the middle of the real actuator. The ends are missing.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bellows_design.design.bellows_parameters import BellowsParameters
from bellows_design.geometry.face_names import GAP_MIDDLE, OUTSIDE, ROOT, SYMMETRY, TIP
from solver import Mesh, Solution

Array = NDArray[np.float64]
MIRRORED = [0, 2, 1, 5, 4, 3]
"""Nodes of a six-node triangle in the order its mirror image needs."""


def chain(bellows: BellowsParameters, cell: Solution) -> tuple[Mesh, Array]:
    """Surfaces of half of the actuator, and their displacement (n, 3) in mm; no tetrahedra.

    Surfaces ``outside``, ``symmetry``, ``root`` and ``tip``. The root, the middle of a gap before
    the first bubble, stays where it is.
    """
    mesh, places = cell.problem.mesh, _places(bellows, cell)
    reference = [_copied(mesh.nodes, side, middle) for middle, side, _, _ in places]
    moved = [
        _turned(_copied(mesh.nodes + cell.displacement, side, 0.0), origin, angle)
        for _, side, origin, angle in places
    ]
    surfaces = {name: _all_copies(mesh, name, places) for name in (OUTSIDE, SYMMETRY)}
    surfaces[ROOT] = _all_copies(mesh, GAP_MIDDLE, places[:1])
    surfaces[TIP] = mesh.surfaces[GAP_MIDDLE] + (len(places) - 1) * len(mesh.nodes)
    nodes = np.concatenate(reference)
    return Mesh(nodes, np.empty((0, 10), np.int32), surfaces), np.concatenate(moved) - nodes


Place = tuple[float, int, Array, float]
"""x of the bubble's middle (mm), side (-1 or 1), its middle's origin (2,) and angle (rad)."""


def _places(bellows: BellowsParameters, cell: Solution) -> list[Place]:
    """Both halves of every bubble, from root to tip."""
    tilt, shift = cell.plane
    reach = bellows.pitch / 2 + shift
    angles = tilt * (2 * np.arange(bellows.bubble_count) + 1)
    steps = reach * np.stack([np.cos(angles), -np.sin(angles)], axis=1)
    start = np.array([bellows.first_gap_middle, 0.0])
    origins = (
        start + np.cumsum(steps, axis=0) + np.cumsum(np.vstack([0 * steps[:1], steps[:-1]]), axis=0)
    )
    return [
        (middle, side, origin, angle)
        for middle, origin, angle in zip(bellows.bubble_middles, origins, angles, strict=True)
        for side in (-1, 1)
    ]


def _copied(points: Array, side: int, middle: float) -> Array:
    """Points (n, 3) of the cell, mirrored at x = 0 if ``side`` is -1, moved to ``middle``."""
    return points * [side, 1, 1] + [middle, 0, 0]


def _turned(points: Array, origin: Array, angle: float) -> Array:
    """Points (n, 3) turned about y by ``angle`` (rad, z to x) and moved to ``origin`` (x, z)."""
    x, z = points[:, 0], points[:, 2]
    turned = points.copy()
    turned[:, 0] = np.cos(angle) * x + np.sin(angle) * z + origin[0]
    turned[:, 2] = np.cos(angle) * z - np.sin(angle) * x + origin[1]
    return turned


def _all_copies(mesh: Mesh, surface: str, places: list[Place]) -> NDArray[np.int32]:
    """Triangles of the copies of a surface."""
    triangles = mesh.surfaces[surface]
    copies = [
        (triangles if side > 0 else triangles[:, MIRRORED]) + number * len(mesh.nodes)
        for number, (_, side, _, _) in enumerate(places)
    ]
    return np.concatenate(copies).astype(np.int32)
