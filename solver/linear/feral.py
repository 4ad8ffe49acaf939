"""The package feral-solver: a portable L D L^T that counts negative eigenvalues."""

from __future__ import annotations

from typing import Any

import numpy as np

from solver.arrays import Reals
from solver.linear.interface import SingularMatrix, require_symmetric
from solver.linear.sparsity import Pattern

FERAL_OPTIONS = {
    # approximate minimum fill: as sparse as METIS's factors, ordered in a fraction of the time
    "ordering": "amf",
    # always the same, where the default is what suits the first matrix of a pattern
    "scaling": "infnorm",
    # no fused multiplications, which not every processor has
    "fma": False,
}


class Feral:
    """feral's multifrontal L D L^T with Bunch-Kaufman pivoting, in double precision.

    Its factors depend on the matrix alone, not on threads or on what was factorized before. To be
    used in the thread that made it. Raises ``ImportError`` where the package is not installed.
    """

    name = "feral"

    def __init__(self) -> None:
        self.negative_pivots: int | None = None
        self._feral = _load_feral()
        self._solver = self._feral.Solver(**FERAL_OPTIONS)
        self._matrix: Any = None

    @property
    def odd_negative(self) -> bool | None:
        """Whether the last matrix has an odd number of negative eigenvalues."""
        return None if self.negative_pivots is None else self.negative_pivots % 2 == 1

    def analyze(self, pattern: Pattern) -> None:
        """Keep the pattern; feral orders it when it factorizes its first matrix.

        The upper triangle row by row is what feral takes: the lower one column by column.
        """
        pointer, rows = (numbers.astype(np.int64) for numbers in (pattern.indptr, pattern.indices))
        self._matrix = self._feral.CscMatrix(len(pointer) - 1, pointer, rows, np.zeros(len(rows)))

    def factorize(self, values: Reals, skew: Reals | None = None) -> None:
        """Numerical factorization; feral accepts zero pivots and counts them, this does not."""
        require_symmetric(self.name, skew)
        self.negative_pivots = None
        try:
            status, inertia = self._solver.factor(self._matrix.set_values(values))
        except (self._feral.FeralError, ValueError) as error:
            raise SingularMatrix(f"feral: {error}") from error
        if status != self._feral.FactorStatus.SUCCESS or inertia.n_zero:
            raise SingularMatrix(f"feral met zero pivots: {inertia.n_zero}")
        self.negative_pivots = inertia.n_neg

    def solve(self, right_hand_side: Reals, transposed: bool = False) -> Reals:
        """Solve with the last factorization."""
        return self._solver.solve(np.ascontiguousarray(right_hand_side, np.float64))


def _load_feral() -> Any:
    """The package feral-solver; raises ``ImportError`` where it is not installed."""
    try:
        import feral
    except ImportError as error:
        raise ImportError("feral cannot be loaded; install the package feral-solver.") from error
    return feral
