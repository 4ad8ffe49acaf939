"""Nominal stress of single Ogden terms at many exponents at once, and its slope in the exponent.

With x = ln λ of a test's measured stretch, a term of Abaqus's form has the nominal stress

    P = 2 μ b x exp(α a x) sinhc(α b x/2) / λ,

a x the mean and b x the difference of the first and the last log stretch, sinhc z = sinh z / z.
Nothing is divided by α or by λ − 1: α = 0 is Hencky's limit, and small strains keep all digits.
"""

from __future__ import annotations

import numpy as np

from solver.arrays import Reals


def unit_stresses(mean: float | Reals, gap: float | Reals, logs: Reals, alpha: Reals) -> Reals:
    """(n, terms) nominal stress of each term per MPa of its μ; ``mean``, ``gap`` as of the mode."""
    shift, half = _arguments(mean, gap, logs, alpha)
    scale = 2 * gap * logs * np.exp(-logs)
    return scale[:, None] * np.exp(shift) * _sinhc(half)


def unit_slopes(mean: float | Reals, gap: float | Reals, logs: Reals, alpha: Reals) -> Reals:
    """(n, terms) derivative of ``unit_stresses`` with respect to each term's α."""
    shift, half = _arguments(mean, gap, logs, alpha)
    scale = 2 * gap * logs * np.exp(-logs)
    by_shift = (mean * logs)[:, None] * _sinhc(half)
    by_half = (gap * logs / 2)[:, None] * _sinhc_slope(half)
    return scale[:, None] * np.exp(shift) * (by_shift + by_half)


def _arguments(
    mean: float | Reals, gap: float | Reals, logs: Reals, alpha: Reals
) -> tuple[Reals, Reals]:
    return np.outer(mean * logs, alpha), np.outer(gap * logs / 2, alpha)


def _sinhc(z: Reals) -> Reals:
    """sinh(z)/z, 1 at 0."""
    safe = np.where(z == 0, 1.0, z)
    return np.where(z == 0, 1.0, np.sinh(safe) / safe)


def _sinhc_slope(z: Reals) -> Reals:
    """(cosh z − sinhc z)/z, by its series where the difference would cancel."""
    safe = np.where(np.abs(z) < 0.5, 1.0, z)
    square = np.where(np.abs(z) < 0.5, z * z, 0.0)
    series = 1 + square / 10 * (1 + square / 28 * (1 + square / 54 * (1 + square / 88)))
    closed = (np.cosh(safe) - np.sinh(safe) / safe) / safe
    return np.where(np.abs(z) < 0.5, z / 3 * series, closed)
