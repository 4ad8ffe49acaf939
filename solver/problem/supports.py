"""Prescribed displacements leave the system by getting no number."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from solver.arrays import Integers, Reals
from solver.linear.sparsity import connected_parts
from solver.mesh.elements import tetrahedron_rule
from solver.mesh.mesh import Mesh

if TYPE_CHECKING:
    from solver.problem.problem import Supports

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

    def gather(self, forces: Reals) -> Reals:
        """Nodal forces (n, 3) as a vector over the unknowns; those on given displacements drop."""
        vector = np.zeros(self.size)
        free = self.displacement >= 0
        vector[self.displacement[free]] = forces[free]
        return vector

    def expand(self, vector: Reals) -> tuple[Reals, Reals, Reals]:
        """Displacements (n, 3), pressures (v,), plane (2,) of unknowns; prescribed ones 0."""
        padded = np.append(vector, 0.0)
        return padded[self.displacement], padded[self.pressure], padded[self.plane]


def fixed_displacements(
    mesh: Mesh, supports: Supports, moving_plane: str | None = None
) -> NDArray[np.bool_]:
    """Which displacements are given, (n, 3); of the moving plane only the pin's z."""
    return ~np.isnan(given_displacements(mesh, supports, 1.0, moving_plane))


def given_displacements(
    mesh: Mesh, supports: Supports, load: float, moving_plane: str | None = None
) -> Reals:
    """Displacements (n, 3) in mm that are given at a fraction of the load, NaN where free.

    Raises ``ValueError`` if a prescribed motion has the wrong shape or infinite values.
    """
    given = np.full(mesh.nodes.shape, np.nan)
    given[mesh.surface_nodes(*supports.clamped)] = 0.0
    for surface, axis in supports.symmetry.items():
        given[mesh.surface_nodes(surface), axis] = 0.0
    if moving_plane is not None:
        given[pin(mesh, moving_plane), 2] = 0.0
    for surface in supports.prescribed:
        nodes = mesh.surface_nodes(surface)
        motion = _prescribed(mesh, supports, surface, load)
        given[nodes] = np.where(np.isnan(motion), given[nodes], motion)
    return given


def _prescribed(mesh: Mesh, supports: Supports, surface: str, load: float) -> Reals:
    """Displacements (k, 3) of a surface's nodes at a fraction of the load."""
    positions = mesh.nodes[mesh.surface_nodes(surface)]
    motion = np.asarray(supports.prescribed[surface](positions, load), float)
    if motion.shape != positions.shape:
        raise ValueError(
            f"supports: the motion of {surface!r} must have the shape {positions.shape}, "
            f"got {motion.shape}."
        )
    if np.isinf(motion).any():
        raise ValueError(f"supports: the motion of {surface!r} is infinite at load {load:g}.")
    return motion


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
    """Raise ``ValueError`` where supports contradict themselves or leave a rigid motion free."""
    for surface in supports.prescribed:
        _check_motion(mesh, supports, surface)
    if moving_plane is not None:
        _check_plane(mesh, supports, moving_plane)
    fixed = fixed_displacements(mesh, supports, moving_plane)
    parts = connected_parts(mesh.tets, len(mesh.nodes))
    for number in range(parts.max() + 1):
        nodes = np.flatnonzero(parts == number)
        loose = free_motions(mesh.nodes[nodes], fixed[nodes])
        if loose:
            middle = ", ".join(f"{x:.4g}" for x in mesh.nodes[nodes].mean(axis=0))
            which = f"part of the body around ({middle}) mm" if parts.max() else "body"
            raise ValueError(
                f"supports: they leave the {which} free to move in {len(loose)} "
                f"way{'s' * (len(loose) > 1)} ({', '.join(loose)})."
            )


def check_pressure(mesh: Mesh, fixed: NDArray[np.bool_]) -> None:
    """Raise ``ValueError`` if no free displacement can change the volume of the body.

    The hydrostatic pressure of an incompressible body is then known but for a constant. The
    derivative of the volume vanishes at inner nodes: one on the surface must be free.
    """
    rule = tetrahedron_rule()
    tangents = np.einsum("qad,eai->eqdi", rule.gradients, mesh.nodes[mesh.tets])
    cofactors = np.stack(
        [np.cross(tangents[:, :, (d + 1) % 3], tangents[:, :, (d + 2) % 3]) for d in range(3)],
        axis=2,
    )
    parts = np.einsum("q,qad,eqdi->eai", rule.weights, rule.gradients, cofactors)
    derivative = np.zeros(mesh.nodes.shape)
    np.add.at(derivative, mesh.tets, parts)
    if (np.abs(derivative) * ~fixed).max() <= LOOSE * np.abs(derivative).max():
        raise ValueError(
            "supports: they prescribe the whole surface of an incompressible body, which leaves "
            "its pressure undetermined; free some of it or give the material a bulk modulus."
        )


def free_motions(nodes: Reals, fixed: NDArray[np.bool_]) -> tuple[str, ...]:
    """Names of independent rigid motions of nodes (k, 3) that ``fixed`` (k, 3) does not hinder.

    The rotations are those about axes through the middle of the body; a body that may turn about
    one point elsewhere is free in as many ways.
    """
    node, axis = np.nonzero(fixed)
    positions = (nodes - nodes.mean(axis=0)) / np.linalg.norm(np.ptp(nodes, axis=0))
    rotations = [np.cross(about, positions) for about in np.eye(3)]
    motions = np.stack([*np.broadcast_to(np.eye(3)[:, None], (3, *positions.shape)), *rotations])
    held = motions[:, node, axis]  # (6, number of held displacements)
    values, vectors = np.linalg.eigh(held @ held.T)
    return tuple(
        RIGID_MOTIONS[k] for k in _leading(vectors[:, values <= LOOSE * max(values[-1], 1)])
    )


LOOSE = 1e-12


def _leading(basis: Reals) -> list[int]:
    """The k rows of a basis (m, k) that span the most: greedily, each after the ones before."""
    rest, chosen = basis.copy(), []
    for _ in range(basis.shape[1]):
        row = int(np.linalg.norm(rest, axis=1).argmax())
        direction = rest[row] / np.linalg.norm(rest[row])
        rest = rest - np.outer(rest @ direction, direction)
        chosen.append(row)
    return sorted(chosen)


def _check_motion(mesh: Mesh, supports: Supports, surface: str) -> None:
    start = _prescribed(mesh, supports, surface, 0.0)
    if (np.isnan(start) != np.isnan(_prescribed(mesh, supports, surface, 1.0))).any():
        raise ValueError(
            f"supports: the motion of {surface!r} must leave the same components free (NaN) "
            "at every load."
        )
    if np.nanmax(np.abs(start), initial=0.0) > 1e-9 * mesh.size:
        raise ValueError(
            f"supports: the motion of {surface!r} must be zero at no load, got "
            f"{np.nanmax(np.abs(start)):.3g} mm."
        )


def _check_plane(mesh: Mesh, supports: Supports, moving_plane: str) -> None:
    if supports.clamped or supports.prescribed or moving_plane in supports.symmetry:
        raise ValueError(
            f"supports: the moving plane {moving_plane!r} goes with planes of symmetry other "
            "than itself, not with clamps or prescribed motions."
        )
    x = mesh.nodes[mesh.surface_nodes(moving_plane), 0]
    if len(x) == 0 or np.ptp(x) > 1e-6 * mesh.size:
        raise ValueError(
            f"supports: the moving plane {moving_plane!r} must be a plane normal to x; "
            f"its nodes spread over {np.ptp(x) if len(x) else 0:.3g} mm along x."
        )
