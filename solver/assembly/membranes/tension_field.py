"""Tension fields: plane stress of a film that wrinkles instead of bearing compression.

A film that neither resists bending nor bears compression has, averaged over its wrinkles, the
relaxed energy of A. C. Pipkin (IMA J. Appl. Math. 36, 85, 1986), here that of St. Venant and
Kirchhoff's law with the Green strain. With its principal values E1 >= E2, Young's modulus times
thickness Y t, and Poisson's ratio nu, there are three regimes:

    taut      E2 >= -nu E1           Y t / (2 (1 - nu^2)) (E1^2 + E2^2 + 2 nu E1 E2)
    wrinkled  E2 < -nu E1, E1 > 0    Y t / 2 E1^2, stress along the first direction only
    slack     E2 < -nu E1, E1 <= 0   0

The energy is convex in the strain and has continuous derivatives, the stress; that one's derivative
jumps between regimes. Where strain vanishes the film is taut.

Strain and stress are in an orthonormal frame and have the components (11, 22, sqrt(2) 12), so that
their scalar product is that of tensors.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from solver.arrays import Reals
from solver.problem.membranes import Membrane

Where = NDArray[np.bool_]

UNIT, TRACE = np.eye(3), np.array([1.0, 1.0, 0.0])


@dataclass(frozen=True)
class Principal:
    """Principal values and directions of strains (..., 3).

    ``first`` and ``second`` (...); ``cosine`` and ``sine`` (...) of twice the angle from the
    frame's first axis to the first direction.
    """

    first: Reals
    second: Reals
    cosine: Reals
    sine: Reals

    @staticmethod
    def of(strain: Reals) -> Principal:
        """Those of ``strain``; along the axes where both values are equal."""
        mean = (strain[..., 0] + strain[..., 1]) / 2
        along, across = (strain[..., 0] - strain[..., 1]) / 2, strain[..., 2] / np.sqrt(2)
        radius = np.hypot(along, across)
        safe = np.where(radius > 0, radius, 1.0)
        cosine = np.where(radius > 0, along / safe, 1.0)
        return Principal(mean + radius, mean - radius, cosine, across / safe)

    def taut(self, poisson_ratio: float) -> Where:
        """Where both stresses are tensile, or none."""
        return np.asarray(self.second >= -poisson_ratio * self.first)

    def wrinkled(self, poisson_ratio: float) -> Where:
        """Where the stress is uniaxial."""
        return ~self.taut(poisson_ratio) & (self.first > 0)

    @property
    def along(self) -> Reals:
        """n1 n1 (..., 3) with the first direction n1."""
        parts = [1 + self.cosine, 1 - self.cosine, np.sqrt(2) * self.sine]
        return np.stack(parts, axis=-1) / 2

    @property
    def shear(self) -> Reals:
        """(n1 n2 + n2 n1) / sqrt(2), (..., 3)."""
        half = self.sine / np.sqrt(2)
        return np.stack([-half, half, self.cosine], axis=-1)


def full_stiffness(membrane: Membrane) -> Reals:
    """Stiffness (3, 3) of plane stress, times thickness, N/mm."""
    nu = membrane.poisson_ratio
    factor = membrane.stiffness / (1 - nu**2)
    stiffness: Reals = factor * (nu * np.outer(TRACE, TRACE) + (1 - nu) * UNIT)
    return stiffness


def energy(membrane: Membrane, strain: Reals) -> Reals:
    """Energy (...) per undeformed area, N/mm, of strains (..., 3)."""
    whole = (strain @ full_stiffness(membrane) * strain).sum(axis=-1) / 2
    if not membrane.wrinkles:
        return np.asarray(whole)
    principal, nu = Principal.of(strain), membrane.poisson_ratio
    uniaxial = membrane.stiffness / 2 * principal.first**2
    return np.select([principal.taut(nu), principal.wrinkled(nu)], [whole, uniaxial], 0.0)


def stress(membrane: Membrane, strain: Reals) -> Reals:
    """Second Piola-Kirchhoff stress times thickness (..., 3), N/mm, of strains (..., 3)."""
    whole: Reals = strain @ full_stiffness(membrane)
    if not membrane.wrinkles:
        return whole
    principal, nu = Principal.of(strain), membrane.poisson_ratio
    uniaxial = membrane.stiffness * principal.first[..., None] * principal.along
    regimes = [principal.taut(nu)[..., None], principal.wrinkled(nu)[..., None]]
    return np.select(regimes, [whole, uniaxial], 0.0)


def stiffness(membrane: Membrane, strain: Reals) -> Reals:
    """Derivative (..., 3, 3) of the stress by the strain (..., 3), N/mm.

    Wrinkled: Y t (N N + E1 / (E1 - E2) M M), N being ``along`` and M ``shear``: the tension turns
    with its direction.
    """
    whole = np.broadcast_to(full_stiffness(membrane), (*strain.shape, 3))
    if not membrane.wrinkles:
        return whole
    principal, nu = Principal.of(strain), membrane.poisson_ratio
    wrinkled = principal.wrinkled(nu)
    apart = np.where(wrinkled, principal.first - principal.second, 1.0)
    turning = (principal.first / apart)[..., None, None]
    uniaxial = _square(principal.along) + turning * _square(principal.shear)
    regimes = [principal.taut(nu)[..., None, None], wrinkled[..., None, None]]
    return np.select(regimes, [whole, membrane.stiffness * uniaxial], 0.0)


def _square(vectors: Reals) -> Reals:
    """Products (..., 3, 3) of vectors (..., 3) with themselves."""
    return vectors[..., :, None] * vectors[..., None, :]
