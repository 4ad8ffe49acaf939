"""Faces of tetrahedra: which lie on the boundary of the body."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from solver.arrays import Integers, Reals
from solver.errors import SolverError
from solver.mesh.elements import TETRAHEDRON_EDGES, TRIANGLE_EDGES

FACES = ((0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2))
"""Corners of a tetrahedron's faces, with outward normals."""


def outer_faces(nodes: Reals, tets: Integers) -> NDArray[np.int64]:
    """Keys (k,) of the faces of one tetrahedron (e, 10) only, with outward normals.

    Raises ``SolverError`` if more than two tetrahedra share a face.
    """
    faces, size = np.concatenate([tets[:, face] for face in FACES]), len(nodes)
    keys = face_keys(np.sort(faces, axis=1), size)
    _, first, counts = np.unique(keys, return_index=True, return_counts=True)
    if counts.max() > 2:
        place = place_of(nodes, faces[first[counts.argmax()]])
        raise SolverError(
            f"mesh: {counts.max()} tetrahedra share a face at {place} mm; two can, the others are "
            "given twice or overlap."
        )
    return face_keys(faces[first[counts == 1]], size)


def lie_outside(triangles: Integers, tets: Integers, outer: NDArray[np.int64], size: int) -> bool:
    """Whether triangles (k, 6) are ``outer`` faces, given by their keys, mid-nodes included.

    ``tets`` (e, 10) are the tetrahedra on ``size`` nodes.
    """
    return bool(
        np.isin(face_keys(triangles, size), outer).all()
        and np.isin(
            edge_keys(triangles, TRIANGLE_EDGES, size), edge_keys(tets, TETRAHEDRON_EDGES, size)
        ).all()
    )


def elements_at(tets: Integers, triangles: Integers) -> NDArray[np.int64]:
    """Numbers of the tetrahedra (e, 10) that have one of the ``triangles`` (k, 6) as a face."""
    size = int(max(tets.max(initial=0), triangles.max(initial=0))) + 1
    wanted = face_keys(np.sort(triangles[:, :3], axis=1), size)
    keys = np.stack([face_keys(np.sort(tets[:, face], axis=1), size) for face in FACES], axis=1)
    return np.flatnonzero(np.isin(keys, wanted).any(axis=1))


def edge_keys(
    cells: Integers, edges: tuple[tuple[int, int], ...], number_of_nodes: int
) -> NDArray[np.int64]:
    """One number for each edge of quadratic cells (k, m): its ends and its mid-node."""
    corners = cells.shape[1] - len(edges)
    ends = np.sort(np.stack([cells[:, edge] for edge in edges], axis=1).astype(np.int64), axis=2)
    places = ends[..., 0] * number_of_nodes + ends[..., 1]
    return (places * number_of_nodes + cells[:, corners:]).ravel()


def face_keys(triangles: Integers, number_of_nodes: int) -> NDArray[np.int64]:
    """One number for the corners of each triangle (k, 3 or more) in their cyclic order, (k,)."""
    corners = triangles[:, :3].astype(np.int64)
    turns = (np.arange(3) + corners.argmin(axis=1)[:, None]) % 3
    a, b, c = np.take_along_axis(corners, turns, axis=1).T
    return (a * number_of_nodes + b) * number_of_nodes + c


def place_of(nodes: Reals, triangle: Integers) -> str:
    """Centroid of a triangle's corners, as text."""
    return f"({', '.join(f'{x:.4g}' for x in nodes[triangle[:3]].mean(axis=0))})"
