"""Manufactured solutions: orders of convergence on distorted meshes."""

from __future__ import annotations

from functools import partial

from case import Case, Order, Outcome, Row
from manufactured import Manufactured, Swirl
from measures import Points, displacement_error, observed_order, pressure_error
from meshes import box_mesh
from references import NINJAFLEX

from solver import (
    BodyForce,
    Ogden,
    Problem,
    Solution,
    SolverOptions,
    Supports,
    Traction,
    solve,
)

SIZES = (2, 3, 5)
TIGHT = SolverOptions(tolerance=1e-9, maximum_iterations=20)
COMPRESSIBLE = Ogden(NINJAFLEX.mu, NINJAFLEX.alpha, bulk_modulus=20.0)
NEARLY_INCOMPRESSIBLE = Ogden(NINJAFLEX.mu, NINJAFLEX.alpha, bulk_modulus=2000.0)
FREE = {"x1": (1.0, 0.0, 0.0), "y0": (0.0, -1.0, 0.0), "z1": (0.0, 0.0, 1.0)}


def loaded(made: Manufactured, n: int) -> Solution:
    """The unit cube, three faces led along the made-up motion, three under its tractions."""
    mesh = box_mesh((n, n, n), distortion=0.2)

    def motion(positions: Points, load: float) -> Points:
        return load * made.motion.displacement(positions)

    supports = Supports(prescribed={surface: motion for surface in ("x0", "y1", "z0")})
    tractions = [Traction(surface, made.traction(normal)) for surface, normal in FREE.items()]
    loads = (BodyForce(made.body_force), *tractions)
    solution = solve(Problem(mesh, made.material, supports, loads=loads), 0.0, TIGHT)
    assert solution.converged, solution.message
    return solution


def convergence(made: Manufactured) -> Outcome:
    """Errors of displacement and pressure over the sizes."""
    displacements, pressures = [], []
    for n in SIZES:
        solution = loaded(made, n)
        displacements.append(displacement_error(solution, made.motion.displacement))
        pressures.append(pressure_error(solution, made.pressure))
    rows = (
        Row("displacement, relative L2 error, finest", 0.0, displacements[-1], 2e-3, absolute=True),
        Row("pressure, relative L2 error, finest", 0.0, pressures[-1], 2e-2, absolute=True),
    )
    orders = (
        Order("displacement, L2", observed_order(SIZES, displacements), 2.8, "3"),
        Order("pressure, L2", observed_order(SIZES, pressures), 1.8, "2"),
    )
    return Outcome(rows, orders, f"{6 * SIZES[-1] ** 3} distorted tetrahedra, {len(SIZES)} meshes")


SOURCE = "made up; the loads follow from the closed-form stress of the motion."
CASES = (
    Case(
        "MMS Incompressible",
        "A cube of NinjaFlex in three superposed waves of shear (J = 1 exactly), held there by "
        "body force, tractions and led faces.",
        SOURCE,
        partial(convergence, Manufactured(Swirl(), NINJAFLEX)),
    ),
    Case(
        "MMS Compressible",
        "The same with a wave of volume change, at a bulk modulus of 20 MPa.",
        SOURCE,
        partial(convergence, Manufactured(Swirl(swelling=0.03), COMPRESSIBLE)),
    ),
    Case(
        "MMS Nearly incompressible",
        "The same with a hundredth of the change of volume, at a bulk modulus of 2000 MPa: the "
        "orders do not suffer (no locking).",
        SOURCE,
        partial(convergence, Manufactured(Swirl(swelling=3e-4), NEARLY_INCOMPRESSIBLE)),
        slow=True,
    ),
)
