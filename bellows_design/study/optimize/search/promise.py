"""How good the best design of a choice may be, judged by one evaluated design and its gradients."""

from __future__ import annotations

import numpy as np

from bellows_design.study.optimize.goal import Goal
from bellows_design.study.optimize.point import Point, gradients
from bellows_design.study.optimize.search.allowed import Allowed
from bellows_design.study.optimize.search.linear_step import linear_step
from bellows_design.study.optimize.space.variables import Variables

RADIUS = 0.4
"""Of the box, relative to the variables, over which changes are taken as linear in logarithms."""


def promise(point: Point, variables: Variables, goal: Goal) -> float:
    """Merit that one large step from a point promises: to compare choices, not to believe.

    Other faces and the reach of a neighbour do not bound it.
    """
    if point.answer.derivatives is None:
        return goal.merit(point.values)
    slopes = gradients(point, variables, goal)
    margins = Allowed(variables, point.design).linearised(point)
    bounding = {name: margins[name] for name in ("room", "port")}
    step = linear_step(point, slopes, bounding, variables, goal, RADIUS)
    change = np.log(step / point.variables)
    expected = {
        name: value + float(slopes[name] @ change)
        if name == "gap"
        else value * float(np.exp(slopes[name] @ change))
        for name, value in point.values.items()
    }
    return goal.merit(expected)
