"""Stress singularities of the ideal body: sharp re-entrant edges and rims of clamps.

The elastic solution is singular there: the stress grows without bound as the mesh is refined. A
real part has no such edge: a printed one is rounded by about half a line's width. So stress nearer
than ``Problem.sharp_edge_radius`` does not count. Edges under pressure always count: a high stress
there shows that a fillet is missing.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from solver.arrays import Integers, Reals
from solver.mesh.faces import face_keys
from solver.mesh.mesh import Mesh
from solver.problem.problem import Problem

SMALLEST_TURN = 40.0
"""Least angle between the normals of two faces that meet in a sharp edge, degrees."""

SAMPLES = np.linspace(-1.0, 1.0, 9)
"""Sampling points of quadratic edges: dense enough for radii above an eighth of an edge."""


def trusted_nodes(problem: Problem) -> NDArray[np.bool_]:
    """Which nodes are farther than ``sharp_edge_radius`` from all sharp edges, (n,)."""
    from scipy.spatial import cKDTree

    mesh = problem.mesh
    edges = np.concatenate([_reentrant_edges(mesh, _unloaded(problem)), _rims(problem)])
    if problem.sharp_edge_radius == 0 or len(edges) == 0:
        return np.ones(len(mesh.nodes), bool)
    distance, _ = cKDTree(_along(mesh.nodes[edges])).query(mesh.nodes)
    return distance > problem.sharp_edge_radius


def _unloaded(problem: Problem) -> Integers:
    """Outer triangles (k, 6) that are neither pressurised nor cuts through the body."""
    planes = set(problem.supports.symmetry) - set(problem.supports.immovable)
    cuts = {*planes, problem.moving_plane, *problem.pressurised}
    mesh = problem.mesh
    triangles = mesh.triangles(*(n for n in mesh.surfaces if n not in cuts))
    _, first = np.unique(triangles, axis=0, return_index=True)  # surfaces may overlap
    triangles = triangles[np.sort(first)]
    outer: Integers = triangles[np.isin(face_keys(triangles, len(mesh.nodes)), mesh.outer_faces)]
    return outer


def _rims(problem: Problem) -> Integers:
    """Edges (k, 3) around the surfaces that are clamped, or held along two axes."""
    edges, _ = _edges(problem.mesh.triangles(*problem.supports.immovable))
    _, first, count = np.unique(edges[:, :2], axis=0, return_index=True, return_counts=True)
    return edges[first[count == 1]]


def _reentrant_edges(mesh: Mesh, triangles: Integers) -> Integers:
    """Edges (k, 3) at which two of the triangles meet with more than 180 degrees of solid."""
    edges, owner = _edges(triangles)
    order = np.lexsort((edges[:, 1], edges[:, 0]))
    same = (edges[order[1:], :2] == edges[order[:-1], :2]).all(axis=1)
    one, other = order[:-1][same], order[1:][same]
    normals, centres = _normals(mesh, triangles), mesh.nodes[triangles[:, :3]].mean(axis=1)
    middle = mesh.nodes[edges[one, 2]]
    first, second = normals[owner[one]], normals[owner[other]]
    sharp = np.einsum("ki,ki->k", first, second) < np.cos(np.radians(SMALLEST_TURN))
    rising = np.einsum("ki,ki->k", centres[owner[other]] - middle, first) > 0
    return edges[one[sharp & rising]]


def _edges(triangles: Integers) -> tuple[Integers, Integers]:
    """All edges (3 k, 3) of triangles (k, 6): ends in ascending order, mid-node; and owners."""
    edges = np.concatenate(
        [triangles[:, [a, b, c]] for a, b, c in ((0, 1, 3), (1, 2, 4), (2, 0, 5))]
    )
    edges[:, :2] = np.sort(edges[:, :2], axis=1)
    return edges, np.tile(np.arange(len(triangles), dtype=np.int32), 3)


def _normals(mesh: Mesh, triangles: Integers) -> Reals:
    """Unit normals (k, 3) of the triangles' planes."""
    a, b, c = (mesh.nodes[triangles[:, corner]] for corner in range(3))
    normals = np.cross(b - a, c - a)
    unit: Reals = normals / np.linalg.norm(normals, axis=1, keepdims=True)
    return unit


def _along(edges: Reals) -> Reals:
    """Points on quadratic edges (k, 3 nodes, 3)."""
    t = SAMPLES[:, None]
    shapes = np.hstack([t * (t - 1) / 2, t * (t + 1) / 2, 1 - t**2])
    points: Reals = np.einsum("sa,kai->ksi", shapes, edges).reshape(-1, 3)
    return points
