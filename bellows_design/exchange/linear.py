"""Linear cells for programs that take no quadratic ones: corners only, numbered anew."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bellows_design.geometry.face_names import CAVITY
from solver import Mesh


@dataclass(frozen=True)
class LinearMesh:
    """Four-node tetrahedra and named triangles, normals out of the solid.

    ``nodes`` (n, 3) in mm, ``tets`` (e, 4), ``surfaces`` name -> (k, 3).
    """

    nodes: NDArray[np.float64]
    tets: NDArray[np.int64]
    surfaces: dict[str, NDArray[np.int64]]


def linear(mesh: Mesh) -> LinearMesh:
    """The corners of a mesh: its edges and faces become straight and flat."""
    corners, tets = np.unique(mesh.tets[:, :4], return_inverse=True)
    number = np.full(len(mesh.nodes), -1)
    number[corners] = np.arange(len(corners))
    surfaces = {name: number[triangles[:, :3]] for name, triangles in mesh.surfaces.items()}
    return LinearMesh(mesh.nodes[corners], tets.reshape(-1, 4), surfaces)


def cavity_walls(mesh: LinearMesh) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Nodes (n, 3) and triangles (k, 3) around the air, normals out of it, into the walls.

    A pressure along the normals inflates, and the volume inside is positive.
    """
    triangles = mesh.surfaces[CAVITY][:, ::-1]
    used, numbers = np.unique(triangles, return_inverse=True)
    return mesh.nodes[used], numbers.reshape(-1, 3)
