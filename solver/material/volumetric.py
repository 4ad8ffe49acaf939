"""Volumetric laws, in terms of the hydrostatic pressure."""

from __future__ import annotations

import math

from solver.numerics.compiled import compiled
from solver.numerics.special_functions import phi1, phi2, sinhc


@compiled()
def volume_law(q: float, compliance: float, logarithmic: bool) -> tuple[float, float]:
    """theta(q) - 1 and -theta'(q), 1/MPa, of the volumetric law; see ``volume_energy``."""
    if not logarithmic:
        return -compliance * q, compliance
    a = math.asinh(compliance * q)
    return math.expm1(-a), compliance * math.exp(-a) / math.cosh(a)


@compiled()
def volume_energy(q: float, compliance: float, logarithmic: bool) -> float:
    """G(q) = U(theta) + q (theta - 1), MPa.

    Quadratic, U = K (J - 1)^2 / 2: theta = 1 - q / K and G = -q^2 / (2 K). Logarithmic,
    U = K (J^2 - 1 - 2 ln J) / 4: theta = exp(-a) with sinh a = q / K, and
    G = K a^2 (phi2(-2 a) - sinhc(a) phi1(-a)).
    """
    if not logarithmic:
        return -0.5 * compliance * q * q
    a = math.asinh(compliance * q)
    return q * a * (phi2(-2.0 * a) / sinhc(a) - phi1(-a))
