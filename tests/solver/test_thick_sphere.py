"""A thick sphere under internal pressure against its closed form."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from solver import Mesh, Ogden, Problem, Solution, Supports, cavity_volume, nodal_von_mises, solve

CASES = json.loads((Path(__file__).parent / "data/thick_sphere.json").read_text())["cases"][0]
NINJAFLEX = CASES["reference"]["NinjaFlex_A10_B12"]["P_of_lambda_a"]


def inflated(mesh: Mesh, material: Ogden, pressure: float) -> Solution:
    supports = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2})
    return solve(Problem(mesh, material, supports, ("inside",)), pressure)


def radial(solution: Solution, surface: str) -> np.ndarray:
    """Radial displacements of the vertices on a surface."""
    mesh = solution.problem.mesh
    nodes = np.unique(mesh.triangles(surface)[:, :3])
    directions = mesh.nodes[nodes] / np.linalg.norm(mesh.nodes[nodes], axis=1, keepdims=True)
    return (solution.displacement[nodes] * directions).sum(axis=1)


@pytest.mark.parametrize("stretch", ["1.01", "1.1", "1.25"])
def test_inner_radius_follows_the_closed_form(
    sphere: Callable[..., Mesh], ninjaflex: Ogden, stretch: str
) -> None:
    solution = inflated(sphere(10.0, 12.0, 2, 5), ninjaflex, NINJAFLEX[stretch])
    assert solution.converged, solution.message
    expected = 10.0 * (float(stretch) - 1)
    assert radial(solution, "inside").mean() == pytest.approx(expected, rel=3e-3)
    outer = np.cbrt(12**3 + 10**3 * (float(stretch) ** 3 - 1)) - 12
    assert radial(solution, "outside").mean() == pytest.approx(outer, rel=3e-3)


def test_error_falls_with_high_order(sphere: Callable[..., Mesh], ninjaflex: Ogden) -> None:
    errors = []
    sizes = np.array([2, 4, 8])
    for n in sizes:
        mesh = sphere(10.0, 12.0, max(1, n // 4), n)
        solution = inflated(mesh, ninjaflex, NINJAFLEX["1.1"])
        inner = cavity_volume(mesh, solution.displacement, ("inside",))
        errors.append(abs(inner / (np.pi * 11.0**3 / 6) - 1))
    order = -np.polyfit(np.log(sizes), np.log(errors), 1)[0]
    assert order > 3, errors


def test_surface_stress_is_that_of_a_biaxial_shell(
    sphere: Callable[..., Mesh], ninjaflex: Ogden
) -> None:
    solution = inflated(sphere(10.0, 12.0, 2, 6), ninjaflex, NINJAFLEX["1.1"])
    hoop = float(np.log(1.1))
    stress = ninjaflex.principal_stresses([hoop, hoop, -2 * hoop])
    inside = np.unique(solution.problem.mesh.triangles("inside")[:, :3])
    assert nodal_von_mises(solution)[inside] == pytest.approx(stress[0] - stress[2], rel=0.05)
