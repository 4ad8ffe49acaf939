"""Quotients of elementary functions, continued to where they would be 0/0."""

from __future__ import annotations

import math

from solver.numerics.compiled import compiled


@compiled()
def phi1(x: float) -> float:
    """(exp(x) - 1) / x, 1 at 0."""
    return math.expm1(x) / x if x != 0.0 else 1.0


@compiled()
def phi2(x: float) -> float:
    """(exp(x) - 1 - x) / x^2, 1/2 at 0; by its series where the difference would cancel."""
    if abs(x) >= 0.5:
        return (math.expm1(x) - x) / (x * x)
    total = 0.5
    term = 0.5
    for k in range(3, 18):
        term *= x / k
        total += term
    return total


@compiled()
def sinhc(x: float) -> float:
    """sinh(x) / x, 1 at 0."""
    return math.sinh(x) / x if x != 0.0 else 1.0


@compiled()
def x_coth_x(x: float) -> float:
    """x coth(x), 1 at 0."""
    return x / math.tanh(x) if x != 0.0 else 1.0
