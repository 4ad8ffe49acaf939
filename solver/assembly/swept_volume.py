"""The volume that pressurised surfaces sweep over: the work of a pressure.

The force of a follower pressure is quadratic in the positions, so that Simpson's rule integrates
its work along a straight line of displacements exactly, also while the pressure changes linearly.
Where the rim of the surfaces is held or slides in a plane of symmetry the volume does not depend on
the way, and the pressure has a potential; with a free rim it does.
"""

from __future__ import annotations

import numpy as np

from solver.arrays import Integers, Reals
from solver.assembly.pressure import enclosed_volume
from solver.errors import SolverError
from solver.mesh.elements import TRIANGLE_EDGES, triangle_rule
from solver.problem.problem import Problem
from solver.problem.supports import fixed_displacements

IN_PLANE = 1e-6
"""Distance from a plane within which a rim lies in it, in body diagonals."""


def swept_volume(problem: Problem, start: Reals, end: Reals) -> Reals:
    """Volume (2,) swept on the straight way between displacements (n, 3), mm^3.

    Two parts, weighted with what is left of the way and with what is behind: a pressure that grows
    linearly from p to q does the work (p, q) @ parts. Positive where the surface gives way. In a
    cell the whole opening in the moving plane counts.
    """
    if problem.moving_plane is not None:
        mesh, surfaces = problem.mesh, problem.pressurised
        before, after = (enclosed_volume(mesh, u, surfaces) for u in (start, end))
        return np.full(2, (after - before) / 2)
    forces = (_unit_forces(problem, u) for u in (start, (start + end) / 2, end))
    first, middle, last = (float((force * (end - start)).sum()) for force in forces)
    return np.array([first + 2 * middle, 2 * middle + last]) / 6


def check_rim(problem: Problem, displacement: Reals) -> None:
    """Raise ``SolverError`` if the pressurised surfaces have a rim that is free.

    A rim edge counts as held if its nodes have at most one free direction, or two in a plane that
    contains the edge.
    """
    if problem.moving_plane is not None:
        return
    mesh = problem.mesh
    fixed = fixed_displacements(mesh, problem.supports)
    rim = _rim(mesh.triangles(*problem.pressurised))
    places = (mesh.nodes + displacement)[rim]
    flat = np.ptp(places, axis=1) <= IN_PLANE * mesh.size  # (k, 3): in a plane normal to that axis
    held = fixed[rim].all(axis=1)
    free = ~((held.sum(axis=1) >= 2) | (held & flat).any(axis=1))
    if free.any():
        where = ", ".join(f"{x:.4g}" for x in mesh.nodes[rim[free][0, 2]])
        raise SolverError(
            f"potential: the pressurised surfaces have a free rim, at ({where}) mm, so that the "
            "work of the pressure depends on the way and it has no potential."
        )


def _rim(triangles: Integers) -> Integers:
    """Edges (k, 3) of one of the triangles (t, 6) only: ends and mid-node."""
    edges = np.concatenate(
        [triangles[:, (a, b, 3 + number)] for number, (a, b) in enumerate(TRIANGLE_EDGES)]
    )
    _, first, count = np.unique(
        np.sort(edges[:, :2], axis=1), axis=0, return_index=True, return_counts=True
    )
    rim: Integers = edges[first[count == 1]]
    return rim


def _unit_forces(problem: Problem, displacement: Reals) -> Reals:
    """Nodal forces (n, 3) of a unit pressure on the body, mm^2."""
    mesh, rule = problem.mesh, triangle_rule()
    triangles = mesh.triangles(*problem.pressurised)
    along = np.einsum("qad,kai->dkqi", rule.gradients, (mesh.nodes + displacement)[triangles])
    normals = np.cross(along[0], along[1])
    forces = np.zeros(mesh.nodes.shape)
    np.add.at(forces, triangles, -np.einsum("q,qa,kqi->kai", rule.weights, rule.quadratic, normals))
    return forces
