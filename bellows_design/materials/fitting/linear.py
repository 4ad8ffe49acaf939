"""Least squares for laws whose stress is linear in their constants: one step, over relative errors.

Intervals are Student's, at 95 %, exact for Gaussian errors.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from bellows_design.materials.fitting.fit_result import (
    VANISHED,
    Constant,
    Estimate,
    Fit,
    judged,
    student_width,
)
from bellows_design.materials.fitting.weighted import Weighted
from bellows_design.materials.measurements.points import Measurements
from solver.arrays import Reals
from solver.material.constants import Constants
from solver.material.homogeneous import MODES, nominal_stress
from solver.material.laws import law as solver_law
from solver.material.laws import number_of

if TYPE_CHECKING:
    from bellows_design.materials.fitting.fit_model import FitModel


@dataclass(frozen=True, eq=False)
class LinearFit:
    """``values`` (k,) in MPa, the same with intervals, the sum of squares, and if one is idle."""

    values: Reals
    constants: tuple[Constant, ...]
    squares: float
    vanished: bool


def fit_law(data: Measurements, problem: Weighted, model: FitModel) -> Fit:
    """Fit the constants, of either sign, of the solver's law with the model's name."""
    names, number = solver_law(model.name).constants, number_of(model.name)
    columns = columns_of(data, problem, lambda values: Constants(number, values), len(names))
    found = fit_linear(problem, columns, names, [-np.inf] * len(names))
    law = Constants(number, found.values)
    return judged(
        data, problem, model.name, Estimate(law, found.constants, found.squares, found.vanished)
    )


def columns_of(
    data: Measurements, problem: Weighted, law: Callable[[Reals], Constants], count: int
) -> Reals:
    """(n, count) weighted stress per MPa of each constant of a law that is linear in them.

    ``law`` turns constants (count,) into those of the solver.
    """
    columns = np.empty((data.stress.size, count))
    for column, unit in enumerate(np.eye(count)):
        for number, mode in enumerate(MODES.values()):
            chosen = data.mode == number
            columns[chosen, column] = nominal_stress(mode, data.stretch[chosen], law(unit))
    return problem.weight[:, None] * columns


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
