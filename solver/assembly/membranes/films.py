"""Membranes among the unknowns of a problem."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from solver.arrays import Integers, Reals
from solver.assembly.membranes.membranes import Membranes
from solver.assembly.state import State
from solver.linear.sparsity import Pattern
from solver.problem.problem import Problem
from solver.problem.unknowns import Numbering


@dataclass(frozen=True)
class Films:
    """The membranes of a problem, and where they go in its tangent.

    ``entries`` (k, 171): positions of the upper halves of the triangles' tangents in the values of
    the solid's pattern, -1 for none.
    """

    membranes: Membranes
    numbering: Numbering
    entries: Integers

    @staticmethod
    def of(problem: Problem, numbering: Numbering, pattern: Pattern) -> Films | None:
        """The membranes of a problem; None without any."""
        if not problem.membranes:
            return None
        membranes = Membranes.of(problem)
        entries = pattern.entries(numbering.of_triangles(membranes.triangles))
        return Films(membranes, numbering, entries)

    def add(self, state: State, tangent: bool, residual: Reals, values: Reals) -> None:
        """Add forces to ``residual`` and the tangent to ``values``."""
        strains = self.membranes.strains(state.displacement)
        slopes = self.membranes.slopes(state.displacement)
        stresses = self.membranes.stresses(strains)
        residual += self.numbering.gather(self.membranes.summed(stresses, slopes))
        if tangent:
            bent = state.membrane_strain if len(state.membrane_strain) else strains
            upper = self.membranes.tangents(strains, bent, slopes)[:, *np.triu_indices(18)]
            used = self.entries >= 0
            np.add.at(values, self.entries[used], upper[used])

    def extrapolated_strain(self, state: State, increment: State) -> Reals:
        """Strain after an increment from a state, to first order: a ``State.membrane_strain``."""
        return self.membranes.strains_along(state.displacement, increment.displacement)

    def energy(self, state: State) -> float:
        """Energy of all membranes, N mm."""
        return self.membranes.energy(state.displacement)
