"""Estimated errors of a table where no point was computed to see them."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from bellows_design.force.law.interpolation.rows import Row, doubt
from bellows_design.force.law.interpolation.table import Table

PLACES = 41
"""Moments at which two rows are compared."""


def within_rows(rows: Sequence[Row]) -> float:
    """Largest doubt between neighbouring points of rows, rad: refinement leaves the tolerance."""
    return max((doubt(*pair) for row in rows for pair in pairwise(row.points)), default=0.0)


def between_rows(table: Table, low: float, high: float) -> float:
    """By how much two interpolations midway between rows (MPa) differ in rotation at most, rad.

    One knows the derivatives by the pressure of both rows, the other one those of one row: at equal
    distance from where neighbours begin to touch, a cubic and a quadratic.
    """
    near, far = table.curves(low), table.curves(high)
    ranges = [np.array(table.reach(p)) - table.curves(p).origin for p in (low, high)]
    first, last = (float(np.mean(ends)) for ends in zip(*ranges, strict=True))
    places = np.linspace(first, last, PLACES)
    start, end = (curves.fields(curves.origin + places) for curves in (near, far))
    rates = [
        fields.by_both[:, 0] + curves.rate * fields.by_moment_twice[:, 0]
        for fields, curves in ((start, near), (end, far))
    ]
    rise = end.by_moment[:, 0] - start.by_moment[:, 0]
    return float(np.abs(rise - (high - low) * (rates[0] + rates[1]) / 2).max() / 4)
