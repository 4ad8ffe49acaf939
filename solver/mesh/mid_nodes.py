"""Curved quadratic tetrahedra with a positive Jacobian everywhere.

Mid-nodes on a curved surface can make the Jacobian determinant of an element negative somewhere:
the element is folded. Its mid-nodes are then moved towards the middles of the straight edges, which
are always valid, only as far as needed.
"""

from __future__ import annotations

import itertools

import numpy as np

from solver.arrays import Integers, Reals
from solver.mesh.elements import TETRAHEDRON_EDGES, quadratic_gradients

SMALLEST_RATIO = 0.1
"""Least ratio of smallest to mean Jacobian determinant of a valid element."""

SWEEPS = 12
"""Most halvings of a mid-node's distance from the straight edge."""


def jacobian_ratios(nodes: Reals, tets: Integers) -> Reals:
    """Smallest Jacobian determinant of each tetrahedron over its mean, (e,); at most 1.

    The determinant is a cubic polynomial; it is sampled on the twenty points that determine it
    (vertices, thirds of edges, middles of faces) and at the middles of the edges.
    """
    determinants = _determinants(nodes[tets], quadratic_gradients(_lattice(), TETRAHEDRON_EDGES))
    smallest: Reals = determinants.min(axis=1) / np.abs(determinants.mean(axis=1))
    return smallest


def relaxed(nodes: Reals, tets: Integers) -> Reals:
    """``nodes`` (n, 3) with the mid-nodes of folded or nearly folded elements moved back."""
    middles = tets[:, 4:]
    ends = np.stack([tets[:, list(edge)] for edge in TETRAHEDRON_EDGES], axis=1)
    straight = nodes.copy()
    straight[middles] = nodes[ends].mean(axis=2)
    share = np.ones(len(nodes))
    moved, bad = nodes, jacobian_ratios(nodes, tets) < SMALLEST_RATIO
    for _ in range(SWEEPS):
        if not bad.any():
            break
        changed = np.zeros(len(nodes), bool)
        changed[middles[bad]] = True
        share[changed] *= 0.5
        moved = straight + share[:, None] * (nodes - straight)
        around = changed[middles].any(axis=1)  # no other element has another shape than before
        bad[around] = jacobian_ratios(moved, tets[around]) < SMALLEST_RATIO
    return moved


def _determinants(corners: Reals, gradients: Reals) -> Reals:
    """Jacobian determinants (e, q) of elements (e, 10, 3) at points with gradients (q, 10, 3).

    One product of two matrices gives all Jacobians: that is what takes the time.
    """
    weights = gradients.transpose(2, 0, 1).reshape(-1, 10)
    positions = corners.transpose(1, 2, 0).reshape(10, -1)
    a, b, c = (weights @ positions).reshape(3, len(gradients), 3, len(corners)).swapaxes(1, 2)
    determinants: Reals = a[0] * (b[1] * c[2] - b[2] * c[1])
    determinants += a[1] * (b[2] * c[0] - b[0] * c[2])
    determinants += a[2] * (b[0] * c[1] - b[1] * c[0])
    return determinants.T


def _lattice() -> Reals:
    """Barycentric coordinates (26, 4): the cubic lattice and the middles of the edges."""
    thirds = [p for p in itertools.product(range(4), repeat=4) if sum(p) == 3]
    middles = [np.eye(4)[list(edge)].mean(axis=0) for edge in TETRAHEDRON_EDGES]
    return np.concatenate([np.array(thirds) / 3, middles])
