"""Cook's membrane: bending and shear of a tapered panel, compressible and not."""

from __future__ import annotations

import numpy as np
from case import Case, Outcome, Row
from measures import Points
from meshes import mapped_box
from structures import converged, node_at, reference, told

from solver import Mesh, Ogden, Problem, Solution, Supports, Traction, solve

GRADING = 1.5
"""Elements get smaller towards the clamp and the upper and lower edge, whose corners are sharp."""


def panel(n: int) -> Mesh:
    """n by n cells in the plane, one across a thickness of half a cell's length."""

    def place(cube: Points) -> Points:
        x = 48 * cube[:, 0] ** GRADING
        side = 2 * cube[:, 1] - 1
        share = 0.5 + 0.5 * np.sign(side) * (1 - (1 - abs(side)) ** GRADING)
        lower, upper = 44 * x / 48, 44 + 16 * x / 48
        return np.stack([x, lower + (upper - lower) * share, 24 / n * cube[:, 2]], axis=1)

    return mapped_box((n, n, 1), place)


def sheared(n: int, material: Ogden, stress: float) -> Solution:
    """The panel in plane strain under a dead shear ``stress`` (MPa) on its right edge."""
    supports = Supports(clamped=("x0",), symmetry={"z0": 2, "z1": 2})
    loads = (Traction("x1", (0.0, stress, 0.0)),)
    return converged(solve(Problem(panel(n), material, supports, loads=loads)))


def moved(solution: Solution, x: float, y: float) -> Points:
    """Displacement (3,) of the node at a point of the front, mm."""
    return solution.displacement[node_at(solution.problem.mesh, x, y, 0.0)]


def bulk_modulus(mu: float, poisson: float) -> float:
    """K of linear elasticity, MPa."""
    return 2 * mu * (1 + poisson) / (3 * (1 - 2 * poisson))


def compressible() -> Outcome:
    """Three meshes, the finer ones within the tolerance."""
    published = reference("F1")["reference"]["u_y"]
    mu = 0.4225
    material = Ogden((mu,), (2.0,), bulk_modulus(mu, 0.3), volumetric="logarithmic")
    rows = []
    for n, tolerance in ((4, 2e-2), (8, 5e-3), (16, 5e-3)):
        ours = moved(sheared(n, material, 1 / 16), 48, 52)[1]
        rows.append(Row(f"u_y (48, 52), {n} × {n}", published, ours, tolerance, "mm"))
    return Outcome(tuple(rows), mesh=CELLS)


CELLS = "n × n cells of 6 tetrahedra, smaller towards the clamp, the upper and the lower edge"


def incompressible() -> Outcome:
    """Three meshes of the stiff and the soft panel, the finest within the tolerance."""
    values = reference("F2")["reference"]
    soft = values["soft_variant"]
    rows: tuple[Row, ...] = ()
    for n, tolerance in ((4, 4e-2), (8, 2e-2), (20, 5e-3)):
        rows += compared(n, STIFF, values, tolerance, "")
        rows += compared(n, soft["mu"], soft, tolerance, "soft, ")
    hard = sheared(20, Ogden((STIFF,), (2.0,), BULK), 6.25)
    name = f"K = {BULK:g} MPa, u_y (48, 52), 20 × 20"
    nearly = Row(name, values["u_y_48_52"], moved(hard, 48, 52)[1], 5e-3, "mm")
    return Outcome((*rows, nearly), mesh=CELLS)


STIFF, BULK = 80.194, 400889.8
"""Shear and bulk modulus, MPa; the bulk modulus lets the volume change by a few millionths."""


def compared(
    n: int, mu: float, values: dict[str, float], tolerance: float, label: str
) -> tuple[Row, ...]:
    """All displacements that have a reference value, on one mesh."""
    panel = sheared(n, Ogden((mu,), (2.0,)), values.get("F", 100.0) / 16)
    rows = []
    for key in ("u_y_48_52", "u_y_48_60", "u_x_48_60"):
        if key in values:
            direction, x, y = key[2], float(key[4:6]), float(key[7:9])
            ours = moved(panel, x, y)["xy".index(direction)]
            name = f"{label}u_{direction} ({x:g}, {y:g}), {n} × {n}"
            rows.append(Row(name, values[key], ours, tolerance, "mm"))
    return tuple(rows)


CASES = (
    Case(
        "F1 Cook's membrane, compressible",
        "A panel at Poisson's ratio 0.3 with W = μ/2 (J^(-2/3) I1 − 3) + κ/4 (J² − 1 − 2 ln J), in "
        "plane strain under a dead shear of 1 N in all; its deflection on three meshes.",
        told("F1"),
        compressible,
    ),
    Case(
        "F2 Cook's membrane, incompressible",
        "The same panel of neo-Hookean rubber that keeps its volume does not lock: even 4 × 4 "
        "cells come within 4 %. Stiff under 100 N and soft under 1 N.",
        told("F2"),
        incompressible,
    ),
)
