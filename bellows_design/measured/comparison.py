"""A measured curve against the model: bands, residuals, the factor, and where both depart."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from bellows_design.errors import DesignError
from bellows_design.materials.material import Material
from bellows_design.measured.factor.departure import Departure, departures
from bellows_design.measured.factor.fit import Factor, Fitted, fit_factor, without_fit
from bellows_design.measured.model.curve import ModelCurve, Zeroed
from bellows_design.measured.reading.curve import MeasuredCurve
from solver.arrays import Reals

MARGIN = 1.3
"""Times the highest measured pressure: so far the model is asked at first."""
MOST_PERCENT = 50.0
"""Of an uncertainty of the material, for whose softest end the model is asked further."""
MOST_CURVES = 3
"""That are asked, each further than the one before."""
DEGREES = 57.29577951308232
IN_RADIANS = 2.5
"""Ratio within which a measurement may be off what degrees taken for radians would make of it."""

Asked = Callable[[float], ModelCurve]
"""From a size of pressure, MPa, to the model's curve that reaches it if it can."""


@dataclass(frozen=True)
class CompareOptions:
    """What is done with a measurement.

    Attributes:
        zero_at: Size of the pressure from whose value both curves are counted, MPa; None without.
        fit: Whether a factor is fitted.
        offset: Whether a constant of all values is fitted, too.
        material_percent: By how much the material's stiffness may be off, percent; None as the
            material says.
    """

    zero_at: float | None = None
    fit: bool = True
    offset: bool = False
    material_percent: float | None = None

    def __post_init__(self) -> None:
        percent = self.material_percent
        if percent is not None and not 0 <= percent < 100:
            raise DesignError(
                f"--material-uncertainty is {percent:g} % but must be at least 0 and below 100 %."
            )


@dataclass(frozen=True, eq=False)
class Comparison:
    """A measurement beside the model.

    Attributes:
        part: Name of the design or body.
        material: Its material.
        measured: As it was read, counted as the model is.
        model: Curve of the model by the stiffness.
        fitted: What became of the factor.
        material_percent: By how much the stiffness may be off, percent; None where nobody says.
        departures: Where the model departs with the fitted factor, or with 1 without one.
        zero_at: Size of the pressure both are counted from, MPa; None without.
    """

    part: str
    material: Material
    measured: MeasuredCurve
    model: ModelCurve
    fitted: Fitted
    material_percent: float | None
    departures: tuple[Departure, ...]
    zero_at: float | None = None

    @property
    def factor(self) -> Factor | None:
        """The fitted factor; None without one."""
        return self.fitted.factor

    @property
    def pressure(self) -> Reals:
        """Sizes of the measured pressures, MPa (n,)."""
        return np.abs(self.measured.pressure)

    @cached_property
    def values(self) -> Reals:
        """(n,) the model's values at the measured pressures; NaN beyond its reach."""
        return self.model.values(self.pressure)

    @cached_property
    def errors(self) -> Reals:
        """(n,) estimated errors of these by the mesh and the like."""
        return self.model.errors(self.pressure)

    @cached_property
    def fitted_values(self) -> Reals:
        """(n,) the same with the fitted factor and offset; without one as they are."""
        if self.factor is None:
            return self.values
        return self.model.values(self.pressure, self.factor.value) + (self.factor.offset or 0.0)

    def band(self, pressure: Reals) -> tuple[Reals, Reals]:
        """Lowest and highest value of the model as designed (n,), by material and mesh."""
        share = (self.material_percent or 0.0) / 100
        return self._band(pressure, (1 - share, 1.0, 1 + share))

    def fitted_band(self, pressure: Reals) -> tuple[Reals, Reals]:
        """The same for the factor's interval; as designed without one."""
        if self.factor is None:
            return self.band(pressure)
        low, high = self._band(pressure, (self.factor.low, self.factor.value, self.factor.high))
        shift = self.factor.offset or 0.0
        return low + shift, high + shift

    def _band(self, pressure: Reals, factors: tuple[float, ...]) -> tuple[Reals, Reals]:
        values = [self.model.values(pressure, factor) for factor in factors]
        errors = [self.model.errors(pressure, factor) for factor in factors]
        low = np.min([v - e for v, e in zip(values, errors, strict=True)], axis=0)
        high = np.max([v + e for v, e in zip(values, errors, strict=True)], axis=0)
        return low, high

    @cached_property
    def inside(self) -> NDArray[np.bool_]:
        """(n,) which points lie in the model's band as designed; none that the band does not reach.

        The point that both are counted from lies in it by definition.
        """
        low, high = self.band(self.pressure)
        value, room = self.measured.value, 1e-9 * np.abs(self.measured.value).max()
        with np.errstate(invalid="ignore"):
            result: NDArray[np.bool_] = (value >= low - room) & (value <= high + room)
        return result

    @cached_property
    def judged(self) -> NDArray[np.bool_]:
        """(n,) which points the model's band as designed reaches, its soft end included."""
        low, high = self.band(self.pressure)
        known: NDArray[np.bool_] = np.isfinite(low) & np.isfinite(high)
        return known

    @property
    def reached(self) -> int:
        """How many points the model's band as designed reaches."""
        return int(self.judged.sum())


def compare(
    part: str, material: Material, measured: MeasuredCurve, asked: Asked, options: CompareOptions
) -> Comparison:
    """Hold a measured curve against the model.

    The model is asked up to somewhat beyond the measured pressures, and again further where the
    part turns out to be so much softer that its curve needs it.

    Args:
        part: Name of the design or body.
        material: Its material.
        measured: The measurement, pressures in MPa.
        asked: Gives the model's curve.
        options: What is done.

    Raises:
        DesignError: A zero outside of the measured pressures, or an angle that seems to be in
            another unit.
        BellowsError: As the model.
    """
    measured = _zeroed(measured, options.zero_at)
    zero = options.zero_at
    percent = _stated_percent(material, options)
    highest = _margin(percent) * float(np.abs(measured.pressure).max())
    model, fitted = asked(highest), without_fit(measured)
    if zero is not None and model.reach(1.0) < zero:
        raise DesignError(
            f"--zero-at {zero:g} MPa is beyond the model's reach of {model.reach(1.0):.4g} MPa."
        )
    for _ in range(MOST_CURVES):
        counted = model if zero is None else Zeroed(model, zero)
        measured = _as_the_model_turns(measured, counted)
        _require_unit(measured, counted)
        if not options.fit:
            break
        fitted = fit_factor(measured, counted, options.offset, zero)
        if model.ending or fitted.wanted <= max(highest, 1.02 * model.reach(1.0)):
            break
        highest, model = fitted.wanted, asked(fitted.wanted)
    factor, offset = _value_and_offset(fitted)
    return Comparison(
        part=part,
        material=material,
        measured=measured,
        model=counted,
        fitted=fitted,
        material_percent=percent,
        departures=departures(measured, counted, factor, offset),
        zero_at=zero,
    )


def _margin(percent: float | None) -> float:
    """Times the highest measured pressure: so far the band reaches, too, of most materials."""
    softest = 1 - min(percent or 0.0, MOST_PERCENT) / 100
    return max(MARGIN, 1.01 / softest)


def _value_and_offset(fitted: Fitted) -> tuple[float, float]:
    factor = fitted.factor
    return (1.0, 0.0) if factor is None else (factor.value, factor.offset or 0.0)


def _stated_percent(material: Material, options: CompareOptions) -> float | None:
    """By how much the stiffness may be off, percent: as told, or the larger of the fit's errors."""
    if options.material_percent is not None:
        return options.material_percent
    stated = [each for each in (material.fit_error, material.fit_modulus_error) if each is not None]
    return min(max(stated), 99.0) if stated else None


def _zeroed(measured: MeasuredCurve, zero: float | None) -> MeasuredCurve:
    if zero is None:
        return measured
    pressure = np.abs(measured.pressure)
    if not pressure[0] <= zero <= pressure[-1]:
        raise DesignError(
            f"--zero-at is {zero:g} MPa but must lie between {pressure[0]:.4g} and "
            f"{pressure[-1]:.4g} MPa, the pressures of {measured.name}."
        )
    value = float(np.interp(zero, pressure, measured.value))
    note = f"both curves are counted from their values at {zero:g} MPa ({value:.4g} measured)"
    return replace(measured, value=measured.value - value).noted(note)


def _as_the_model_turns(measured: MeasuredCurve, model: ModelCurve) -> MeasuredCurve:
    """With the sign of the model's values: which way is positive is a matter of convention."""
    ours, theirs = _pairs(measured, model)
    if ours.size and float(ours @ theirs) < -0.5 * np.linalg.norm(ours) * np.linalg.norm(theirs):
        return measured.turned().noted(
            "values are taken with the other sign, so that they run as the model's do"
        )
    return measured


def _pairs(measured: MeasuredCurve, model: ModelCurve) -> tuple[Reals, Reals]:
    """The model's and the measured values where both are known."""
    values = model.values(np.abs(measured.pressure))
    known = np.isfinite(values)
    return values[known], measured.value[known]


def _require_unit(measured: MeasuredCurve, model: ModelCurve) -> None:
    """Refuse angles that are as small, or as large, as the other unit would make them."""
    ours, theirs = _pairs(measured, model)
    square = float(ours @ ours)
    if measured.quantity.name != "angle" or measured.unit_told or not square:
        return
    ratio = float(ours @ theirs) / square
    for factor, unit, other in ((1 / DEGREES, "rad", "deg"), (DEGREES, "deg", "rad")):
        if factor / IN_RADIANS < ratio < factor * IN_RADIANS:
            raise DesignError(
                f"{measured.name} has angles of {100 * ratio:.3g} % of the model's, as if they "
                f"were in {unit}; --units angle={unit} reads them so, --units angle={other} as "
                "they are."
            )
