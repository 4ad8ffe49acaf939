"""Other programs' tests: homogeneous states they publish numbers for."""

from __future__ import annotations

import numpy as np
from case import Case, Outcome, Row
from measures import Points
from meshes import box_mesh
from structures import converged, node_at, reference, told

from solver import Ogden, Problem, Solution, SolverOptions, Supports, Traction, solve

TIGHT = SolverOptions(tolerance=1e-10, maximum_iterations=30)
THREE_PLANES = {"x0": 0, "y0": 1, "z0": 2}


def calculix_bar() -> Outcome:
    """Stretches of a compressible bar under a dead force of 1 N."""
    mu = 3.488
    material = Ogden((mu,), (2.163,), bulk_modulus=2 / (0.1 / mu))
    mesh = box_mesh((1, 1, 4), (1.0, 1.0, 8.0), distortion=0.2)
    loads = (Traction("z1", (0.0, 0.0, 1.0)),)
    problem = Problem(mesh, material, Supports(symmetry=THREE_PLANES), loads=loads)
    stretched = 1 + corner(converged(solve(problem, 0.0, TIGHT)), 1.0, 1.0, 8.0) / [1, 1, 8]
    values = reference("P2")["reference"]
    rows = (
        Row("axial stretch", values["axial_stretch"], stretched[2], 1e-5, digits=8),
        Row("lateral stretch", values["lateral_stretch"], stretched[0], 1e-5, digits=8),
    )
    return Outcome(rows, mesh=f"{len(mesh.tets)} tetrahedra")


def corner(solution: Solution, x: float, y: float, z: float) -> Points:
    """Displacement (3,) of the node at a corner, mm."""
    return solution.displacement[node_at(solution.problem.mesh, x, y, z)]


def doubled(positions: Points, load: float) -> Points:
    """The front goes from z = 1 to z = 2, free to shrink."""
    motion = np.full(positions.shape, np.nan)
    motion[:, 2] = load
    return motion


def skfem_cube() -> Outcome:
    """Pressure and volume of a cube stretched to double length.

    There the stress is mu b + p I, here it is mu dev b - q I: p = -q - mu tr b / 3.
    """
    mesh = box_mesh((2, 2, 2), distortion=0.2)
    supports = Supports(symmetry=THREE_PLANES, prescribed={"z1": doubled})
    solution = converged(solve(Problem(mesh, Ogden((1.0,), (2.0,)), supports), 0.0, TIGHT))
    stretches = 1 + corner(solution, 1.0, 1.0, 1.0)
    pressures = -solution.hydrostatic_pressure - (stretches**2).sum() / 3
    values = reference("P4")["reference"]
    rows = (
        Row("smallest p", values["p"], pressures.min(), 1e-4, "MPa", digits=6),
        Row("largest p", values["p"], pressures.max(), 1e-4, "MPa", digits=6),
        Row("volume", values["volume"], stretches.prod(), 1e-4, "mm³", digits=6),
    )
    return Outcome(rows, mesh=f"{len(mesh.tets)} distorted tetrahedra")


CASES = (
    Case(
        "P2 CalculiX's beamog",
        "A bar of 1 × 1 × 8 mm of Ogden's rubber, compressible with K = 2 / D, under a dead force "
        "of 1 N.",
        told("P2"),
        calculix_bar,
    ),
    Case(
        "P4 scikit-fem's example 36",
        "A neo-Hookean cube pulled to twice its length. There the pressure p belongs to the stress "
        "μ b + p I, here q to μ dev b − q I, so p = −q − μ tr b / 3; there λ is 10⁴ MPa, here the "
        "volume is kept exactly.",
        told("P4"),
        skfem_cube,
    ),
)
