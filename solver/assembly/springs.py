"""Forces of linear springs, and their part of the tangent.

Springs act on all displacements, given ones included, so forces come from the matrix over all nodes
and the tangent takes its entries between unknowns.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_array, triu

from solver.arrays import Integers, Reals
from solver.linear.sparsity import Pattern
from solver.problem.problem import Problem
from solver.problem.springs import stiffness_matrix
from solver.problem.unknowns import Numbering


@dataclass(frozen=True)
class Springs:
    """All springs of a problem.

    ``matrix`` (3 n, 3 n) over the displacements, N/mm; ``entries`` (k,) positions of its upper
    triangle between unknowns in the values of the solid's pattern, and the ``values`` (k,) there.
    """

    matrix: csr_array
    entries: Integers
    values: Reals

    @staticmethod
    def of(problem: Problem, numbering: Numbering, pattern: Pattern) -> Springs | None:
        """The springs of a problem; None without any."""
        if not problem.springs:
            return None
        matrix = stiffness_matrix(problem.mesh, problem.springs)
        size = numbering.size
        numbers, coordinates = numbering.displacement.ravel(), matrix.tocoo()
        rows, columns = numbers[coordinates.row], numbers[coordinates.col]
        between = (rows >= 0) & (columns >= 0)
        places = (rows[between], columns[between])
        upper = triu(csr_array((coordinates.data[between], places), shape=(size, size))).tocoo()
        pairs = np.stack([upper.row, upper.col], axis=1).astype(np.int32)
        diagonal = pairs[:, 0] == pairs[:, 1]
        entries = np.where(
            diagonal, pattern.entries(pairs)[:, 0], pattern.entries(pairs)[:, 1]
        ).astype(np.int32)
        return Springs(matrix, entries, upper.data)

    def forces(self, displacement: Reals) -> Reals:
        """Stiffness times displacement (n, 3), N: minus the forces of the springs on the body."""
        forces: Reals = (self.matrix @ displacement.ravel()).reshape(-1, 3)
        return forces

    def energy(self, displacement: Reals) -> float:
        """Energy of all springs, N mm."""
        return 0.5 * float(displacement.ravel() @ self.forces(displacement).ravel())
