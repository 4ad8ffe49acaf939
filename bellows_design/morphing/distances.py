"""Signed distances from rounded boxes, and their gradients."""

from __future__ import annotations

import numpy as np

from bellows_design.morphing.primitives import Boxes, Indices
from solver.arrays import Reals


def signed_distances(boxes: Boxes, chosen: Indices, points: Reals) -> Reals:
    """Distance of points (k, 3) from the surfaces of the boxes ``chosen`` (k,), mm.

    Negative inside. Source: I. Quilez, distance functions of rounded boxes.
    """
    middle, half = _middles_and_halves(boxes, chosen)
    beyond = np.abs(points - middle) - half
    outside = np.linalg.norm(np.maximum(beyond, 0.0), axis=1)
    return outside + np.minimum(beyond.max(axis=1), 0.0) - boxes.radius[chosen]


def distances_and_normals(boxes: Boxes, chosen: Indices, points: Reals) -> tuple[Reals, Reals]:
    """Signed distances (k,) as above, mm, and their gradients (k, 3) for points outside of cores.

    Inside of a core the gradient is that of its nearest plane.
    """
    middle, half = _middles_and_halves(boxes, chosen)
    offset = points - middle
    beyond = np.abs(offset) - half
    outer = np.maximum(beyond, 0.0)
    outside = np.linalg.norm(outer, axis=1)
    inside = outside == 0
    nearest = beyond == beyond.max(axis=1, keepdims=True)
    steepest = np.where(inside[:, None], nearest, outer)
    gradient = steepest / np.linalg.norm(steepest, axis=1, keepdims=True)
    distance = outside + np.minimum(beyond.max(axis=1), 0.0) - boxes.radius[chosen]
    return distance, gradient * np.where(offset < 0, -1.0, 1.0)


def _middles_and_halves(boxes: Boxes, chosen: Indices) -> tuple[Reals, Reals]:
    middle = boxes.core.mean(axis=1)
    half = (boxes.core[:, 1] - boxes.core[:, 0]) / 2
    return middle[chosen], half[chosen]
