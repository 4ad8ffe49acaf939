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

FAR = 0.3
"""Strain from which on a test must not begin with a stress of nothing."""

CERTAIN = 4.0
"""Standard errors by which a shift must differ from none."""

LEAST_TOE, LEAST_PRELOAD = 0.005, 0.05
"""Strain, and part of the stress at the end of the zone, below which it does not matter."""

MOST = 0.15
"""Strain. A larger shift is no preload or toe but something else."""

NEAR = 0.1
"""Strain within which the curve is continued to zero."""


class _Shift(NamedTuple):
    """Strain at which the stress begins, the first strain that counts, and what it is."""

    strain: float
    first: float
    what: str


def from_zero(series: Series) -> tuple[Series, str | None]:
    """The series with strain counted from where stress begins, and a note if that is another place.

    ``series.strain`` is a stretch. Raises ``DesignError`` where the shift would be too large.
    """
    order = np.argsort(series.strain, kind="stable")
    strain, stress = series.strain[order] - 1, series.stress[order]
    if strain.size < FEWEST_POINTS or strain[0] < -0.02:
        return series, None
    _require_near_zero(series, strain, stress)
    found = _toe(strain, stress) or _preload(strain, stress)
    if found is None:
        return series, None
    if abs(found.strain) > MOST:
        raise DesignError(_too_far(series, found.strain))
    moved = replace(series, strain=series.strain / (1 + found.strain))
    kept = moved.at(series.strain - 1 >= found.first)
    left = series.strain.size - kept.strain.size
    return kept, (
        f"{found.what}: strain is counted from {100 * found.strain:.3g} % of the file"
        f"{f', {left} points before are left out' if left else ''}; --keep zero takes it as it is"
    )


def _require_near_zero(series: Series, strain: Reals, stress: Reals) -> None:
    """Refuse strains that are stretches: the stress begins where the strains do."""
    begin = _line(strain[:6], stress[:6])
    if strain[0] > FAR and begin.slope > 0 and begin.zero > 0.7 * strain[0]:
        raise DesignError(_too_far(series, begin.zero))


def _too_far(series: Series, zero: float) -> str:
    return (
        f"{series.place}: the stress begins at a strain of {100 * zero:.3g} %, too far from zero "
        "for preload or slack; is the column a stretch, or in another unit? --columns and --units "
        "tell it, --keep zero takes strain and stress as they are."
    )


def _toe(strain: Reals, stress: Reals) -> _Shift | None:
    """Slack: the steepest tangent of the beginning is not the first."""
    zone = np.flatnonzero(strain <= strain[0] + min(ZONE, np.ptp(strain) / 2))
    width = max(6, zone.size // 6)
    if zone.size < 2 * width:
        return None
    lines = [_line(strain[k : k + width], stress[k : k + width]) for k in range(zone.size - width)]
    slopes = np.array([each.slope for each in lines])
    steepest = int(slopes.argmax())
    chosen = lines[steepest]
    if not chosen.slope > STEEPER * max(slopes[0], 0.0):
        return None
    noise = np.median([each.noise for each in lines])
    error = chosen.reach * np.sqrt(noise) / chosen.slope
    if chosen.zero - strain[0] < max(LEAST_TOE, CERTAIN * error):
        return None
    what = "the curve begins flat, as with slack or a toe"
    return _Shift(chosen.zero, float(strain[steepest]), what)


def _preload(strain: Reals, stress: Reals) -> _Shift | None:
    """Stress at zero strain, by a parabola through the beginning."""
    near = np.flatnonzero(strain <= strain[0] + NEAR)
    near = near if near.size >= FEWEST_POINTS else np.arange(0)
    if not near.size or strain[0] > NEAR / 5:
        return None
    x, y = strain[near], stress[near]
    basis = np.stack([np.ones_like(x), x, x * x], axis=1)
    (start, slope, _), *_ = np.linalg.lstsq(basis, y, rcond=None)
    left = y - basis @ np.linalg.lstsq(basis, y, rcond=None)[0]
    noise = float(left @ left) / (x.size - 3)
    error = float(np.sqrt(noise * np.linalg.pinv(basis.T @ basis)[0, 0]))
    if slope <= 0 or abs(start) < max(CERTAIN * error, LEAST_PRELOAD * float(np.abs(y).max())):
        return None
    what = f"the stress at zero strain is {start:.3g} MPa, taken for a preload"
    if start < 0:
        what = f"the stress at zero strain is {start:.3g} MPa, taken for slack"
    return _Shift(-start / slope, -1.0 if start > 0 else -start / slope, what)


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
