"""Linear springs between the body and the ground: force = -stiffness times displacement.

They are without force in the undeformed body, and act in fixed directions. A spring of stiffness k
along the unit vector d has the matrix k d d^T.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array

from solver.arrays import Integers, Reals
from solver.errors import SolverError
from solver.mesh.elements import triangle_rule
from solver.mesh.mesh import Mesh
from solver.problem.loads import node_at
from solver.problem.vectors import finite

Vector: TypeAlias = tuple[float, float, float]
Stiffness: TypeAlias = Vector | tuple[Vector, Vector, Vector]

ROUNDING = 1e-9
"""Fraction of a matrix's largest entry by which it may fail to be symmetric and semidefinite."""


@dataclass(frozen=True)
class FoundationSpring:
    """Springs all over a surface: an elastic foundation.

    Attributes:
        surface: name of the surface.
        stiffness: force per displacement and per area of the undeformed surface, N/mm^3: one number
            for each direction x, y, z, or a symmetric matrix without negative eigenvalues.

            *Shape:* (3,) or (3, 3).

    Raises:
        SolverError: another shape, or a stiffness that is negative, not symmetric or not finite.

    Examples:
        >>> from solver import FoundationSpring, Ogden, Problem, Supports, Traction, solve
        >>> from solver.mesh import block
        >>> bed = FoundationSpring("z0", (0, 0, 0.05))  # N/mm^3, along z alone
        >>> held = Supports(symmetry={"x0": 0, "y0": 1})
        >>> push = Traction("z1", (0, 0, -0.01))
        >>> rubber = Ogden.neo_hooke(0.5)
        >>> cube = block((4, 4, 4), (1, 1, 1))
        >>> sunk = solve(Problem(cube, rubber, held, loads=(push,), springs=(bed,)))
        >>> print(f"{sunk.displacement[:, 2].max():.3f} mm")  # 0.01 / 0.05 at the bottom
        -0.200 mm
    """

    surface: str
    stiffness: Stiffness

    def __post_init__(self) -> None:
        object.__setattr__(self, "stiffness", _checked(self.stiffness, "N/mm^3"))


@dataclass(frozen=True)
class NodeSpring:
    """A spring on a node.

    Attributes:
        position: of the node in the undeformed body.

            *Shape:* (3,) in mm.
        stiffness: force per displacement, N/mm: one number for each direction x, y, z, or a
            symmetric matrix without negative eigenvalues.

            *Shape:* (3,) or (3, 3).

    Raises:
        SolverError: another shape, or a stiffness that is negative, not symmetric or not finite.

    Examples:
        >>> from solver import NodeSpring, Ogden, Problem, Supports, Traction, solve
        >>> from solver.mesh import block
        >>> spring = NodeSpring((30, 0, 0), (0, 0, 0.05))  # N/mm
        >>> bend = Traction("x1", (0, 0, -0.001))
        >>> bar = block((30, 4, 4), (6, 1, 1))
        >>> rubber = Ogden.neo_hooke(0.5)
        >>> free = solve(Problem(bar, rubber, Supports(("x0",)), loads=(bend,)))
        >>> held = solve(Problem(bar, rubber, Supports(("x0",)), loads=(bend,), springs=(spring,)))
        >>> print(f"{free.displacement[:, 2].min():.2f} mm, {held.displacement[:, 2].min():.2f} mm")
        -4.16 mm, -0.49 mm
    """

    position: Vector
    stiffness: Stiffness

    def __post_init__(self) -> None:
        position = finite("springs: the position of a node (mm)", self.position, (3,))
        object.__setattr__(self, "position", tuple(float(x) for x in position))
        object.__setattr__(self, "stiffness", _checked(self.stiffness, "N/mm"))


Spring: TypeAlias = FoundationSpring | NodeSpring


def stiffness_matrix(mesh: Mesh, springs: Sequence[Spring]) -> csr_array:
    """Matrix (3 n, 3 n) of all ``springs`` over the displacements of the nodes, N/mm.

    That of a foundation is the integral of N_a N_b times its stiffness, by a rule that is exact on
    flat triangles. Raises ``SolverError`` for a spring on no node.
    """
    size = mesh.nodes.size
    total = csr_array((size, size))
    for spring in springs:
        nodes, blocks = _blocks(mesh, spring)
        dofs = (3 * nodes[:, :, None] + np.arange(3)).reshape(len(nodes), -1)
        width = dofs.shape[1]
        rows, columns = np.repeat(dofs, width, axis=1).ravel(), np.tile(dofs, width).ravel()
        total = total + csr_array((blocks.ravel(), (rows, columns)), shape=(size, size))
    return csr_array(total)


def held_directions(
    mesh: Mesh, springs: Sequence[Spring], among: NDArray[np.int64]
) -> tuple[NDArray[np.int64], Reals]:
    """Which of the nodes ``among`` (ascending) springs hold, and along which unit vectors.

    Indices into ``among`` (k,) and vectors (k, 3).
    """
    nodes, directions = [np.zeros(0, np.int64)], [np.zeros((0, 3))]
    for spring in springs:
        values, vectors = np.linalg.eigh(_matrix(spring.stiffness))
        held = vectors.T[values > ROUNDING * max(values[-1], 0.0)]
        at = np.flatnonzero(np.isin(among, _nodes(mesh, spring)))
        nodes.append(np.repeat(at, len(held)))
        directions.append(np.tile(held, (len(at), 1)))
    return np.concatenate(nodes), np.concatenate(directions)


def sprung_surfaces(springs: Sequence[Spring]) -> tuple[str, ...]:
    """Names of the surfaces with springs."""
    return tuple(each.surface for each in springs if isinstance(each, FoundationSpring))


def check_springs(springs: Sequence[Spring], moving_plane: str | None) -> tuple[Spring, ...]:
    """Springs as a tuple. Raises ``SolverError`` for anything else, and with a moving plane."""
    if not isinstance(springs, Sequence) or isinstance(springs, str):
        raise SolverError(f"springs: needs a tuple of springs, got {springs!r}.")
    for spring in springs:
        if not isinstance(spring, FoundationSpring | NodeSpring):
            raise SolverError(f"springs: needs FoundationSpring or NodeSpring, got {spring!r}.")
    if springs and moving_plane is not None:
        raise SolverError("springs: a cell with a moving plane takes none.")
    return tuple(springs)


def _blocks(mesh: Mesh, spring: Spring) -> tuple[Integers, Reals]:
    """Nodes (k, m) of a spring's cells and their matrices (k, m, 3, m, 3), N/mm."""
    nodes, matrix = _nodes(mesh, spring), _matrix(spring.stiffness)
    if isinstance(spring, NodeSpring):
        return nodes, matrix[None, None, :, None, :]
    rule = triangle_rule()
    tangents = np.einsum("qad,kai->dkqi", rule.gradients, mesh.nodes[nodes])
    areas = rule.weights * np.linalg.norm(np.cross(tangents[0], tangents[1]), axis=-1)
    masses = np.einsum("kq,qa,qb->kab", areas, rule.quadratic, rule.quadratic)
    return nodes, np.einsum("kab,ij->kaibj", masses, matrix)


def _nodes(mesh: Mesh, spring: Spring) -> Integers:
    """Nodes (k, m) of a spring's cells: triangles, or one node."""
    if isinstance(spring, FoundationSpring):
        return mesh.triangles(spring.surface)
    return np.array([[node_at(mesh, spring.position, "springs")]], np.int32)


def _matrix(stiffness: Stiffness) -> Reals:
    """A stiffness as a matrix (3, 3)."""
    given = np.array(stiffness, float)
    return np.diag(given) if given.ndim == 1 else given


def _checked(stiffness: Stiffness, unit: str) -> Stiffness:
    """A stiffness as tuples of floats. Raises ``SolverError`` if it is none."""
    what = f"springs: stiffness ({unit})"
    given = finite(what, stiffness, (3,), (3, 3))
    matrix = np.diag(given) if given.ndim == 1 else given
    scale = np.abs(matrix).max()
    if np.abs(matrix - matrix.T).max() > ROUNDING * scale:
        raise SolverError(f"{what} must be a symmetric matrix, got {stiffness}.")
    least = np.linalg.eigvalsh(matrix)[0]
    if least < -ROUNDING * scale:
        raise SolverError(f"{what} must not be negative, got {least:g} among {stiffness}.")
    if given.ndim == 1:
        return _triple(given)
    x, y, z = (_triple(row) for row in (matrix + matrix.T) / 2)
    return x, y, z


def _triple(row: Reals) -> Vector:
    x, y, z = (float(value) for value in row)
    return x, y, z
