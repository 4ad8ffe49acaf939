"""Least squares for laws whose stress is linear in their constants: one step, over relative errors.

Intervals are Student's, at 95 %, exact for Gaussian errors.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from bellows_design.materials.fitting.fit_result import VANISHED, Constant, student_width
from bellows_design.materials.fitting.weighted import Weighted
from solver.material.homogeneous import Reals


@dataclass(frozen=True, eq=False)
class LinearFit:
    """``values`` (k,) in MPa, the same with intervals, the sum of squares, and if one is idle."""

    values: Reals
    constants: tuple[Constant, ...]
    squares: float
    vanished: bool


def fit_linear(
    problem: Weighted, columns: Reals, names: Sequence[str], least: Sequence[float]
) -> LinearFit:
    """The constants called ``names``, none below its ``least`` (MPa).

    ``columns`` (n, k) is the weighted stress per MPa of each constant.
    """
    from scipy.optimize import lsq_linear

    scale = np.linalg.norm(columns, axis=0)
    scaled = lsq_linear(columns / scale, problem.target, (least, np.inf), tol=1e-14)
    values = scaled.x / scale
    squares = float(((columns @ values - problem.target) ** 2).sum())
    return LinearFit(
        values * problem.unit,
        _constants(values * problem.unit, columns, names, squares, problem),
        squares,
        bool((np.abs(columns * values).max(axis=0) < VANISHED).any()),
    )


def _constants(
    values: Reals, columns: Reals, names: Sequence[str], squares: float, problem: Weighted
) -> tuple[Constant, ...]:
    """The constants, MPa, with standard errors and intervals."""
    freedom = problem.informative - len(names)
    scale = np.linalg.norm(columns, axis=0)
    inverse = np.linalg.pinv(columns / scale)
    noise = math.sqrt(squares / problem.informative) * math.sqrt(problem.informative / freedom)
    errors = noise * np.linalg.norm(inverse, axis=1) / scale * problem.unit
    width = student_width(freedom)
    return tuple(
        Constant(
            name, "MPa", value, error, value - width * error, value + width * error, signed=True
        )
        for name, value, error in zip(names, values.tolist(), errors.tolist(), strict=True)
    )
