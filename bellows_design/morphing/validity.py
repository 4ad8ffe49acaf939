"""Elements of a morphed mesh: none may fold."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from solver.arrays import Integers, Reals
from solver.mesh.elements import TETRAHEDRON_EDGES
from solver.mesh.mid_nodes import SMALLEST_RATIO, jacobian_ratios, relaxed

STRAIGHT = 1e-12
"""mm. Mid-nodes nearer to the middles of their edges make no element curved."""


def unfolded(nodes: Reals, tets: Integers) -> tuple[Reals, str]:
    """The nodes (n, 3) with mid-nodes of nearly folded elements moved back, and what is folded yet.

    As for a mesh that is new: mid-nodes leave their surface only where elements need it. The second
    is empty if no element is folded.
    """
    worst, ratio = _worst(nodes, tets)
    if 0 < ratio < SMALLEST_RATIO or (ratio <= 0 and _volumes(nodes, tets).min() > 0):
        nodes = relaxed(nodes, tets)
        worst, ratio = _worst(nodes, tets)
    if ratio >= SMALLEST_RATIO:
        return nodes, ""
    x, y, z = nodes[tets[worst, :4]].mean(axis=0)
    place = f"({x:.2f}, {y:.2f}, {z:.2f}) mm"
    return nodes, f"tetrahedron {worst} near {place} folds (Jacobian ratio {ratio:.2g})"


def _worst(nodes: Reals, tets: Integers) -> tuple[int, float]:
    """The element of the least ratio of smallest to mean Jacobian, and that ratio.

    Straight elements have one of 1 or -1, by the sign of their volume.
    """
    volumes = _volumes(nodes, tets)
    if volumes.min() <= 0:
        return int(volumes.argmin()), -1.0
    curved = np.flatnonzero(_bent(nodes, tets))
    if len(curved) == 0:
        return 0, 1.0
    ratios = jacobian_ratios(nodes, tets[curved])
    worst = int(ratios.argmin())
    return int(curved[worst]), float(ratios[worst])


def _volumes(nodes: Reals, tets: Integers) -> Reals:
    """Six times the volumes of the tetrahedra with straight edges, (e,), mm³."""
    a, b, c, d = (nodes[corner] for corner in tets[:, :4].T)
    volumes: Reals = np.einsum("ei,ei->e", np.cross(b - a, c - a), d - a)
    return volumes


def _bent(nodes: Reals, tets: Integers) -> NDArray[np.bool_]:
    """Whether each element has a mid-node beside the middle of its edge."""
    bent = np.zeros(len(tets), bool)
    for middle, (a, b) in enumerate(TETRAHEDRON_EDGES, start=4):
        offset = nodes[tets[:, middle]] - (nodes[tets[:, a]] + nodes[tets[:, b]]) / 2
        bent |= np.abs(offset).max(axis=1) > STRAIGHT
    return bent
