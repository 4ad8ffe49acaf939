"""Points in order of pressure, no more of them than a fit needs."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from bellows_design.errors import DesignError
from bellows_design.measured.reading.curve import MeasuredCurve
from solver.arrays import Reals

Numbers = NDArray[np.intp]

MOST_POINTS = 120
"""Of a curve; those of longer files are means in so many equal intervals of pressure."""

SAME_PRESSURE = 1e-6
"""Part of the highest pressure within which points have the same."""


def merged(curve: MeasuredCurve) -> MeasuredCurve:
    """The points in order of pressure, those of the same pressure as their mean.

    Raises ``DesignError`` if they all have the same.
    """
    order = np.argsort(np.abs(curve.pressure), kind="stable")
    curve = curve.at(order)
    groups = _groups(np.abs(curve.pressure))
    count = int(groups[-1]) + 1
    if count == 1:
        raise DesignError(
            f"{curve.name} has points at one pressure alone, {curve.pressure[0]:.4g} MPa; a curve "
            "has at least 2."
        )
    if count == curve.pressure.size:
        return curve
    same = count <= MOST_POINTS and not _too_many(curve)
    what = "of the same pressure" if same else f"in {count} intervals of pressure"
    note = f"{curve.pressure.size} points are read as {count}, each the mean of those {what}"
    return replace(
        curve,
        pressure=_mean(curve.pressure, groups),
        value=_mean(curve.value, groups),
        spread=None if curve.spread is None else np.sqrt(_mean(curve.spread**2, groups)),
    ).noted(note)


def _too_many(curve: MeasuredCurve) -> bool:
    return int(_same(np.abs(curve.pressure))[-1]) + 1 > MOST_POINTS


def _groups(size: Reals) -> Numbers:
    """(n,) number of each point's group, ascending from 0 without gaps."""
    groups = _same(size)
    if groups[-1] + 1 > MOST_POINTS:
        edges = np.linspace(size[0], size[-1], MOST_POINTS + 1)[1:-1]
        inside = np.searchsorted(edges, size, side="right")
        groups = np.unique(inside, return_inverse=True)[1].astype(np.intp)
    return groups


def _same(size: Reals) -> Numbers:
    apart = np.diff(size) > SAME_PRESSURE * size[-1]
    return np.concatenate(([0], np.cumsum(apart))).astype(np.intp)


def _mean(values: Reals, groups: Numbers) -> Reals:
    result: Reals = np.bincount(groups, values) / np.bincount(groups)
    return result
