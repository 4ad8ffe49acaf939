"""Where the model departs from a measurement with any factor: more than scatter and its error.

Residuals are smoothed by a polynomial over pressure. It counts if it explains more of them than
chance does, and where it is larger than the scatter, the model's estimated error, and a few per
cent of the largest value, which nobody would ask a model to be better than.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.stats import f as f_distribution

from bellows_design.measured.model.curve import ModelCurve
from bellows_design.measured.reading.curve import MeasuredCurve
from solver.arrays import Reals

DEGREE = 4
"""Of the polynomial; less where there are few points."""
FEWEST_POINTS = 8
CHANCE = 0.01
"""Probability below which residuals without a course would have one so large."""
TOLERANCE = 0.04
"""Of the largest value."""
SCATTERS = 2.0
"""Standard deviations of the scatter."""


@dataclass(frozen=True)
class Departure:
    """Pressures at which the part does something else than the model.

    Attributes:
        start: Size of its first pressure, MPa.
        end: Of its last.
        largest: Measurement less model where that is largest, smoothed, in the quantity's unit.
        pressure: Size of the pressure there, MPa.
    """

    start: float
    end: float
    largest: float
    pressure: float


def departures(
    measured: MeasuredCurve, model: ModelCurve, factor: float, offset: float = 0.0
) -> tuple[Departure, ...]:
    """Where the model with ``factor`` and ``offset`` departs from points that it reaches."""
    pressure = np.abs(measured.pressure)
    reached = pressure <= model.reach(factor)
    pressure, value = pressure[reached], measured.value[reached]
    if pressure.size < FEWEST_POINTS:
        return ()
    residual = value - offset - model.values(pressure, factor)
    smooth, scatter, by_chance = _smoothed(pressure, residual)
    if by_chance > CHANCE:
        return ()
    bound = np.maximum(SCATTERS * scatter, model.errors(pressure, factor))
    bound = np.maximum(bound, TOLERANCE * np.abs(value).max())
    beyond = np.sign(smooth) * (np.abs(smooth) > bound)
    return tuple(_stretches(pressure, smooth, beyond))


def _smoothed(pressure: Reals, residual: Reals) -> tuple[Reals, float, float]:
    """The polynomial's values (n,), the scatter about it, and how probable it is by chance."""
    count = pressure.size
    degree = min(DEGREE, count // 3)
    place = 2 * (pressure - pressure.min()) / np.ptp(pressure) - 1
    matrix = np.polynomial.legendre.legvander(place, degree)
    smooth = matrix @ np.linalg.lstsq(matrix, residual, rcond=None)[0]
    free = count - degree - 1
    left = float(((residual - smooth) ** 2).sum()) / free
    explained = float((smooth**2).sum()) / (degree + 1)
    ratio = explained / left if left else np.inf
    return smooth, float(np.sqrt(left)), float(f_distribution.sf(ratio, degree + 1, free))


def _stretches(pressure: Reals, smooth: Reals, beyond: Reals) -> list[Departure]:
    """Points after each other that depart to the same side; one alone is none."""
    found = []
    edges = np.flatnonzero(np.diff(beyond)) + 1
    for part in np.split(np.arange(pressure.size), edges):
        if part.size < 2 or not beyond[part[0]]:
            continue
        worst = part[np.abs(smooth[part]).argmax()]
        found.append(
            Departure(
                float(pressure[part[0]]),
                float(pressure[part[-1]]),
                float(smooth[worst]),
                float(pressure[worst]),
            )
        )
    return found
