"""The common edge of two surfaces: quadratic lines, their lengths and integrals along them."""

from __future__ import annotations

import numpy as np

from solver.arrays import Integers, Reals
from solver.errors import SolverError
from solver.mesh.elements import TRIANGLE_EDGES
from solver.mesh.faces import edge_keys
from solver.mesh.mesh import Mesh

POINTS, WEIGHTS = np.polynomial.legendre.leggauss(4)
"""Gauss points on a line from -1 to 1: exact for straight lines, to rounding for arcs as usual."""

SHAPES = np.stack([POINTS * (POINTS - 1) / 2, POINTS * (POINTS + 1) / 2, 1 - POINTS**2], axis=1)
SLOPES = np.stack([POINTS - 0.5, POINTS + 0.5, -2 * POINTS], axis=1)
"""Shape functions (q, 3) of both ends and the middle, and their derivatives."""


def common_edge(mesh: Mesh, first: str, second: str) -> Integers:
    """Lines (k, 3) on which two surfaces meet: both ends and the mid-node of each.

    Raises ``SolverError`` for an unknown surface, or if they have no edge in common.
    """
    own, other = mesh.triangles(first), mesh.triangles(second)
    size = len(mesh.nodes)
    keys, place = np.unique(edge_keys(own, TRIANGLE_EDGES, size), return_index=True)
    shared = place[np.isin(keys, edge_keys(other, TRIANGLE_EDGES, size))]
    if first == second or not len(shared):
        raise SolverError(f"mesh: the surfaces {first!r} and {second!r} have no edge in common.")
    columns = np.array([(*ends, 3 + k) for k, ends in enumerate(TRIANGLE_EDGES)])
    lines: Integers = own[:, columns].reshape(-1, 3)[np.sort(shared)]
    return lines


def along(values: Reals, lines: Integers) -> Reals:
    """Nodal values (n, 3) at the integration points of lines (k, 3): (k, q, 3)."""
    return np.einsum("qa,kai->kqi", SHAPES, values[lines])


def tangents(nodes: Reals, lines: Integers) -> Reals:
    """Derivatives (k, q, 3) of the position, mm, along lines (k, 3) from -1 to 1."""
    return np.einsum("qa,kai->kqi", SLOPES, nodes[lines])


def lengths(nodes: Reals, lines: Integers) -> Reals:
    """Length (k, q), mm, that each integration point of lines (k, 3) stands for."""
    sizes: Reals = WEIGHTS * np.linalg.norm(tangents(nodes, lines), axis=2)
    return sizes
