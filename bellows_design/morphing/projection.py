"""Points moved onto surfaces by Newton's method."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bellows_design.morphing.classification import Places, plane_values
from bellows_design.morphing.distances import distances_and_normals
from bellows_design.morphing.primitives import Boxes, Indices
from solver.arrays import Reals

STEPS = 20
"""Most steps of Newton's method; three or four are usual."""

EXACT = 1e-12
"""mm. A point this near to its surfaces lies on them."""


def projected(boxes: Boxes, places: Places, rows: Indices, points: Reals) -> tuple[Reals, Reals]:
    """The points (k, 3) of ``places[rows]`` on their surfaces, and how far they miss them, mm.

    Pinned coordinates take their planes' values; the free ones move by the least change that
    meets the linearised distances.
    """
    pins, curved = places.pins[rows], places.curved[rows]
    pinned = pins >= 0
    moved = np.where(pinned, plane_values(boxes)[pins], points)
    missed = np.zeros(len(rows))
    left = np.flatnonzero(curved[:, 0, 0] >= 0)
    for _ in range(STEPS):
        distance, slopes = _conditions(boxes, curved[left], moved[left], ~pinned[left])
        missed[left] = np.abs(distance).max(axis=1, initial=0.0)
        far = missed[left] > EXACT
        left = left[far]
        if len(left) == 0:
            break
        moved[left] -= _least_change(distance[far], slopes[far])
    return moved, missed


def _conditions(
    boxes: Boxes, curved: Indices, points: Reals, free: NDArray[np.bool_]
) -> tuple[Reals, Reals]:
    """Distances (k, 3) from the surfaces in every slot, and slopes (k, 3, 3) in free directions."""
    distance = np.zeros(curved.shape[:2])
    slopes = np.zeros((*curved.shape[:2], 3))
    for slot, choice in np.ndindex(curved.shape[1:]):
        rows = np.flatnonzero(curved[:, slot, choice] >= 0)
        if len(rows) == 0:
            continue
        found, normal = distances_and_normals(boxes, curved[rows, slot, choice], points[rows])
        if choice:
            nearer = found < distance[rows, slot]
            rows, found, normal = rows[nearer], found[nearer], normal[nearer]
        distance[rows, slot] = found
        slopes[rows, slot] = normal * free[rows]
    return distance, slopes


def _least_change(distance: Reals, slopes: Reals) -> Reals:
    """The shortest step (k, 3) with ``slopes`` · step = ``distance``."""
    gram = slopes @ np.swapaxes(slopes, 1, 2)
    diagonal = np.einsum("kss->ks", gram)
    gram[:, range(3), range(3)] += np.where(diagonal == 0, 1.0, 1e-14)  # empty slots do nothing
    return np.einsum("ksi,ks->ki", slopes, np.linalg.solve(gram, distance[..., None])[..., 0])
