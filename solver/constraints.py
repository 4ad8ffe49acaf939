"""Prescribed displacements leave the system by getting no number."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from solver.arrays import Integers, Reals
from solver.mesh import Mesh

if TYPE_CHECKING:
    from solver.models import Supports

RIGID_MOTIONS = (
    "translation along x",
    "translation along y",
    "translation along z",
    "rotation about x",
    "rotation about y",
    "rotation about z",
)


@dataclass(frozen=True)
class Numbering:
    """Numbers of the unknowns, -1 where prescribed.

    ``displacement`` (n, 3) and ``pressure`` (v,), interleaved node by node so that what is near
    in the mesh is near in the matrix; ``size`` unknowns in all.
    """

    displacement: Integers
    pressure: Integers
    size: int

    def of_tets(self, mesh: Mesh) -> Integers:
        """Unknowns of each tetrahedron, (e, 34): 10 x 3 displacements, then 4 pressures."""
        displacement = self.displacement[mesh.tets].reshape(-1, 30)
        return np.hstack([displacement, self.pressure[mesh.tet_vertices]])

    def of_triangles(self, triangles: Integers) -> Integers:
        """Unknowns of each six-node triangle, (k, 18)."""
        return np.ascontiguousarray(self.displacement[triangles].reshape(-1, 18))

    def expand(self, vector: Reals) -> tuple[Reals, Reals]:
        """Displacements (n, 3) and pressures (v,) of a vector of unknowns; prescribed ones 0."""
        padded = np.append(vector, 0.0)
        return padded[self.displacement], padded[self.pressure]


def fixed_displacements(mesh: Mesh, supports: Supports) -> NDArray[np.bool_]:
    """Which displacements are held at zero, (n, 3)."""
    fixed = np.zeros(mesh.nodes.shape, bool)
    fixed[mesh.surface_nodes(*supports.clamped)] = True
    for surface, axis in supports.symmetry.items():
        fixed[mesh.surface_nodes(surface), axis] = True
    return fixed


def number_unknowns(mesh: Mesh, supports: Supports) -> Numbering:
    """Number the free displacements and the pressures of a mesh."""
    free = np.zeros((len(mesh.nodes), 4), bool)
    free[:, :3] = ~fixed_displacements(mesh, supports)
    free[np.setdiff1d(np.arange(len(mesh.nodes)), mesh.tets), :3] = False
    free[mesh.vertices, 3] = True
    numbers = np.full(free.shape, -1, np.int32)
    numbers[free] = np.arange(free.sum(), dtype=np.int32)
    return Numbering(
        displacement=np.ascontiguousarray(numbers[:, :3]),
        pressure=numbers[mesh.vertices, 3],
        size=int(free.sum()),
    )


def check_supports(mesh: Mesh, supports: Supports) -> None:
    """Raise ``ValueError`` if the supports leave a rigid motion of the body free."""
    node, axis = np.nonzero(fixed_displacements(mesh, supports))
    positions = (mesh.nodes - mesh.nodes.mean(axis=0)) / mesh.size
    rotations = [np.cross(about, positions) for about in np.eye(3)]
    motions = np.stack([*np.broadcast_to(np.eye(3)[:, None], (3, *positions.shape)), *rotations])
    held = motions[:, node, axis]  # (6, number of held displacements)
    values, vectors = np.linalg.eigh(held @ held.T)
    if values[0] <= 1e-12 * max(values[-1], 1.0):
        loosest = RIGID_MOTIONS[int(np.abs(vectors[:, 0]).argmax())]
        raise ValueError(f"supports: they leave the body free to move ({loosest}).")
