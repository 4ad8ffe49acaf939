"""Cauchy stress at the nodes, recovered from the quadrature points."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from solver.arrays import Integers, Reals
from solver.assembly.assembly import solid
from solver.assembly.state import State
from solver.kernels.element import Solid
from solver.kernels.stress import deviatoric_stress
from solver.mesh.elements import TETRAHEDRON_EDGES, tetrahedron_rule
from solver.problem.problem import Problem
from solver.results.sharp_edges import trusted_nodes
from solver.results.solution import Solution, check_solution


@dataclass(frozen=True)
class Peak:
    """A largest nodal stress.

    Attributes:
        value: MPa.
        node: its number.
        position: of the node in the undeformed body, mm.
        scatter: MPa, how far the elements around the node differ: the root mean square of the von
            Mises stress of their differences from the average. It vanishes under refinement, and
            is 0 at a node of a single element.
    """

    value: float
    node: int
    position: tuple[float, float, float]
    scatter: float


def nodal_von_mises(solution: Solution) -> Reals:
    """Von Mises Cauchy stress at the nodes.

    Args:
        solution: an equilibrium.

    Returns:
        Of the stress averaged over the elements at each node, weighted by their volumes.

        *Shape:* (n,) in MPa.
    """
    check_solution(solution)
    return von_mises(deviatoric_at_nodes(solution.problem, solution.state.displacement))


def nodal_cauchy(solution: Solution) -> Reals:
    """Cauchy stress at the nodes.

    Args:
        solution: an equilibrium.

    Returns:
        Components in the order xx, yy, zz, xy, yz, zx.

        *Shape:* (n, 6) in MPa.
    """
    check_solution(solution)
    stress = deviatoric_at_nodes(solution.problem, solution.state.displacement)
    stress[:, :3] -= nodal_pressure(solution.problem, solution.state)[:, None]
    return stress


def peak_von_mises(solution: Solution) -> Peak:
    """Largest nodal von Mises stress.

    Args:
        solution: an equilibrium. Nodes nearer to a sharp edge than its problem's
            ``sharp_edge_radius`` do not count (``solver.results.sharp_edges``).

    Returns:
        The stress and where it is.
    """
    check_solution(solution)
    return peak_of(solution.problem, solution.displacement)


def peak_of(
    problem: Problem, displacement: Reals, counted: NDArray[np.bool_] | None = None
) -> Peak:
    """The same after a displacement (n, 3), mm; ``counted`` (n,): the nodes that count."""
    mesh, stress = problem.mesh, stress_after(problem, displacement)
    counted = trusted_nodes(problem) if counted is None else counted
    values = np.where(counted, von_mises(stress.nodal), 0.0)
    node = int(values.argmax())
    around = (mesh.tets == node).any(axis=1)
    jumps = stress.raw[around] - stress.nodal[mesh.tets[around]]
    differences = von_mises(jumps[mesh.tets[around] == node])
    scatter = float(np.sqrt((differences**2).mean()))
    x, y, z = (float(c) for c in mesh.nodes[node])
    return Peak(float(values[node]), node, (x, y, z), scatter)


@dataclass(frozen=True)
class ElementStress:
    """Deviatoric Cauchy stress at the ten nodes of each element, MPa.

    ``raw`` (e, 10, 6) of the element itself, ``nodal`` (n, 6) averages at the nodes of the mesh,
    ``volumes`` (e,) of the elements, mm^3; ``tets`` (e, 10).
    """

    raw: Reals
    nodal: Reals
    volumes: Reals
    tets: Integers

    @property
    def smoothed(self) -> Reals:
        """The nodal averages at the nodes of each element, (e, 10, 6)."""
        return self.nodal[self.tets]

    @property
    def jumps(self) -> Reals:
        """Differences of each element from the nodal averages, (e, 10, 6)."""
        return self.raw - self.smoothed


def element_stress(solution: Solution) -> ElementStress:
    """Deviatoric stress in the elements of a solution, and smoothed over them."""
    return stress_after(solution.problem, solution.displacement)


def stress_after(problem: Problem, displacement: Reals) -> ElementStress:
    """The same after a displacement (n, 3), mm."""
    mesh = problem.mesh
    raw, volumes = in_elements(solid(problem), displacement)
    return ElementStress(
        raw, averaged(mesh.tets, raw, volumes, len(mesh.nodes)), volumes, mesh.tets
    )


def von_mises(stress: Reals) -> Reals:
    """sqrt(3/2 s:s) of stresses (..., 6) in the order xx, yy, zz, xy, yz, zx."""
    deviator = stress[..., :3] - stress[..., :3].mean(axis=-1, keepdims=True)
    return np.sqrt(1.5 * (deviator**2).sum(-1) + 3 * (stress[..., 3:] ** 2).sum(-1))


def nodal_pressure(problem: Problem, state: State) -> Reals:
    """Hydrostatic pressure at all nodes (n,), MPa; linear along element edges."""
    mesh = problem.mesh
    values = np.zeros(len(mesh.nodes))
    values[mesh.vertices] = state.hydrostatic_pressure
    for middle, (a, b) in enumerate(TETRAHEDRON_EDGES, start=4):
        ends = values[mesh.tets[:, a]] + values[mesh.tets[:, b]]
        values[mesh.tets[:, middle]] = ends / 2
    return values


def deviatoric_at_nodes(problem: Problem, displacement: Reals) -> Reals:
    """Deviatoric Cauchy stress at the nodes, MPa: (n, 6).

    In each element the linear field through the four quadrature points, extrapolated to its ten
    nodes; at each node the average over its elements, weighted by their volumes.
    """
    at_nodes, volumes = in_elements(solid(problem), displacement)
    return averaged(problem.mesh.tets, at_nodes, volumes, len(problem.mesh.nodes))


def extrapolation() -> Reals:
    """Values (10, 4) at an element's nodes of the linear field through its quadrature points."""
    corners = np.linalg.inv(tetrahedron_rule().linear)
    middles = [(corners[a] + corners[b]) / 2 for a, b in TETRAHEDRON_EDGES]
    values: Reals = np.concatenate([corners, middles])
    return values


def in_elements(body: Solid, displacement: Reals) -> tuple[Reals, Reals]:
    """Deviatoric stress at the ten nodes of each element (e, 10, 6), and element volumes (e,)."""
    stress = np.empty((len(body.tets), len(body.weights), 6))
    volumes = np.empty(stress.shape[:2])
    deviatoric_stress(body, np.ascontiguousarray(displacement), stress, volumes)
    at_corners = np.einsum("vq,eqc->evc", np.linalg.inv(body.linear), stress)
    middles = [(at_corners[:, a] + at_corners[:, b]) / 2 for a, b in TETRAHEDRON_EDGES]
    at_nodes = np.concatenate([at_corners, np.stack(middles, axis=1)], axis=1)
    return at_nodes, volumes.sum(axis=1)


def averaged(
    tets: Integers,
    values: Reals,
    volumes: Reals,
    number_of_nodes: int,
) -> Reals:
    """Averages (n, 6) of element values (e, 10, 6) weighted by element volumes (e,)."""
    nodes, weights = tets.ravel(), np.repeat(volumes, tets.shape[1])
    total = np.bincount(nodes, weights, number_of_nodes)
    sums = [np.bincount(nodes, weights * values[..., c].ravel(), number_of_nodes) for c in range(6)]
    return np.stack(sums, axis=1) / np.where(total > 0, total, 1.0)[:, None]
