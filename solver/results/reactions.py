"""What supports exert on a body: force and moment."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from solver.arrays import Reals
from solver.assembly.assembly import unbalanced_forces
from solver.results.solution import Solution


@dataclass(frozen=True)
class Reaction:
    """``force`` (3,) in N and ``moment`` (3,) in N mm of a support on the body."""

    force: Reals
    moment: Reals


def reaction(
    solution: Solution, surface: str, about: tuple[float, float, float] = (0.0, 0.0, 0.0)
) -> Reaction:
    """What the support on ``surface`` exerts, its moment about a point in space (mm).

    Lever arms are those of the deformed body. Nodes that are held by two supports count in full,
    so a symmetry plane next to the surface adds its own forces, normal to itself. Raises
    ``SolverError`` for an unknown surface.
    """
    mesh = solution.problem.mesh
    nodes = mesh.surface_nodes(surface)
    forces = unbalanced_forces(solution.problem, solution.state, solution.pressure, solution.load)
    arms = mesh.nodes[nodes] + solution.displacement[nodes] - np.asarray(about, float)
    return Reaction(forces[nodes].sum(axis=0), np.cross(arms, forces[nodes]).sum(axis=0))
