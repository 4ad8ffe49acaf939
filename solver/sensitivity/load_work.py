"""Derivatives of the virtual work of dead loads and springs by the nodes' positions.

A load that is a function of positions is differentiated by central differences of that function.
Forces and springs on single nodes move with them and have no derivative.
"""

from __future__ import annotations

import numpy as np

from solver.arrays import Reals
from solver.assembly.section import Section
from solver.assembly.state import State
from solver.mesh import edges
from solver.mesh.edges import common_edge
from solver.mesh.elements import tetrahedron_rule
from solver.mesh.mesh import Mesh
from solver.problem.loads import BodyForce, EdgeForce, Field, Traction, elements_of, plane_loads
from solver.problem.problem import Problem
from solver.problem.springs import FoundationSpring
from solver.sensitivity.surface_integrals import (
    area_derivative,
    areas,
    at_points,
    spread,
    summed,
)
from solver.sensitivity.unknowns import Direction

STEP = 1e-6
"""Of the difference quotients of a load's function, in body diagonals."""


def load_derivative(problem: Problem, along: Reals) -> Reals:
    """Derivative (n, 3) of the whole dead loads' work along displacements (n, 3), N."""
    total = np.zeros_like(along)
    for load in problem.loads:
        if isinstance(load, Traction):
            total += _of_traction(problem.mesh, load, along)
        elif isinstance(load, BodyForce):
            total += _of_body_force(problem.mesh, load, along)
        elif isinstance(load, EdgeForce):
            total += _of_edge_force(problem.mesh, load, along)
    return total


def section_derivative(problem: Problem, state: State, direction: Direction) -> Reals:
    """Derivative (n, 3) of the work of the whole axial force on a section along a direction, N.

    The force is spread over the undeformed section, which alone depends on positions: a mean f over
    the area A changes by the change of the integral of f minus f times that of A, both over A.
    """
    section, axial = Section.of(problem), plane_loads(problem.loads)[1]
    if section is None or not axial:
        return np.zeros_like(state.displacement)
    mesh, surface = problem.mesh, str(problem.moving_plane)
    triangles = mesh.triangles(surface)
    moves = np.zeros_like(state.displacement)
    moves[section.plane.nodes, 0] = section.moves(state, direction.displacement, direction.plane)
    density = at_points(moves, triangles)[..., 0]
    sizes = areas(mesh.nodes, triangles)
    area, mean = sizes.sum(), (sizes * density).sum() / sizes.sum()
    change: Reals = axial / area * area_derivative(mesh.nodes, triangles, density - mean)
    return change


def spring_derivative(problem: Problem, displacement: Reals, along: Reals) -> Reals:
    """Derivative (n, 3) of all springs' work at a displacement along another (n, 3), N."""
    mesh, total = problem.mesh, np.zeros_like(along)
    for spring in problem.springs:
        if isinstance(spring, FoundationSpring):
            given, triangles = np.array(spring.stiffness, float), mesh.triangles(spring.surface)
            matrix = np.diag(given) if given.ndim == 1 else given
            forces = at_points(displacement, triangles) @ matrix
            density = (forces * at_points(along, triangles)).sum(axis=-1)
            total += area_derivative(mesh.nodes, triangles, density)
    return total


def _of_traction(mesh: Mesh, load: Traction, along: Reals) -> Reals:
    triangles = mesh.triangles(load.surface)
    places, moves = at_points(mesh.nodes, triangles), at_points(along, triangles)
    density = (_values(load.stress, places) * moves).sum(axis=-1)
    changes = _slopes(load.stress, places, moves, STEP * mesh.size)
    changes *= areas(mesh.nodes, triangles)[..., None]
    fixed = area_derivative(mesh.nodes, triangles, density)
    return fixed + spread(len(mesh.nodes), triangles, changes)


def _of_body_force(mesh: Mesh, load: BodyForce, along: Reals) -> Reals:
    rule, tets = tetrahedron_rule(), elements_of(mesh, load)
    places = np.einsum("qa,eai->eqi", rule.quadratic, mesh.nodes[tets])
    moves = np.einsum("qa,eai->eqi", rule.quadratic, along[tets])
    matrices = np.einsum("qad,eai->eqdi", rule.gradients, mesh.nodes[tets])
    sizes = rule.weights * np.linalg.det(matrices)
    gradients = np.einsum("eqid,qad->eqai", np.linalg.inv(matrices), rule.gradients)
    density = sizes * (_values(load.density, places) * moves).sum(axis=-1)
    changes = _slopes(load.density, places, moves, STEP * mesh.size) * sizes[..., None]
    parts = np.einsum("eq,eqai->eai", density, gradients)
    parts += np.einsum("qa,eqi->eai", rule.quadratic, changes)
    return summed(len(mesh.nodes), tets, parts)


def _of_edge_force(mesh: Mesh, load: EdgeForce, along: Reals) -> Reals:
    """A mean of the work along the edge: it changes as that of ``section_derivative``."""
    lines = common_edge(mesh, *load.surfaces)
    work, sizes = edges.along(along, lines) @ np.array(load.force), edges.lengths(mesh.nodes, lines)
    length = sizes.sum()
    excess = (work - (sizes * work).sum() / length) / length
    tangents = edges.tangents(mesh.nodes, lines)
    pulls = tangents / np.linalg.norm(tangents, axis=2, keepdims=True)
    parts = np.einsum("kq,q,qa,kqi->kai", excess, edges.WEIGHTS, edges.SLOPES, pulls)
    return summed(len(mesh.nodes), lines, parts)


def _values(field: Field, places: Reals) -> Reals:
    """A load (k, q, 3) at places (k, q, 3)."""
    value = field(places.reshape(-1, 3)) if callable(field) else field
    rows = np.asarray(value, float).reshape(-1, 3)
    return np.broadcast_to(rows, (places.size // 3, 3)).reshape(places.shape)


def _slopes(field: Field, places: Reals, moves: Reals, step: float) -> Reals:
    """Derivative (k, q, 3) of a load times displacements ``moves`` (k, q, 3) by its place."""
    slopes = np.zeros_like(places)
    if callable(field):
        for axis, unit in enumerate(np.eye(3)):
            ahead, behind = (_values(field, places + s * step * unit) for s in (1, -1))
            slopes[..., axis] = ((ahead - behind) * moves).sum(axis=-1) / (2 * step)
    return slopes
