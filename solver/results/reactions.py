"""Reactions of supports."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from solver.arrays import Reals
from solver.assembly.assembly import unbalanced_forces
from solver.problem.supports import SINGLE_NODES, held_by_each
from solver.problem.vectors import finite
from solver.results.solution import Solution, check_solution
from solver.results.tractions import traction_forces

Held = NDArray[np.bool_]
"""Which displacements a support holds, (n, 3)."""


@dataclass(frozen=True)
class Reaction:
    """Force and moment of a support on the body.

    Attributes:
        force: its components.

            *Shape:* (3,) in N.
        moment: about a given point.

            *Shape:* (3,) in N mm.
        by_traction: which components of the force two supports share at some nodes, where each
            one's part follows from the traction on its surface; the others are sums of nodal
            forces, as accurate as the equilibrium itself.

    Examples:
        >>> from solver import Ogden, Problem, Supports, Traction, reaction, solve
        >>> from solver.mesh import block
        >>> bend = Traction("x1", (0, 0, -0.001))
        >>> rubber = Ogden.neo_hooke(0.5)  # MPa
        >>> bar = Problem(block((30, 4, 4), (6, 1, 1)), rubber, Supports(("x0",)), loads=(bend,))
        >>> clamp = reaction(solve(bar), "x0", about=(0, 2, 2))
        >>> print(f"{clamp.force[2]:.3f} N, {clamp.moment[1]:.2f} N mm")
        0.016 N, -0.47 N mm
    """

    force: Reals
    moment: Reals
    by_traction: tuple[bool, bool, bool] = (False, False, False)


def reaction(
    solution: Solution, surface: str, about: tuple[float, float, float] = (0.0, 0.0, 0.0)
) -> Reaction:
    """Reaction of the support on a surface.

    The nodal forces that balance the body, in the components that the surface's support holds.
    Where another support holds the same component of a node, as a clamp does at the edge of a plane
    of symmetry, each takes the integral of the traction on its own surface, weighted by the node's
    shape function and without what loads, springs, membranes and planes exert there, and an equal
    part of what these leave of the nodal force: the reactions of all supports add up to the nodal
    forces. Lever arms are those of the deformed body.

    Args:
        solution: an equilibrium.
        surface: name of the held surface.
        about: point in space that the moment refers to, mm.

    Returns:
        Force and moment on the body. For a surface that bears no support, those of all supports on
        its nodes.

    Raises:
        SolverError: an unknown surface, or a point that is not three finite numbers.

    Examples:
        >>> from solver import Ogden, Problem, Supports, reaction, solve
        >>> from solver.mesh import block
        >>> led = {"x1": lambda at, load: at * 0 + (3 * load, 0, 0)}
        >>> pulled = Supports(("x0",), prescribed=led)
        >>> stretched = solve(Problem(block((30, 4, 4), (6, 1, 1)), Ogden.neo_hooke(0.5), pulled))
        >>> both = (reaction(stretched, side).force[0] for side in ("x0", "x1"))
        >>> print([f"{force:.3f} N" for force in both])
        ['-2.283 N', '2.283 N']
    """
    check_solution(solution)
    point = finite("reaction: about (mm)", about, (3,))
    mesh = solution.problem.mesh
    nodes = mesh.surface_nodes(surface)
    forces, shared = _forces(solution, surface)
    arms = mesh.nodes[nodes] + solution.displacement[nodes] - point
    x, y, z = (bool(shared[:, axis].any()) for axis in range(3))
    moment = np.cross(arms, forces[nodes]).sum(axis=0)
    return Reaction(forces[nodes].sum(axis=0), moment, (x, y, z))


def _forces(solution: Solution, surface: str) -> tuple[Reals, Held]:
    """Forces (n, 3) of a surface's support on the nodes, N, and where it shares them (n, 3)."""
    problem = solution.problem
    total = unbalanced_forces(problem, solution.state, solution.pressure, solution.load)
    if len(solution.remaining_force):
        total = total - solution.remaining_force
    holders = held_by_each(problem.mesh, problem.supports, problem.moving_plane)
    if surface not in holders:
        held = np.logical_or.reduce([np.zeros(total.shape, bool), *holders.values()])
        return np.where(held, total, 0.0), np.zeros(total.shape, bool)
    held = holders.pop(surface)
    others = {name: mask for name, mask in holders.items() if (held & mask).any()}
    shared = held & np.logical_or.reduce([np.zeros_like(held), *others.values()])
    if shared.any():
        total = np.where(shared, _part(solution, total, surface, others), total)
    return np.where(held, total, 0.0), shared


def _part(solution: Solution, total: Reals, surface: str, others: dict[str, Held]) -> Reals:
    """A support's part (n, 3) of nodal forces that it shares with others, N."""
    own = traction_forces(solution, surface)
    left, count = total - own, np.ones(total.shape)
    for name, mask in others.items():
        if name != SINGLE_NODES:
            left -= np.where(mask, traction_forces(solution, name), 0.0)
        count += mask
    return own + left / count
