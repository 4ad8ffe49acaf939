"""Cauchy stress at the nodes, recovered from the quadrature points."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

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
    mesh = solution.problem.mesh
    stress = element_stress(solution)
    at_nodes = averaged(mesh.tets, stress.raw, stress.volumes, len(mesh.nodes))
    values = np.where(trusted_nodes(solution.problem), von_mises(at_nodes), 0.0)
    node = int(values.argmax())
    differences = von_mises(stress.jumps[mesh.tets == node])
    scatter = float(np.sqrt((differences**2).mean()))
    x, y, z = (float(c) for c in mesh.nodes[node])
    return Peak(float(values[node]), node, (x, y, z), scatter)


@dataclass(frozen=True)
class ElementStress:
    """Deviatoric Cauchy stress at the ten nodes of each element, MPa.

    ``raw`` (e, 10, 6) of the element itself, ``smoothed`` (e, 10, 6) of the nodal averages;
    ``volumes`` (e,) of the elements, mm^3.
    """

    raw: Reals
    smoothed: Reals
    volumes: Reals

    @property
    def jumps(self) -> Reals:
        """Differences of each element from the nodal averages, (e, 10, 6)."""
        return self.raw - self.smoothed


def element_stress(solution: Solution) -> ElementStress:
    """Deviatoric stress in the elements of a solution, and smoothed over them."""
    mesh = solution.problem.mesh
    raw, volumes = in_elements(solid(solution.problem), solution.displacement)
    smoothed = averaged(mesh.tets, raw, volumes, len(mesh.nodes))[mesh.tets]
    return ElementStress(raw, smoothed, volumes)


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
