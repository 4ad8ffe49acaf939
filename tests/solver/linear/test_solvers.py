"""Factorizations of saddle-point matrices."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from scipy.sparse import csr_array

from solver import Mesh, Ogden, Problem, Supports
from solver.assembly.assembly import Assembly
from solver.assembly.state import State
from solver.errors import SolverError
from solver.linear.interface import LinearSolver, SingularMatrix
from solver.linear.solvers import SOLVERS, linear_solver
from solver.linear.sparsity import Pattern, upper_pattern

EVERY = ("pardiso", "feral", "superlu")
COUNTING = ("pardiso", "feral")
"""Those that know the inertia."""


def loaded(name: str) -> LinearSolver:
    try:
        return linear_solver(name)
    except ImportError as error:
        pytest.skip(str(error))


def elastic(box: Callable[..., Mesh], material: Ogden) -> tuple[Assembly, np.ndarray]:
    problem = Problem(box((3, 2, 2)), material, Supports(clamped=("x0",)), ("x1",))
    assembly = Assembly(problem)
    return assembly, assembly.evaluate(State.zero(problem), 0.0).tangent


def whole(assembly: Assembly, values: np.ndarray) -> csr_array:
    size = assembly.numbering.size
    pattern = assembly.pattern
    upper = csr_array((values, pattern.indices, pattern.indptr), shape=(size, size)).toarray()
    return upper + np.triu(upper, 1).T


def dense_pattern(size: int) -> Pattern:
    """Every entry of the upper triangle."""
    return upper_pattern(np.arange(size, dtype=np.int32)[None], size)


@pytest.mark.parametrize("name", EVERY)
def test_solutions_satisfy_the_equations(
    box: Callable[..., Mesh], ninjaflex: Ogden, name: str
) -> None:
    solver = loaded(name)
    assembly, values = elastic(box, ninjaflex)
    solver.analyze(assembly.pattern)
    for scale in (1.0, 3.0):  # one analysis serves many matrices
        solver.factorize(scale * values)
        rhs = np.random.default_rng(0).normal(size=assembly.numbering.size)
        solution = solver.solve(rhs)
        assert scale * whole(assembly, values) @ solution == pytest.approx(rhs, abs=1e-10)


@pytest.mark.parametrize("name", EVERY)
def test_a_bar_100_times_as_long_as_thick_is_solved_well_enough_to_be_steered_by(
    box: Callable[..., Mesh], ninjaflex: Ogden, name: str
) -> None:
    """In single precision the residual was as large as the right-hand side."""
    solver = loaded(name)
    mesh = box((50, 1, 1), (100.0, 1.0, 1.0))
    assembly = Assembly(Problem(mesh, ninjaflex, Supports(clamped=("x0",)), ("z1",)))
    equilibrium = assembly.evaluate(State.zero(assembly.problem), 0.0)
    solver.analyze(assembly.pattern)
    solver.factorize(equilibrium.tangent)
    residual = equilibrium.force - whole(assembly, equilibrium.tangent) @ solver.solve(
        equilibrium.force
    )
    assert np.linalg.norm(residual) < 1e-4 * np.linalg.norm(equilibrium.force)


@pytest.mark.parametrize("name", EVERY)
def test_solutions_are_those_of_the_dense_matrix(
    box: Callable[..., Mesh], ninjaflex: Ogden, name: str
) -> None:
    solver = loaded(name)
    assembly, values = elastic(box, ninjaflex)
    solver.analyze(assembly.pattern)
    solver.factorize(values)
    rhs = np.random.default_rng(1).normal(size=assembly.numbering.size)
    expected = np.linalg.solve(whole(assembly, values), rhs)
    assert solver.solve(rhs) == pytest.approx(expected, abs=1e-10 * abs(expected).max())


@pytest.mark.parametrize("name", COUNTING)
def test_a_stable_body_has_one_negative_pivot_per_pressure(
    box: Callable[..., Mesh], ninjaflex: Ogden, name: str
) -> None:
    solver = loaded(name)
    assembly, values = elastic(box, ninjaflex)
    solver.analyze(assembly.pattern)
    solver.factorize(values)
    eigenvalues = np.linalg.eigvalsh(whole(assembly, values))
    assert solver.negative_pivots == (eigenvalues < 0).sum()
    assert solver.negative_pivots == len(assembly.problem.mesh.vertices)


@pytest.mark.parametrize("name", COUNTING)
def test_the_inertia_of_a_congruence_is_that_of_its_diagonal(name: str) -> None:
    """Sylvester's law: C^T D C has as many negative eigenvalues as D, whatever C is."""
    size, generator = 40, np.random.default_rng(5)
    solver = loaded(name)
    solver.analyze(dense_pattern(size))
    for negative in (0, 1, 13, 39, 40):
        signs = np.where(np.arange(size) < negative, -1.0, 1.0)
        mixed = generator.normal(size=(size, size))
        solver.factorize((mixed.T * signs @ mixed)[np.triu_indices(size)])
        assert solver.negative_pivots == negative
        assert solver.odd_negative is bool(negative % 2)


@pytest.mark.parametrize("name", COUNTING)
def test_a_saddle_without_a_stiffness_of_its_own_is_no_obstacle(name: str) -> None:
    """[[0, B], [B^T, 0]]: every pivot on the diagonal is zero, half of the eigenvalues negative."""
    half = 6
    coupling = np.random.default_rng(2).normal(size=(half, half))
    saddle = np.block([[np.zeros((half, half)), coupling], [coupling.T, np.zeros((half, half))]])
    solver = loaded(name)
    solver.analyze(dense_pattern(2 * half))
    solver.factorize(saddle[np.triu_indices(2 * half)])
    assert solver.negative_pivots == half
    assert saddle @ solver.solve(np.ones(2 * half)) == pytest.approx(np.ones(2 * half), abs=1e-10)


SINGULAR = {
    "two equal rows": [[1.0, 1.0, 0.0], [1.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
    "a row of zeros": [[2.0, 1.0, 0.0], [1.0, 3.0, 0.0], [0.0, 0.0, 0.0]],
    "nothing but zeros": [[0.0] * 3] * 3,
    "two equal constraints": [[1.0, 2.0, 2.0], [2.0, 0.0, 0.0], [2.0, 0.0, 0.0]],
}


@pytest.mark.parametrize("name", ["feral", "superlu"])
@pytest.mark.parametrize("case", SINGULAR)
def test_a_singular_matrix_is_refused_and_the_next_one_is_not(name: str, case: str) -> None:
    """PARDISO perturbs zero pivots instead."""
    solver = loaded(name)
    solver.analyze(dense_pattern(3))
    with pytest.raises(SingularMatrix):
        solver.factorize(np.array(SINGULAR[case])[np.triu_indices(3)])
    solver.factorize(np.eye(3)[np.triu_indices(3)])
    assert solver.solve(np.arange(3.0)) == pytest.approx(np.arange(3.0))


@pytest.mark.parametrize("name", EVERY)
def test_many_factorizations_live_side_by_side(
    box: Callable[..., Mesh], ninjaflex: Ogden, name: str
) -> None:
    assembly, values = elastic(box, ninjaflex)
    solvers = [loaded(name) for _ in range(3)]
    for scale, solver in enumerate(solvers, start=1):
        solver.analyze(assembly.pattern)
        solver.factorize(scale * values)
    rhs = np.ones(assembly.numbering.size)
    first = solvers[0].solve(rhs)
    del solvers[1]
    assert solvers[-1].solve(rhs) == pytest.approx(first / 3, rel=1e-9)


@pytest.mark.parametrize("name", EVERY)
def test_every_solver_knows_whether_the_number_of_negative_eigenvalues_is_odd(
    box: Callable[..., Mesh], ninjaflex: Ogden, name: str
) -> None:
    solver = loaded(name)
    assembly, values = elastic(box, ninjaflex)
    solver.analyze(assembly.pattern)
    diagonal = assembly.pattern.indptr[:-1]
    for row in range(0, 40, 7):  # push one eigenvalue after the other below zero
        values[diagonal[row]] = -50.0
        solver.factorize(values)
        negative = (np.linalg.eigvalsh(whole(assembly, values)) < 0).sum()
        assert solver.odd_negative is bool(negative % 2)


def missing() -> LinearSolver:
    raise ImportError("hidden")


@pytest.mark.parametrize(
    ("hidden", "chosen"),
    [((), "pardiso"), (("pardiso",), "feral"), (("pardiso", "feral"), "superlu")],
)
def test_auto_is_the_fastest_solver_that_can_be_loaded(
    monkeypatch: pytest.MonkeyPatch, hidden: tuple[str, ...], chosen: str
) -> None:
    loaded(chosen)
    for name in hidden:
        monkeypatch.setitem(SOLVERS, name, missing)
    assert linear_solver("auto").name == linear_solver().name == chosen


def test_a_solver_asked_for_by_name_is_that_one_or_none(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("solver.linear.feral._load_feral", missing)
    with pytest.raises(ImportError, match="hidden"):
        linear_solver("feral")
    assert linear_solver("superlu").name == "superlu"


def test_an_unknown_name_is_refused_with_the_known_ones() -> None:
    words = "linear_solver must be one of auto, pardiso, feral, superlu, got 'umfpack'."
    with pytest.raises(SolverError, match=words):
        linear_solver("umfpack")
