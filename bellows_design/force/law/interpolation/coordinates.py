"""The moment relative to that at which neighbouring bubbles begin to touch.

There a half bubble becomes stiff, at each pressure at another moment A(p). Rows of the table are
therefore interpolated at equal m = M - A(p), so that the kink of one meets that of the next. A is
interpolated between rows too, once differentiable, monotone where its values are.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from bellows_design.force.law.interpolation.rows import Row
from solver.arrays import Reals


@dataclass(frozen=True)
class Coordinates:
    """A (n,), N mm, at pressures (n,), MPa, and its derivative (n,) by the pressure."""

    pressures: Reals
    origins: Reals
    rates: Reals

    @staticmethod
    def of(rows: Sequence[Row]) -> Coordinates:
        """By where neighbours begin to touch, if all of at least two rows know that; else A = 0."""
        from scipy.interpolate import PchipInterpolator

        onsets = [row.onset for row in rows]
        known = [onset for onset in onsets if onset is not None]
        pressures = np.array([row.pressure for row in rows])
        if len(known) < len(rows):
            return Coordinates(pressures, np.zeros(len(rows)), np.zeros(len(rows)))
        origins = np.array(known)
        rates = PchipInterpolator(pressures, origins).derivative()(pressures)
        return Coordinates(pressures, origins, rates)

    def at(self, weights: Reals, number: int) -> float:
        """A by the weights (4,) of ``hermite_weights`` from row ``number`` to the next."""
        near = (self.origins[number], self.rates[number])
        far = (self.origins[number + 1], self.rates[number + 1])
        return float(weights @ np.array([*near, *far]))


def hermite_weights(share: float, step: float, order: int = 0) -> Reals:
    """Weights (4,) of value and slope at the start, and at the end, of an interval.

    ``share`` of it lies before the place; ``step`` is its length. With ``order`` 1 they are those
    of the derivative by the place.
    """
    t, h = share, step
    if order:
        bump = 6 * t * (1 - t) / h
        return np.array([-bump, (1 - t) * (1 - 3 * t), bump, t * (3 * t - 2)])
    near, far = (1 + 2 * t) * (1 - t) ** 2, t**2 * (3 - 2 * t)
    return np.array([near, h * t * (1 - t) ** 2, far, h * t**2 * (t - 1)])
