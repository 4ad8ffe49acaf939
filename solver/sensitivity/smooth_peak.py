"""A smooth maximum of the recovered nodal von Mises stress, and its derivatives.

The maximum itself jumps from node to node and has no derivative there. The p-norm over the nodes
that count,

    (sum v_a^p)^(1/p),

has: it is homogeneous in the stress, never below the peak, and above it by at most the factor
N^(1/p) of N nodes with one value; by how much is stated with the value. Derivatives go to the
elements at nodes with a weight in them only. A node between regions counts with the stress on each
of its sides (``Mesh.sides``).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from solver.arrays import Integers, Reals
from solver.assembly.assembly import solid
from solver.kernels.element import Solid
from solver.kernels.shape_derivatives import stress_derivatives
from solver.problem.problem import Problem
from solver.results.stress import (
    averaged,
    deviatoric_at_sides,
    extrapolation,
    in_elements,
    von_mises,
)
from solver.sensitivity.surface_integrals import summed

LEAST_WEIGHT = 1e-12
"""Derivative of the smooth peak by a node's stress below which the node is left out."""

SHARPNESS = 64.0
"""Default of p."""


@dataclass(frozen=True)
class SmoothPeak:
    """A smooth maximum of the nodal von Mises stress.

    Attributes:
        value: (sum v^p)^(1/p), MPa.
        sharpness: p.
        peak: the largest nodal value itself, MPa, over the same nodes.
        nodes: how many nodes have a part in it, those between regions once for each.

    Examples:
        >>> from solver import Ogden, Problem, Supports, sensitivities, solve
        >>> from solver.mesh import block
        >>> shell = block((5, 5, 5), (2, 2, 2), hollow=((0, 0, 0), (1, 1, 1)))  # an eighth
        >>> held = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2})
        >>> blown = solve(Problem(shell, Ogden.neo_hooke(0.5), held, ("cavity",)), 0.05)
        >>> smooth = sensitivities(blown).smooth_peak
        >>> print(f"{smooth.value / smooth.peak:.3f} at sharpness {smooth.sharpness:g}")
        1.018 at sharpness 64
    """

    value: float
    sharpness: float
    peak: float
    nodes: int

    @property
    def ratio(self) -> float:
        """Value over peak, at least 1; 1 where there is no stress."""
        return self.value / self.peak if self.peak else 1.0


@dataclass(frozen=True)
class PeakRegion:
    """What a smooth peak depends on: sides of nodes (k,), and the elements there as a ``body``.

    ``tet_sides`` (e, 10): the sides of the nodes of these elements.
    """

    sides: Integers
    tet_sides: Integers
    body: Solid
    sharpness: float

    @staticmethod
    def of(
        problem: Problem, displacement: Reals, counted: NDArray[np.bool_], sharpness: float
    ) -> PeakRegion:
        """The region of the nodes with a weight among those ``counted`` (n,)."""
        mesh, whole = problem.mesh, solid(problem)
        values = von_mises(deviatoric_at_sides(problem, displacement))
        values = np.where(counted[mesh.sides], values, 0.0)
        _, weights = _norm(values, sharpness)
        active = weights > LEAST_WEIGHT
        around = active[mesh.tet_sides].any(axis=1)
        body = whole._replace(
            tets=whole.tets[around],
            tet_vertices=whole.tet_vertices[around],
            material_of=whole.material_of[around],
        )
        sides = np.flatnonzero(active).astype(np.int32)
        return PeakRegion(sides, mesh.tet_sides[around], body, sharpness)

    def value(self, body: Solid, displacement: Reals) -> float:
        """The smooth peak, MPa, with another material or other positions in ``body``."""
        return _norm(von_mises(self._stress(body, displacement)[0]), self.sharpness)[0]

    def change(self, ahead: Solid, behind: Solid, displacement: Reals) -> float:
        """First-order change of the smooth peak between two materials, MPa."""
        here, there, back = (
            self._stress(body, displacement)[0] for body in (self.body, ahead, behind)
        )
        return float((self._weights(here) * (there - back)).sum())

    def peak(self, displacement: Reals) -> SmoothPeak:
        """Value and peak."""
        values = von_mises(self._stress(self.body, displacement)[0])
        value, _ = _norm(values, self.sharpness)
        return SmoothPeak(value, self.sharpness, float(values.max(initial=0.0)), len(self.sides))

    def derivatives(self, displacement: Reals) -> tuple[Reals, Reals]:
        """Derivatives (n, 3) of the smooth peak by positions and by displacements, MPa/mm."""
        tets, sides = self.body.tets, self.tet_sides
        size, number = len(displacement), int(sides.max(initial=0)) + 1
        stress, raw, volumes = self._stress(self.body, displacement)
        shares = np.zeros((number, 6))
        shares[self.sides] = self._weights(stress)
        total = np.bincount(sides.ravel(), np.repeat(volumes, 10), number)
        shares /= np.where(total > 0, total, 1.0)[:, None]
        average = np.zeros((number, 6))
        average[self.sides] = stress
        by_volume = ((raw - average[sides]) * shares[sides]).sum(axis=(1, 2))
        by_raw = volumes[:, None, None] * shares[sides]
        by_stress = extrapolation().T @ by_raw
        parts = np.empty((2, *tets.shape, 3))
        stress_derivatives(
            self.body, np.ascontiguousarray(displacement), by_stress, by_volume, *parts
        )
        return summed(size, tets, parts[0]), summed(size, tets, parts[1])

    def _stress(self, body: Solid, displacement: Reals) -> tuple[Reals, Reals, Reals]:
        """Stress on the sides (k, 6) and in the elements (e, 10, 6), and their volumes (e,)."""
        raw, volumes = in_elements(body, displacement)
        number = int(self.tet_sides.max(initial=0)) + 1
        return averaged(self.tet_sides, raw, volumes, number)[self.sides], raw, volumes

    def _weights(self, stress: Reals) -> Reals:
        """Derivatives (k, 6) of the smooth peak by the stress at the nodes (k, 6)."""
        values = von_mises(stress)
        _, weights = _norm(values, self.sharpness)
        factors = np.repeat([1.5, 3.0], 3)
        slopes: Reals = factors * stress * (weights / np.where(values > 0, values, 1.0))[:, None]
        slopes[:, :3] -= slopes[:, :3].mean(axis=1, keepdims=True)
        return slopes


def _norm(values: Reals, power: float) -> tuple[float, Reals]:
    """(sum v^p)^(1/p) of values v (k,) of at least 0, and its derivatives (k,)."""
    largest = float(values.max(initial=0.0))
    if largest == 0.0:
        return 0.0, np.zeros_like(values)
    shares = values / largest
    total = float((shares**power).sum())
    return largest * total ** (1 / power), total ** (1 / power - 1) * shares ** (power - 1)
