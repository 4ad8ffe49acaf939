"""Tractions on surfaces of the deformed body, from the stress at the nodes."""

from __future__ import annotations

import numpy as np

from solver.arrays import Reals
from solver.assembly.membranes.membranes import Membranes
from solver.assembly.pairs.made import contact_pairs
from solver.mesh.elements import triangle_rule
from solver.problem.contacts import surfaces_of
from solver.problem.loads import Traction, nodal_forces
from solver.problem.springs import FoundationSpring, stiffness_matrix
from solver.results.solution import Solution
from solver.results.stress import nodal_cauchy

VOIGT = np.array([[0, 3, 5], [3, 1, 4], [5, 4, 2]])
"""Places of the components of a tensor in the order xx, yy, zz, xy, yz, zx."""


def traction_forces(solution: Solution, surface: str) -> Reals:
    """Nodal forces (n, 3) of what holds a surface, N: its traction without the surface's loads.

    The integral of N_a sigma n over the deformed triangles, with the Cauchy stress that is averaged
    at their nodes and quadratic between them. Pressure, dead tractions, springs and contacts
    that act on the surface itself are no part of what its support exerts.
    """
    problem, rule = solution.problem, triangle_rule()
    mesh, cells = problem.mesh, problem.mesh.triangles(surface)
    stress = nodal_cauchy(solution)[cells][..., VOIGT]
    if surface in problem.pressurised:
        stress = stress + solution.pressure * np.eye(3)
    places = (mesh.nodes + solution.displacement)[cells]
    tangents = np.einsum("qad,kai->dkqi", rule.gradients, places)
    areas = np.cross(tangents[0], tangents[1])
    at_points = np.einsum("qa,kaij->kqij", rule.quadratic, stress)
    parts = np.einsum("q,qa,kqij,kqj->kai", rule.weights, rule.quadratic, at_points, areas)
    forces = np.zeros(mesh.nodes.shape)
    np.add.at(forces, cells, parts)
    return forces - _loads_on(solution, surface)


def _loads_on(solution: Solution, surface: str) -> Reals:
    """Nodal forces (n, 3) of dead tractions, springs, membranes and contacts on a surface, N."""
    problem, load = solution.problem, solution.load
    dead = [each for each in problem.loads if isinstance(each, Traction)]
    forces = load * nodal_forces(problem.mesh, [each for each in dead if each.surface == surface])
    springs = [each for each in problem.springs if isinstance(each, FoundationSpring)]
    stiffness = stiffness_matrix(problem.mesh, [s for s in springs if s.surface == surface])
    forces -= (stiffness @ solution.displacement.ravel()).reshape(-1, 3)
    for membrane in problem.membranes:
        if membrane.surface == surface:
            films = Membranes.on(problem.mesh, membrane)
            forces -= films.forces(solution.displacement)
    nodes = problem.mesh.surface_nodes(surface)
    for pair in contact_pairs(problem):
        if surface in surfaces_of(pair.contact):
            forces[nodes] += pair.forces(solution.state, load)[nodes]
    return forces
