"""One step of sequential linear programming, in the logarithms of variables and responses.

Angle and stress are nearly products of powers of the lengths, so that their logarithms are nearly
linear in those of the lengths over steps of ten or twenty percent.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from scipy.optimize import linprog

from bellows_design.study.optimize.goal import PENALTY, Goal
from bellows_design.study.optimize.point import Point
from bellows_design.study.optimize.space.variables import Variables
from solver.arrays import Reals

FALLING_SHORT = ("angle", "gap")
"""Responses whose limits are lower ones."""

SINGULAR = 1e-12
"""Slopes below this are none."""


def linear_step(
    at: Point,
    slopes: Mapping[str, Reals],
    margins: Mapping[str, tuple[float, Reals]],
    variables: Variables,
    goal: Goal,
    radius: float,
) -> Reals:
    """Variables of the best design by first-order changes, within ``radius`` (relative) of a point.

    Minimises the quantity and, weighted, how far limits are exceeded; each has a slack of its own.

    Args:
        at: Where the changes are taken.
        slopes: Elasticities of the responses.
        margins: Values and slopes of what must stay positive.
        variables: Bounds.
        goal: What is minimised, and its limits.
        radius: Of the box around the point, in logarithms.
    """
    size = len(at.variables)
    limits = goal.limits(at.values)
    objective = goal.sign * slopes[goal.quantity]
    rows, right = [], []
    for name, excess in limits.items():
        sign = -1.0 if name in FALLING_SHORT else 1.0
        rows.append(np.concatenate([sign * slopes[name], _slack(limits, name)]))
        right.append(-excess)
    for value, slope in margins.values():
        if np.abs(slope).max() > SINGULAR:
            rows.append(np.concatenate([-slope, np.zeros(len(limits))]))
            right.append(max(value, 0.0))
    cost = np.concatenate([objective, np.full(len(limits), PENALTY)])
    box = [*_box(at.variables, variables, radius), *[(0.0, None)] * len(limits)]
    found = linprog(cost, A_ub=np.array(rows), b_ub=np.array(right), bounds=box)
    if not found.success:
        return at.variables
    moved: Reals = at.variables * np.exp(found.x[:size])
    return variables.within_room(np.clip(moved, variables.lower, variables.upper))


def _slack(limits: Mapping[str, float], name: str) -> Reals:
    """Minus one in the place of a limit's own slack."""
    return np.array([-1.0 if each == name else 0.0 for each in limits])


def _box(values: Reals, variables: Variables, radius: float) -> list[tuple[float, float]]:
    low = np.maximum(np.log(variables.lower / values), -radius)
    high = np.minimum(np.log(variables.upper / values), radius)
    return list(zip(np.minimum(low, 0.0), np.maximum(high, 0.0), strict=True))
