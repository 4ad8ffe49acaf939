"""Where an Ogden material is stable: Hill's and Drucker's inequality along the three tests.

An incompressible material is stable at a state if every small change of strain costs work,
dτ : dε > 0 with Kirchhoff stress τ and logarithmic strain ε; this is Drucker's postulate as Abaqus
checks it and, for log strain, Hill's inequality. With kᵢ = ∂τᵢ/∂eᵢ = Σ 2 μ exp(α eᵢ) it holds for
changes along the principal axes if

    k₁ + k₂ + k₃ > 0  and  k₁k₂ + k₂k₃ + k₃k₁ > 0,

and for shear between axes i and j if (τᵢ − τⱼ)/(eᵢ − eⱼ) > 0 (Baker and Ericksen). Where every μ
is positive all of it holds at every strain; a set of mixed signs has to be asked state by state.

Stable material may still neck: past a peak of the nominal stress a dead load finds no equilibrium.
That peak is reported by itself.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from bellows_design.homogeneous import MODES, Mode, Reals

LOWEST, HIGHEST = 0.1, 10.0
"""Stretches between which is looked, along every test."""

STEPS = 400
"""Stretches looked at on either side of 1, evenly in the logarithm."""


@dataclass(frozen=True)
class StableRange:
    """Stretches around 1 over which one test is stable, and up to which its load rises.

    Ends at ``LOWEST`` and ``HIGHEST`` mean that no end was found.
    """

    mode: str
    lowest: float
    highest: float
    load_rises_to: float

    @property
    def complete(self) -> bool:
        """True if no end was found."""
        return self.lowest <= LOWEST and self.highest >= HIGHEST

    def covers(self, low: float, high: float) -> bool:
        """True if all stretches from ``low`` to ``high`` are stable."""
        return self.lowest <= low and high <= self.highest


@dataclass(frozen=True)
class Stability:
    """What ``stability`` found; ``shear_modulus`` is the initial one, MPa."""

    shear_modulus: float
    ranges: tuple[StableRange, ...]

    @property
    def everywhere(self) -> bool:
        """True if nothing unstable was found."""
        return self.shear_modulus > 0 and all(each.complete for each in self.ranges)

    def of(self, mode: str) -> StableRange:
        """The range of one test."""
        return next(each for each in self.ranges if each.mode == mode)

    def covers(self, low: float, high: float) -> bool:
        """True if every test is stable at all stretches from ``low`` to ``high``."""
        return self.shear_modulus > 0 and all(each.covers(low, high) for each in self.ranges)


def stability(mu: Sequence[float] | Reals, alpha: Sequence[float] | Reals) -> Stability:
    """Stable ranges of constants of either sign, ``mu`` in MPa, in tension and compression."""
    constants = np.asarray(mu, float), np.asarray(alpha, float)
    ranges = tuple(_range_of(mode, *constants) for mode in MODES.values())
    return Stability(float(constants[0].sum()), ranges)


def _range_of(mode: Mode, mu: Reals, alpha: Reals) -> StableRange:
    def stable(logs: Reals) -> Reals:
        return _margin(np.outer(logs, mode.exponents), mu, alpha)

    def rising(logs: Reals) -> Reals:
        return _load_slope(mode, logs, mu, alpha)

    return StableRange(
        mode.name,
        _first_failure(stable, LOWEST),
        _first_failure(stable, HIGHEST),
        _first_failure(rising, HIGHEST),
    )


def _margin(logs: Reals, mu: Reals, alpha: Reals) -> Reals:
    """(n,) positive where the states (n, 3) are stable: the smallest of all that must be so."""
    first, second, third = np.moveaxis(_stiffnesses(logs, mu, alpha), -1, 0)
    total = first + second + third
    product = first * second + second * third + third * first
    shears = [_divided(logs[:, i], logs[:, j], mu, alpha) for i, j in ((0, 1), (1, 2), (0, 2))]
    result: Reals = np.min([total, product, *shears], axis=0)
    return result


def _stiffnesses(logs: Reals, mu: Reals, alpha: Reals) -> Reals:
    """kᵢ = Σ 2 μ exp(α eᵢ), MPa, of the shape of ``logs``."""
    return 2 * np.exp(logs[..., None] * alpha) @ mu


def _divided(first: Reals, second: Reals, mu: Reals, alpha: Reals) -> Reals:
    """(τᵢ − τⱼ)/(eᵢ − eⱼ) = Σ 2 μ exp(α ē) sinhc(α Δ/2), MPa."""
    mean = np.outer((first + second) / 2, alpha)
    half = np.outer((first - second) / 2, alpha)
    safe = np.where(half == 0, 1.0, half)
    return 2 * (np.exp(mean) * np.where(half == 0, 1.0, np.sinh(safe) / safe)) @ mu


def _load_slope(mode: Mode, logs: Reals, mu: Reals, alpha: Reals) -> Reals:
    """λ² dP/dλ of the nominal stress P = τ/λ, MPa: dτ/d ln λ − τ."""
    stiffness = _stiffnesses(np.outer(logs, mode.exponents), mu, alpha)
    slope = stiffness[:, 0] * mode.exponents[0] - stiffness[:, 2] * mode.exponents[2]
    ends = mode.exponents[0] * logs, mode.exponents[2] * logs
    return slope - mode.gap * logs * _divided(*ends, mu, alpha)


def _first_failure(positive: Callable[[Reals], Reals], end: float) -> float:
    """The stretch between 1 and ``end`` from which ``positive`` no longer is; else ``end``."""
    logs = np.linspace(0.0, math.log(end), STEPS + 1)
    failed = np.flatnonzero(~(positive(logs) > 0))
    if not failed.size:
        return end
    if failed[0] == 0:
        return 1.0
    good, bad = float(logs[failed[0] - 1]), float(logs[failed[0]])
    for _ in range(40):
        middle = (good + bad) / 2
        good, bad = (middle, bad) if positive(np.array([middle]))[0] > 0 else (good, middle)
    return math.exp(good)
