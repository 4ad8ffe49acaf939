"""Surfaces and layers to show: small, with answers that are known."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bellows_design.web.layers import LayerMark, PrintLayers
from bellows_design.web.scene import Field, Surface

QUADS = ((0, 1, 2, 3), (7, 6, 5, 4), (0, 4, 5, 1), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0))
SIDES = [[0, 0, 0], [0, 1, 0], [1, 1, 0], [1, 0, 0], [0, 0, 1], [0, 1, 1], [1, 1, 1], [1, 0, 1]]


def block(*size: float) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Eight corners of a block of `size` (x, y, z), mm, and its triangles seen from outside."""
    triangles = [tri for a, b, c, d in QUADS for tri in ((a, b, c), (a, c, d))]
    return np.array(SIDES, float) * size, np.array(triangles)


def hollow(size: float, wall: float) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """A cube of `size` with a cubic void: walls of `wall`, mm."""
    outer, triangles = block(size, size, size)
    inner = block(*[size - 2 * wall] * 3)[0] + wall
    return np.vstack([outer, inner]), np.vstack([triangles, triangles[:, ::-1] + 8])


def sheared(frames: int = 5) -> Surface:
    """A block 40 mm × 10 mm × 10 mm whose top moves by 5 mm along x from frame to frame.

    Its stress is x / 40 times the share of the way, MPa, so from 0 to 1.
    """
    points, triangles = block(40, 10, 10)
    steps = np.arange(frames)[:, None]
    positions = np.repeat(points[None], frames, axis=0)
    positions[:, :, 0] += 5 * steps * points[None, :, 2] / 10
    share = steps / (frames - 1)
    stress = Field("von Mises stress", "MPa", points[None, :, 0] / 40 * share, limit=0.8)
    thickness = Field("wall thickness", "mm", np.where(points[:, 2] > 5, 2.0, np.nan))
    labels = tuple(f"{0.02 * step:.2f} MPa" for step in range(frames))
    return Surface("block", triangles, positions, (stress, thickness), labels)


def bent_grid(points: int, frames: int) -> Surface:
    """A sheet of about `points` that bends by up to a half circle, with a field: much to pack."""
    side = round(points**0.5)
    u, v = (
        each.ravel() for each in np.meshgrid(np.linspace(0, 80, side), np.linspace(0, 20, side))
    )
    positions = [_bent(u, v, angle) for angle in np.linspace(0, np.pi, frames)]
    stress = np.linspace(0, 1, frames)[:, None] * (0.6 + 0.4 * np.sin(u / 3) * np.cos(v / 2))
    cell = np.arange(side * (side - 1)).reshape(side - 1, side)[:, :-1].ravel()
    lower = np.column_stack([cell, cell + 1, cell + side])
    upper = np.column_stack([cell + 1, cell + side + 1, cell + side])
    field = Field("von Mises stress", "MPa", stress)
    return Surface("sheet", np.vstack([lower, upper]), np.array(positions), (field,))


def _bent(u: NDArray[np.float64], v: NDArray[np.float64], angle: float) -> NDArray[np.float64]:
    wave = 2 * np.sin(u)
    if angle == 0:
        return np.column_stack([u, v, wave])
    radius = 80 / angle
    turn = u / radius
    away = radius - wave
    return np.column_stack([away * np.sin(turn), v, radius - away * np.cos(turn)])


def two_layers() -> PrintLayers:
    """Two layers: a square of four beads, then one bead across and one apart from it.

    The places are multiples of the step they are packed in.
    """
    corners = np.array([[100, 50], [110, 50], [110, 58], [100, 58]], float)
    start = np.vstack([corners, [[100, 54], [103, 57]]])
    end = np.vstack([np.roll(corners, -1, axis=0), [[110, 54], [107, 57]]])
    return PrintLayers(
        start=start,
        end=end,
        width=np.array([0.42, 0.42, 0.42, 0.42, 0.38, 0.5]),
        kind=np.array([0, 0, 0, 0, 1, 1]),
        layer=np.array([0, 0, 0, 0, 1, 1]),
        tops=np.array([0.2, 0.35]),
        kind_names=("external perimeter", "solid infill"),
        marks=(LayerMark(105.0, 54.0, 1, "leak, 0.15 mm <wide>", "fail"),),
    )
