"""Matrices that feral refuses go to SuperLU, and the result says so."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from inertia import needs_feral

from solver import Mesh, Ogden, Problem, Solution, SolverOptions, Supports, Traction, solve
from solver.arrays import Reals
from solver.linear.fallback import Fallback
from solver.linear.feral import Feral
from solver.linear.interface import SingularMatrix
from solver.linear.sparsity import Pattern, upper_pattern
from solver.linear.superlu import SuperLU

FERAL = SolverOptions(linear_solver="feral")


class Choosy:
    """Takes positive numbers, one by one."""

    name = "choosy"
    negative_pivots: int | None = 0
    odd_negative: bool | None = False

    def analyze(self, pattern: Pattern) -> None:
        assert len(pattern.indices) == 1

    def factorize(self, values: Reals) -> None:
        if values[0] <= 0:
            raise SingularMatrix("not positive")
        self._value = values[0]

    def solve(self, right_hand_side: Reals) -> Reals:
        return right_hand_side / self._value


@pytest.fixture
def number() -> Fallback:
    """For matrices of one number."""
    solver = Fallback(Choosy(), SuperLU())
    solver.analyze(upper_pattern(np.zeros((1, 1), np.int32), 1))
    return solver


def test_as_long_as_nothing_is_refused_the_second_solver_does_nothing(number: Fallback) -> None:
    number.factorize(np.array([2.0]))
    assert number.solve(np.array([3.0])) == pytest.approx(1.5)
    assert (number.name, number.negative_pivots, number.odd_negative) == ("choosy", 0, False)


def test_what_the_first_refuses_the_second_factorizes(number: Fallback) -> None:
    number.factorize(np.array([-2.0]))
    assert number.solve(np.array([3.0])) == pytest.approx(-1.5)
    assert number.name == "choosy, superlu"
    assert (number.negative_pivots, number.odd_negative) == (None, True)


def test_the_next_matrix_is_the_firsts_again_and_the_name_still_tells(number: Fallback) -> None:
    for value in (-2.0, 2.0):
        number.factorize(np.array([value]))
        assert number.solve(np.array([3.0])) == pytest.approx(3.0 / value)
    assert (number.name, number.negative_pivots) == ("choosy, superlu", 0)


def test_a_new_pattern_reaches_the_second_solver_too(number: Fallback) -> None:
    number.factorize(np.array([-2.0]))
    number.analyze(upper_pattern(np.zeros((2, 1), np.int32), 1))
    number.factorize(np.array([-4.0]))
    assert number.solve(np.array([2.0])) == pytest.approx(-0.5)


def test_what_both_refuse_is_singular_and_the_second_is_not_named(number: Fallback) -> None:
    with pytest.raises(SingularMatrix):
        number.factorize(np.array([0.0]))
    assert number.name == "choosy"


def pulled(mesh: Mesh, material: Ogden) -> Solution:
    loads = (Traction("x1", (0.05, 0.0, 0.0)),)
    return solve(Problem(mesh, material, Supports(clamped=("x0",)), loads=loads), options=FERAL)


@needs_feral
@pytest.mark.parametrize("size", [1.0, 1000.0])  # far units are scaled
def test_the_result_says_which_solvers_it_took(
    box: Callable[..., Mesh], ninjaflex: Ogden, monkeypatch: pytest.MonkeyPatch, size: float
) -> None:
    mesh = box((2, 1, 1), (2 * size, size, size))
    usual = pulled(mesh, ninjaflex)
    assert usual.linear_solver == "feral" and usual.stable

    def refuse(_solver: Feral, _values: Reals) -> None:
        raise SingularMatrix("refused")

    monkeypatch.setattr(Feral, "factorize", refuse)
    portable = pulled(mesh, ninjaflex)
    assert portable.linear_solver == "feral, superlu" and portable.stable is None
    assert portable.displacement == pytest.approx(usual.displacement, abs=1e-6 * size)
