"""Numbering of the unknowns; prescribed displacements get no number."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from solver.arrays import Integers, Reals
from solver.mesh.mesh import Mesh
from solver.problem.supports import Supports, fixed_displacements


@dataclass(frozen=True)
class Numbering:
    """Numbers of the unknowns, -1 where prescribed.

    ``displacement`` (n, 3) and ``pressure`` (v,), interleaved node by node, so that neighbours in
    the mesh are neighbours in the matrix; ``plane`` (2,): tilt and shift of the moving plane, last;
    ``size`` unknowns in all. Nodes on the moving plane have no x, and their z is the height in
    the plane.
    """

    displacement: Integers
    pressure: Integers
    plane: Integers
    size: int

    def of_tets(self, mesh: Mesh) -> Integers:
        """Unknowns of each tetrahedron, (e, 34): 10 x 3 displacements, then 4 pressures."""
        displacement = self.displacement[mesh.tets].reshape(-1, 30)
        return np.hstack([displacement, self.pressure[mesh.tet_vertices]])

    def of_triangles(self, triangles: Integers) -> Integers:
        """Unknowns of each six-node triangle, (k, 18)."""
        return np.ascontiguousarray(self.displacement[triangles].reshape(-1, 18))

    def gather(self, forces: Reals) -> Reals:
        """Nodal forces (n, 3) as a vector over the unknowns, without those on given ones."""
        vector = np.zeros(self.size)
        free = self.displacement >= 0
        vector[self.displacement[free]] = forces[free]
        return vector

    def expand(self, vector: Reals) -> tuple[Reals, Reals, Reals]:
        """Displacements (n, 3), pressures (v,), plane (2,) of unknowns; prescribed ones 0."""
        padded = np.append(vector, 0.0)
        return padded[self.displacement], padded[self.pressure], padded[self.plane]


def number_unknowns(mesh: Mesh, supports: Supports, moving_plane: str | None = None) -> Numbering:
    """Number the free displacements, the pressures and the moving plane of a mesh.

    The pressures of a node between regions follow each other.
    """
    rank = np.arange(len(mesh.vertices)) - np.searchsorted(mesh.vertices, mesh.vertices)
    free = np.zeros((len(mesh.nodes), 4 + rank.max(initial=0)), bool)
    free[:, :3] = ~fixed_displacements(mesh, supports, moving_plane)
    if moving_plane is not None:
        free[mesh.surface_nodes(moving_plane), 0] = False
    free[np.setdiff1d(np.arange(len(mesh.nodes)), mesh.tets), :3] = False
    free[mesh.vertices, 3 + rank] = True
    numbers = np.full(free.shape, -1, np.int32)
    numbers[free] = np.arange(free.sum(), dtype=np.int32)
    size = int(free.sum())
    plane = np.array([-1, -1] if moving_plane is None else [size, size + 1], np.int32)
    return Numbering(
        displacement=np.ascontiguousarray(numbers[:, :3]),
        pressure=numbers[mesh.vertices, 3 + rank],
        plane=plane,
        size=size + int((plane >= 0).sum()),
    )
