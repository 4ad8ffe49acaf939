"""SciPy's SuperLU."""

from __future__ import annotations

import numpy as np

from solver.arrays import Reals
from solver.linear.interface import SingularMatrix
from solver.linear.sparsity import Pattern, WholeMatrix, is_odd


class SuperLU:
    """SciPy's SuperLU on the whole matrix, symmetric or not: slower and hungrier, but everywhere.

    Its pivots are not the matrix's inertia, but their signs and the swaps of rows and columns give
    the sign of the determinant: whether the number of negative eigenvalues is odd.
    """

    name = "superlu"
    negative_pivots: int | None = None
    odd_negative: bool | None = None

    def analyze(self, pattern: Pattern) -> None:
        """Build the full matrix's pattern and where its values come from."""
        from scipy.sparse import csc_array

        self._whole = whole = WholeMatrix.of(pattern)
        size = len(pattern.indptr) - 1
        zeros = np.zeros(len(whole.indices))
        self._full = csc_array((zeros, whole.indices, whole.indptr), shape=(size, size))

    def factorize(self, values: Reals, skew: Reals | None = None) -> None:
        """Numerical factorization; SuperLU repeats the ordering every time."""
        from scipy.sparse.linalg import splu

        self._full.data = self._whole.by_columns(values, skew)
        try:
            self._factor = splu(
                self._full,
                permc_spec="MMD_AT_PLUS_A",
                diag_pivot_thresh=0.01,
                options={"SymmetricMode": True},
            )
        except RuntimeError as error:
            raise SingularMatrix(str(error)) from error
        negative = int(np.count_nonzero(self._factor.U.diagonal() < 0))
        swaps = (is_odd(order) for order in (self._factor.perm_r, self._factor.perm_c))
        self.odd_negative = bool((negative + sum(swaps)) % 2 == 1)

    def solve(self, right_hand_side: Reals, transposed: bool = False) -> Reals:
        """Solve with the last factorization and one step of iterative refinement."""
        matrix, mode = (self._full.T, "T") if transposed else (self._full, "N")
        solution = self._factor.solve(right_hand_side, mode)
        return solution + self._factor.solve(right_hand_side - matrix @ solution, mode)
