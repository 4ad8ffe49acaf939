"""Points after a specimen broke: noticed, left out, said."""

from __future__ import annotations

import numpy as np

from bellows_design.materials.measurements.series import Series

FALLEN, NEVER_AGAIN, BEFORE = 0.7, 0.8, 0.95
"""Broken is what falls below the first part of its largest stress and stays below the second; the
last point above the third is the last that counts."""


def before_break(series: Series) -> tuple[Series, str | None]:
    """The points until the specimen breaks, in the order of strain, and a note if it does.

    ``series.strain`` is a stretch. A fall at the end is a break; load cells read about zero after.
    """
    order = np.argsort(np.abs(series.strain - 1), kind="stable")
    load = np.abs(series.stress[order])
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


def _line(series: Series, index: int) -> str:
    return f"line {int(series.lines[index])}"
