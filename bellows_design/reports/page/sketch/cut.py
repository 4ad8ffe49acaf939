"""Where a plane cuts a closed mesh, as closed lines."""

from __future__ import annotations

from collections import defaultdict
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from bellows_design.geometry.tessellation import ClosedMesh

BESIDE = 1.7e-3
"""mm. By so much planes are moved off the place asked for, where many vertices may lie on them."""

ROUNDING = 1e-6
"""mm, within which ends of segments are one point."""

SAME = 2 * BESIDE
"""mm. Points nearer to each other are one corner, cut off by a plane beside it."""

STRAIGHT = 1e-3
"""Sine of the angle by which a line turns at a corner."""

Loop = tuple[tuple[float, float], ...]


def cut(mesh: ClosedMesh, axis: int, place: float) -> tuple[Loop, ...]:
    """Closed lines in which the plane of this ``axis`` (0, 1, 2) at ``place`` (mm) cuts the mesh.

    Their points are the other two coordinates in their order, mm. Points on straight lines are
    left out.
    """
    from trimesh import Trimesh
    from trimesh.intersections import mesh_plane

    solid = Trimesh(mesh.vertices, mesh.triangles, process=False)
    normal, origin = np.eye(3)[axis], np.eye(3)[axis] * (place + BESIDE)
    segments = mesh_plane(solid, normal, origin)  # type: ignore[no-untyped-call]
    others = [each for each in range(3) if each != axis]
    return tuple(map(_without_straights, _loops(np.asarray(segments)[:, :, others])))


def _loops(segments: np.ndarray) -> list[list[tuple[float, float]]]:
    """Segments (n, 2, 2) joined end to end."""
    if not len(segments):
        return []
    keys = np.round(segments / ROUNDING).astype(np.int64)
    beside: dict[tuple[int, int], list[int]] = defaultdict(list)
    for number, ends in enumerate(keys):
        for end in ends:
            beside[tuple(end.tolist())].append(number)
    left, found = set(range(len(segments))), []
    while left:
        found.append(_walked(segments, keys, beside, left))
    return [loop for loop in found if len(loop) > 2]


def _walked(
    segments: np.ndarray,
    keys: np.ndarray,
    beside: dict[tuple[int, int], list[int]],
    left: set[int],
) -> list[tuple[float, float]]:
    """One loop, whose segments are taken from those ``left``."""
    number, end, loop = left.pop(), 1, []
    while True:
        x, y = segments[number, end].tolist()
        loop.append((x, y))
        here = tuple(keys[number, end].tolist())
        following = [each for each in beside[here] if each in left]
        if not following:
            return loop
        number = following[0]
        left.discard(number)
        end = 0 if tuple(keys[number, 1].tolist()) == here else 1


def _without_straights(loop: list[tuple[float, float]]) -> Loop:
    """The loop's corners: no point twice, none on a straight line between its neighbours."""
    points = np.array(loop)
    points = points[np.linalg.norm(points - np.roll(points, 1, axis=0), axis=1) > SAME]
    before, after = points - np.roll(points, 1, axis=0), np.roll(points, -1, axis=0) - points
    area = np.abs(before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0])
    lengths = np.linalg.norm(before, axis=1) * np.linalg.norm(after, axis=1)
    kept = points[area > STRAIGHT * lengths]
    return tuple((float(x), float(y)) for x, y in (kept if len(kept) > 2 else points))
