"""What a solver of sparse systems keeps to."""

from __future__ import annotations

from typing import Protocol

from solver.arrays import Reals
from solver.linear.sparsity import Pattern


class LinearSolver(Protocol):
    """Solves A x = b for a matrix A with a symmetric pattern, given as its upper triangle in CSR.

    ``analyze`` once per pattern, ``factorize`` once per matrix, ``solve`` once per right-hand
    side, or with the transpose of A for an adjoint. A has the upper triangle ``values + skew``, the
    lower one ``values - skew``; without ``skew`` it is symmetric. Solvers for symmetric matrices
    only raise ``ValueError`` if given any. ``factorize`` raises ``SingularMatrix`` where the
    factorization breaks down. ``negative_pivots`` counts the negative eigenvalues of the last
    matrix; None where unknown.
    ``odd_negative`` says whether their number is odd, which may be known where it is not.
    ``name`` is what a result says it was solved with.
    """

    @property
    def name(self) -> str: ...
    @property
    def negative_pivots(self) -> int | None: ...
    @property
    def odd_negative(self) -> bool | None: ...

    def analyze(self, pattern: Pattern) -> None: ...
    def factorize(self, values: Reals, skew: Reals | None = None) -> None: ...
    def solve(self, right_hand_side: Reals, transposed: bool = False) -> Reals: ...


class SingularMatrix(ArithmeticError):
    """The matrix could not be factorized."""


def require_symmetric(name: str, skew: Reals | None) -> None:
    """Raise ``ValueError`` for a matrix with a skew part."""
    if skew is not None and len(skew):
        raise ValueError(f"{name} takes symmetric matrices only.")
