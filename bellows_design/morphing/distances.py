"""Signed distances from rounded boxes, and their gradients."""

from __future__ import annotations

import numpy as np

from bellows_design.morphing.primitives import Boxes, Indices
from solver.arrays import Reals


def signed_distances(boxes: Boxes, chosen: Indices, points: Reals) -> Reals:
    """Distance of points (k, 3) from the surfaces of the boxes ``chosen`` (k,), mm.

    Negative inside. Source: I. Quilez, distance functions of rounded boxes.
    """
    return distances_and_normals(boxes, chosen, points)[0]


def distances_and_normals(boxes: Boxes, chosen: Indices, points: Reals) -> tuple[Reals, Reals]:
    """Signed distances (k,) as above, mm, and their gradients (k, 3).

    Inside of a core the gradient is that of its nearest plane.
    """
    lower, upper = boxes.core[chosen, 0], boxes.core[chosen, 1]
    below, above = lower - points, points - upper
    outer = np.maximum(above, 0.0) - np.maximum(below, 0.0)
    distance = np.sqrt(outer[:, 0] ** 2 + outer[:, 1] ** 2 + outer[:, 2] ** 2)
    inside = np.flatnonzero(distance == 0)
    if len(inside):
        depth, outer[inside] = _to_nearest_plane(below[inside], above[inside])
        gradient = outer / np.where(distance == 0, 1.0, distance)[:, None]
        distance[inside] = depth
    else:
        gradient = outer / distance[:, None]
    return distance - boxes.radius[chosen], gradient


def _to_nearest_plane(below: Reals, above: Reals) -> tuple[Reals, Reals]:
    """Signed distances (k,) of points inside cores from the nearest planes, and normals (k, 3)."""
    depths = np.hstack([below, above])
    nearest = depths.argmax(axis=1)
    rows = np.arange(len(depths))
    normal = np.zeros_like(below)
    normal[rows, nearest % 3] = np.where(nearest < 3, -1.0, 1.0)
    return depths[rows, nearest], normal
