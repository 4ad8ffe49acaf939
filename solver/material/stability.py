"""Where a material is stable: Hill's and Drucker's inequality, at any strain and along tests.

An incompressible material is stable at a state if every small change of strain costs work,
dτ : dε > 0 with Kirchhoff stress τ and logarithmic strain ε. For changes along the principal axes
this is Drucker's postulate as Abaqus checks it: ∂τᵢ/∂eⱼ = kᵢ δᵢⱼ + 4 W″ λᵢ² λⱼ² must be positive
definite on changes that keep the volume, with kᵢ = Σ 2 μ exp(α eᵢ) and W″ of Yeoh's terms; without
those, k₁ + k₂ + k₃ > 0 and k₁k₂ + k₂k₃ + k₃k₁ > 0. For all changes it is Hill's inequality: shear
between axes i and j also needs (τᵢ − τⱼ)/(eᵢ − eⱼ) > 0 (Baker and Ericksen). Where every μ is
positive and no Cᵢ₀ negative all of it holds at every strain; a set of mixed signs has to be asked
state by state.

Stable material may still neck: past a peak of the nominal stress a dead load finds no equilibrium.
That peak is reported by itself.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from solver.material.homogeneous import MODES, Mode, Reals, invariant_slopes

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


@dataclass(frozen=True, eq=False)
class Constants:
    """``mu`` (MPa) and ``alpha`` (terms,) of Ogden, ``higher`` = C₂₀, C₃₀, … (MPa) of Yeoh."""

    mu: Reals
    alpha: Reals
    higher: Reals

    @classmethod
    def of(
        cls,
        mu: Sequence[float] | Reals,
        alpha: Sequence[float] | Reals,
        higher: Sequence[float] | Reals = (),
    ) -> Constants:
        """From any sequences of numbers, of either sign."""
        return cls(*(np.asarray(values, float) for values in (mu, alpha, higher)))


def stability(
    mu: Sequence[float] | Reals,
    alpha: Sequence[float] | Reals,
    higher: Sequence[float] | Reals = (),
) -> Stability:
    """Stable ranges of constants of either sign, in MPa, in tension and compression."""
    constants = Constants.of(mu, alpha, higher)
    ranges = tuple(_range_of(mode, constants) for mode in MODES.values())
    return Stability(float(constants.mu.sum()), ranges)


def drucker_margin(logs: Reals, constants: Constants) -> Reals:
    """(n,) least stiffness against isochoric changes along the axes at states (n, 3), MPa.

    ``logs`` are isochoric principal log stretches; where it is not positive Drucker's inequality
    fails.
    """
    first, second, third = _stiffnesses(logs, constants).T
    _, curvature = invariant_slopes(logs, constants.higher)
    squares = np.exp(2 * logs)
    gaps = (np.roll(squares, -1, axis=1) - np.roll(squares, -2, axis=1)) ** 2
    trace = (2 * (first + second + third) + 4 * curvature * gaps.sum(axis=1)) / 3
    product = first * second + second * third + third * first
    cross = first * gaps[:, 0] + second * gaps[:, 1] + third * gaps[:, 2]
    determinant = (product + 4 * curvature * cross) / 3
    root = np.sqrt(np.maximum(trace**2 - 4 * determinant, 0.0))
    with np.errstate(divide="ignore", invalid="ignore"):
        least: Reals = np.where(trace > 0, 2 * determinant / (trace + root), (trace - root) / 2)
    return least


def shear_margin(logs: Reals, constants: Constants) -> Reals:
    """(n,) least (τᵢ − τⱼ)/(eᵢ − eⱼ) of states (n, 3), MPa: positive by Baker and Ericksen."""
    slope, _ = invariant_slopes(logs, constants.higher)
    pairs = [(logs[:, i], logs[:, j], 2 * slope) for i, j in ((0, 1), (1, 2), (0, 2))]
    least: Reals = np.min([_divided(*pair, constants) for pair in pairs], axis=0)
    return least


def _range_of(mode: Mode, constants: Constants) -> StableRange:
    def stable(logs: Reals) -> Reals:
        states = np.outer(logs, mode.exponents)
        return np.minimum(drucker_margin(states, constants), shear_margin(states, constants))

    def rising(logs: Reals) -> Reals:
        return _load_slope(mode, logs, constants)

    return StableRange(
        mode.name,
        _first_failure(stable, LOWEST),
        _first_failure(stable, HIGHEST),
        _first_failure(rising, HIGHEST),
    )


def _stiffnesses(logs: Reals, constants: Constants) -> Reals:
    """kᵢ = Σ 2 μ exp(α eᵢ) at states (n, 3), MPa; Yeoh's terms count as μ = 2 W′, α = 2."""
    slope, _ = invariant_slopes(logs, constants.higher)
    own = 2 * np.exp(logs[..., None] * constants.alpha) @ constants.mu
    return own + 4 * slope[:, None] * np.exp(2 * logs)


def _divided(first: Reals, second: Reals, modulus: Reals, constants: Constants) -> Reals:
    """(τᵢ − τⱼ)/(eᵢ − eⱼ) = Σ 2 μ exp(α ē) sinhc(α Δ/2), MPa; ``modulus`` = 2 W′."""
    exponents = np.append(constants.alpha, 2.0)
    mean = np.outer((first + second) / 2, exponents)
    half = np.outer((first - second) / 2, exponents)
    safe = np.where(half == 0, 1.0, half)
    units = 2 * (np.exp(mean) * np.where(half == 0, 1.0, np.sinh(safe) / safe))
    return units[:, :-1] @ constants.mu + units[:, -1] * modulus


def _load_slope(mode: Mode, logs: Reals, constants: Constants) -> Reals:
    """λ² dP/dλ of the nominal stress P = τ/λ, MPa: dτ/d ln λ − τ."""
    states, exponents = np.outer(logs, mode.exponents), np.array(mode.exponents)
    stiffness, squares = _stiffnesses(states, constants), np.exp(2 * states)
    first, second = invariant_slopes(states, constants.higher)
    slope = stiffness[:, 0] * exponents[0] - stiffness[:, 2] * exponents[2]
    slope += 4 * second * (squares[:, 0] - squares[:, 2]) * (squares @ exponents)
    ends = states[:, 0], states[:, 2]
    return slope - mode.gap * logs * _divided(*ends, 2 * first, constants)


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
