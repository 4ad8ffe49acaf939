"""A fitted model: constants with intervals, errors, stability."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from bellows_design.materials.fitting.measurements import Measurements
from solver.material.homogeneous import MODES, Reals, nominal_stress
from solver.material.stability import Stability

VANISHED = 1e-4
"""Relative part of the stress below which a term adds nothing anywhere."""

OPEN_FACTOR, OPEN_EXPONENT = 10.0, 2.0
"""Half-widths of an interval from which on a constant counts as not determined."""

RIVAL = 0.1
"""Relative difference in stress from which on equally good fits are not the same."""

BEST_ERROR = 0.01
"""Relative error below which no model is better than another."""


@dataclass(frozen=True)
class Constant:
    """A fitted constant: value, standard error and 95 % interval; an exponent may be given.

    ``signed`` is one of Yeoh's, which may be negative.
    """

    name: str
    unit: str
    value: float
    standard_error: float
    low: float
    high: float
    fixed: bool = False
    signed: bool = False

    @property
    def determined(self) -> bool:
        """False if the measurements leave it open: μ by a factor of 10, α by 2 and by itself.

        Of a signed constant the measurements must tell the sign.
        """
        if self.fixed:
            return True
        if self.signed:
            return self.low * self.high > 0
        if self.unit:
            return self.high < OPEN_FACTOR * self.value
        return self.high - self.value < max(abs(self.value), OPEN_EXPONENT)


@dataclass(frozen=True)
class Misfit:
    """The largest difference of model and measurement, MPa, and where it is."""

    error: float
    mode: str
    stretch: float


@dataclass(frozen=True)
class Fit:
    """A fitted model. Terms are in the order of falling ``mu``; ``higher`` is of Yeoh's; MPa."""

    model: str
    mu: tuple[float, ...]
    alpha: tuple[float, ...]
    constants: tuple[Constant, ...]
    points: int
    r_squared: float
    relative_error: float
    misfit: Misfit
    aicc: float
    vanished: bool
    rivalry: float
    stability: Stability
    higher: tuple[float, ...] = ()

    @property
    def unique(self) -> bool:
        """False if quite other constants, found from another start, fit the tests as well.

        Planar tests, for one, do not tell the sign of α. ``rivalry`` is the relative difference
        that they make to the stress of any of the three tests.
        """
        return self.rivalry < RIVAL

    @property
    def determined(self) -> bool:
        """True if the measurements tell every constant."""
        told = all(constant.determined for constant in self.constants)
        return told and self.unique and not self.vanished

    @property
    def stable(self) -> bool:
        """True if no unstable state was found."""
        return self.stability.everywhere

    @property
    def free_constants(self) -> int:
        """Number of constants that were fitted."""
        return sum(not constant.fixed for constant in self.constants)


class Choice(NamedTuple):
    """The fit that answers, and all that were tried for it."""

    fit: Fit
    tried: tuple[Fit, ...]


def difference_of(
    data: Measurements, mu: Reals, alpha: Reals, higher: Sequence[float] = ()
) -> Reals:
    """(n,) model less measurement, MPa."""
    result = -data.stress
    for number, mode in enumerate(MODES.values()):
        chosen = data.mode == number
        result[chosen] += nominal_stress(mode, data.stretch[chosen], mu, alpha, higher)
    return result


def r_squared_of(stress: Reals, difference: Reals) -> float:
    """1 less the part of the variance that is left; 0 where there is no variance."""
    variance = float(((stress - stress.mean()) ** 2).sum())
    return 1 - float((difference**2).sum()) / variance if variance > 0 else 0.0


def misfit_of(data: Measurements, difference: Reals) -> Misfit:
    worst = int(np.abs(difference).argmax())
    mode = list(MODES)[data.mode[worst]]
    return Misfit(float(abs(difference[worst])), mode, float(data.stretch[worst]))


def aicc_of(relative: float, points: int, count: int) -> float:
    if points <= count + 1:
        return math.inf
    fit = points * math.log(max(relative, BEST_ERROR) ** 2)
    return fit + 2 * count + 2 * count * (count + 1) / (points - count - 1)
