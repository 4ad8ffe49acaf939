"""The volume that pressurised surfaces sweep over: the work of a pressure.

The force of a follower pressure is quadratic in the positions, so that Simpson's rule integrates
its work along a straight line of displacements exactly, also while the pressure changes linearly.
Without a free rim (``solver.assembly.free_rim``) the volume does not depend on the way, and the
pressure has a potential.
"""

from __future__ import annotations

import numpy as np

from solver.arrays import Reals
from solver.assembly.pressure import enclosed_volume
from solver.mesh.elements import triangle_rule
from solver.problem.problem import Problem


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


def _unit_forces(problem: Problem, displacement: Reals) -> Reals:
    """Nodal forces (n, 3) of a unit pressure on the body, mm^2."""
    mesh, rule = problem.mesh, triangle_rule()
    triangles = mesh.triangles(*problem.pressurised)
    along = np.einsum("qad,kai->dkqi", rule.gradients, (mesh.nodes + displacement)[triangles])
    normals = np.cross(along[0], along[1])
    forces = np.zeros(mesh.nodes.shape)
    np.add.at(forces, triangles, -np.einsum("q,qa,kqi->kai", rule.weights, rule.quadratic, normals))
    return forces
