"""Ogden's rubber in the three tests of homogeneous strain: uniaxial, equibiaxial, planar.

Incompressible, in Abaqus's form, W = Σ 2 μₖ/αₖ² (λ₁^αₖ + λ₂^αₖ + λ₃^αₖ − 3). With x = ln λ of the
stretch that is measured, the log stretches of a test are x times fixed numbers, and the direction
with the last of them is free of stress. Then the nominal stress of the measured direction is

    P = (τ₁ − τ₃)/λ = Σ 2 μₖ b x exp(αₖ a x) sinhc(αₖ b x/2) / λ,

a x the mean and b x the difference of the first and the last log stretch, sinhc z = sinh z / z.
Nothing is divided by αₖ or by λ − 1: α = 0 is Hencky's limit, and small strains keep all digits.

Yeoh's terms Σ Cᵢ₀ (I₁ − 3)ⁱ of order i ≥ 2 act as a term with α = 2 whose μ = 2 dW/dI₁ depends on
the strain.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

Reals: TypeAlias = NDArray[np.float64]


@dataclass(frozen=True)
class Mode:
    """A test: the principal log stretches over the log stretch that is measured."""

    name: str
    exponents: tuple[float, float, float]

    @property
    def mean(self) -> float:
        """a: mean of the first and the last exponent."""
        return (self.exponents[0] + self.exponents[2]) / 2

    @property
    def gap(self) -> float:
        """b: the first exponent less the last."""
        return self.exponents[0] - self.exponents[2]

    def principal_stretches(self, stretch: Reals) -> Reals:
        """(n, 3) principal stretches at measured stretches (n,)."""
        return np.asarray(stretch)[:, None] ** np.array(self.exponents)


UNIAXIAL = Mode("uniaxial", (1.0, -0.5, -0.5))
BIAXIAL = Mode("biaxial", (1.0, 1.0, -2.0))
PLANAR = Mode("planar", (1.0, 0.0, -1.0))
MODES = {mode.name: mode for mode in (UNIAXIAL, BIAXIAL, PLANAR)}


def nominal_stress(
    mode: Mode,
    stretch: Reals,
    mu: Sequence[float] | Reals,
    alpha: Sequence[float] | Reals,
    higher: Sequence[float] | Reals = (),
) -> Reals:
    """Nominal stress at stretches (n,), of ``mu``, ``alpha`` and ``higher`` = C₂₀, C₃₀, …; MPa."""
    logs = np.log(np.asarray(stretch, float))
    stress = unit_stresses(mode.mean, mode.gap, logs, np.asarray(alpha, float)) @ np.asarray(mu)
    if not len(higher):
        return stress
    slope, _ = invariant_slopes(np.outer(logs, mode.exponents), higher)
    square = unit_stresses(mode.mean, mode.gap, logs, np.array([2.0]))[:, 0]
    return stress + 2 * slope * square


def first_invariant(logs: Reals) -> Reals:
    """I₁ − 3 = Σ (exp 2eᵢ − 1 − 2eᵢ) of isochoric log stretches (…, 3), by series where small."""
    twice = 2 * np.asarray(logs, float)
    small = np.abs(twice) < 0.5
    safe, square = np.where(small, 1.0, twice), np.where(small, twice, 0.0)
    term = square * square / 2
    series = term.copy()
    for order in range(3, 18):
        term = term * square / order
        series += term
    total: Reals = np.where(small, series, np.expm1(safe) - safe).sum(axis=-1)
    return total


def invariant_slopes(logs: Reals, higher: Sequence[float] | Reals) -> tuple[Reals, Reals]:
    """dW/dI₁ and d²W/dI₁² in MPa of ``higher`` = C₂₀, C₃₀, … at log stretches (…, 3)."""
    if not len(higher):
        none = np.zeros(np.shape(logs)[:-1])
        return none, none
    falling = np.array([*reversed(higher), 0.0, 0.0])
    invariant, slope = first_invariant(logs), np.polyder(falling)
    second = np.polyder(slope)
    return np.asarray(np.polyval(slope, invariant)), np.asarray(np.polyval(second, invariant))


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
