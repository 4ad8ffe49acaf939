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
    in the mesh is near in the matrix; ``plane`` (2,): tilt and shift of the moving plane, last;
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

    def expand(self, vector: Reals) -> tuple[Reals, Reals, Reals]:
        """Displacements (n, 3), pressures (v,), plane (2,) of unknowns; prescribed ones 0."""
        padded = np.append(vector, 0.0)
        return padded[self.displacement], padded[self.pressure], padded[self.plane]


def fixed_displacements(
    mesh: Mesh, supports: Supports, moving_plane: str | None = None
) -> NDArray[np.bool_]:
    """Which displacements are held at zero, (n, 3); of the moving plane only the pin's z."""
    fixed = np.zeros(mesh.nodes.shape, bool)
    fixed[mesh.surface_nodes(*supports.clamped)] = True
    for surface, axis in supports.symmetry.items():
        fixed[mesh.surface_nodes(surface), axis] = True
    if moving_plane is not None:
        fixed[pin(mesh, moving_plane), 2] = True
    return fixed


def pin(mesh: Mesh, moving_plane: str) -> int:
    """The lowest node of a moving plane, (first of the lowest): the plane cannot slide past it.

    Nothing else would hold a cell along z; as no load acts along the plane, this takes no force.
    """
    nodes = mesh.surface_nodes(moving_plane)
    return int(nodes[mesh.nodes[nodes, 2].argmin()])


def number_unknowns(mesh: Mesh, supports: Supports, moving_plane: str | None = None) -> Numbering:
    """Number the free displacements, the pressures and the moving plane of a mesh."""
    free = np.zeros((len(mesh.nodes), 4), bool)
    free[:, :3] = ~fixed_displacements(mesh, supports, moving_plane)
    if moving_plane is not None:
        free[mesh.surface_nodes(moving_plane), 0] = False
    free[np.setdiff1d(np.arange(len(mesh.nodes)), mesh.tets), :3] = False
    free[mesh.vertices, 3] = True
    numbers = np.full(free.shape, -1, np.int32)
    numbers[free] = np.arange(free.sum(), dtype=np.int32)
    size = int(free.sum())
    plane = np.array([-1, -1] if moving_plane is None else [size, size + 1], np.int32)
    return Numbering(
        displacement=np.ascontiguousarray(numbers[:, :3]),
        pressure=numbers[mesh.vertices, 3],
        plane=plane,
        size=size + int((plane >= 0).sum()),
    )


def check_supports(mesh: Mesh, supports: Supports, moving_plane: str | None = None) -> None:
    """Raise ``ValueError`` if a moving plane is not plane or a rigid motion of the body is free."""
    if moving_plane is not None:
        if supports.clamped or moving_plane in supports.symmetry:
            raise ValueError(
                f"supports: the moving plane {moving_plane!r} goes with planes of symmetry other "
                "than itself, not with clamps."
            )
        x = mesh.nodes[mesh.surface_nodes(moving_plane), 0]
        if len(x) == 0 or np.ptp(x) > 1e-6 * mesh.size:
            raise ValueError(
                f"supports: the moving plane {moving_plane!r} must be a plane normal to x; "
                f"its nodes spread over {np.ptp(x) if len(x) else 0:.3g} mm along x."
            )
    node, axis = np.nonzero(fixed_displacements(mesh, supports, moving_plane))
    positions = (mesh.nodes - mesh.nodes.mean(axis=0)) / mesh.size
    rotations = [np.cross(about, positions) for about in np.eye(3)]
    motions = np.stack([*np.broadcast_to(np.eye(3)[:, None], (3, *positions.shape)), *rotations])
    held = motions[:, node, axis]  # (6, number of held displacements)
    values, vectors = np.linalg.eigh(held @ held.T)
    if values[0] <= 1e-12 * max(values[-1], 1.0):
        loosest = RIGID_MOTIONS[int(np.abs(vectors[:, 0]).argmax())]
        raise ValueError(f"supports: they leave the body free to move ({loosest}).")
