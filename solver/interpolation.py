"""Carry a solution to another mesh of the same body, to start Newton from there."""

from __future__ import annotations

import numpy as np
from numba import njit, prange
from numpy.typing import NDArray

from solver.arrays import Integers, Reals
from solver.elements import TETRAHEDRON_EDGES, quadratic_shapes
from solver.mesh import Mesh
from solver.results import Solution

CANDIDATES = 24


def transfer(solution: Solution, finer_mesh: Mesh) -> tuple[Reals, Reals]:
    """Displacement (n, 3) and hydrostatic pressure (v,) of a solution on another mesh.

    Interpolates with the shape functions of the element each node lies in; a node slightly
    outside of the old mesh takes the extrapolation of the element it is least outside of. Pass
    the result as ``initial`` to ``solver.solve``.
    """
    mesh = solution.problem.mesh
    element, barycentric = locate(mesh, finer_mesh.nodes)
    shapes = quadratic_shapes(barycentric, TETRAHEDRON_EDGES)
    displacement = np.einsum("na,nai->ni", shapes, solution.displacement[mesh.tets[element]])
    corners = solution.hydrostatic_pressure[mesh.tet_vertices[element]]
    pressure = np.einsum("na,na->n", barycentric, corners)
    return displacement, pressure[finer_mesh.vertices]


def locate(mesh: Mesh, points: Reals) -> tuple[NDArray[np.int64], Reals]:
    """The element each point (k, 3) lies in, (k,), and barycentric coordinates in it, (k, 4)."""
    from scipy.spatial import cKDTree

    centres = mesh.nodes[mesh.tets].mean(axis=1)
    count = min(CANDIDATES, len(centres))
    _, near = cKDTree(centres).query(points, k=count)
    element = np.zeros(len(points), np.int64)
    barycentric = np.empty((len(points), 4))
    near = near.reshape(len(points), count)
    _locate(mesh.nodes, mesh.tets, points, near, element, barycentric)
    return element, barycentric


@njit(cache=True, error_model="numpy", parallel=True)
def _locate(
    nodes: Reals,
    tets: Integers,
    points: Reals,
    near: NDArray[np.int64],
    element: NDArray[np.int64],
    barycentric: Reals,
) -> None:
    """Of the elements ``near`` (k, c) each point, the one it is in or least outside of."""
    for p in prange(len(points)):
        best = -np.inf
        for candidate in near[p]:
            local = _inverse_map(nodes[tets[candidate]], points[p])
            inside = local.min()
            if inside > best:
                best = inside
                element[p] = candidate
                barycentric[p] = local
            if best >= 0.0:
                break


@njit(cache=True, error_model="numpy")
def _inverse_map(x: Reals, point: Reals) -> Reals:
    """Barycentric coordinates (4,) of a point in the ten-node tetrahedron x (10, 3), by Newton."""
    edge_a = np.array([0, 1, 0, 0, 2, 1])
    edge_b = np.array([1, 2, 2, 3, 3, 3])
    local = np.full(4, 0.25)
    slopes = np.empty((4, 3))  # dX / dL_k
    for _ in range(20):
        position = np.zeros(3)
        slopes[:] = 0.0
        for k in range(4):
            position += local[k] * (2.0 * local[k] - 1.0) * x[k]
            slopes[k] += (4.0 * local[k] - 1.0) * x[k]
        for e in range(6):
            a, b = edge_a[e], edge_b[e]
            position += 4.0 * local[a] * local[b] * x[4 + e]
            slopes[a] += 4.0 * local[b] * x[4 + e]
            slopes[b] += 4.0 * local[a] * x[4 + e]
        step = np.linalg.solve((slopes[1:] - slopes[0]).T, point - position)
        local[1:] += step
        local[0] -= step.sum()
        if np.abs(step).max() < 1e-12:
            return local
    return np.full(4, -1e3)  # far outside of a curved element: the map has no inverse there
