"""Axes of charts: which range, which ticks, where a value lies."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

from bellows_design.errors import BellowsError

_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


class ChartError(BellowsError):
    """Values that a chart cannot show."""


@dataclass(frozen=True)
class Scale:
    """From values to pixels.

    Attributes:
        low, high: Values at both ends.
        start, end: Their pixels; `start` may be the greater one.
        log: Whether equal ratios are equally long.
    """

    low: float
    high: float
    start: float
    end: float
    log: bool = False

    def __call__(self, value: float) -> float:
        """Where `value` lies, pixels."""
        share = (self._measured(value) - self._measured(self.low)) / (
            self._measured(self.high) - self._measured(self.low)
        )
        return self.start + share * (self.end - self.start)

    def shows(self, value: float) -> bool:
        """Whether the value is a number within the ends."""
        return math.isfinite(value) and self.low <= value <= self.high

    @property
    def ticks(self) -> tuple[float, ...]:
        """Round values between the ends."""
        if self.log:
            return log_ticks(self.low, self.high)
        return nice_ticks(self.low, self.high, max(2, round(abs(self.end - self.start) / 62)))

    def said(self, value: float) -> str:
        """The value with as many digits as the ticks need."""
        if self.log:
            return _as_power(value)
        ticks = self.ticks
        return short(value, ticks[1] - ticks[0] if len(ticks) > 1 else self.high - self.low)

    def _measured(self, value: float) -> float:
        return math.log10(value) if self.log else value


def scale(
    values: Iterable[float],
    start: float,
    end: float,
    *,
    log: bool = False,
    bounds: tuple[float, float] | None = None,
    with_zero: bool = False,
) -> Scale:
    """A scale that holds all finite `values`, its ends round numbers, or as `bounds` say.

    Raises:
        ChartError: There is no finite value, or none above zero on a logarithmic scale.
    """
    known = [float(value) for value in values if math.isfinite(value) and (value > 0 or not log)]
    if bounds is None and not known:
        raise ChartError(f"there is no {'positive ' if log else ''}finite value to draw.")
    low, high = bounds or (min(known), max(known))
    if bounds is not None:
        return Scale(low, high, start, end, log)
    if with_zero and not log:
        low, high = min(low, 0.0), max(high, 0.0)
    return Scale(*_rounded(low, high, log), start, end, log)


def nice_step(rough: float) -> float:
    """The least of 1, 2 and 5 times a power of ten that is not smaller."""
    power = 10.0 ** math.floor(math.log10(rough))
    return next(factor * power for factor in (1, 2, 5, 10) if factor * power >= rough * (1 - 1e-9))


def nice_ticks(low: float, high: float, count: int = 5) -> tuple[float, ...]:
    """Multiples of a round step from `low` to `high`, about `count`."""
    if not high > low:
        return (low,)
    step = nice_step((high - low) / count)
    first, last = math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9)
    return tuple(_exact(number, step) for number in range(first, last + 1))


def log_ticks(low: float, high: float) -> tuple[float, ...]:
    """Powers of ten from `low` to `high`; twice and five times them too where these are few."""
    first, last = math.floor(math.log10(low)), math.ceil(math.log10(high))
    for factors in ((1,), (1, 2, 5)):
        exponents = range(first, last + 1)
        ticks = tuple(factor * 10.0**exponent for exponent in exponents for factor in factors)
        shown = tuple(tick for tick in ticks if low * 0.999 <= tick <= high * 1.001)
        if len(shown) > 2:
            break
    return shown


def short(value: float, step: float) -> str:
    """A number with the digits of `step`; a true minus sign."""
    digits = min(max(0, -math.floor(math.log10(step) + 1e-9)), 8) if step > 0 else 2
    return f"{value:.{digits}f}".replace("-", "−")


def _as_power(value: float) -> str:
    exponent = math.floor(math.log10(value) + 1e-9)
    if -3 < exponent < 4:
        return f"{value:g}"
    factor = round(value / 10.0**exponent)
    power = f"10{str(exponent).translate(_RAISED)}"
    return power if factor == 1 else f"{factor}·{power}"


def _rounded(low: float, high: float, log: bool) -> tuple[float, float]:
    if log:
        return (low / 2, high * 2) if low == high else (low / 1.15, high * 1.15)
    if high - low <= 1e-9 * max(abs(low), abs(high)):  # the same but for rounding
        room = abs(low) / 10 or 1.0
        low, high = low - room, high + room
    step = nice_step((high - low) / 5)
    return _exact(math.floor(low / step + 1e-9), step), _exact(math.ceil(high / step - 1e-9), step)


def _exact(number: int, step: float) -> float:
    """A multiple of the step without the last digits of binary numbers."""
    return round(number * step, max(0, 2 - math.floor(math.log10(step))))
