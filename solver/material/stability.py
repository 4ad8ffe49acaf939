"""Stability of a material: Hill's and Drucker's inequality, at any strain and along tests.

An incompressible material is stable at a state if every small change of strain needs work,
dτ : dε > 0 with Kirchhoff stress τ and logarithmic strain ε. For changes along the principal axes
this is Drucker's postulate as Abaqus checks it: ∂²W/∂eᵢ∂eⱼ must be positive definite on changes
that keep the volume. For all changes it is Hill's inequality: shear between axes i and j also needs
(τᵢ − τⱼ)/(eᵢ − eⱼ) > 0 (Baker and Ericksen). Ogden's law, where every μ is positive and no Cᵢ₀
negative, satisfies both at every strain; constants of mixed signs are checked state by state.

Stable material may still neck: there is no homogeneous equilibrium under a dead load above a
maximum of the nominal stress. That maximum is reported separately.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from solver.arrays import Reals
from solver.material.constants import Constants
from solver.material.homogeneous import MODES, Mode
from solver.material.states import responses

LOWEST, HIGHEST = 0.1, 10.0
"""Bounds of the stretches that are checked along every test."""

STEPS = 400
"""Number of stretches checked on either side of 1, evenly spaced in the logarithm."""


@dataclass(frozen=True)
class StableRange:
    """Stretches around 1 over which one test is stable, and up to which its load rises.

    Ends at ``LOWEST`` and ``HIGHEST`` mean that the test is stable over all stretches checked.
    """

    mode: str
    lowest: float
    highest: float
    load_rises_to: float

    @property
    def complete(self) -> bool:
        """True if the test is stable over all stretches checked."""
        return self.lowest <= LOWEST and self.highest >= HIGHEST

    def covers(self, low: float, high: float) -> bool:
        """True if all stretches from ``low`` to ``high`` are stable."""
        return self.lowest <= low and high <= self.highest


@dataclass(frozen=True)
class Stability:
    """Stable ranges of all tests; ``shear_modulus`` is the initial one, MPa."""

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


def stability(constants: Constants) -> Stability:
    """Stable ranges of a law's constants, of either sign, in tension and compression."""
    ranges = tuple(_range_of(mode, constants) for mode in MODES.values())
    return Stability(initial_shear_modulus(constants), ranges)


def initial_shear_modulus(constants: Constants) -> float:
    """Shear modulus of the undeformed material, MPa: half of (s₁ − s₂)/(e₁ − e₂)."""
    return float(responses(np.zeros((1, 3)), constants).divided[0, 0]) / 2


def drucker_margin(logs: Reals, constants: Constants) -> Reals:
    """(n,) least stiffness against isochoric changes along the axes at states (n, 3), MPa.

    ``logs`` are isochoric principal log stretches; where it is not positive Drucker's inequality
    fails. On the plane of isochoric changes the Hessian H has the determinant 1ᵀ adj(H) 1 / 3,
    which is free of cancellation where one axis is far stiffer than the others.
    """
    hessian = responses(logs, constants).hessian
    trace = np.trace(hessian, axis1=1, axis2=2) - hessian.sum(axis=(1, 2)) / 3
    determinant = _sum_of_cofactors(hessian) / 3
    root = np.sqrt(np.maximum(trace**2 - 4 * determinant, 0.0))
    with np.errstate(divide="ignore", invalid="ignore"):
        least: Reals = np.where(trace > 0, 2 * determinant / (trace + root), (trace - root) / 2)
    return least


def shear_margin(logs: Reals, constants: Constants) -> Reals:
    """(n,) least (τᵢ − τⱼ)/(eᵢ − eⱼ) of states (n, 3), MPa: positive by Baker and Ericksen."""
    least: Reals = responses(logs, constants).divided.min(axis=1)
    return least


def _sum_of_cofactors(matrices: Reals) -> Reals:
    """Sum of the nine cofactors of symmetric matrices (n, 3, 3)."""
    total = np.zeros(len(matrices))
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        total += matrices[:, j, j] * matrices[:, k, k] - matrices[:, j, k] ** 2
        mixed = matrices[:, j, i] * matrices[:, k, i] - matrices[:, j, k] * matrices[:, i, i]
        total += 2 * mixed
    return total


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


def _load_slope(mode: Mode, logs: Reals, constants: Constants) -> Reals:
    """λ² dP/dλ of the nominal stress P = τ/λ, MPa: dτ/d ln λ − τ."""
    found = responses(np.outer(logs, mode.exponents), constants)
    stiffness = found.hessian @ np.array(mode.exponents)
    slope: Reals = stiffness[:, 0] - stiffness[:, 2] - mode.gap * logs * found.divided[:, 2]
    return slope


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
