"""A model's curve in closed form, and measurements made of it with a known factor and scatter."""

from __future__ import annotations

import numpy as np

from bellows_design.measured.model.curve import ScaledByPressure, StoredCurve
from bellows_design.measured.quantities import ANGLE, FORCE, Quantity
from bellows_design.measured.reading.curve import MeasuredCurve
from solver.arrays import Reals

HIGHEST = 0.1
"""MPa. Of the measured pressures."""


def bend(pressure: Reals) -> Reals:
    """Degrees at pressures in MPa: like a bellows, ever softer from where its walls bulge."""
    result: Reals = 900 * pressure + 9000 * pressure**2 * np.tanh(pressure / 0.05)
    return result


def model(
    reach: float = 0.25, error: float = 0.0, ending: str = "", by_force: bool = False
) -> ScaledByPressure:
    """The model up to a pressure, with an estimated error as a part of the value."""
    pressure = np.append(np.arange(0, reach - 1e-9, 0.01), reach)
    value = bend(pressure) / (100 if by_force else 1)
    return ScaledByPressure(StoredCurve(pressure, value, error * value, ending), by_force)


def measured(
    value: Reals, pressure: Reals, quantity: Quantity = ANGLE, spread: Reals | None = None
) -> MeasuredCurve:
    return MeasuredCurve("part.csv", quantity, pressure, value, spread)


def made_up(
    rng: np.random.Generator,
    factor: float,
    points: int = 20,
    scatter: float = 0.02,
    correlation: float = 0.0,
    by_force: bool = False,
) -> MeasuredCurve:
    """A measurement of a part that is ``factor`` times as stiff as ``model``.

    Args:
        rng: Where the scatter is from.
        factor: On the stiffness.
        points: How many, at equal distances up to ``HIGHEST``.
        scatter: Standard deviation by the value.
        correlation: Length over which the scatter is correlated, by the range of pressures.
        by_force: Whether forces are measured.
    """
    pressure = HIGHEST * np.arange(1, points + 1) / points
    noise = rng.normal(size=points)
    if correlation:
        apart = np.abs(pressure[:, None] - pressure) / HIGHEST
        noise = np.linalg.cholesky(np.exp(-apart / correlation)) @ noise
    value = model(by_force=by_force).values(pressure, factor) * (1 + scatter * noise)
    return measured(value, pressure, FORCE if by_force else ANGLE)
