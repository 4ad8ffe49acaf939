"""Factorization of a problem's tangent: solutions, and stability by its inertia."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from solver.arrays import Reals
from solver.assembly.assembly import Assembly, Equilibrium
from solver.assembly.state import State
from solver.linear.interface import LinearSolver
from solver.linear.scaling import factors, scaled
from solver.linear.solvers import linear_solver
from solver.linear.sparsity import Pattern


@dataclass(frozen=True)
class Kind:
    """What decides which linear solver a matrix gets: its name, symmetry, and scale (m,)."""

    name: str
    symmetric: bool
    scale: Reals | None

    def same(self, other: Kind) -> bool:
        """Whether one solver does for both."""
        names = (self.name, self.symmetric) == (other.name, other.symmetric)
        if self.scale is None or other.scale is None:
            return names and self.scale is other.scale
        return names and np.array_equal(self.scale, other.scale)


class LinearSystem:
    """The last factorization of the tangent of an ``assembly``, by the solver ``name``.

    Attributes:
        factorized: whether there is a factorization, of this assembly or of one before.
    """

    factorized: bool
    _solver: LinearSolver
    _analyzed: Pattern

    def __init__(self, assembly: Assembly, name: str, former: LinearSystem | None = None) -> None:
        """``former``: of a problem before, of no use after that.

        Its ordering, and until the next one its factorization, are taken over if the matrices are
        of one kind.
        """
        self._numbering = assembly.numbering
        self._pressures = len(assembly.problem.mesh.vertices)
        self._kind = Kind(name, assembly.symmetric, factors(assembly.problem, assembly.numbering))
        if former is not None and former._kind.same(self._kind):
            self._solver, self._analyzed = former._solver, former._analyzed
            self.factorized = former.factorized
            return
        self._solver = scaled(linear_solver(name, assembly.symmetric), self._kind.scale)
        self._solver.analyze(assembly.pattern)
        self._analyzed, self.factorized = assembly.pattern, False

    def forget(self) -> None:
        """Drop the factorization: it is of a state that led nowhere."""
        self.factorized = False

    @property
    def name(self) -> str:
        """Name of the linear solver."""
        return self._solver.name

    @property
    def negative_pivots(self) -> int | None:
        """Negative eigenvalues of the last tangent; None where the solver cannot tell."""
        return self._solver.negative_pivots

    def factorize(self, equilibrium: Equilibrium) -> None:
        """Factorize a tangent; contact may have changed its pattern. Raises ``SingularMatrix``."""
        self.factorized = False
        if equilibrium.pattern is not self._analyzed:
            self._solver.analyze(equilibrium.pattern)
            self._analyzed = equilibrium.pattern
        self._solver.factorize(equilibrium.tangent, equilibrium.skew)
        self.factorized = True

    def solve(self, right_hand_side: Reals, transposed: bool = False) -> Reals:
        """Solve for the unknowns (m,) with the last factorization, or its transpose."""
        return self._solver.solve(right_hand_side, transposed)

    def increment(self, right_hand_side: Reals) -> State:
        """The same as an increment of the state."""
        return self.expanded(self.solve(right_hand_side))

    def expanded(self, vector: Reals) -> State:
        """A vector over the unknowns (m,) as an increment of the state."""
        return State(*self._numbering.expand(vector))

    @property
    def unstable_modes(self) -> int | None:
        """Number of modes in which the body of the last tangent is unstable; None if unknown.

        Negative eigenvalues beyond one for each pressure. Where only their parity is known, a
        wrong one counts as one mode, and a right one as unknown. Loads without a potential leave it
        at that: a wrong sign of the determinant means that the body diverges, a right one does not
        exclude that it flutters.
        """
        negative = self._solver.negative_pivots
        if negative is not None:
            return abs(negative - self._pressures)
        odd = self._solver.odd_negative
        return None if odd is None or odd == (self._pressures % 2 == 1) else 1

    @property
    def stable(self) -> bool | None:
        """Whether the last factorized tangent is that of a stable state; None if unknown."""
        return None if self.unstable_modes is None else self.unstable_modes == 0
