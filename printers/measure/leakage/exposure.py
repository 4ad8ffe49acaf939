"""Which parts of a surface see the open air: what lies in a cavity with a narrow leak sees none.

From points of every triangle rays go out in directions spread evenly over the half space. On
an outside wall some escape, even deep in a gap between bubbles, where they run along the walls.
"""

from __future__ import annotations

import numpy as np

from printers.arrays import Floats, Ints
from printers.measure.box_tree import first_hits
from printers.measure.surface import Surface

DIRECTIONS = 64  # half of them lead away from a face
OFF_THE_SURFACE = 1e-6  # mm
LARGE = 1.0  # mm²: one point stands for a smaller triangle
MIDDLE = np.array([[1, 1, 1]]) / 3
SPREAD = np.array([[1, 1, 1], [4, 1, 1], [1, 4, 1], [1, 1, 4]]) / np.array([[3], [6], [6], [6]])
"""Barycentric coordinates of the points."""


def escaping_rays(surface: Surface) -> Ints:
    """(m,): from the point of every triangle that sees most, how many rays leave the part."""
    large = surface.areas >= LARGE
    most = np.zeros(len(surface.triangles), dtype=np.int64)
    for which, weights in ((np.flatnonzero(~large), MIDDLE), (np.flatnonzero(large), SPREAD)):
        points = np.einsum("pk,mki->mpi", weights, surface.corners[which])
        escaped = _escaping(surface, points.reshape(-1, 3), np.repeat(which, len(weights)))
        most[which] = escaped.reshape(points.shape[:2]).max(axis=1, initial=0)
    return most


def _escaping(surface: Surface, points: Floats, triangle: Ints) -> Ints:
    """(k,): how many rays leave the part from points (k, 3) of these triangles (k,)."""
    reach = 2 * float(np.linalg.norm(np.ptp(surface.bounds, axis=0)))
    start = points + OFF_THE_SURFACE * surface.normals[triangle]
    escaped = np.zeros(len(points), dtype=np.int64)
    for direction in _sphere(DIRECTIONS):
        ahead = surface.normals[triangle] @ direction > 0
        end = start[ahead] + reach * direction
        hit = first_hits(surface.tree, start[ahead], end, triangle[ahead])[0]
        escaped[ahead] += ~np.isfinite(hit)
    return escaped


def _sphere(count: int) -> Floats:
    """(count, 3) unit vectors, evenly spread: Fibonacci's spiral."""
    step = np.arange(count) + 0.5
    height = 1 - 2 * step / count
    turn = np.pi * (1 + 5**0.5) * step
    across = np.sqrt(1 - height**2)
    return np.stack([across * np.cos(turn), across * np.sin(turn), height], axis=1)
