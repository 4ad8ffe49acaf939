"""What PARDISO's error numbers mean, and that MKL is used as the binding needs it."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from solver.linear import pardiso
from solver.linear.interface import SingularMatrix
from solver.linear.sparsity import upper_pattern

ROOT = Path(__file__).parents[3]


@pytest.fixture
def solver() -> pardiso.Pardiso:
    """For matrices of one number."""
    try:
        solver = pardiso.Pardiso()
    except ImportError as error:
        pytest.skip(str(error))
    solver.analyze(upper_pattern(np.zeros((1, 1), np.int32), 1))
    return solver


@pytest.mark.parametrize(
    ("number", "kind", "words"),
    [
        (-1, RuntimeError, "error -1 in phase 22"),
        (-2, MemoryError, "no memory for the factors"),
        (-3, RuntimeError, "error -3 in phase 22"),
        (-4, SingularMatrix, "error -4 in phase 22"),
        (-7, SingularMatrix, "error -7 in phase 22"),
        (-8, MemoryError, "32-bit integers"),
        (-9, MemoryError, "no memory for the factors"),
    ],
)
def test_only_what_says_so_is_a_singular_matrix(
    number: int,
    kind: type[Exception],
    words: str,
    solver: pardiso.Pardiso,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(pardiso, "_pardiso", lambda *_: number)
    with pytest.raises(kind, match=words):
        solver.factorize(np.array([2.0]))


SOLVES_TWO = """
import numpy as np
from solver.linear.pardiso import Pardiso
from solver.linear.sparsity import upper_pattern
solver = Pardiso()
solver.analyze(upper_pattern(np.arange(2, dtype=np.int32)[None], 2))
solver.factorize(np.array([2.0, 1.0, -3.0]))
print(*np.round(solver.solve(np.array([3.0, -2.0])), 12), solver.negative_pivots)
"""


@pytest.mark.parametrize(
    "variables",
    [
        {"MKL_INTERFACE_LAYER": "GNU,ILP64", "MKL_THREADING_LAYER": "TBB"},
        pytest.param({"MKL_INTERFACE_LAYER": "ILP64"}, marks=pytest.mark.slow),
        pytest.param({"MKL_INTERFACE_LAYER": "GNU"}, marks=pytest.mark.slow),
        pytest.param({"MKL_THREADING_LAYER": "GNU"}, marks=pytest.mark.slow),
        pytest.param({"MKL_THREADING_LAYER": "PGI"}, marks=pytest.mark.slow),
        pytest.param({"MKL_THREADING_LAYER": "SEQUENTIAL"}, marks=pytest.mark.slow),
    ],
    ids=str,
)
def test_layers_that_another_program_asked_for_are_not_used(
    variables: dict[str, str], solver: pardiso.Pardiso
) -> None:
    done = subprocess.run(
        [sys.executable, "-c", SOLVES_TWO],
        cwd=ROOT,
        env={**os.environ, "PYTHONPATH": str(ROOT), **variables},
        capture_output=True,
        encoding="utf-8",
    )
    assert (done.stdout, done.returncode) == ("1.0 1.0 1\n", 0), done.stderr


def test_an_interface_that_is_in_use_already_is_no_solver(monkeypatch: pytest.MonkeyPatch) -> None:
    """``auto`` takes another solver then."""

    class InUse:
        def MKL_Set_Interface_Layer(self, wanted: int) -> int:
            return 1

    with pytest.raises(ImportError, match="not LP64"):
        pardiso._with_our_interface(InUse())  # type: ignore[arg-type]
