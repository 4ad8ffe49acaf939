"""Checks of supports: contradictions, free rigid motions, an undetermined pressure."""

from __future__ import annotations

import itertools
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from solver.arrays import Reals
from solver.errors import SolverError
from solver.mesh.connectivity import connected_parts
from solver.mesh.elements import tetrahedron_rule
from solver.mesh.mesh import Mesh
from solver.problem.materials import Distribution
from solver.problem.springs import Spring, held_directions
from solver.problem.supports import Supports, fixed_displacements, prescribed_motion

RIGID_MOTIONS = (
    "translation along x",
    "translation along y",
    "translation along z",
    "rotation about x",
    "rotation about y",
    "rotation about z",
)

NEGLIGIBLE = 1e-12
"""Fraction of the largest value below which a value counts as zero."""


def check_supports(
    mesh: Mesh, supports: Supports, moving_plane: str | None = None, springs: Sequence[Spring] = ()
) -> None:
    """Raise ``SolverError`` where supports contradict themselves or leave a rigid motion free.

    Springs hold rigid motions too.
    """
    for surface in supports.prescribed:
        _check_motion(mesh, supports, surface)
    _check_agreement(mesh, supports)
    if moving_plane is not None:
        _check_plane(mesh, supports, moving_plane)
    fixed = fixed_displacements(mesh, supports, moving_plane)
    parts = connected_parts(mesh.tets, len(mesh.nodes))
    for number in range(parts.max() + 1):
        nodes = np.flatnonzero(parts == number)
        held = held_directions(mesh, springs, nodes)
        free = free_motions(mesh.nodes[nodes], fixed[nodes], held)
        if free:
            middle = ", ".join(f"{x:.4g}" for x in mesh.nodes[nodes].mean(axis=0))
            which = f"part of the body around ({middle}) mm" if parts.max() else "body"
            raise SolverError(
                f"supports: they leave the {which} free to move in {len(free)} "
                f"way{'s' * (len(free) > 1)} ({', '.join(free)})."
            )


def check_pressure(distribution: Distribution, fixed: NDArray[np.bool_]) -> None:
    """Raise ``SolverError`` if free displacements cannot change some volume that is incompressible.

    The hydrostatic pressure there is then known but for a constant. Each connected part of an
    incompressible region may have its own constant; no sum of their volumes may be the same
    whatever the free displacements (n, 3) are. The derivative of a volume vanishes at its inner
    nodes, so a displacement on its surface must be free.
    """
    mesh = distribution.mesh
    compliant = np.array([each.compliance > 0 for each in distribution.materials])
    part = connected_parts(mesh.tet_vertices, len(mesh.vertices))[mesh.tet_vertices[:, 0]]
    derivatives, regions = [], []
    for number in np.unique(part[~compliant[distribution.of_tet]]):
        derivative = _volume_derivative(mesh, part == number)
        derivatives.append((derivative * ~fixed).ravel() / np.linalg.norm(derivative))
        regions.append(int(mesh.region_of_tet[part == number][0]))
    if not derivatives:
        return
    _, values, vectors = np.linalg.svd(np.stack(derivatives, axis=1), full_matrices=False)
    if values[-1] <= NEGLIGIBLE * max(values[0], 1.0):
        raise SolverError(_undetermined(mesh, regions[int(np.abs(vectors[-1]).argmax())]))


def _undetermined(mesh: Mesh, region: int) -> str:
    """The sentence on a region whose pressure the supports leave undetermined."""
    name = mesh.region_names[region]
    which = f"region {name!r}" if name else "body"
    return (
        f"supports: they prescribe the whole surface of an incompressible {which}, which leaves "
        "its pressure undetermined; free some of it or give the material a bulk modulus."
    )


def _volume_derivative(mesh: Mesh, elements: NDArray[np.bool_]) -> Reals:
    """Derivative (n, 3) of the volume of some elements by the positions of nodes, mm^2."""
    rule, tets = tetrahedron_rule(), mesh.tets[elements]
    tangents = np.einsum("qad,eai->eqdi", rule.gradients, mesh.nodes[tets], optimize=True)
    cofactors = np.stack(
        [np.cross(tangents[:, :, (d + 1) % 3], tangents[:, :, (d + 2) % 3]) for d in range(3)],
        axis=2,
    )
    weighted = rule.weights[:, None, None] * rule.gradients
    parts = np.einsum("qad,eqdi->eai", weighted, cofactors, optimize=True).reshape(-1, 3)
    nodes, count = tets.ravel(), len(mesh.nodes)
    return np.stack([np.bincount(nodes, part, count) for part in parts.T], axis=1)


def free_motions(
    nodes: Reals, fixed: NDArray[np.bool_], sprung: tuple[NDArray[np.int64], Reals] | None = None
) -> tuple[str, ...]:
    """Names of independent rigid motions of nodes (k, 3) that ``fixed`` (k, 3) does not prevent.

    Nor ``sprung``: indices (m,) of nodes that springs hold, and directions (m, 3) along which.
    Rotations are about axes through the centroid of the nodes; a body that is free to rotate about
    another point has as many free motions.
    """
    node, axis = np.nonzero(fixed)
    positions = (nodes - nodes.mean(axis=0)) / np.linalg.norm(np.ptp(nodes, axis=0))
    rotations = [np.cross(about, positions) for about in np.eye(3)]
    motions = np.stack([*np.broadcast_to(np.eye(3)[:, None], (3, *positions.shape)), *rotations])
    held = motions[:, node, axis]  # (6, number of held displacements)
    if sprung is not None:
        along = np.einsum("rmi,mi->rm", motions[:, sprung[0]], sprung[1])
        held = np.concatenate([held, along], axis=1)
    values, vectors = np.linalg.eigh(held @ held.T)
    return tuple(
        RIGID_MOTIONS[k] for k in _leading(vectors[:, values <= NEGLIGIBLE * max(values[-1], 1)])
    )


def _leading(basis: Reals) -> list[int]:
    """Rows that pivoting chooses from a basis (m, k): k of them, each the largest remaining one."""
    rest, chosen = basis.copy(), []
    for _ in range(basis.shape[1]):
        row = int(np.linalg.norm(rest, axis=1).argmax())
        direction = rest[row] / np.linalg.norm(rest[row])
        rest = rest - np.outer(rest @ direction, direction)
        chosen.append(row)
    return sorted(chosen)


def _check_motion(mesh: Mesh, supports: Supports, surface: str) -> None:
    start = prescribed_motion(mesh, supports, surface, 0.0)
    if (np.isnan(start) != np.isnan(prescribed_motion(mesh, supports, surface, 1.0))).any():
        raise SolverError(
            f"supports: the motion of {surface!r} must leave the same components free (NaN) "
            "at every load."
        )
    if np.nanmax(np.abs(start), initial=0.0) > 1e-9 * mesh.size:
        raise SolverError(
            f"supports: the motion of {surface!r} must be zero at no load, got "
            f"{np.nanmax(np.abs(start)):.3g} mm."
        )


LOADS_COMPARED = (1.0, 0.5, 0.25)
"""Fractions of the load at which motions of neighbouring surfaces are compared."""


def _check_agreement(mesh: Mesh, supports: Supports) -> None:
    """Raise ``SolverError`` where two surfaces lead a shared node to different places."""
    for one, other in itertools.combinations(supports.prescribed, 2):
        nodes, first, second = np.intersect1d(
            mesh.surface_nodes(one), mesh.surface_nodes(other), return_indices=True
        )
        for load in LOADS_COMPARED if len(nodes) else ():
            motions = (
                prescribed_motion(mesh, supports, one, load)[first],
                prescribed_motion(mesh, supports, other, load)[second],
            )
            apart = np.nan_to_num(np.abs(motions[0] - motions[1]), nan=0.0)
            if apart.max() > 1e-9 * mesh.size:
                row, axis = np.unravel_index(apart.argmax(), apart.shape)
                place = ", ".join(f"{x:.4g}" for x in mesh.nodes[nodes[row]])
                raise SolverError(
                    f"supports: at {100 * load:g} % of the load the motions of {one!r} and "
                    f"{other!r} lead the node at ({place}) mm along {'xyz'[axis]} by "
                    f"{motions[0][row, axis]:.4g} and {motions[1][row, axis]:.4g} mm; they must "
                    "agree on shared nodes."
                )


def _check_plane(mesh: Mesh, supports: Supports, moving_plane: str) -> None:
    others = supports.clamped or supports.prescribed or supports.nodes
    if others or moving_plane in supports.symmetry:
        raise SolverError(
            f"supports: the moving plane {moving_plane!r} goes with planes of symmetry other "
            "than itself, not with clamps, held nodes or prescribed motions."
        )
    x = mesh.nodes[mesh.surface_nodes(moving_plane), 0]
    if len(x) == 0 or np.ptp(x) > 1e-6 * mesh.size:
        raise SolverError(
            f"supports: the moving plane {moving_plane!r} must be a plane normal to x; "
            f"its nodes spread over {np.ptp(x) if len(x) else 0:.3g} mm along x."
        )
