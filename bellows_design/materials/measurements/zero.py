"""Where strain begins: preloads and slack at the start of a test in tension.

The stress of an elastomer rises steepest at zero strain. Where it rises ever more steeply at first,
grips settle and the specimen straightens (a toe); the tangent where it is steepest leads back to
the true zero, as in ASTM D638, annex A1. Where the stress at zero strain is not zero, the specimen
was loaded before strain was counted; its curve is continued back to zero stress.
"""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from bellows_design.errors import DesignError
from bellows_design.materials.measurements.series import Series
from solver.arrays import Reals

ZONE = 0.3
"""Strain within which a toe may end."""

FEWEST_POINTS = 8
"""Within the zone; with less nothing is judged."""

STEEPER = 1.3
"""Largest slope of the beginning over the first one from which on that is a toe."""

MOST_STEEPER = 1.5
"""Slope at the end over that of the beginning which tension of an elastomer does not reach if it
never falls in between."""

STIFFENS_BEYOND = 1.0
"""Strain beyond which nominal stress of silicones may rise more steeply than at first."""

FAR = 0.3
"""Strain from which on a test must not begin with a stress of nothing."""

CERTAIN = 4.0
"""Standard errors by which a shift must differ from none."""

LEAST_TOE, LEAST_PRELOAD = 0.005, 0.05
"""Strain, and part of the stress at the end of the zone, below which it does not matter."""

MOST, MOST_SLACK = 0.06, 0.5
"""Strain. A larger preload, or slack, is something else."""

AT_ZERO, MEASURED = 1e-5, 0.005
"""Strain that counts as zero, and part of the largest stress that is none there."""

NEAR = 0.1
"""Strain within which the curve is continued to zero."""


class _Shift(NamedTuple):
    """Strain at which the stress begins, its error, the first strain that counts, what it is."""

    strain: float
    error: float
    first: float
    what: str


def from_zero(series: Series) -> tuple[Series, str | None]:
    """The series with strain counted from where stress begins, and a note if that is another place.

    ``series.strain`` is a stretch. Raises ``DesignError`` where the shift would be too large.
    """
    _require_bend_of_compression(series)
    order = np.argsort(series.strain, kind="stable")
    strain, stress = series.strain[order] - 1, series.stress[order]
    if strain.size < FEWEST_POINTS or strain[0] < -0.02:
        return series, None
    _require_near_zero(series, strain, stress)
    _require_bend(series, strain, stress)
    found = _toe(strain, stress) or _preload(strain, stress)
    if found is None:
        return series, None
    slack = found.strain > 0 and strain[0] < MOST and strain.size
    if abs(found.strain) > (MOST_SLACK if slack else MOST):
        raise DesignError(_too_far(series, found.strain))
    moved = replace(series, strain=series.strain / (1 + found.strain))
    kept = moved.at(series.strain - 1 >= found.first)
    left = series.strain.size - kept.strain.size
    return kept, (
        f"{found.what}: strain is counted from {100 * found.strain:.3g} ± {200 * found.error:.1g} "
        "% of the file"
        f"{f', {left} points before are left out' if left else ''}; --keep zero takes it as it is"
    )


def _require_near_zero(series: Series, strain: Reals, stress: Reals) -> None:
    """Refuse strains that are stretches: the stress begins where the strains do."""
    begin = _line(strain[:6], stress[:6])
    if strain[0] > FAR and begin.slope > 0 and begin.zero > 0.7 * strain[0]:
        raise DesignError(_too_far(series, begin.zero))


def _require_bend_of_compression(series: Series) -> None:
    """Refuse compression that flattens: it is tension with signs turned."""
    strain, stress = 1 - series.strain, -series.stress
    if strain.size < FEWEST_POINTS or strain.min() < 0 or strain.max() < 0.2:
        return
    beginning, end = strain < 0.1 * strain.max() + 0.05, strain > 0.8 * strain.max()
    used = beginning & (strain > 0)
    if used.sum() < 2 or end.sum() < 2:
        return
    first, last = (np.median(stress[each] / strain[each]) for each in (used, end))
    if 0 < last < 0.95 * first:
        raise DesignError(
            f"{series.place}: the stress of compression rises ever more steeply, but this one "
            "flattens: are these tension with the signs turned? Give tension as positive; "
            "--keep zero takes strain and stress as they are."
        )


def _require_bend(series: Series, strain: Reals, stress: Reals) -> None:
    """Refuse curves that rise ever more steeply from the first, as no nominal tension does."""
    first = np.flatnonzero(strain <= STIFFENS_BEYOND)
    parts = [part for part in np.array_split(first, 6) if part.size >= 4]
    slopes = [_line(strain[part], stress[part]).slope for part in parts]
    if len(slopes) < 6 or not np.isfinite(slopes).all() or np.ptp(strain) < 0.2:
        return
    if (
        slopes[0] < min(slopes[1:])
        and slopes[-1] > MOST_STEEPER * slopes[0]
        and (slopes[-1] > 0.95 * max(slopes))
    ):
        raise DesignError(
            f"{series.place}: the stress rises ever more steeply from the first on, as no nominal "
            "stress of an elastomer in tension: is it true stress (--true-stress), or compression "
            "that counts as positive (--columns compressive_strain,compressive_stress_mpa)? "
            "--keep zero takes strain and stress as they are."
        )


def _too_far(series: Series, zero: float) -> str:
    return (
        f"{series.place}: the stress begins at a strain of {100 * zero:.3g} %, too far from zero "
        "for preload or slack; is the column a stretch, or in another unit? --columns and --units "
        "tell it, --keep zero takes strain and stress as they are."
    )


def _toe(strain: Reals, stress: Reals) -> _Shift | None:
    """Slack: the steepest tangent of the beginning is not the first."""
    lines = _tangents(strain, stress)
    slopes = np.array([each.slope for each in lines])
    if not lines or slopes.max() <= STEEPER * max(slopes[0], 0.0):
        return None
    steepest = int(slopes.argmax())
    start = _parabola(strain[steepest:], stress[steepest:])
    if start is None or start.zero - strain[0] < max(LEAST_TOE, CERTAIN * start.error):
        return None
    what = "the curve begins flat, as with slack or a toe"
    return _Shift(start.zero, start.error, float(strain[steepest]), what)


def _preload(strain: Reals, stress: Reals) -> _Shift | None:
    """Stress at zero strain, by the continued beginning of the curve."""
    start = _parabola(strain, stress)
    if start is None or strain[0] > NEAR / 5:
        return None
    least = max(CERTAIN * start.error * start.slope, LEAST_PRELOAD * start.top)
    if abs(start.stress) < least and not _measured(strain, stress):
        return None
    what = "a preload" if start.stress > 0 else "slack"
    return _Shift(
        start.zero,
        start.error,
        max(start.zero, -1.0) if start.stress < 0 else -1.0,
        f"the stress at zero strain is {start.stress:.3g} MPa, taken for {what}",
    )


def _measured(strain: Reals, stress: Reals) -> bool:
    """True if points at zero strain show that the stress is not zero there."""
    at_zero = stress[np.abs(strain) < AT_ZERO]
    return bool(at_zero.size and abs(np.median(at_zero)) > MEASURED * np.abs(stress).max())


def _tangents(strain: Reals, stress: Reals) -> list[_Line]:
    """Lines through points beside each other, from the first on, within the beginning."""
    reach = strain[0] + min(ZONE, np.ptp(strain) / 2)
    while True:
        zone = int((strain <= reach).sum())
        width = max(6, zone // 6)
        if zone < 2 * width:
            return []
        lines = [
            _line(strain[k : k + width], stress[k : k + width]) for k in range(zone - width + 1)
        ]
        at_the_end = int(np.argmax([each.slope for each in lines])) >= len(lines) - 1
        if not at_the_end or reach >= min(MOST_SLACK, strain[-1]):
            return [] if at_the_end and len(lines) > 1 else lines
        reach += ZONE / 2


class _Start(NamedTuple):
    """A curve continued to the left.

    Its zero, the standard error of that, its stress at zero strain, the largest it was continued
    from, and its slope.
    """

    zero: float
    error: float
    stress: float
    top: float
    slope: float


def _parabola(strain: Reals, stress: Reals) -> _Start | None:
    """A polynomial through the first points, continued to where it is zero.

    A parabola within the nearest strains; where these hold too few points, a cubic over more.
    """
    near = int((strain <= strain[0] + NEAR).sum())
    degree = 2
    if near < FEWEST_POINTS:
        near, degree = max(near, FEWEST_POINTS), 3
        if strain.size < near or strain[near - 1] > strain[0] + 3 * NEAR:
            return None
    x, y = strain[:near] - strain[0], stress[:near]
    basis = np.vander(x, degree + 1, increasing=True)
    solution, *_ = np.linalg.lstsq(basis, y, rcond=None)
    left = y - basis @ solution
    slope = float(solution[1])
    if slope <= 0:
        return None
    noise = float(left @ left) / max(x.size - degree - 1, 1)
    error = float(np.sqrt(noise * np.linalg.pinv(basis.T @ basis)[0, 0])) / slope
    zero = _root(np.asarray(solution, float))
    if zero is None:
        return None
    at_zero = float(np.polyval(solution[::-1], -strain[0]))
    return _Start(zero + float(strain[0]), error, at_zero, float(np.abs(y).max()), slope)


def _root(solution: Reals) -> float | None:
    """The zero of a polynomial next to 0, by Newton's method from there."""
    value, slopes = np.polynomial.Polynomial(solution), np.polynomial.Polynomial(solution).deriv()
    x = 0.0
    for _ in range(20):
        if slopes(x) <= 0:
            return None
        x -= float(value(x) / slopes(x))
    return x if np.isfinite(x) else None


class _Line(NamedTuple):
    """A line through points: where it meets zero, and what the error of that is made of."""

    slope: float
    zero: float
    noise: float
    reach: float


def _line(x: Reals, y: Reals) -> _Line:
    middle = x.mean()
    square = float(((x - middle) ** 2).sum())
    slope = float(((x - middle) * y).sum()) / square if square else 0.0
    if not slope > 0:
        return _Line(-np.inf, 0.0, 0.0, np.inf)
    left = y - y.mean() - slope * (x - middle)
    zero = float(middle - y.mean() / slope)
    reach = float(np.sqrt(1 / x.size + (zero - middle) ** 2 / square))
    return _Line(slope, zero, float(left @ left) / (x.size - 2), reach)
