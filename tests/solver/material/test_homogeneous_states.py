"""Blocks in homogeneous states of the finite element solver: volumetric laws and Yeoh's model."""

from __future__ import annotations

from collections.abc import Callable
from typing import Literal

import numpy as np
import pytest

from solver import Mesh, Ogden, Problem, SolverOptions, Supports, Traction, solve

Meshes = Callable[..., Mesh]
THREE_PLANES = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2})
TIGHT = SolverOptions(tolerance=1e-9, maximum_iterations=40)


@pytest.mark.parametrize("pressure", [-2.0, 0.8, 9.0])
def test_the_logarithmic_law_sets_the_volume_of_a_block_under_pressure(
    box: Meshes, pressure: float
) -> None:
    bulk = 20.0
    material = Ogden((1.0,), (2.0,), bulk, (0.1,), "logarithmic")
    mesh = box((2, 1, 1))
    solution = solve(Problem(mesh, material, THREE_PLANES, ("x1", "y1", "z1")), pressure, TIGHT)
    assert solution.converged, solution.message
    volume = float(np.prod(1 + solution.displacement.max(axis=0)))
    if pressure > 0:
        volume = float(np.prod(1 + solution.displacement.min(axis=0)))
    assert bulk / 2 * (volume - 1 / volume) == pytest.approx(-pressure, rel=1e-8)
    assert solution.hydrostatic_pressure == pytest.approx(pressure, abs=1e-8)


LAWS: tuple[Literal["quadratic", "logarithmic"], ...] = ("quadratic", "logarithmic")


@pytest.mark.parametrize("law", LAWS)
def test_a_compressible_block_pulled_in_one_direction_balances_both_parts_of_the_energy(
    box: Meshes, law: Literal["quadratic", "logarithmic"]
) -> None:
    nominal, bulk = 0.8, 4.0
    material = Ogden((0.7, 0.3), (3.0, -1.0), bulk, (0.05, -0.002), law)
    mesh = box((2, 2, 2), distortion=0.2)
    pull = Traction("x1", (nominal, 0.0, 0.0))
    solution = solve(Problem(mesh, material, THREE_PLANES, loads=(pull,)), options=TIGHT)
    assert solution.converged, solution.message
    stretches = 1 + solution.displacement.max(axis=0)
    stretches[1:] = 1 + solution.displacement.min(axis=0)[1:]
    volume = float(stretches.prod())
    logs = np.log(stretches) - np.log(volume) / 3
    tension = bulk * (volume - 1) if law == "quadratic" else bulk / 2 * (volume - 1 / volume)
    stresses = material.principal_stresses(logs) / volume + tension
    cauchy = nominal / (stretches[1] * stretches[2])
    assert stresses == pytest.approx([cauchy, 0.0, 0.0], abs=1e-8)
    assert volume > 1.02


def test_a_pulled_block_of_yeoh_stiffens_as_the_closed_form_says(box: Meshes) -> None:
    c10, c20, c30 = 0.11, -0.01, 0.002
    stretch = 3.0
    x = stretch**2 + 2 / stretch - 3
    slope = c10 + 2 * c20 * x + 3 * c30 * x**2
    nominal = 2 * (stretch - 1 / stretch**2) * slope
    mesh = box((1, 1, 1))
    pull = Traction("x1", (nominal, 0.0, 0.0))
    problem = Problem(mesh, Ogden.yeoh(c10, c20, c30), THREE_PLANES, loads=(pull,))
    solution = solve(problem, options=TIGHT)
    assert solution.converged, solution.message
    expected = mesh.nodes * (np.array([stretch, stretch**-0.5, stretch**-0.5]) - 1)
    assert solution.displacement == pytest.approx(expected, abs=1e-7)
