"""Which surfaces each node of a mesh lies on, found by distances in closed form."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bellows_design.morphing.distances import distances_and_normals, signed_distances
from bellows_design.morphing.primitives import AIR, SOLID, Boxes
from solver.arrays import Integers, Reals

TOLERANCE = 1e-5
"""mm. Nodes lie on their surfaces as exactly as the CAD kernel's curves do, which is a hundred times
better; features are a thousand times larger."""

PARALLEL = 1e-6
"""Two surfaces whose normals differ by less (one minus the cosine) touch instead of crossing."""

ALTERNATIVES, SLOTS = 2, 3


@dataclass(frozen=True)
class Places:
    """What holds each of k points on the surface of a body.

    - ``pins`` (k, 3): for each axis the plane that the point lies in, as a place in
      ``plane_values``, or -1. Planes of sharp boxes, of cuts, and the seams of rounded boxes.
    - ``curved`` (k, 3, 2): the rounded boxes whose surfaces it lies on, or -1; of two in a row, which
      touch there, the outer one of the two holds it.
    - ``level`` (k,): number of independent conditions: 1 on a face, 2 on a curve, 3 at a corner.
    """

    pins: NDArray[np.int64]
    curved: NDArray[np.int64]
    level: NDArray[np.int64]

    def conditions(self, boxes: int) -> NDArray[np.bool_]:
        """Whether each point keeps to each plane and each of so many boxes, (k, 7 boxes + 3)."""
        table = np.zeros((len(self.pins), 7 * boxes + 4), bool)  # the last column is for -1
        rows = np.arange(len(self.pins))
        for axis in range(3):
            table[rows, self.pins[:, axis]] = True
        boxed = self.curved.reshape(len(rows), SLOTS * ALTERNATIVES)
        for column in boxed.T:
            table[rows, np.where(column < 0, -1, 6 * boxes + 3 + column)] = True
        return table[:, :-1]


def plane_values(boxes: Boxes) -> Reals:
    """Coordinates of the planes that pins name (6 m + 3,), mm: the ends of cores, and the cuts at zero."""
    return np.append(boxes.core.ravel(), np.zeros(3))


def on_surfaces(boxes: Boxes, points: Reals) -> NDArray[np.bool_]:
    """Whether each point (k, 3) lies on the surface of each box, (k, m), where that is outermost.

    What a solid box has inside another solid one is no surface of the body, nor is that of a hollow
    inside another hollow.
    """
    count = len(points)
    distance = np.stack(
        [
            signed_distances(boxes, np.full(count, box), points)
            for box in range(len(boxes.radius))
        ],
        axis=1,
    )
    within = np.stack([(distance < -TOLERANCE)[:, boxes.role == role].any(axis=1) for role in (SOLID, AIR)])
    hidden = np.where(boxes.role == SOLID, within[0][:, None], within[1][:, None])
    return (np.abs(distance) < TOLERANCE) & ~hidden


def in_cuts(points: Reals) -> NDArray[np.bool_]:
    """Whether each point (k, 3) lies in the planes x = 0, y = 0, z = 0."""
    return np.abs(points) < TOLERANCE


def classified(boxes: Boxes, points: Reals) -> Places:
    """The surfaces that points (k, 3) lie on."""
    on = on_surfaces(boxes, points)
    pins = _pins(boxes, points, on)
    curved = _curved(boxes, points, on, pins < 0)
    level = np.minimum((pins >= 0).sum(axis=1) + (curved[:, :, 0] >= 0).sum(axis=1), 3)
    return Places(pins, curved, level)


def _pins(boxes: Boxes, points: Reals, on: NDArray[np.bool_]) -> NDArray[np.int64]:
    """The planes of points: those of cuts first, then of sharp boxes, then seams."""
    zero = boxes.core.size
    pins = np.where(in_cuts(points), zero + np.arange(3), -1)
    for box in np.argsort(boxes.radius > 0, kind="stable"):
        for side, axis in np.ndindex(2, 3):
            there = np.abs(points[:, axis] - boxes.core[box, side, axis]) < TOLERANCE
            chosen = on[:, box] & there & (pins[:, axis] < 0)
            pins[chosen, axis] = (box * 2 + side) * 3 + axis
    return pins


def _curved(
    boxes: Boxes, points: Reals, on: NDArray[np.bool_], free: NDArray[np.bool_]
) -> NDArray[np.int64]:
    """The rounded boxes of points, those that touch each other side by side, (k, 3, 2)."""
    curved = np.full((len(points), SLOTS, ALTERNATIVES), -1)
    normals = np.zeros((len(points), SLOTS, 3))
    used = np.zeros(len(points), np.int64)
    for box in np.flatnonzero(boxes.radius > 0):
        rows = np.flatnonzero(on[:, box])
        _, normal = distances_and_normals(boxes, np.full(len(rows), box), points[rows])
        slopes = normal * free[rows]
        size = np.linalg.norm(slopes, axis=1)
        bends = size > 1e-3  # otherwise the pins hold it on this surface
        rows, slopes = rows[bends], slopes[bends] / size[bends, None]
        cosines = np.abs(np.einsum("ksi,ki->ks", normals[rows], slopes))
        touching = cosines > 1 - PARALLEL
        twice = touching.any(axis=1)
        slot = touching.argmax(axis=1)
        curved[rows[twice], slot[twice], 1] = box
        rows, slopes = rows[~twice], slopes[~twice]
        room = used[rows] < SLOTS
        rows, slopes = rows[room], slopes[room]
        curved[rows, used[rows], 0] = box
        normals[rows, used[rows]] = slopes
        used[rows] += 1
    return curved
