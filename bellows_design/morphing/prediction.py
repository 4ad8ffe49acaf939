"""Where points of one body lie in another, about: each axis stretched between its planes."""

from __future__ import annotations

import numpy as np

from bellows_design.morphing.primitives import FAR, Boxes
from solver.arrays import Reals


def predicted(own: Boxes, other: Boxes, points: Reals) -> Reals:
    """Points (k, 3) of the own body in the other, mm, by a piecewise linear map of each axis."""
    columns = [np.interp(points[:, axis], *_knots(own, other, axis)) for axis in range(3)]
    return np.stack(columns, axis=1)


def _knots(own: Boxes, other: Boxes, axis: int) -> tuple[Reals, Reals]:
    """Ascending coordinates of the own boxes' planes, and where the other's lie."""
    here, there = (_planes(boxes, axis) for boxes in (own, other))
    near = np.abs(here) < FAR / 2
    here, there = np.append(here[near], 0.0), np.append(there[near], 0.0)
    known, places = np.unique(np.round(here, 6), return_inverse=True)
    means = np.bincount(places, there) / np.bincount(places)
    return known, means


def _planes(boxes: Boxes, axis: int) -> Reals:
    reach = boxes.radius[:, None] * np.array([-1.0, 1.0])
    core = boxes.core[:, :, axis]
    return np.concatenate([(core + reach).ravel(), core.ravel()])
