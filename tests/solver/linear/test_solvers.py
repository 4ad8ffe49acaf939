"""Factorizations of saddle-point matrices."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from scipy.sparse import csr_array

from solver import Mesh, Ogden, Problem, Supports
from solver.assembly.assembly import Assembly
from solver.assembly.state import State
from solver.linear.interface import LinearSolver, SingularMatrix
from solver.linear.solvers import linear_solver
from solver.linear.sparsity import upper_pattern


def pardiso() -> LinearSolver:
    try:
        return linear_solver("pardiso")
    except ImportError:
        pytest.skip("MKL is not installed")


def elastic(box: Callable[..., Mesh], material: Ogden) -> tuple[Assembly, np.ndarray]:
    problem = Problem(box((3, 2, 2)), material, Supports(clamped=("x0",)), ("x1",))
    assembly = Assembly(problem)
    return assembly, assembly.evaluate(State.zero(problem), 0.0).tangent


def whole(assembly: Assembly, values: np.ndarray) -> csr_array:
    size = assembly.numbering.size
    pattern = assembly.pattern
    upper = csr_array((values, pattern.indices, pattern.indptr), shape=(size, size)).toarray()
    return upper + np.triu(upper, 1).T


@pytest.mark.parametrize("name", ["pardiso", "superlu"])
def test_solutions_satisfy_the_equations(
    box: Callable[..., Mesh], ninjaflex: Ogden, name: str
) -> None:
    solver = pardiso() if name == "pardiso" else linear_solver(name)
    assembly, values = elastic(box, ninjaflex)
    solver.analyze(assembly.pattern)
    for scale in (1.0, 3.0):  # one analysis serves many matrices
        solver.factorize(scale * values)
        rhs = np.random.default_rng(0).normal(size=assembly.numbering.size)
        solution = solver.solve(rhs)
        assert scale * whole(assembly, values) @ solution == pytest.approx(rhs, abs=1e-10)


@pytest.mark.parametrize("name", ["pardiso", "superlu"])
def test_a_bar_100_times_as_long_as_thick_is_solved_well_enough_to_be_steered_by(
    box: Callable[..., Mesh], ninjaflex: Ogden, name: str
) -> None:
    """In single precision the residual was as large as the right-hand side."""
    solver = pardiso() if name == "pardiso" else linear_solver(name)
    mesh = box((50, 1, 1), (100.0, 1.0, 1.0))
    assembly = Assembly(Problem(mesh, ninjaflex, Supports(clamped=("x0",)), ("z1",)))
    equilibrium = assembly.evaluate(State.zero(assembly.problem), 0.0)
    solver.analyze(assembly.pattern)
    solver.factorize(equilibrium.tangent)
    residual = equilibrium.force - whole(assembly, equilibrium.tangent) @ solver.solve(
        equilibrium.force
    )
    assert np.linalg.norm(residual) < 1e-4 * np.linalg.norm(equilibrium.force)


def test_a_stable_body_has_one_negative_pivot_per_pressure(
    box: Callable[..., Mesh], ninjaflex: Ogden
) -> None:
    solver = pardiso()
    assembly, values = elastic(box, ninjaflex)
    solver.analyze(assembly.pattern)
    solver.factorize(values)
    eigenvalues = np.linalg.eigvalsh(whole(assembly, values))
    assert solver.negative_pivots == (eigenvalues < 0).sum()
    assert solver.negative_pivots == len(assembly.problem.mesh.vertices)


def test_superlu_reports_a_singular_matrix() -> None:
    solver = linear_solver("superlu")
    solver.analyze(upper_pattern(np.array([[0, 1]], np.int32), 2))
    with pytest.raises(SingularMatrix):
        solver.factorize(np.array([1.0, 1.0, 1.0]))


def test_many_factorizations_live_side_by_side(box: Callable[..., Mesh], ninjaflex: Ogden) -> None:
    assembly, values = elastic(box, ninjaflex)
    solvers = [pardiso() for _ in range(3)]
    for scale, solver in enumerate(solvers, start=1):
        solver.analyze(assembly.pattern)
        solver.factorize(scale * values)
    rhs = np.ones(assembly.numbering.size)
    first = solvers[0].solve(rhs)
    del solvers[1]
    assert solvers[-1].solve(rhs) == pytest.approx(first / 3, rel=1e-9)


@pytest.mark.parametrize("name", ["pardiso", "superlu"])
def test_either_solver_knows_whether_the_number_of_negative_eigenvalues_is_odd(
    box: Callable[..., Mesh], ninjaflex: Ogden, name: str
) -> None:
    solver = pardiso() if name == "pardiso" else linear_solver(name)
    assembly, values = elastic(box, ninjaflex)
    solver.analyze(assembly.pattern)
    diagonal = assembly.pattern.indptr[:-1]
    for row in range(0, 40, 7):  # push one eigenvalue after the other below zero
        values[diagonal[row]] = -50.0
        solver.factorize(values)
        negative = (np.linalg.eigvalsh(whole(assembly, values)) < 0).sum()
        assert solver.odd_negative is bool(negative % 2)
