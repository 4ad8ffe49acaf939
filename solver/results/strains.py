"""Strain of a body: principal stretches at the quadrature points."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from solver.arrays import Reals
from solver.mesh.elements import tetrahedron_rule
from solver.mesh.mesh import Mesh
from solver.problem.problem import Problem
from solver.results.sharp_edges import trusted_nodes
from solver.results.solution import Solution


def principal_logs(mesh: Mesh, displacement: Reals) -> Reals:
    """ln of the principal stretches at the quadrature points, ascending: (e, q, 3).

    ``displacement`` (n, 3) in mm. From the eigenvalues of C - 1, so small strains keep full
    relative precision.
    """
    gradients = tetrahedron_rule().gradients
    rows = gradients.swapaxes(1, 2).reshape(-1, gradients.shape[1])  # of points and directions
    jacobian, change = (
        (rows @ values[mesh.tets]).reshape(len(mesh.tets), -1, 3, 3)
        for values in (mesh.nodes, displacement)
    )
    h = np.linalg.solve(jacobian, change)  # transposed: h[j, i] = du_i / dX_j
    strain = h + h.swapaxes(-1, -2) + h @ h.swapaxes(-1, -2)
    logs: Reals = 0.5 * np.log1p(np.linalg.eigvalsh(strain))
    return logs


def reached_logs(solution: Solution) -> Reals:
    """``principal_logs`` of a solution as rows (k, 3), without elements at sharp edges.

    Those are left out as for the highest stress (``trusted_nodes``): there the strain of an ideal
    body is unbounded. All count if none is left.
    """
    everywhere = np.ones(len(solution.problem.mesh.tets), bool)
    return _reached(solution, everywhere)


def reached_logs_by_region(solution: Solution) -> dict[str, Reals]:
    """The same of each region by its name, as ``peaks_by_region`` names them."""
    mesh = solution.problem.mesh
    return {
        mesh.region_names[number]: _reached(solution, mesh.region_of_tet == number)
        for number in np.unique(mesh.region_of_tet)
    }


def _reached(solution: Solution, elements: NDArray[np.bool_]) -> Reals:
    """Rows (k, 3) of some of the elements (e,)."""
    logs = principal_logs(solution.problem.mesh, solution.displacement)
    trusted = elements & _trusted(solution.problem)
    rows: Reals = (logs[trusted] if trusted.any() else logs[elements]).reshape(-1, 3)
    return rows


def _trusted(problem: Problem) -> np.ndarray:
    """Which elements have no node near a sharp edge, (e,)."""
    return np.asarray(trusted_nodes(problem)[problem.mesh.tets].all(axis=1))
