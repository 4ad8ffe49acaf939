"""Functions of one variable that are quintic polynomials piece by piece, twice differentiable.

From values and derivatives at nodes (quintic Hermite interpolation). Before the first node and
behind the last they go on with constant second derivative, or linearly.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import comb

import numpy as np

from solver.arrays import Integers, Reals

DEGREE = 5


@dataclass(frozen=True)
class Piecewise:
    """Functions on pieces between ascending breaks.

    Piece 0 lies before the first break and has that as its origin; piece k, from break k - 1 on,
    has that one.

    Attributes:
        breaks: where pieces meet.

            *Shape:* (b,).
        coefficients: of the powers 0 to 5 of the distance from the origin.

            *Shape:* (b + 1, ..., 6).
    """

    breaks: Reals
    coefficients: Reals

    def on(self, breaks: Reals) -> Piecewise:
        """The same functions with more breaks: ``breaks`` contain all of this one's."""
        origins = np.concatenate([breaks[:1], breaks])
        inside = np.concatenate([breaks[:1] - 1.0, breaks])
        own = pieces(self.breaks, inside)
        shift = origins - self.origins[own]
        return Piecewise(breaks, shifted(self.coefficients[own], shift))

    @cached_property
    def origins(self) -> Reals:
        """Of every piece, (b + 1,)."""
        return np.concatenate([self.breaks[:1], self.breaks])


def pieces(breaks: Reals, places: Reals) -> Integers:
    """Numbers (k,) of the pieces in which places (k,) lie."""
    return np.searchsorted(breaks, places, side="right").astype(np.int32)


def evaluated(coefficients: Reals, distances: Reals, order: int = 0) -> Reals:
    """Derivatives of polynomials (k, ..., 6) at distances (k,) from their origins: (k, ...)."""
    powers = distances[:, None] ** np.arange(DEGREE + 1 - order)
    weights = powers * FACTORS[order][order:]
    result: Reals = np.einsum("k...c,kc->k...", coefficients[..., order:], weights)
    return result


FACTORS = np.array(
    [
        [np.prod(np.arange(power, power - order, -1.0)) for power in range(DEGREE + 1)]
        for order in range(3)
    ]
)
"""Of powers (columns) in derivatives of an order (rows)."""


def shifted(coefficients: Reals, shift: Reals) -> Reals:
    """Polynomials (k, ..., 6) about origins that lie further by ``shift`` (k,)."""
    powers = shift[:, None] ** np.arange(DEGREE + 1)
    result = np.zeros_like(coefficients)
    for high in range(DEGREE + 1):
        for low in range(high + 1):
            factor = comb(high, low) * powers[:, high - low]
            result[..., low] += (coefficients[..., high].T * factor).T
    return result


def hermite(
    nodes: Reals, values: Reals, slopes: Reals, curvatures: Reals, bent: Reals
) -> Piecewise:
    """Quintic Hermite interpolation at nodes (n,) of functions (n, ...), n at least 1.

    Beyond the ends the curvature stays what it is there, times ``bent`` (...): 1, or 0 for a
    straight line.
    """
    before = _quadratic(values[:1], slopes[:1], bent * curvatures[:1])
    behind = _quadratic(values[-1:], slopes[-1:], bent * curvatures[-1:])
    between = _quintic(np.diff(nodes), values, slopes, curvatures)
    return Piecewise(nodes, np.concatenate([before, between, behind]))


def _quadratic(value: Reals, slope: Reals, curvature: Reals) -> Reals:
    """Coefficients (..., 6) of value + slope x + curvature x^2 / 2."""
    none = np.zeros_like(value)
    return np.stack([value, slope, curvature / 2, none, none, none], axis=-1)


def _quintic(steps: Reals, values: Reals, slopes: Reals, curvatures: Reals) -> Reals:
    """Coefficients (n - 1, ..., 6) between nodes that lie ``steps`` (n - 1,) apart."""
    h = steps.reshape(-1, *[1] * (values.ndim - 1))
    start = _quadratic(values[:-1], slopes[:-1], curvatures[:-1])
    value = values[1:] - (values[:-1] + h * slopes[:-1] + h**2 * curvatures[:-1] / 2)
    slope = h * (slopes[1:] - slopes[:-1] - h * curvatures[:-1])
    bend = h**2 * (curvatures[1:] - curvatures[:-1])
    start[..., 3] = (10 * value - 4 * slope + bend / 2) / h**3
    start[..., 4] = (-15 * value + 7 * slope - bend) / h**4
    start[..., 5] = (6 * value - 3 * slope + bend / 2) / h**5
    return start
