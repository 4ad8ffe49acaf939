"""From one equilibrium to that of a neighbouring problem, and what both have in common."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from solver import Mesh, Ogden, Problem, Solution, SolverOptions, Supports, solve
from solver.errors import SolverError
from solver.nonlinear.newton import Newton
from solver.paths.neighbouring import neighbouring
from solver.sensitivity.gradients import gradients

PRESSURE = 0.05
EXACT = SolverOptions(tolerance=1e-10, reuse=0)


@pytest.fixture(scope="module")
def problem(cell: Mesh, ninjaflex: Ogden) -> Problem:
    """A quarter of a bubble whose gap's middle stays plane."""
    supports = Supports(symmetry={"y0": 1, "x0": 0})
    return Problem(cell, ninjaflex, supports, ("cavity",), moving_plane="x1")


@pytest.fixture(scope="module")
def solved(problem: Problem) -> Solution:
    return solve(problem, PRESSURE, EXACT)


def on(problem: Problem, factors: tuple[float, float, float]) -> Problem:
    """The problem with its mesh stretched along x, y and z."""
    return replace(problem, mesh=problem.mesh.moved(problem.mesh.nodes * factors))


@pytest.mark.parametrize("factors", [(1.05, 1, 1), (1, 0.95, 1), (1.03, 0.96, 1.04)])
def test_neighbour_is_the_state_that_the_load_leads_to_from_zero(
    problem: Problem, solved: Solution, factors: tuple[float, float, float]
) -> None:
    there = on(problem, factors)
    found = neighbouring(there, PRESSURE, solved, options=EXACT).solution
    walked = solve(there, PRESSURE, EXACT)
    assert found is not None
    assert found.converged and found.stable in (True, None)
    assert np.abs(found.displacement - walked.displacement).max() < 1e-8
    assert found.rotation == pytest.approx(walked.rotation, rel=1e-8)


def test_neighbour_of_a_neighbour_takes_over_ordering_and_factorization(
    problem: Problem, solved: Solution
) -> None:
    first = neighbouring(on(problem, (1.02, 1, 1)), PRESSURE, solved)
    assert first.solution is not None
    layout = first.newton.assembly.layout
    second = neighbouring(on(problem, (1.03, 1, 1)), PRESSURE, first.solution, first.newton)
    anew = neighbouring(on(problem, (1.03, 1, 1)), PRESSURE, first.solution)
    assert second.solution is not None and anew.solution is not None
    assert second.newton.assembly.layout is layout
    assert second.solution.factorizations <= anew.solution.factorizations
    size = problem.mesh.size
    apart = np.abs(second.solution.displacement - anew.solution.displacement).max()
    assert apart < SolverOptions.tolerance * size


def test_other_material_and_pressure_are_neighbours_too(problem: Problem, solved: Solution) -> None:
    stiffer = replace(problem, material=Ogden(mu=(0.2, 3.4), alpha=(3.05, -0.0054)))
    found = neighbouring(stiffer, 1.05 * PRESSURE, solved, options=EXACT).solution
    walked = solve(stiffer, 1.05 * PRESSURE, EXACT)
    assert found is not None and found.pressure == 1.05 * PRESSURE
    assert found.rotation == pytest.approx(walked.rotation, rel=1e-8)


def test_failure_says_why_and_leaves_no_solution(problem: Problem, solved: Solution) -> None:
    found = neighbouring(problem, 40 * PRESSURE, solved)
    assert found.solution is None
    assert found.failure
    again = neighbouring(problem, PRESSURE, solved, found.newton)
    assert again.solution is not None
    assert again.solution.rotation == pytest.approx(solved.rotation, rel=1e-6)


def test_other_regions_are_no_neighbour(problem: Problem, solved: Solution) -> None:
    """Even where there are as many pressures as there were."""
    halves = [np.arange(len(problem.mesh.tets)) % 2 == k for k in (0, 1)]
    one, other = (
        replace(
            problem, mesh=problem.mesh.with_regions({"half": np.flatnonzero(half).astype(np.int32)})
        )
        for half in halves
    )
    with pytest.raises(SolverError, match="same regions"):
        neighbouring(one, 0.1, solved)
    with pytest.raises(SolverError, match="same regions"):
        neighbouring(one, 0.1, replace(solved, problem=other))


def test_other_tetrahedra_are_no_neighbour(problem: Problem, solved: Solution) -> None:
    mesh = problem.mesh
    fewer = Mesh(mesh.nodes, mesh.tets[::-1], dict(mesh.surfaces))
    with pytest.raises(SolverError, match="same tetrahedra"):
        neighbouring(replace(problem, mesh=fewer), PRESSURE, solved)


def test_moved_mesh_shares_what_does_not_depend_on_positions(cell: Mesh) -> None:
    faces, vertices = cell.outer_faces, cell.vertices
    moved = cell.moved(1.5 * cell.nodes)
    assert moved.outer_faces is faces and moved.vertices is vertices
    assert moved.edge == pytest.approx(1.5 * cell.edge)
    with pytest.raises(SolverError, match="moved nodes must have the shape"):
        cell.moved(cell.nodes[:-1])


def test_what_a_solve_leaves_serves_derivatives_and_the_next_solve(problem: Problem) -> None:
    left: list[Newton] = []
    solution = solve(problem, PRESSURE, keep=left.append)
    anew, kept = gradients(solution), gradients(solution, left[0])
    for name, gradient in anew.responses.items():
        scale = np.abs(gradient.nodes).max()
        assert kept.responses[name].nodes == pytest.approx(gradient.nodes, abs=1e-6 * scale)
    layout = left[0].assembly.layout
    found = neighbouring(on(problem, (1.01, 1, 1)), PRESSURE, solution, left[0])
    assert found.solution is not None and found.newton.assembly.layout is layout


def test_keep_must_be_a_function(problem: Problem) -> None:
    with pytest.raises(SolverError, match="keep must be a function of what a solve leaves"):
        solve(problem, PRESSURE, keep=1)  # type: ignore[arg-type]
