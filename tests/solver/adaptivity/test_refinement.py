"""Sizes of the next mesh: finer where the stress is least certain, and as much as asked for."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray

from solver import Mesh, Ogden, Problem, Solution, SolverOptions, Supports, peak_von_mises, solve
from solver.adaptivity.refinement import (
    COARSEST,
    FINEST,
    STEP,
    Refinement,
    _energy_ratios,
    _peak_ratios,
    mean_edges,
    refined_sizes,
)
from solver.results.stress import element_stress, von_mises

Array = NDArray[np.float64]
Meshes = Callable[..., Mesh]
NO_PEAK = 1e9
"""A peak tolerance that asks for nothing."""


@pytest.fixture(scope="module")
def notched(cells: Meshes) -> Solution:
    """A square of 2 mm without its upper right quarter, pulled at its right."""
    square = np.ones((8, 1, 8), int)
    square[4:, :, 4:] = 0
    line = np.linspace(0, 2, 9)
    mesh = cells(square, [line, np.array([0.0, 0.25]), line])
    supports = Supports(symmetry={"x0": 0, "y0": 1, "y1": 1, "z0": 2})
    return solve(Problem(mesh, Ogden((1.0,), (2.0,)), supports, ("x1",)), -0.05)


def ratios(solution: Solution, refinement: Refinement) -> Array:
    """New sizes over old ones at the corners of tetrahedra, which are all alike here."""
    mesh = solution.problem.mesh
    edges = mean_edges(mesh)
    assert np.ptp(edges) < 1e-12
    return refined_sizes(solution, refinement)[mesh.vertices] / edges[0]


def test_mean_edges_of_a_corner_of_a_cube_are_known() -> None:
    corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1.0]])
    pairs = [(0, 1), (1, 2), (0, 2), (0, 3), (2, 3), (1, 3)]
    middles = [(corners[a] + corners[b]) / 2 for a, b in pairs]
    mesh = Mesh(2 * np.concatenate([corners, middles]), np.arange(10)[None])
    assert mean_edges(mesh) == pytest.approx([1 + np.sqrt(2)])


def test_sizes_shrink_where_the_stress_jumps_are_largest(notched: Solution) -> None:
    mesh, wanted = notched.problem.mesh, ratios(notched, Refinement(3.0, NO_PEAK))
    away = np.hypot(*(mesh.nodes[mesh.vertices][:, [0, 2]] - 1).T)
    finest = wanted.argmin()
    assert away[finest] < 1e-9  # at the notch, where the stress is singular
    assert wanted[away < 0.3].max() < wanted[away > 0.9].mean()
    jumps = (von_mises(element_stress(notched).jumps) ** 2).mean(axis=1)
    at_elements = np.log(refined_sizes(notched, Refinement(3.0, NO_PEAK)))[mesh.tets[:, :4]].mean(1)
    assert np.corrcoef(at_elements, np.log(jumps))[0, 1] < -0.7


@pytest.mark.parametrize("growth", [1.5, 3.0, 6.0])
def test_growth_predicted_is_the_growth_asked_for(notched: Solution, growth: float) -> None:
    """An element of half the size makes room for eight; the nodes' averages smooth that a bit."""
    mesh = notched.problem.mesh
    in_elements = _energy_ratios(notched.problem, element_stress(notched), growth)
    assert (in_elements**-3.0).sum() == pytest.approx(growth * len(mesh.tets), rel=1e-3)
    sizes = refined_sizes(notched, Refinement(growth, NO_PEAK))
    smoothed = np.exp(np.log(sizes[mesh.tets[:, :4]]).mean(axis=1)) / mean_edges(mesh)
    assert (smoothed**-3.0).sum() == pytest.approx(growth * len(mesh.tets), rel=0.2)


def test_errors_would_be_alike_in_all_elements(notched: Solution) -> None:
    """As far as the bounds of a size let them: error times ratio to the power 7/2."""
    stress = element_stress(notched)
    in_elements = _energy_ratios(notched.problem, stress, 3.0)
    error = np.sqrt((von_mises(stress.jumps) ** 2).mean(axis=1) * stress.volumes)
    free = (in_elements > FINEST * 1.001) & (in_elements < COARSEST * 0.999)
    target = error[free] * in_elements[free] ** 3.5
    assert free.sum() > 50
    assert target == pytest.approx(target[0], rel=1e-9)


def test_no_element_changes_more_than_one_solution_can_tell(notched: Solution) -> None:
    for refinement in (Refinement(1000.0, NO_PEAK), Refinement(0.01, NO_PEAK), Refinement()):
        wanted = ratios(notched, refinement)
        assert FINEST * (1 - STEP) <= wanted.min() <= wanted.max() <= COARSEST * (1 + STEP)
    assert ratios(notched, Refinement(1000.0, NO_PEAK)) == pytest.approx(FINEST, rel=STEP)
    assert ratios(notched, Refinement(0.01, NO_PEAK)) == pytest.approx(COARSEST, rel=STEP)


@pytest.mark.parametrize("tolerance", [0.02, 0.05, 0.2])
def test_elements_at_the_peak_get_at_most_the_size_that_resolves_it(
    notched: Solution, tolerance: float
) -> None:
    """Stress is of second order: a jump of four times the tolerance asks for half the size."""
    mesh, peak, stress = notched.problem.mesh, peak_von_mises(notched), element_stress(notched)
    around = (mesh.tets == peak.node).any(axis=1)
    jumps = von_mises(stress.jumps)[around].max(axis=1)
    allowed = np.clip(np.sqrt(tolerance * peak.value / jumps), FINEST, COARSEST)
    at_peak = _peak_ratios(notched, stress, Refinement(3.0, tolerance))[around]
    assert at_peak == pytest.approx(allowed, rel=1e-9)
    without, wanted = (ratios(notched, Refinement(3.0, asked)) for asked in (NO_PEAK, tolerance))
    assert (wanted <= without * (1 + 1e-9)).all()


def test_far_from_the_peak_its_demand_is_not_heard(notched: Solution) -> None:
    mesh = notched.problem.mesh
    wanted = ratios(notched, Refinement(1e-3, 1e-6))
    away = np.hypot(*(mesh.nodes[mesh.vertices][:, [0, 2]] - 1).T)
    assert wanted[away.argmin()] == pytest.approx(FINEST, rel=STEP)
    assert wanted[away.argmax()] == pytest.approx(COARSEST, rel=STEP)


def test_an_untrusted_peak_asks_for_nothing(notched: Solution) -> None:
    from dataclasses import replace

    near = replace(notched, problem=replace(notched.problem, sharp_edge_radius=0.6))
    mesh = near.problem.mesh
    at_edge = np.hypot(*(mesh.nodes[mesh.vertices][:, [0, 2]] - 1).T).argmin()
    assert ratios(notched, Refinement(1e-3, 1e-6))[at_edge] == pytest.approx(FINEST, rel=STEP)
    assert ratios(near, Refinement(1e-3, 0.04))[at_edge] == pytest.approx(COARSEST, rel=STEP)


def test_rounding_errors_of_a_solution_make_no_other_sizes(notched: Solution) -> None:
    """So that two runs on different threads make the same next mesh."""
    from dataclasses import replace

    noise = np.random.default_rng(3).uniform(-1e-13, 1e-13, notched.displacement.shape)
    other = replace(notched, displacement=notched.displacement + noise)
    one, two = (refined_sizes(of, Refinement()) for of in (notched, other))
    assert np.mean(one == two) > 0.99
    assert two == pytest.approx(one, rel=1.1 * STEP)


@pytest.mark.parametrize("pressure", [0.0, -0.3])
def test_a_uniform_stress_without_jumps_has_finite_sizes(box: Meshes, pressure: float) -> None:
    planes = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2})
    problem = Problem(box((2, 2, 2)), Ogden((1.0,), (2.0,)), planes, ("x1",))
    solution = solve(problem, pressure, SolverOptions(tolerance=1e-10))
    wanted = ratios(solution, Refinement())
    assert solution.converged and np.isfinite(wanted).all()
    assert FINEST * (1 - STEP) <= wanted.min() <= wanted.max() <= COARSEST * (1 + STEP)


def test_zero_stress_asks_for_no_more_elements_than_growth_does(box: Meshes) -> None:
    planes = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2})
    solution = solve(Problem(box((2, 2, 2)), Ogden((1.0,), (2.0,)), planes, ("x1",)), 0.0)
    assert (ratios(solution, Refinement(3.0)) ** -3.0).mean() <= 3.5
