"""Points that are no loading: while the strain is held, and after the specimen broke."""

from __future__ import annotations

import numpy as np
from scipy.ndimage import median_filter

from bellows_design.materials.measurements.series import Series
from solver.arrays import Reals

FALLEN, NEVER_AGAIN, BEFORE = 0.7, 0.8, 0.95
"""Broken is what falls below the first part of its largest stress and stays below the second; the
last point above the third is the last that counts."""

HELD, RELAXED, SHORTEST_HOLD = 1e-3, 0.02, 8
"""Part of the range of strain within which it is held, part of the stress that relaxes at least,
and points of a hold at least."""


def before_break(series: Series) -> tuple[Series, str | None]:
    """The points until the specimen breaks, in the order of strain, and a note if it does.

    ``series.strain`` is a stretch. A fall at the end is a break; load cells read about zero after.
    """
    order = np.argsort(np.abs(series.strain - 1), kind="stable")
    load = _without_spikes(np.abs(series.stress[order]))
    peak = int(load.argmax())
    after = load[peak:]
    fallen = np.flatnonzero(after < FALLEN * load[peak])
    if not fallen.size or (after[fallen[0] :] > NEVER_AGAIN * load[peak]).any():
        return series, None
    last = peak + int(np.flatnonzero(after[: fallen[0]] >= BEFORE * load[peak])[-1])
    kept = np.sort(order[: last + 1])
    strain = series.strain[order[last]] - 1
    return series.at(kept), (
        f"the stress falls for good after a strain of {100 * strain:.4g} %: taken for the break, "
        f"{load.size - last - 1} points from {_line(series, order[last + 1])} on are left out; "
        "--keep break keeps them"
    )


def without_holds(series: Series) -> tuple[Series, str | None]:
    """The points without those at which the strain is held while the stress relaxes, and a note.

    ``series.strain`` is a stretch. Of each hold the first point stays.
    """
    width = HELD * float(np.ptp(series.strain)) if series.strain.size else 0.0
    if width == 0:
        return series, None
    dropped = np.zeros(series.strain.size, bool)
    start = 0
    strain, load = series.strain, np.abs(series.stress)
    for k in range(1, strain.size + 1):
        if k < strain.size and abs(strain[k] - strain[start]) <= width:
            continue
        relaxes = load[k - 1] < (1 - RELAXED) * load[start] and load[start] > 0.05 * load.max()
        dropped[start + 1 : k] = k - start >= SHORTEST_HOLD and relaxes
        start = k
    if not dropped.any():
        return series, None
    return series.at(~dropped), (
        f"the strain is held while the stress relaxes: {int(dropped.sum())} points are left out, "
        "of each hold the first is used; --keep break keeps them"
    )


def _without_spikes(load: Reals) -> Reals:
    """Medians of three neighbours: one point that jumps up is no peak."""
    if load.size < 5:
        return load
    result: Reals = median_filter(load, 3, mode="nearest")
    return result


def _line(series: Series, index: int) -> str:
    return f"line {int(series.lines[index])}"
