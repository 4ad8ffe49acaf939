"""What a solver of sparse symmetric systems keeps to."""

from __future__ import annotations

from typing import Protocol

from solver.arrays import Reals
from solver.linear.sparsity import Pattern


class LinearSolver(Protocol):
    """Solves A x = b for symmetric A, given as its upper triangle in CSR.

    ``analyze`` once per pattern, ``factorize`` once per matrix, ``solve`` once per right-hand
    side. ``factorize`` raises ``SingularMatrix`` where the factorization breaks down.
    ``negative_pivots`` counts the negative eigenvalues of the last matrix; None where unknown.
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
    def factorize(self, values: Reals) -> None: ...
    def solve(self, right_hand_side: Reals) -> Reals: ...


class SingularMatrix(ArithmeticError):
    """The matrix could not be factorized."""
