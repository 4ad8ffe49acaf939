"""What the table knows besides the motion: stress, and whether neighbouring bubbles touch.

Interpolated at equal relative moments, linearly between rows; within a row monotonically.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from bellows_design.force.law.interpolation.points import SectionPoint
from bellows_design.force.law.interpolation.table import Table
from solver.arrays import Reals


def highest_stress(table: Table, pressure: float, moments: Reals) -> Reals:
    """Highest von Mises stress (k,), MPa, at moments (k,), N mm; beyond the rows that at their end.

    Raises ``BellowsError`` for a pressure beyond the rows.
    """
    return _between_rows(table, pressure, moments, lambda point: point.stress)


def gaps(table: Table, pressure: float, moments: Reals) -> Reals:
    """Air to the neighbouring bubble (k,), mm, likewise; infinite where none faces it."""
    return _between_rows(
        table, pressure, moments, lambda point: np.inf if point.gap is None else point.gap
    )


def _between_rows(
    table: Table, pressure: float, moments: Reals, number: Callable[[SectionPoint], float]
) -> Reals:
    index, places = table.interval(pressure), moments - table.curves(pressure).origin
    low, high = table.pressures[index : index + 2]
    share = (pressure - low) / (high - low)
    near, far = (_in_row(table, each, places, number) for each in (index, index + 1))
    return (1 - share) * near + share * far if share else near


def _in_row(
    table: Table, index: int, places: Reals, number: Callable[[SectionPoint], float]
) -> Reals:
    from scipy.interpolate import PchipInterpolator

    row, values = table.rows[index], table.rows[index].column(number)
    known = row.moments - table.coordinates.origins[index]
    if len(known) < 2 or not np.isfinite(values).all():
        return np.interp(places, known, values)
    result: Reals = PchipInterpolator(known, values)(np.clip(places, known[0], known[-1]))
    return result
