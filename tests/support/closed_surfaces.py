"""What tests measure of meshes and surfaces."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from solver import Mesh
from solver.mesh.elements import tetrahedron_rule

Array = NDArray[np.float64]


def volume_of_cells(mesh: Mesh, nodes: Array) -> float:
    """Volume of the tetrahedra on nodes that may be elsewhere, mm³."""
    rule = tetrahedron_rule()
    jacobians = np.einsum("qad,eai->eqdi", rule.gradients, nodes[mesh.tets])
    return float((np.linalg.det(jacobians) * rule.weights).sum())


def volume_inside(triangles: NDArray[np.int32], nodes: Array) -> float:
    """Volume that flat triangles with outward normals enclose, mm³."""
    a, b, c = (nodes[triangles[:, corner]] for corner in range(3))
    return float(np.einsum("ki,ki->", a, np.cross(b, c)) / 6)


def open_edges(triangles: NDArray[np.int32]) -> int:
    """How many edges are not used once in either direction."""
    corners = [*range(3), 0]
    edges = np.concatenate([triangles[:, list(pair)] for pair in pairwise(corners)])
    forward, counts = np.unique(edges, axis=0, return_counts=True)
    backward = np.unique(edges[:, ::-1], axis=0)
    both = np.concatenate([forward, backward])
    _, uses = np.unique(both, axis=0, return_counts=True)
    return int((uses == 1).sum() + (counts > 1).sum())
