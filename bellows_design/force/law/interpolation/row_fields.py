"""What is interpolated of a row, as functions of the relative moment m at its pressure.

Fields are the complementary energy, the extension and the compliance against axial force, each with
its derivative by the pressure at constant m.
"""

from __future__ import annotations

import numpy as np

from bellows_design.force.law.interpolation.derivatives import (
    curvatures,
    monotone_slopes,
    slopes,
)
from bellows_design.force.law.interpolation.polynomials import Piecewise, hermite
from bellows_design.force.law.interpolation.rows import Row
from solver.arrays import Reals

Columns = tuple[Reals, Reals, Reals]
"""Values and first and second derivatives by m at the points, (n,) each."""

BENT = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 0.0]])
"""Beyond its moments a row's energy has a constant compliance; all else is linear."""


def row_fields(row: Row, origin: float, rate: float) -> Piecewise:
    """Fields and their derivatives by the pressure, (2, 3), as functions of m.

    ``origin``: moment at m = 0, N mm; ``rate``: its derivative by the pressure.
    """
    places = row.moments - origin
    columns = [*_fields(row, places), *_rates(row, places, rate)]
    shape = (len(places), 2, 3)
    value, slope, bend = (
        np.stack(each, axis=1).reshape(shape) for each in zip(*columns, strict=True)
    )
    return hermite(places, value, slope, bend, BENT)


def _fields(row: Row, places: Reals) -> list[Columns]:
    """Energy, extension and axial compliance."""
    by, extension = row.derivatives, row.column(lambda point: point.extension)
    energy = row.column(lambda point: point.energy)
    rotation = row.column(lambda point: point.rotation)
    return [
        (energy, rotation, by[:, 0, 0]),
        _completed(places, extension, by[:, 0, 1]),
        _completed(places, by[:, 1, 1], monotone_slopes(places, by[:, 1, 1])),
    ]


def _rates(row: Row, places: Reals, rate: float) -> list[Columns]:
    """Their derivatives by the pressure at constant m.

    Where neighbours begin to touch, the kinks of volume and rotation cancel each other, so that
    their sum is interpolated. The rate of the axial compliance is not known, and small.
    """
    by = row.derivatives
    energy = row.column(lambda point: point.volume + point.rotation * rate)
    extension = by[:, 1, 2] + by[:, 0, 1] * rate
    none = np.zeros_like(energy)
    return [
        _completed(places, energy, by[:, 0, 2] + by[:, 0, 0] * rate),
        _completed(places, extension, slopes(places, extension)),
        (none, none, none),
    ]


def _completed(places: Reals, values: Reals, first: Reals) -> Columns:
    return values, first, curvatures(places, values, first)
