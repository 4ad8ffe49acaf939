"""Closed forms of incompressible thick walls: spheres and tubes under pressure.

Equilibrium along the radius: the pressure inside less that outside is the integral over the
deformed wall of 2 (s_t - s_r) / r dr for a sphere and of (s_t - s_r) / r dr for a tube, where s_t
and s_r are the Cauchy stresses around and along the radius. Gauss quadrature.
"""

from __future__ import annotations

import numpy as np
from scipy.optimize import brentq, minimize_scalar

from solver import Ogden

POINTS, WEIGHTS = np.polynomial.legendre.leggauss(40)


def difference(material: Ogden, one: np.ndarray, other: np.ndarray | float) -> np.ndarray:
    """Cauchy stress along a principal direction of stretch ``one`` less that of another, MPa."""
    terms = zip(material.mu, material.alpha, strict=True)
    return sum(2 * mu / alpha * (one**alpha - other**alpha) for mu, alpha in terms)


def _radii(inner: float, outer: float) -> tuple[np.ndarray, np.ndarray]:
    """Points and weights of an integral over the deformed wall."""
    half = (outer - inner) / 2
    return (inner + outer) / 2 + half * POINTS, half * WEIGHTS


def sphere_outside(inner: float, outer: float, stretch: float) -> float:
    """Deformed outer radius of a hollow sphere whose inner one is stretched, mm."""
    return float(np.cbrt(outer**3 + ((stretch * inner) ** 3 - inner**3)))


def sphere_pressure(material: Ogden, inner: float, outer: float, stretch: float) -> float:
    """Pressure inside less that outside a hollow sphere of radii in mm, MPa."""
    r, weights = _radii(stretch * inner, sphere_outside(inner, outer, stretch))
    around = r / np.cbrt(r**3 - (stretch * inner) ** 3 + inner**3)
    return float(weights @ (2 * difference(material, around, around**-2) / r))


def tube_state(
    material: Ogden, inner: float, outer: float, stretch: float, along: float
) -> tuple[float, float]:
    """Pressure inside a tube (MPa) and the force along it beyond that on closed ends (N).

    ``stretch`` of the inner radius, ``along`` of the length.
    """
    a = stretch * inner
    r, weights = _radii(a, np.sqrt(a**2 + (outer**2 - inner**2) / along))
    around = r / np.sqrt(inner**2 + (r**2 - a**2) * along)
    across = 1 / (around * along)
    hoop = difference(material, around, across)
    axial = difference(material, along + 0 * r, across)
    return float(weights @ (hoop / r)), float(weights @ (np.pi * r * (2 * axial - hoop)))


def closed_tube(material: Ogden, inner: float, outer: float, stretch: float) -> tuple[float, float]:
    """Pressure (MPa) in a tube with free closed ends, and the stretch of its length."""
    along = brentq(lambda s: tube_state(material, inner, outer, stretch, s)[1], 0.3, 4, xtol=1e-14)
    return tube_state(material, inner, outer, stretch, along)[0], along


def closed_tube_at(material: Ogden, inner: float, outer: float, growth: float) -> float:
    """Pressure in it where its volume has grown by that factor, MPa."""

    def excess(stretch: float) -> float:
        return stretch**2 * closed_tube(material, inner, outer, stretch)[1] - growth

    stretch = brentq(excess, 0.8 * np.sqrt(growth), 1.2 * np.sqrt(growth), xtol=1e-14)
    return closed_tube(material, inner, outer, stretch)[0]


def highest_in_closed_tube(material: Ogden, inner: float, outer: float) -> float:
    """Limit of the pressure in it, MPa."""
    found = minimize_scalar(
        lambda stretch: -closed_tube(material, inner, outer, stretch)[0],
        bounds=(1.05, 2.9),
        method="bounded",
        options={"xatol": 1e-8},
    )
    return -float(found.fun)
