"""Which surfaces each node of a mesh lies on, found by distances in closed form."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bellows_design.morphing.distances import distances_and_normals, signed_distances
from bellows_design.morphing.primitives import AIR, SOLID, Boxes, Indices
from solver.arrays import Reals

TOLERANCE = 1e-5
"""mm. Nodes lie on their surfaces as exactly as the CAD kernel's curves do, which is a hundred
times better; features are a thousand times larger."""

PARALLEL = 1e-6
"""Two surfaces whose normals differ by less (one minus the cosine) touch instead of crossing."""

SHALLOW = 0.6
"""The same where level floors part. The curve in which the fillets of channel and chamber cross
ends in a point where they touch, and leaps from it as soon as one floor is higher."""

ALTERNATIVES, SLOTS = 2, 3


@dataclass(frozen=True)
class Places:
    """What holds each of k points on the surface of a body that m boxes bound.

    - ``pins`` (k, 3): for each axis the plane that the point lies in, as a place in
      ``plane_values``, or -1. Planes of sharp boxes, of cuts, and the seams of rounded boxes.
    - ``on`` (k, m): the rounded boxes whose surfaces it lies on.
    - ``curved`` (k, 3, 2): those of them that hold it besides the pins, or -1. Of two in a row,
      which touch there instead of crossing, the outer one holds it.
    - ``level`` (k,): number of independent conditions: 1 on a face, 2 on a curve, 3 at a corner.
    """

    pins: Indices
    on: NDArray[np.bool_]
    curved: Indices
    level: Indices

    def conditions(self, boxes: Boxes) -> NDArray[np.bool_]:
        """Whether each point keeps to each plane and each box, (k, 7 m + 3); one plane counts once.

        The planes come first, in the order of ``plane_values``.
        """
        planes = _distinct(plane_values(boxes))
        table = np.zeros((len(self.pins), len(planes)), bool)  # the last column is for -1
        for pins in self.pins.T:
            table[np.arange(len(table)), planes[pins]] = True
        return np.hstack([table[:, :-1], self.on])

    def shared(self, boxes: Boxes, one: Indices, two: Indices) -> Indices:
        """Number of independent conditions that points ``one`` and ``two`` (j,) share, (j,)."""
        planes = self.conditions(boxes)[:, : boxes.core.size + 3]
        count = (planes[one] & planes[two]).sum(axis=1)
        both = np.pad(self.on[one] & self.on[two], ((0, 0), (0, 1)))  # the last column is for -1
        for slot in range(SLOTS):
            count += np.take_along_axis(both, self.curved[one, slot], axis=1).any(axis=1)
        return count


def _distinct(values: Reals) -> Indices:
    """For each plane the first one of the same axis and place; -1 for the pin -1, at the end."""
    axes = np.arange(len(values)) % 3
    keys = np.stack([axes, np.round(values / TOLERANCE)], axis=1)
    _, first, inverse = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    return np.append(first[inverse.ravel()], -1)


def plane_values(boxes: Boxes) -> Reals:
    """Coordinates of the planes that pins name, (6 m + 3,) mm: ends of cores, and cuts at zero."""
    return np.append(boxes.core.ravel(), np.zeros(3))


def on_surfaces(boxes: Boxes, points: Reals) -> NDArray[np.bool_]:
    """Whether each point (k, 3) lies on the surface of each box, (k, m), where that is outermost.

    What a solid box has inside another solid one is no surface of the body, nor is that of a hollow
    inside another hollow.
    """
    count = len(points)
    distance = np.stack(
        [signed_distances(boxes, np.full(count, box), points) for box in range(len(boxes.radius))],
        axis=1,
    )
    found, within = np.abs(distance) < TOLERANCE, distance < -TOLERANCE
    for role in (SOLID, AIR):
        alike = boxes.role == role
        found[:, alike] &= ~within[:, alike].any(axis=1, keepdims=True)
    return found


def in_cuts(points: Reals) -> NDArray[np.bool_]:
    """Whether each point (k, 3) lies in the planes x = 0, y = 0, z = 0."""
    return np.abs(points) < TOLERANCE


def classified(boxes: Boxes, points: Reals, parallel: float = PARALLEL) -> Places:
    """The surfaces that points (k, 3) lie on; those count as one that are so ``parallel``."""
    on = on_surfaces(boxes, points)
    pins = _pins(boxes, points, on)
    curved = _curved(boxes, points, on, pins < 0, parallel)
    level = np.minimum((pins >= 0).sum(axis=1) + (curved[:, :, 0] >= 0).sum(axis=1), 3)
    _add_other_hollows(boxes, points, curved)
    return Places(pins, on & (boxes.radius > 0), curved, level)


def _pins(boxes: Boxes, points: Reals, on: NDArray[np.bool_]) -> Indices:
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
    boxes: Boxes, points: Reals, on: NDArray[np.bool_], free: NDArray[np.bool_], parallel: float
) -> Indices:
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
        touching = cosines > 1 - parallel
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


def _add_other_hollows(boxes: Boxes, points: Reals, curved: Indices) -> None:
    """Let the outer one of its box and the nearest other hollow hold a point of a single hollow.

    So that a point which comes to lie inside of the other one moves onto the surface of both.
    """
    first = curved[:, 0, 0]
    single = (first >= 0) & (curved[:, 0, 1] < 0) & (curved[:, 1, 0] < 0)
    rows = np.flatnonzero(single & (boxes.role[first] == AIR))
    hollows = np.flatnonzero((boxes.role == AIR) & (boxes.radius > 0))
    if len(hollows) < 2:
        return
    distance = np.stack(
        [signed_distances(boxes, np.full(len(rows), box), points[rows]) for box in hollows], axis=1
    )
    distance[first[rows][:, None] == hollows] = np.inf
    curved[rows, 0, 1] = hollows[distance.argmin(axis=1)]
