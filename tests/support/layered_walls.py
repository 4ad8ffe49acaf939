"""Closed forms of bodies of several layers, each incompressible and neo-Hookean.

Walls under pressure: the pressure drops over each layer as over a wall of its own, whose inner
radius is stretched as that of the layer is. Bending of a block in plane strain (R. S. Rivlin,
*Proc. R. Soc. A* 195, 463, 1949): lines across the layers stay straight and the layers become
circular, so that the square of the stretch along them, s = C + 2 k Z, grows linearly with the
undeformed height Z, where k is the angle per undeformed length. Equilibrium along the radius makes
the radial stress mu / 2 (s + 1 / s) plus a constant in each layer, and it vanishes on both faces.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq
from thick_walls import difference, sphere_outside, sphere_pressure, tube_state

from solver import Ogden

POINTS, WEIGHTS = np.polynomial.legendre.leggauss(40)

Values = NDArray[np.float64]


@dataclass(frozen=True)
class Wall:
    """Layers of a hollow sphere or a tube: ``radii`` (k + 1,) in mm and shear ``moduli`` (k,)."""

    radii: tuple[float, ...]
    moduli: tuple[float, ...]

    def sphere_pressure(self, stretch: float) -> float:
        """Pressure in a sphere whose inner radius is stretched, MPa."""

        def outside(inner: float, outer: float, stretch: float) -> float:
            return sphere_outside(inner, outer, stretch)

        return sum(self._drops(stretch, outside, sphere_pressure))

    def tube_drops(self, stretch: float) -> list[float]:
        """Drop of the pressure, MPa, over each layer of a tube that keeps its length."""

        def outside(inner: float, outer: float, stretch: float) -> float:
            return float(np.sqrt((stretch * inner) ** 2 + outer**2 - inner**2))

        def drop(material: Ogden, inner: float, outer: float, stretch: float) -> float:
            return tube_state(material, inner, outer, stretch, 1.0)[0]

        return self._drops(stretch, outside, drop)

    def _drops(
        self,
        stretch: float,
        outside: Callable[[float, float, float], float],
        drop: Callable[[Ogden, float, float, float], float],
    ) -> list[float]:
        drops = []
        for (inner, outer), modulus in zip(pairwise(self.radii), self.moduli, strict=True):
            drops.append(drop(Ogden.neo_hooke(modulus), inner, outer, stretch))
            stretch = outside(inner, outer, stretch) / outer
        return drops


def mean_stress_in_tube(modulus: float, around: float, radial: float) -> float:
    """Mean stress, MPa, where a tube is stretched ``around`` and has a radial stress."""
    stretches = np.array([1 / around, around, 1.0])
    material = Ogden.neo_hooke(modulus)
    return radial + float(sum(difference(material, s, stretches[0]) for s in stretches)) / 3


@dataclass(frozen=True)
class Strip:
    """Layers of a block that bends, from the inner side: heights (mm) and shear moduli (MPa)."""

    heights: tuple[float, ...]
    moduli: tuple[float, ...]

    def moment(self, curvature: float) -> float:
        """Moment per width, N, at an angle per undeformed length, 1/mm."""
        stress, total = 0.0, 0.0
        first = self._first(curvature)
        for low, high, modulus in self._layers():
            ends = first + 2 * curvature * np.array([low, high])
            s = ends.mean() + np.ptp(ends) / 2 * POINTS
            radial = stress + modulus / 2 * (beyond(s) - beyond(ends[0]))
            hoop = radial + modulus * (s - 1 / s)
            total += (high - low) / 2 * float(WEIGHTS @ hoop) / curvature
            stress += modulus / 2 * float(beyond(ends[1]) - beyond(ends[0]))
        return total

    @property
    def reversed(self) -> Strip:
        """The same layers from the other side."""
        return Strip(self.heights[::-1], self.moduli[::-1])

    @property
    def stiffness(self) -> float:
        """Moment per width over small curvatures, N mm: that of the transformed section."""
        layers, young = self._layers(), 4 * np.array(self.moduli)  # in plane strain, nu = 1/2
        heights = np.array(self.heights)
        middles = np.array([(low + high) / 2 for low, high, _ in layers])
        axis = (young * heights * middles).sum() / (young * heights).sum()
        return float((young * (heights**3 / 12 + heights * (middles - axis) ** 2)).sum())

    def _layers(self) -> list[tuple[float, float, float]]:
        ends = np.cumsum([0.0, *self.heights]).tolist()
        return [(*pair, modulus) for pair, modulus in zip(pairwise(ends), self.moduli, strict=True)]

    def _first(self, curvature: float) -> float:
        """Square of the stretch along the inner face, at which the outer one is free."""

        def excess(first: float) -> float:
            faces = np.cumsum([0.0, *self.heights])
            terms = beyond(first + 2 * curvature * faces).tolist()
            return sum(m * (b - a) for m, (a, b) in zip(self.moduli, pairwise(terms), strict=True))

        return float(brentq(excess, 1e-6, 1.0, xtol=1e-15))


def beyond(s: Values) -> Values:
    """s + 1 / s - 2, without loss of digits near 1."""
    return np.asarray((s - 1) ** 2 / s)


def bimetal_curvature(heights: Sequence[float], moduli: Sequence[float], misfit: float) -> float:
    """Curvature, 1/mm, of two layers of which the second wants to be longer by a small share.

    S. Timoshenko, *J. Opt. Soc. Am.* 11, 233, 1925, equation (4).
    """
    m, n, total = heights[0] / heights[1], moduli[0] / moduli[1], sum(heights)
    below = 3 * (1 + m) ** 2 + (1 + m * n) * (m**2 + 1 / (m * n))
    return 6 * misfit * (1 + m) ** 2 / (total * below)


def lame_displacements(
    radii: Sequence[float], moduli: Sequence[tuple[float, float]], pressure: float, band: float
) -> Values:
    """Radial displacements, mm, of the faces of a tube of elastic layers in plane strain.

    In each layer u = A r + B / r (G. Lamé). ``moduli``: shear and bulk, MPa; ``band`` (N/mm) is the
    hoop force per strain of a film on the outer face, which presses on it with ``band`` u / r^2.
    """
    count = len(moduli)
    matrix, right = np.zeros((2 * count, 2 * count)), np.zeros(2 * count)

    def stress(layer: int, r: float) -> Values:
        shear, bulk = moduli[layer]
        return np.array([2 * (bulk + shear / 3), -2 * shear / r**2])

    matrix[0, :2], right[0] = stress(0, radii[0]), -pressure
    for layer, r in enumerate(radii[1:-1]):
        rows, places = slice(2 * layer + 1, 2 * layer + 3), slice(2 * layer, 2 * layer + 4)
        moved = np.array([r, 1 / r])
        matrix[rows, places] = [
            [*stress(layer, r), *-stress(layer + 1, r)],
            [*moved, *-moved],
        ]
    end = radii[-1]
    matrix[-1, -2:] = stress(count - 1, end) + band / end**2 * np.array([end, 1 / end])
    a, b = np.linalg.solve(matrix, right).reshape(-1, 2).T
    faces = np.array(radii)
    layers = np.minimum(np.arange(len(radii)), count - 1)
    return a[layers] * faces + b[layers] / faces
