"""A fitted model: constants with intervals, errors, stability."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from bellows_design.materials.fitting.weighted import Weighted
from bellows_design.materials.measurements.points import Measurements
from solver.arrays import Reals
from solver.material.constants import Constants
from solver.material.homogeneous import MODES, nominal_stress
from solver.material.stability import Stability, stability

VANISHED = 1e-4
"""Relative part of the stress below which a term adds nothing anywhere."""

OPEN_FACTOR, OPEN_EXPONENT = 10.0, 2.0
"""Half-widths of an interval from which on a constant counts as not determined."""

SAME_STRESS = 0.1
"""Relative difference in stress from which on equally good fits are not the same."""

BEST_ERROR = 0.01
"""Relative error below which no model is better than another."""


@dataclass(frozen=True)
class Constant:
    """A fitted constant with its 95 % interval; an exponent may be given instead of fitted.

    ``value``, ``standard_error``, ``low`` and ``high`` are in ``unit``. ``signed``: may be
    negative, as Yeoh's.
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

        Of a signed constant the measurements must determine the sign.
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
class Estimate:
    """Constants as a law's own fit finds them, before they are compared with the measurements.

    ``law``: the law with its constants; ``squares`` is the sum of squared relative errors;
    ``vanished`` if a term adds nothing; ``mu`` (MPa), ``alpha`` and ``higher`` (MPa) of a case of
    Ogden's law; ``ambiguity`` see ``Fit.unique``.
    """

    law: Constants
    constants: tuple[Constant, ...]
    squares: float
    vanished: bool
    mu: tuple[float, ...] = ()
    alpha: tuple[float, ...] = ()
    higher: tuple[float, ...] = ()
    ambiguity: float = 0.0


@dataclass(frozen=True)
class Fit:
    """A fitted model.

    ``law`` with its constants; of a case of Ogden's law ``mu`` (MPa) of the terms, in falling
    order, their ``alpha``, and ``higher`` of Yeoh's (MPa); the ``constants`` with their intervals;
    the number of ``points``, the coefficient of determination, the ``relative_error`` (root mean
    square, a fraction), the largest error, the corrected information criterion, whether a term
    adds nothing, how far equally good fits differ, and where the material is stable.
    """

    model: str
    law: Constants
    mu: tuple[float, ...]
    alpha: tuple[float, ...]
    constants: tuple[Constant, ...]
    points: int
    r_squared: float
    relative_error: float
    misfit: Misfit
    aicc: float
    vanished: bool
    ambiguity: float
    stability: Stability
    higher: tuple[float, ...] = ()

    @property
    def unique(self) -> bool:
        """False if quite other constants, found from another start, fit the tests as well.

        Planar tests, for one, do not determine the sign of α. ``ambiguity`` is the relative
        difference that they make to the stress of any of the three tests.
        """
        return self.ambiguity < SAME_STRESS

    @property
    def determined(self) -> bool:
        """True if the measurements determine every constant."""
        every = all(constant.determined for constant in self.constants)
        return every and self.unique and not self.vanished

    @property
    def stable(self) -> bool:
        """True if no unstable state was found."""
        return self.stability.everywhere

    @property
    def free_constants(self) -> int:
        """Number of constants that were fitted."""
        return sum(not constant.fixed for constant in self.constants)


class Choice(NamedTuple):
    """The fit that answers, and all that were tried for it.

    ``by_criterion`` is the one that the information criterion alone would take, where that is
    another: with few points it prefers models whose error the measurements contradict.
    """

    fit: Fit
    tried: tuple[Fit, ...]
    by_criterion: Fit | None = None


def judged(data: Measurements, problem: Weighted, model: str, found: Estimate) -> Fit:
    """The fit of ``model`` that ``found`` makes: its errors, criterion and stability."""
    difference = _difference(data, found)
    relative = math.sqrt(found.squares / problem.informative)
    free = sum(not constant.fixed for constant in found.constants)
    return Fit(
        model=model,
        law=found.law,
        mu=found.mu,
        alpha=found.alpha,
        constants=found.constants,
        points=data.stress.size,
        r_squared=_r_squared(data.stress, difference),
        relative_error=relative,
        misfit=_misfit(data, difference),
        aicc=_aicc(relative, problem.informative, free + 1),
        vanished=found.vanished,
        ambiguity=found.ambiguity,
        stability=stability(found.law),
        higher=found.higher,
    )


def student_width(freedom: int) -> float:
    """Half-width of a 95 % interval in standard errors, with so many degrees of freedom."""
    from scipy.stats import t as student

    return float(student.ppf(0.975, freedom))


def _difference(data: Measurements, found: Estimate) -> Reals:
    """(n,) model less measurement, MPa."""
    result = -data.stress
    for number, mode in enumerate(MODES.values()):
        chosen = data.mode == number
        result[chosen] += nominal_stress(mode, data.stretch[chosen], found.law)
    return result


def _r_squared(stress: Reals, difference: Reals) -> float:
    """1 less the part of the variance that is left; 0 where there is no variance."""
    variance = float(((stress - stress.mean()) ** 2).sum())
    return 1 - float((difference**2).sum()) / variance if variance > 0 else 0.0


def _misfit(data: Measurements, difference: Reals) -> Misfit:
    worst = int(np.abs(difference).argmax())
    mode = list(MODES)[data.mode[worst]]
    return Misfit(float(abs(difference[worst])), mode, float(data.stretch[worst]))


def _aicc(relative: float, points: int, count: int) -> float:
    if points <= count + 1:
        return math.inf
    fit = points * math.log(max(relative, BEST_ERROR) ** 2)
    return fit + 2 * count + 2 * count * (count + 1) / (points - count - 1)
