"""A solver that leaves the matrices it refuses to another one."""

from __future__ import annotations

from solver.arrays import Reals
from solver.linear.interface import LinearSolver, SingularMatrix, require_symmetric
from solver.linear.sparsity import Pattern


class Fallback:
    """``first``, and ``second`` for every matrix that ``first`` takes for singular.

    Raises ``SingularMatrix`` where both do. The ``name`` is that of ``first``; from the first
    matrix on that was left to ``second``, of both.
    """

    def __init__(self, first: LinearSolver, second: LinearSolver) -> None:
        self._first, self._second, self._last = first, second, first
        self._unseen: Pattern | None = None
        self.name = first.name

    @property
    def negative_pivots(self) -> int | None:
        """By the solver that factorized the last matrix."""
        return self._last.negative_pivots

    @property
    def odd_negative(self) -> bool | None:
        """By the solver that factorized the last matrix."""
        return self._last.odd_negative

    def analyze(self, pattern: Pattern) -> None:
        """For ``first``; for ``second`` only where it is needed."""
        self._first.analyze(pattern)
        self._unseen = pattern

    def factorize(self, values: Reals, skew: Reals | None = None) -> None:
        """Factorize with ``first``, else with ``second``."""
        require_symmetric(self.name, skew)
        self._last = self._first
        try:
            self._first.factorize(values)
        except SingularMatrix:
            self._factorize_with_second(values)

    def solve(self, right_hand_side: Reals, transposed: bool = False) -> Reals:
        """Solve with the last factorization."""
        return self._last.solve(right_hand_side)

    def _factorize_with_second(self, values: Reals) -> None:
        if self._unseen is not None:
            self._second.analyze(self._unseen)
            self._unseen = None
        self._second.factorize(values)
        self._last = self._second
        self.name = f"{self._first.name}, {self._second.name}"
