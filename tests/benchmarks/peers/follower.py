"""Follower pressure on six-node triangles, in NumPy, for codes that have none."""

from __future__ import annotations

import numpy as np
from case import Integers, Reals

EDGES = ((0, 1), (1, 2), (2, 0))


class FollowerPressure:
    """Forces of a unit pressure and their derivative over the displacement.

    ``nodes`` (n, 3), mm; ``triangles`` (k, 6) in Gmsh's order, normals out of the solid. The
    residual of a body under pressure p is that of the body plus p times these forces. ``rows`` and
    ``columns`` are the unknowns of the entries of ``stiffness``; its unsymmetric part cancels where
    the edges of the surface are held or lie in a plane of symmetry.
    """

    def __init__(self, nodes: Reals, triangles: Integers) -> None:
        self.nodes, self.triangles = nodes, triangles
        self.weights, self.shapes, self.slopes = quadratic_triangle()
        unknowns = (3 * triangles[:, :, None] + np.arange(3)).reshape(len(triangles), -1)
        self.unknowns = unknowns
        self.rows = np.repeat(unknowns, unknowns.shape[1], axis=1).ravel()
        self.columns = np.tile(unknowns, unknowns.shape[1]).ravel()

    def forces(self, displacement: Reals, size: int) -> Reals:
        """Forces (size,), mm^2, numbered node by node."""
        along = self._tangents(displacement)
        normals = np.cross(along[:, :, 0], along[:, :, 1])
        forces = np.einsum("qa,tqi->tai", self.weights[:, None] * self.shapes, normals)
        return np.bincount(self.unknowns.ravel(), forces.ravel(), minlength=size)

    def stiffness(self, displacement: Reals) -> Reals:
        """Derivatives of the forces over the displacement, mm, at ``rows`` and ``columns``.

        d(x_r cross x_s) = x_r cross dx_s - x_s cross dx_r
        """
        spins = np.einsum("ijk,tqdj->tqdik", SPIN, self._tangents(displacement))
        turned = np.einsum("qb,tqik->tqbik", self.slopes[:, :, 1], spins[:, :, 0])
        turned -= np.einsum("qb,tqik->tqbik", self.slopes[:, :, 0], spins[:, :, 1])
        weighted = self.weights[:, None] * self.shapes
        return np.einsum("qa,tqbik->taibk", weighted, turned, optimize=True).ravel()

    def _tangents(self, displacement: Reals) -> Reals:
        """Two tangents (k, 6, 2, 3) of the deformed triangles at their quadrature points."""
        position = (self.nodes + displacement)[self.triangles]
        return np.einsum("qad,tai->tqdi", self.slopes, position)


SPIN = np.zeros((3, 3, 3))
"""SPIN[i, j, k] x_j y_k = (x cross y)_i."""
for _i, _j, _k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
    SPIN[_i, _j, _k], SPIN[_i, _k, _j] = 1.0, -1.0


def quadratic_triangle() -> tuple[Reals, Reals, Reals]:
    """Six-point rule, exact for quartics (Dunavant 1985), with shape functions at its points.

    Weights (6,) sum to 1/2; shapes (6, 6); their derivatives over (r, s) (6, 6, 2).
    """
    a, b = 0.445948490915965, 0.091576213509771
    L = np.concatenate([x + (1 - 3 * x) * np.eye(3) for x in (a, b)])
    weights = np.repeat([0.223381589678011, 0.109951743655322], 3) / 2
    slope = np.array([[-1.0, -1.0], [1.0, 0.0], [0.0, 1.0]])
    corners = [L[:, k] * (2 * L[:, k] - 1) for k in range(3)]
    middles = [4 * L[:, i] * L[:, j] for i, j in EDGES]
    corner_slopes = [np.outer(4 * L[:, k] - 1, slope[k]) for k in range(3)]
    middle_slopes = [
        4 * (np.outer(L[:, i], slope[j]) + np.outer(L[:, j], slope[i])) for i, j in EDGES
    ]
    shapes = np.stack(corners + middles, axis=1)
    return weights, shapes, np.stack(corner_slopes + middle_slopes, axis=1)
