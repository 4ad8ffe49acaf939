"""Scaling of the unknowns where lengths or moduli are many powers of ten from mm and MPa.

Or from each other, as in a body of several materials.

Unscaled, a linear solver would take pivots for zeros there. A displacement's pivots are of the
order of mu h, the coupling with a pressure of h^2, for a shear modulus mu and elements of size h.
With unknowns scaled by (mu h)^(-1/2) and (mu / h^3)^(1/2) all of them are of order 1, whatever the
units are, mu being that of the stiffest element at a node and of the region of a pressure. The
factors are powers of two, so that scaling is exact.
"""

from __future__ import annotations

import numpy as np

from solver.arrays import Reals
from solver.linear.interface import LinearSolver
from solver.linear.sparsity import Pattern
from solver.problem.problem import Problem
from solver.problem.unknowns import Numbering

LENGTHS, MODULI = (1e-2, 1e2), (1e-4, 1e4)
"""Mean edges (mm) and shear moduli (MPa) that need no scaling."""

RATIO = 10.0
"""Ratio of the shear moduli of two materials of one body that needs no scaling."""


def factors(problem: Problem, numbering: Numbering) -> Reals | None:
    """Scale of each unknown (m,), or None where none is needed."""
    edge, moduli = problem.mesh.edge, problem.distribution.moduli
    lengths_fit = LENGTHS[0] <= edge <= LENGTHS[1]
    moduli_fit = MODULI[0] <= moduli.min() <= moduli.max() <= MODULI[1]
    if lengths_fit and moduli_fit and moduli.max() <= RATIO * moduli.min():
        return None
    at_nodes, at_vertices = _moduli(problem)
    scale = np.full(numbering.size, (moduli.max() * edge) ** -0.5)
    free = numbering.displacement >= 0
    of_nodes = np.broadcast_to(at_nodes[:, None], free.shape)
    scale[numbering.displacement[free]] = (of_nodes[free] * edge) ** -0.5
    scale[numbering.pressure] = (at_vertices / edge**3) ** 0.5
    if numbering.plane[0] >= 0:
        scale[numbering.plane[0]] /= problem.mesh.size  # displaces points by tilt times size
    return np.exp2(np.rint(np.log2(scale)))


def _moduli(problem: Problem) -> tuple[Reals, Reals]:
    """Shear moduli that pivots go with, MPa: of displacements by node (n,), of pressures (v,).

    At a node the stiffest element counts, for a pressure the region that it is in.
    """
    mesh, distribution = problem.mesh, problem.distribution
    at_nodes = np.zeros(len(mesh.nodes))
    np.maximum.at(at_nodes, mesh.tets.ravel(), np.repeat(distribution.tet_moduli, 10))
    return at_nodes, distribution.region_moduli[mesh.region_of_vertex]


def scaled(solver: LinearSolver, scale: Reals | None) -> LinearSolver:
    """``solver`` with its unknowns scaled, if there is a scale."""
    return solver if scale is None else Scaled(solver, scale)


class Scaled:
    """A linear solver for D A D instead of A."""

    def __init__(self, solver: LinearSolver, scale: Reals) -> None:
        self._solver, self._scale, self._products = solver, scale, np.zeros(0)

    @property
    def name(self) -> str:
        """As for A; that of a fallback may change."""
        return self._solver.name

    @property
    def negative_pivots(self) -> int | None:
        """Those of D A D are as many as those of A."""
        return self._solver.negative_pivots

    @property
    def odd_negative(self) -> bool | None:
        """As for A."""
        return self._solver.odd_negative

    def analyze(self, pattern: Pattern) -> None:
        """Analyze the pattern, and compute each entry's factor."""
        rows = np.repeat(self._scale, np.diff(pattern.indptr))
        self._products = rows * self._scale[pattern.indices]
        self._solver.analyze(pattern)

    def factorize(self, values: Reals, skew: Reals | None = None) -> None:
        """Factorize D A D."""
        if skew is None or not len(skew):
            self._solver.factorize(self._products * values)
        else:
            self._solver.factorize(self._products * values, self._products * skew)

    def solve(self, right_hand_side: Reals, transposed: bool = False) -> Reals:
        """Solve A x = b by D A D y = D b, x = D y."""
        return self._scale * self._solver.solve(self._scale * right_hand_side, transposed)
