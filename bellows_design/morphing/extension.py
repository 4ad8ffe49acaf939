"""Smooth extension of known values into the rest of a mesh, by harmonic functions."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_matrix, csr_matrix
from scipy.sparse.linalg import splu

from bellows_design.morphing.primitives import Indices
from solver.arrays import Reals


@dataclass(frozen=True)
class Extension:
    """Values at all points from those at ``known``: ``unknown`` ones solve K u = 0.

    ``coupling`` are the rows of K of unknown points and the columns of known ones; ``solve``
    applies the inverse of the rest, which was factorized once.
    """

    known: Indices
    unknown: Indices
    coupling: csr_matrix
    solve: Callable[[Reals], Reals]

    def __call__(self, values: Reals) -> Reals:
        """``values`` (n, c) with the unknown rows filled in from the known ones."""
        filled = values.copy()
        if len(self.unknown):
            filled[self.unknown] = self.solve(-(self.coupling @ values[self.known]))
        return filled

    def transposed(self, gradient: Reals) -> Reals:
        """Derivatives (n, c) by the known values, of a function with ``gradient`` by all."""
        pulled = gradient.copy()
        if len(self.unknown):
            pulled[self.known] -= self.coupling.T @ self.solve(gradient[self.unknown])
            pulled[self.unknown] = 0.0
        return pulled


def extension(
    stiffness: csr_matrix, known: NDArray[np.bool_], among: NDArray[np.bool_]
) -> Extension:
    """Harmonic extension from points ``known`` (n,) to the others ``among`` (n,) them.

    ``stiffness`` (n, n) is symmetric and positive semidefinite.
    """
    fixed, free = np.flatnonzero(known), np.flatnonzero(among & ~known)
    rows = stiffness[free]
    return Extension(fixed, free, rows[:, fixed].tocsr(), _inverse(csc_matrix(rows[:, free])))


def _inverse(matrix: csc_matrix) -> Callable[[Reals], Reals]:
    """What applies the inverse of a symmetric positive definite matrix."""
    if matrix.shape[0] == 0:
        return np.asarray
    symmetric: dict[str, Any] = {"SymmetricMode": True}
    solve: Callable[[Reals], Reals] = splu(matrix, "MMD_AT_PLUS_A", options=symmetric).solve
    return solve


def path_stiffness(points: Reals, edges: Indices) -> csr_matrix:
    """Stiffness of straight bars ``edges`` (k, 2) between points (n, 3): 1 over their lengths."""
    lengths = np.linalg.norm(points[edges[:, 0]] - points[edges[:, 1]], axis=1)
    signs = np.array([[1.0, -1.0], [-1.0, 1.0]])
    return _assembled(len(points), edges, signs / lengths[:, None, None])


def simplex_stiffness(points: Reals, cells: Indices) -> csr_matrix:
    """Stiffness of a Laplacian with linear functions on triangles or tetrahedra (k, d + 1).

    The smaller a cell the stiffer it is, by the inverse square of its size: what is meshed finely,
    around edges and corners, then moves as a whole and keeps its shape.
    """
    corners = points[cells]
    sides = corners[:, 1:] - corners[:, :1]
    metric = sides @ np.swapaxes(sides, 1, 2)
    volume = np.sqrt(np.linalg.det(metric))
    dimension = cells.shape[1] - 1
    slopes = np.vstack([-np.ones(dimension), np.eye(dimension)])
    local = slopes @ np.linalg.inv(metric) @ slopes.T
    stiffness = volume ** (1 - 2 / dimension)
    return _assembled(len(points), cells, local * stiffness[:, None, None])


def _assembled(size: int, cells: Indices, local: Reals) -> csr_matrix:
    width = cells.shape[1]
    rows = np.repeat(cells, width, axis=1).ravel()
    columns = np.tile(cells, (1, width)).ravel()
    return csr_matrix((local.ravel(), (rows, columns)), shape=(size, size))
