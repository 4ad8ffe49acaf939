"""The factor on the stiffness that a measured curve tells, and its interval.

Points that the model does not reach, because its load path ends before, are left out: a point
counts only if the model knows it for every factor that is probable.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bellows_design.measured.factor.likelihood import Likelihood, likelihood
from bellows_design.measured.factor.noise import scatter_of
from bellows_design.measured.model.curve import ModelCurve
from bellows_design.measured.reading.curve import MeasuredCurve
from solver.arrays import Reals

FEWEST_POINTS = 5
"""For a factor."""
LEAST_FACTOR, MOST_FACTOR = 1 / 8, 8.0
"""Beyond them a unit is wrong, or the part is another one."""
WIDEST = 3.0
"""Ratio of an interval's ends above which the factor is not determined."""
FACTORS = 161
"""Looked at over the whole range, and again where they are probable."""
RESOLVED = 12
"""Steps that an interval has at least, for its ends to be known to a fraction of one."""
AROUND = 3
"""Steps on either side of those that are probable, which are looked at, too."""
MOST_LOOKS = 4
NEGLIGIBLE = 1e-3
"""Of the highest density: what may lie at either end of the factors looked at."""
PROBABLE = 1e-4
"""Of the highest density: factors that are looked at closely."""
STEP = 0.02
"""In log s, of differences by the factor."""

Mask = NDArray[np.bool_]


@dataclass(frozen=True)
class Factor:
    """A factor on the material's stiffness.

    Attributes:
        value: How many times as stiff as it stands the material is.
        low: Lower end of the 95 % interval, by scatter and the model's error together.
        high: Upper end.
        scatter: The interval by the measurement's scatter alone.
        model_percent: What the model's estimated error makes of the factor, percent.
        offset: Of all values, in the quantity's unit, if one was fitted; else None.
        points: How many points tell it.
        beyond: How many the model does not reach.
        difference: Root mean square of measurement less model with the factor 1, and with this
            one, in the quantity's unit, of those points; the first NaN where it is not known.
    """

    value: float
    low: float
    high: float
    scatter: tuple[float, float]
    model_percent: float
    offset: float | None
    points: int
    beyond: int
    difference: tuple[float, float]

    @property
    def agrees(self) -> bool:
        """Whether the interval holds the factor 1."""
        return self.low <= 1 <= self.high


@dataclass(frozen=True)
class Fitted:
    """What became of a fit.

    Attributes:
        factor: The factor; None where it is not determined.
        refused: Why not, as a sentence; empty if it is.
        used: (n,) which points tell it.
        wanted: Size of the pressure that the model should reach, MPa, for all points to count.
    """

    factor: Factor | None
    refused: str
    used: Mask
    wanted: float


def fit_factor(
    measured: MeasuredCurve, model: ModelCurve, offset: bool = False, zero: float | None = None
) -> Fitted:
    """Fit the factor by which the model is as stiff as the part that was measured.

    Args:
        measured: Pressures of one sign; values counted as the model's are.
        model: Curve of the model.
        offset: Whether a constant that all values have in common is fitted, too.
        zero: Size of the pressure, MPa, from whose value both are counted; None without one.
    """
    pressure = np.abs(measured.pressure)
    nobody = np.zeros(pressure.size, bool)
    counted = nobody | True if zero is None else np.abs(pressure - zero) > 1e-9
    few = int(counted.sum()) < FEWEST_POINTS
    if few:
        count = int(counted.sum())
        return Fitted(None, _too_few(count, measured.name), nobody, float(pressure.max()))
    start = _nearest(measured, model, counted, offset)
    wanted = float(pressure.max()) / (0.7 * start)
    used = counted & (pressure <= model.reach(0.8 * start))
    while int(used.sum()) >= FEWEST_POINTS:
        found = _likelihood(measured.at(used), model, offset, zero, start)
        if found.cut[0] < NEGLIGIBLE:
            whole = bool((used == counted).all())
            least = float(pressure.max()) if whole else wanted
            return _fitted(found, measured, model, used, counted, offset, least)
        used = used & (pressure < 0.9 * pressure[used].max())
    return Fitted(None, _unreached(model, measured), nobody, wanted)


def _too_few(count: int, name: str) -> str:
    return (
        f"{name} has {count} point{'s' * (count != 1)} to compare, but a factor needs at least "
        f"{FEWEST_POINTS}."
    )


def _unreached(model: ModelCurve, measured: MeasuredCurve) -> str:
    because = model.ending or f"the model ends at {model.reach(1.0):.4g} MPa"
    return (
        f"the model reaches too few of the measured pressures, up to "
        f"{np.abs(measured.pressure).max():.4g} MPa, to tell a factor: {because}."
    )


def _nearest(measured: MeasuredCurve, model: ModelCurve, counted: Mask, offset: bool) -> float:
    """The factor of least squares, each over the points that the model reaches."""
    part = measured.at(counted)
    pressure, least = np.abs(part.pressure), max(FEWEST_POINTS, int(counted.sum()) // 3)
    factors = np.geomspace(LEAST_FACTOR, MOST_FACTOR, FACTORS)
    residuals = part.value[:, None] - model.table(pressure, factors)
    reached = np.isfinite(residuals)
    if offset:
        residuals = residuals - np.nanmean(np.where(reached, residuals, np.nan), axis=0)
    count = reached.sum(axis=0)
    # By the size of the values there: else the factor that leaves the fewest points is the best.
    sizes = np.where(reached, np.abs(part.value)[:, None], 0.0).max(axis=0)
    squares = np.where(reached, residuals**2, 0.0).sum(axis=0)
    enough = (count >= least) & (sizes > 0)
    means = np.full(factors.size, np.inf)
    means[enough] = squares[enough] / count[enough] / sizes[enough] ** 2
    return float(factors[means.argmin()]) if enough.any() else 1.0


def _likelihood(
    part: MeasuredCurve, model: ModelCurve, offset: bool, zero: float | None, near: float
) -> Likelihood:
    """Of the factors for which the model reaches all points; again and again where it is high.

    ``near`` is about the factor: the course of the scatter is taken from the model there.
    """
    pressure = np.abs(part.pressure)
    scatter = scatter_of(pressure, model.values(pressure, near), part.spread, zero)

    def on(logs: Reals) -> Likelihood:
        residuals = part.value[:, None] - model.table(pressure, np.exp(logs))
        return likelihood(logs, residuals, scatter, offset)

    lowest = max(LEAST_FACTOR, _least_reaching(model, float(pressure.max())))
    found = on(np.linspace(np.log(lowest), np.log(MOST_FACTOR), FACTORS))
    for _ in range(MOST_LOOKS):
        probable = np.flatnonzero(found.density > PROBABLE * found.density.max())
        first, last = max(probable[0] - AROUND, 0), min(probable[-1] + AROUND, FACTORS - 1)
        found = on(np.linspace(found.logs[first], found.logs[last], FACTORS))
        low, high = np.log(found.interval)
        if high - low > RESOLVED * (found.logs[1] - found.logs[0]):
            break
    return found


def _least_reaching(model: ModelCurve, pressure: float) -> float:
    """The least factor for which the model reaches a pressure."""
    factors = np.geomspace(LEAST_FACTOR, MOST_FACTOR, 4 * FACTORS)
    reaching = [each for each in factors if model.reach(float(each)) >= pressure]
    return float(reaching[0]) if reaching else MOST_FACTOR / 2


def _fitted(
    found: Likelihood,
    measured: MeasuredCurve,
    model: ModelCurve,
    used: Mask,
    counted: Mask,
    offset: bool,
    wanted: float,
) -> Fitted:
    low, high = found.interval
    if found.cut[1] > NEGLIGIBLE or high > WIDEST * low:
        return Fitted(None, _undetermined(low, high, found, measured), used, wanted)
    part, value = measured.at(used), found.factor
    course = _course(part, model, value, offset)
    share = course.share_of_error
    below, above = np.log(value / low), np.log(high / value)
    beyond = int(counted.sum()) - int(used.sum())
    factor = Factor(
        value=value,
        low=float(value * np.exp(-np.hypot(below, share))),
        high=float(value * np.exp(np.hypot(above, share))),
        scatter=(low, high),
        model_percent=100 * share,
        offset=course.offset if offset else None,
        points=int(used.sum()),
        beyond=beyond,
        difference=(_difference(part, model, 1.0, 0.0), course.difference),
    )
    return Fitted(factor, "", used, wanted)


def _undetermined(low: float, high: float, found: Likelihood, measured: MeasuredCurve) -> str:
    ends = f"{low:.2g} to {high:.2g}"
    if found.cut[1] > NEGLIGIBLE or high > 0.9 * MOST_FACTOR:
        ends = f"{low:.2g} or anything above"
    return (
        f"{measured.name} does not determine the stiffness: factors of {ends} explain it about as "
        "well; it is flat, scatters too much, runs otherwise than the model, or a unit is wrong."
    )


class _Course(NamedTuple):
    """What belongs to a factor: offset, remaining difference, and what the model's error does."""

    offset: float
    difference: float
    share_of_error: float


def _course(part: MeasuredCurve, model: ModelCurve, factor: float, offset: bool) -> _Course:
    """By least squares about the factor: an error e moves log s by g·e / g·g, g = ∂f/∂log s."""
    pressure = np.abs(part.pressure)
    residual = part.value - model.values(pressure, factor)
    shift = float(residual.mean()) if offset else 0.0
    softer = model.reach(factor * np.exp(-STEP)) >= pressure.max()
    near, far = factor * np.exp(-STEP if softer else 0.0), factor * np.exp(STEP)
    slope = model.values(pressure, far) - model.values(pressure, near)
    slope = slope / np.log(far / near)
    error = model.errors(pressure, factor)
    if offset:
        slope, error = slope - slope.mean(), error - error.mean()
    square = float(slope @ slope)
    share = abs(float(slope @ error)) / square if square else np.inf
    return _Course(shift, _difference(part, model, factor, shift), float(share))


def _difference(part: MeasuredCurve, model: ModelCurve, factor: float, shift: float) -> float:
    """Root mean square of what is left; NaN where the model does not reach all points."""
    residual = part.value - shift - model.values(np.abs(part.pressure), factor)
    return float(np.sqrt((residual**2).mean()))


def without_fit(measured: MeasuredCurve) -> Fitted:
    """What stands for a fit that was not asked for."""
    used = np.zeros(measured.pressure.size, bool)
    return Fitted(None, "", used, float(np.abs(measured.pressure).max()))
