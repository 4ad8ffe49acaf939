"""Adjoint solutions: the transposed tangent at the converged state, by a factorization at hand.

That factorization may be of an earlier iterate or less precise. Its solutions are refined against
the tangent of the state itself; only where this does not converge is the tangent factorized anew.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Protocol

import numpy as np
from scipy.sparse import csr_array

from solver.arrays import Reals
from solver.assembly.assembly import Assembly, Equilibrium
from solver.errors import SolverError
from solver.linear.interface import SingularMatrix
from solver.nonlinear.linear_system import LinearSystem
from solver.results.solution import Solution, check_solution
from solver.sensitivity.work import Equilibrated

ENOUGH = 1e-10
"""Relative residual at which refinement ends."""

LARGEST = 1e-6
"""Relative residual above which an adjoint is not used."""

CONTRACTION, CONTRACTION_AT_HAND = 0.3, 0.03
"""Refinement that does not reduce the residual to this share is given up; sooner with an earlier
factorization: a new one costs as much as seven solutions, and each adjoint would need as many."""

MOST_REFINEMENTS = 8


class Workspace(Protocol):
    """What a solve leaves: its assembly, and the linear system with its last factorization.

    ``solver.nonlinear.newton.Newton`` is one.
    """

    @property
    def assembly(self) -> Assembly: ...
    @property
    def system(self) -> LinearSystem: ...


@dataclass(frozen=True)
class Tangent:
    """Both triangles of the tangent of an equilibrium, as products with vectors (m,)."""

    upper: csr_array
    diagonal: Reals
    skew: csr_array | None

    @staticmethod
    def of(equilibrium: Equilibrium) -> Tangent:
        """From the values of the upper triangle."""
        pattern = equilibrium.pattern
        size = len(pattern.indptr) - 1

        def matrix(values: Reals) -> csr_array:
            return csr_array((values, pattern.indices, pattern.indptr), shape=(size, size))

        skew = matrix(equilibrium.skew) if len(equilibrium.skew) else None
        upper = matrix(equilibrium.tangent)
        return Tangent(upper, upper.diagonal(), skew)

    def times(self, vector: Reals, transposed: bool = False) -> Reals:
        """The product, or that of the transpose."""
        result: Reals = self.upper @ vector + self.upper.T @ vector - self.diagonal * vector
        if self.skew is None:
            return result
        skew: Reals = self.skew @ vector - self.skew.T @ vector
        return result - skew if transposed else result + skew


SENSITIVITIES = "sensitivities"
"""What errors name if not told otherwise."""


@dataclass
class TangentSystem:
    """Linear systems with the tangent of ``equilibrium``, solved by ``system`` and refined.

    ``caller``: what errors name. ``factorizations``: how many were made for it.
    """

    at: Equilibrated
    system: LinearSystem
    equilibrium: Equilibrium
    caller: str = SENSITIVITIES
    factorizations: int = 0
    tangent: Tangent = field(init=False)

    def __post_init__(self) -> None:
        self.tangent = Tangent.of(self.equilibrium)

    @staticmethod
    def of(
        solution: Solution, workspace: Workspace | None, caller: str = SENSITIVITIES
    ) -> TangentSystem:
        """At a solution, with the factorization of a ``workspace`` or a new one.

        Raises ``SolverError`` if the tangent is singular, or the workspace is of another problem.
        """
        problem = solution.problem
        if workspace is not None and workspace.assembly.problem is not problem:
            raise SolverError(f"{caller}: the workspace belongs to another problem.")
        assembly = Assembly(problem) if workspace is None else workspace.assembly
        at = Equilibrated(assembly, solution.state, solution.pressure, solution.load)
        equilibrium = assembly.evaluate(at.state, at.pressure, load=at.load)
        if not equilibrium.admissible:
            raise SolverError(f"{caller}: an element of the state is turned inside out.")
        if workspace is not None:
            return TangentSystem(at, workspace.system, equilibrium, caller)
        return TangentSystem(at, LinearSystem(assembly, "auto"), equilibrium, caller)

    def factorize(self) -> None:
        """Factorize the tangent of the state itself. Raises ``SolverError`` if it is singular."""
        try:
            self.system.factorize(self.equilibrium)
        except SingularMatrix as error:
            raise SolverError(f"{self.caller}: {SINGULAR} ({error}).") from error
        self.factorizations += 1

    def solve(self, right_hand_side: Reals, transposed: bool = False) -> tuple[Reals, float]:
        """Solution (m,) and its residual relative to the right-hand side.

        Raises ``SolverError`` if the tangent is singular to working precision.
        """
        if not self.system.factorized:
            self.factorize()
        vector, residual = self._refined(right_hand_side, transposed)
        if not residual <= LARGEST and not self.factorizations:
            self.factorize()
            vector, residual = self._refined(right_hand_side, transposed)
        if not residual <= LARGEST:
            raise SolverError(f"{self.caller}: {SINGULAR} (relative residual {residual:.1e}).")
        return vector, residual

    def _refined(self, right_hand_side: Reals, transposed: bool) -> tuple[Reals, float]:
        """The best solution by refinement with the last factorization, and its residual."""
        scale = inner(right_hand_side, right_hand_side) ** 0.5 or 1.0
        best, least = np.zeros_like(right_hand_side), 1.0
        enough = CONTRACTION if self.factorizations else CONTRACTION_AT_HAND
        vector, rest = best, right_hand_side
        for _ in range(MOST_REFINEMENTS):
            vector = vector + self.system.solve(rest, transposed)
            rest = right_hand_side - self.tangent.times(vector, transposed)
            residual = inner(rest, rest) ** 0.5 / scale
            if not residual < least:
                break
            slow, best, least = residual > enough * least, vector, residual
            if least <= ENOUGH or slow:
                break
        return best, least


def inner(one: Reals, other: Reals) -> float:
    """Scalar product; not by BLAS, whose threads wait longer than such vectors take."""
    return float((one * other).sum())


def check_equilibrium(solution: Solution, caller: str = SENSITIVITIES) -> None:
    """Raise ``SolverError`` unless a solution is an equilibrium at the whole load of one stage.

    ``caller``: what the error names.
    """
    check_solution(solution)
    if not solution.converged:
        raise SolverError(
            f"{caller}: the solution did not converge ({solution.message.rstrip('.')}); "
            "derivatives belong to an equilibrium at the whole load."
        )
    if len(solution.remaining_force):
        raise SolverError(
            f"{caller}: the equilibrium lies between two stages of loading; derivatives of "
            "what the stage before has left are not known."
        )


SINGULAR = (
    "the tangent is singular at this state, as at a limit point or bifurcation; "
    "derivatives exist only away from it"
)
