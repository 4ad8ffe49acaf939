"""What is left of a stage of loading in a later one, as dead forces on the unknowns."""

from __future__ import annotations

import numpy as np

from solver.arrays import Reals
from solver.assembly.moving_plane import MovingPlane
from solver.assembly.state import State
from solver.problem.problem import Problem
from solver.results.solution import Solution


def remaining_forces(solution: Solution) -> Reals:
    """Forces (n + 1, 3): on the nodes, N; last on tilt (N mm) and shift (N) of the moving plane."""
    forces = solution.remaining_force
    nodal = forces if len(forces) else np.zeros_like(solution.displacement)
    return np.vstack([nodal, np.append(solution.remaining_plane, 0.0)])


def moved_unknowns(problem: Problem, state: State) -> Reals:
    """What ``remaining_forces`` work on (n + 1, 3), mm and rad: zero in the undeformed body.

    Displacements, of nodes on the moving plane what they have gained in height in it; tilt, shift.
    """
    moved = np.vstack([state.displacement, np.append(state.plane, 0.0)])
    if problem.moving_plane is not None:
        plane = MovingPlane.of(problem.mesh, problem.moving_plane)
        moved[plane.nodes, 0] = 0.0
        moved[plane.nodes, 2] = plane.heights(state)[plane.nodes] - plane.positions[:, 2]
    return moved
