"""Residual and tangent of a body of two materials."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from two_materials import HARD, OTHER, SOFT, layered

from solver import Problem, Supports, Traction, solve
from solver.assembly.assembly import Assembly
from solver.assembly.layout import Layout
from solver.assembly.state import State
from solver.linear.scaling import factors


def body(distortion: float = 0.2) -> Problem:
    mesh = layered((2, 1, 2), distortion=distortion)
    return Problem(mesh, SOFT, Supports(("x0",)), materials={"hard": OTHER})


def state(problem: Problem, size: float = 0.02) -> State:
    random, mesh = np.random.default_rng(4), problem.mesh
    displacement = random.uniform(-size, size, mesh.nodes.shape)
    displacement[mesh.surface_nodes("x0")] = 0.0
    return State(displacement, random.uniform(-1.0, 1.0, len(mesh.vertices)))


def beside(assembly: Assembly, at: State, step: np.ndarray) -> State:
    du, dq, _ = assembly.numbering.expand(step)
    return State(at.displacement + du, at.hydrostatic_pressure + dq)


def test_the_tangent_is_the_derivative_of_the_residual() -> None:
    problem = body()
    assembly, at = Assembly(problem), state(problem)
    direction = np.random.default_rng(5).normal(size=assembly.numbering.size)
    there, back = (
        assembly.evaluate(beside(assembly, at, s * 1e-6 * direction), 0.0) for s in (1, -1)
    )
    found = assembly.evaluate(at, 0.0)
    size, pattern = assembly.numbering.size, found.pattern
    upper = np.zeros((size, size))
    rows = np.repeat(np.arange(size), np.diff(pattern.indptr))
    upper[rows, pattern.indices] = found.tangent
    product = (upper + np.triu(upper, 1).T) @ direction
    difference = (there.residual - back.residual) / 2e-6
    assert difference == pytest.approx(product, abs=1e-6 * abs(product).max())


def test_the_residual_is_the_derivative_of_the_energy() -> None:
    problem = body()
    assembly, at = Assembly(problem), state(problem)
    direction = np.random.default_rng(6).normal(size=assembly.numbering.size)
    there, back = (assembly.energy(beside(assembly, at, s * 1e-6 * direction)) for s in (1, -1))
    slope = assembly.evaluate(at, 0.0, tangent=False).residual @ direction
    assert (there - back) / 2e-6 == pytest.approx(slope, rel=1e-6)


def test_a_layout_fits_regions_of_the_same_elements_only() -> None:
    problem = body()
    layout = Layout.of(problem)
    mesh = problem.mesh
    renamed = replace(mesh, regions={"other": mesh.regions["hard"]})
    assert layout.fits(Problem(renamed, SOFT, problem.supports))
    none = replace(mesh, regions={})
    assert not layout.fits(Problem(none, SOFT, problem.supports))


def test_unknowns_are_scaled_where_materials_differ_by_more_than_ten() -> None:
    problem = replace(body(), materials={"hard": HARD})
    assembly = Assembly(problem)
    assert factors(problem, assembly.numbering) is None
    stiffer = replace(problem, materials={"hard": replace(HARD, mu=(1e5,))})
    scale = factors(stiffer, assembly.numbering)
    assert scale is not None
    pressures = scale[assembly.numbering.pressure]
    hard = stiffer.mesh.region_of_vertex == 1
    assert np.unique(pressures[hard]) / np.unique(pressures[~hard]) == pytest.approx(512.0)


@pytest.mark.parametrize("ratio", [1e2, 1e5, 1e10])
def test_pivots_count_modes_whatever_the_ratio_of_stiffness_is(ratio: float) -> None:
    """Without scaling PARDISO counts wrongly from 1e9 on: it takes small pivots for zeros."""
    stiff = replace(HARD, mu=(ratio,))
    problem = replace(body(0.0), materials={"hard": stiff})
    pressed = replace(problem, loads=(Traction("z0", (0.02, 0.0, 0.0)),))
    found = solve(pressed)
    assert found.converged
    assert found.negative_pivots in (len(problem.mesh.vertices), None)
    assert found.stable in (True, None)
