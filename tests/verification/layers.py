"""What the cases of two materials share: moduli, solutions, pressures by region."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from measures import Points
from numpy.typing import NDArray
from structures import converged

from solver import Mesh, Ogden, Problem, Solution, SolverOptions, Supports, Traction, solve

SOFT, STIFF = 1.0, 20.0
"""Shear moduli, MPa, of neo-Hookean layers."""

TIGHT = SolverOptions(tolerance=1e-9)


def solved(
    mesh: Mesh,
    soft: Ogden,
    stiff: Ogden,
    supports: Supports,
    loads: tuple[Traction, ...] = (),
) -> Solution:
    """Equilibrium of a body with a region ``stiff``."""
    problem = Problem(mesh, soft, supports, loads=loads, materials={"stiff": stiff})
    return converged(solve(problem, options=TIGHT))


def region_pressure(
    solution: Solution, where: Callable[[Points], NDArray[np.bool_]]
) -> dict[str, float]:
    """Mean hydrostatic pressure, MPa, of each region at the undeformed places (k, 3) ``where``.

    The elements of no region are called ``""``.
    """
    mesh, values = solution.problem.mesh, solution.hydrostatic_pressure
    chosen = where(mesh.nodes[mesh.vertices])
    return {
        name: float(values[chosen & (mesh.region_of_vertex == number)].mean())
        for number, name in enumerate(mesh.region_names)
    }
