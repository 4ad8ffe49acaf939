"""Reactions of supports."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from solver.arrays import Reals
from solver.assembly.assembly import unbalanced_forces
from solver.results.solution import Solution


@dataclass(frozen=True)
class Reaction:
    """Force and moment of a support on the body.

    Attributes:
        force: its components.

            *Shape:* (3,) in N.
        moment: about a given point.

            *Shape:* (3,) in N mm.
    """

    force: Reals
    moment: Reals


def reaction(
    solution: Solution, surface: str, about: tuple[float, float, float] = (0.0, 0.0, 0.0)
) -> Reaction:
    """Reaction of the support on a surface.

    Lever arms are those of the deformed body. Nodes that are held by two supports count in full: a
    symmetry plane next to the surface adds its own forces, normal to itself.

    Args:
        solution: an equilibrium.
        surface: name of the held surface.
        about: point in space that the moment refers to, mm.

    Returns:
        Force and moment on the body.

    Raises:
        SolverError: an unknown surface.
    """
    mesh = solution.problem.mesh
    nodes = mesh.surface_nodes(surface)
    forces = unbalanced_forces(solution.problem, solution.state, solution.pressure, solution.load)
    if len(solution.remaining_force):
        forces = forces - solution.remaining_force
    arms = mesh.nodes[nodes] + solution.displacement[nodes] - np.asarray(about, float)
    return Reaction(forces[nodes].sum(axis=0), np.cross(arms, forces[nodes]).sum(axis=0))
