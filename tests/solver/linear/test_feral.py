"""What feral must keep to be the solver where MKL does not exist: inertia and repeatability."""

from __future__ import annotations

import hashlib
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from inertia import needs_feral
from scipy.sparse import csr_array

from solver import Mesh, Ogden, Problem, Supports, Trace, trace
from solver.assembly.assembly import Assembly
from solver.assembly.state import State
from solver.linear.feral import Feral
from solver.linear.interface import SingularMatrix
from solver.linear.solvers import linear_solver
from solver.linear.sparsity import Pattern

pytestmark = needs_feral

Meshes = Callable[..., Mesh]
PLANES = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2})
TANGENTS = 20


@pytest.fixture(scope="module")
def ball(sphere: Meshes, ninjaflex: Ogden) -> Problem:
    return Problem(sphere(10.0, 12.0, 1, 3), ninjaflex, PLANES, ("inside",))


@pytest.fixture(scope="module")
def path(ball: Problem) -> Trace:
    """A balloon through its limit point, far beyond it."""
    return trace(ball, 2.0, steps=TANGENTS)


def dense(pattern: Pattern, values: np.ndarray) -> np.ndarray:
    size = len(pattern.indptr) - 1
    upper = csr_array((values, pattern.indices, pattern.indptr), shape=(size, size)).toarray()
    return upper + np.triu(upper, 1).T


@pytest.mark.thorough
def test_the_inertia_is_right_along_a_path_through_a_limit_point(
    ball: Problem, path: Trace
) -> None:
    assembly, solver = Assembly(ball), linear_solver("feral")
    solver.analyze(assembly.pattern)
    unstable = []
    for state, point in zip(path.states, path.points, strict=True):
        tangent = assembly.evaluate(state, point.pressure).tangent
        solver.factorize(tangent)
        eigenvalues = np.linalg.eigvalsh(dense(assembly.pattern, tangent))
        assert solver.negative_pivots == (eigenvalues < 0).sum()
        unstable.append(solver.negative_pivots - len(ball.mesh.vertices))
    assert len(unstable) > TANGENTS and path.limits[0].kind == "maximum"
    assert unstable[0] == 0 and max(unstable) >= 1 and unstable == sorted(unstable)


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ((1.0, 1.0, 1.0), "zero pivots: 1"),
        ((0.0, 0.0, 0.0), "zero pivots: 2"),
        ((np.nan,) * 3, "NaN"),
    ],
)
def test_feral_by_itself_refuses_what_has_no_solution(
    values: tuple[float, ...], words: str
) -> None:
    solver = Feral()
    solver.analyze(Pattern(np.array([0, 2, 3], np.int32), np.array([0, 1, 1], np.int32)))
    with pytest.raises(SingularMatrix, match=words):
        solver.factorize(np.array(values))
    assert solver.negative_pivots is None


def solution(pattern: Pattern, matrices: list[np.ndarray]) -> np.ndarray:
    """Of the last one of ``matrices``, all of them factorized."""
    solver = linear_solver("feral")
    solver.analyze(pattern)
    for values in matrices:
        solver.factorize(values)
    assert solver.name == "feral"
    return solver.solve(np.ones(len(pattern.indptr) - 1))


def digest(array: np.ndarray) -> str:
    return hashlib.sha256(array.tobytes()).hexdigest()


IN_A_PROCESS = """
import sys
import numpy as np
from solver.linear.solvers import linear_solver
from solver.linear.sparsity import Pattern
data = np.load(sys.argv[1])
pattern = Pattern(data["indptr"], data["indices"])
solver = linear_solver("feral")
solver.analyze(pattern)
solver.factorize(data["values"])
np.save(sys.argv[2], solver.solve(np.ones(len(pattern.indptr) - 1)))
"""


@pytest.fixture(scope="module")
def bar(box: Meshes, ninjaflex: Ogden) -> Assembly:
    """Large enough for two threads to share the work."""
    return Assembly(Problem(box((10, 4, 4)), ninjaflex, Supports(clamped=("x0",)), ("x1",)))


def test_the_same_matrix_gives_the_same_bits_whatever_came_before(bar: Assembly) -> None:
    first = bar.evaluate(State.zero(bar.problem), 0.0).tangent
    other = bar.evaluate(State.zero(bar.problem), 0.5).tangent * np.linspace(
        1.0, 1e4, len(bar.pattern.indices)
    )
    usual = solution(bar.pattern, [first])
    assert digest(solution(bar.pattern, [first, -first, other, first])) == digest(usual)


def test_the_same_bits_in_a_new_process_with_one_thread_and_with_two(
    bar: Assembly, tmp_path: Path
) -> None:
    tangent = bar.evaluate(State.zero(bar.problem), 0.0).tangent
    pattern, given = bar.pattern, tmp_path / "matrix.npz"
    np.savez(given, indptr=pattern.indptr, indices=pattern.indices, values=tangent)
    for threads in ("1", "2"):
        found = tmp_path / f"{threads}.npy"
        environment = os.environ | {"RAYON_NUM_THREADS": threads}
        command = [sys.executable, "-c", IN_A_PROCESS, str(given), str(found)]
        subprocess.run(command, env=environment, check=True)
        assert digest(np.load(found)) == digest(solution(pattern, [tangent]))
