"""Confined compression: displacements are known beforehand, the pressure is not."""

from __future__ import annotations

import numpy as np
from case import Case, Outcome, Row
from measures import Points
from meshes import box_mesh
from structures import converged

from solver import Ogden, Problem, Solution, SolverOptions, Supports, nodal_cauchy, reaction, solve
from solver.material.law import Volumetric

LATERAL = {"y0": 1, "y1": 1, "z0": 2, "z1": 2}
STRETCHES = (0.2, 0.5, 1.5, 3.0)
BULK = 20.0
LAWS = {
    "NinjaFlex": ((0.19825, 3.2778), (3.05, -0.0054)),
    "neo-Hooke": ((1.0,), (2.0,)),
    "Mooney-Rivlin": ((0.8, 0.2), (2.0, -2.0)),
}
"""Constants mu (MPa) and exponents alpha; W = sum of 2 mu / alpha^2 (sum of x_i^alpha - 3)."""


def confined(volumetric: Volumetric) -> Outcome:
    """Axial force and lateral stress of a unit cube, its sides held, one end led."""
    rows = []
    for name, (mu, alpha) in LAWS.items():
        material = Ogden(mu, alpha, BULK, volumetric=volumetric)
        for stretch in STRETCHES:
            solution = _led(material, stretch)
            axial, lateral = _stresses(mu, alpha, volumetric, stretch)
            force = -reaction(solution, "x0").force[0]
            found = float(nodal_cauchy(solution)[:, 1].mean())
            rows.append(Row(f"{name}, force at λ = {stretch:g}", axial, force, 3e-5, "N"))
            rows.append(Row(f"{name}, lateral stress", lateral, found, 3e-5, "MPa"))
    return Outcome(tuple(rows), mesh="6 tetrahedra")


def _led(material: Ogden, stretch: float) -> Solution:
    def motion(positions: Points, load: float) -> Points:
        displacement = np.full(positions.shape, np.nan)
        displacement[:, 0] = load * (stretch - 1) * positions[:, 0]
        return displacement

    supports = Supports(symmetry={"x0": 0, **LATERAL}, prescribed={"x1": motion})
    return converged(solve(Problem(box_mesh((1, 1, 1)), material, supports), options=OPTIONS))


OPTIONS = SolverOptions()
"""The default tolerances are what is tested."""


def _stresses(
    mu: tuple[float, ...], alpha: tuple[float, ...], volumetric: Volumetric, stretch: float
) -> tuple[float, float]:
    """Axial and lateral Cauchy stress, MPa; the section keeps its area, so J is the stretch."""
    isochoric = np.array([stretch ** (2 / 3), stretch ** (-1 / 3), stretch ** (-1 / 3)])
    pairs = zip(mu, alpha, strict=True)
    kirchhoff = sum(2 * m / a * (isochoric**a - (isochoric**a).mean()) for m, a in pairs)
    quadratic = BULK * (stretch - 1)
    logarithmic = BULK * (stretch - 1 / stretch) / 2
    mean = quadratic if volumetric == "quadratic" else logarithmic
    axial, lateral, _ = (float(s) for s in kirchhoff / stretch + mean)
    return axial, lateral


def _case(volumetric: Volumetric) -> Case:
    return Case(
        f"Confined compression, {volumetric} law",
        "A cube whose sides are held and whose end is led: every displacement is right at once, "
        "and what is left to find is the hydrostatic pressure, at default tolerances.",
        "closed form. Status: exact",
        lambda: confined(volumetric),
    )


CASES = (_case("logarithmic"), _case("quadratic"))
