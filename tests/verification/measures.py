"""Errors over a mesh and orders of convergence."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import product

import numpy as np
from numpy.typing import NDArray

from solver import Solution
from solver.mesh.elements import TETRAHEDRON_EDGES, quadratic_gradients, quadratic_shapes

Points = NDArray[np.float64]
Field = Callable[[Points], Points]


def observed_order(divisions: Sequence[float], errors: Sequence[float]) -> float:
    """Slope of the errors over the elements' size, both as logarithms, by least squares."""
    return float(-np.polyfit(np.log(divisions), np.log(errors), 1)[0])


def displacement_error(solution: Solution, exact: Field) -> float:
    """L2 norm of displacement minus ``exact`` (of reference positions), over that of ``exact``."""
    shapes, _, positions, volumes = _samples(solution)
    nodal = solution.displacement[solution.problem.mesh.tets]
    ours = np.einsum("qa,eai->eqi", shapes, nodal).reshape(-1, 3)
    return _relative(ours, exact(positions), volumes)


def pressure_error(solution: Solution, exact: Field) -> float:
    """L2 norm of hydrostatic pressure minus ``exact``, over that of ``exact``."""
    _, linear, positions, volumes = _samples(solution)
    nodal = solution.hydrostatic_pressure[solution.problem.mesh.tet_vertices]
    return _relative(np.einsum("qa,ea->eq", linear, nodal).ravel(), exact(positions), volumes)


def _relative(ours: Points, exact: Points, volumes: Points) -> float:
    weights = volumes.reshape(-1, *(1,) * (exact.ndim - 1))
    return float(np.sqrt((weights * (ours - exact) ** 2).sum() / (weights * exact**2).sum()))


def _samples(solution: Solution) -> tuple[Points, Points, Points, Points]:
    """Quadratic and linear shapes (q, .), positions (e q, 3) and volumes (e q,) to integrate at."""
    barycentric, weights = collapsed_rule(5)
    shapes = quadratic_shapes(barycentric, TETRAHEDRON_EDGES)
    gradients = quadratic_gradients(barycentric, TETRAHEDRON_EDGES)
    corners = solution.problem.mesh.nodes[solution.problem.mesh.tets]
    determinants = np.linalg.det(np.einsum("qad,eai->eqdi", gradients, corners))
    positions = np.einsum("qa,eai->eqi", shapes, corners).reshape(-1, 3)
    return shapes, barycentric, positions, (determinants * weights).ravel()


def collapsed_rule(n: int) -> tuple[Points, Points]:
    """n^3 points (barycentric) and weights for the unit tetrahedron, exact to degree 2 n - 3."""
    x, w = np.polynomial.legendre.leggauss(n)
    axis = list(zip((1 + x) / 2, w / 2, strict=True))
    points, weights = [], []
    for (a, wa), (b, wb), (c, wc) in product(axis, repeat=3):
        points.append([a, b * (1 - a), c * (1 - a) * (1 - b)])
        weights.append(wa * wb * wc * (1 - a) ** 2 * (1 - b))
    rst = np.array(points)
    return np.column_stack([1 - rst.sum(axis=1), rst]), np.array(weights)
