"""From a start to the best design of its choice, by exact gradients.

Rounds of sequential linear programming: a round begins with a design's evaluation by itself, goes
on from neighbour to neighbour on the moved mesh, and ends where it comes no further or too far for
its mesh. Steps are taken within a box, which shrinks where a step does not hold what it promised.
"""

from __future__ import annotations

import math
from collections.abc import Generator
from dataclasses import dataclass
from typing import Literal

import numpy as np

from bellows_design.design.design import Design
from bellows_design.neighbours.distance import distance
from bellows_design.study.optimize.goal import Goal
from bellows_design.study.optimize.point import Point, Request, gap_slope, gradients
from bellows_design.study.optimize.search.allowed import CLEARANCE, SEARCH_REACH, Allowed
from bellows_design.study.optimize.search.linear_step import linear_step
from bellows_design.study.optimize.space.variables import Variables
from solver.arrays import Reals

FIRST_RADIUS, LARGEST_RADIUS, SMALLEST_RADIUS = 0.10, 0.16, 0.01
"""Of the box for one step, relative to the variables."""

SMALLEST_STEP = 2e-3
"""Relative change of the variables that is worth an evaluation."""

MOST_ROUNDS, MOST_STEPS = 8, 8
"""Rounds of a descent, and steps of a round."""

FAR = 0.8
"""A round ends where its best design is so far away, as a fraction of what a neighbour may be."""

AT_WALL = 0.2 * CLEARANCE
"""mm. A design so near to other faces has come up against them."""

WORTHWHILE = 0.003
"""Least gain of a round, relative, for another one. The gain is that on one mesh: from mesh to mesh
a stress differs by more."""

HOPELESS = 0.08
"""A descent that is so much worse than the best known after two rounds is given up."""

Search = Generator[Request, Point | None, None]
"""Yields what it wants evaluated; it is sent the point, or None where the evaluation failed."""

Round = Generator[Request, Point | None, Point]
"""The same; returns its best point."""


@dataclass(frozen=True)
class Descent:
    """Looks for the best design of one choice.

    Attributes:
        variables: Of the choice.
        goal: What is minimised.
        start: Values of the variables to begin with.
        bar: The best merit known before; descents that stay far behind are given up.
        accuracy_percent: Of evaluations by themselves; without it the usual one.
    """

    variables: Variables
    goal: Goal
    start: Reals
    bar: float = math.inf
    accuracy_percent: float | None = None

    def search(self) -> Search:
        """Round by round; the last evaluation is one by itself, of the best design."""
        start, best, crossed = self.variables.rounded(self.start), math.inf, {""}
        settled, gap = False, GapSlope(len(start))
        if self.variables.exists(start):
            return
        for number in range(MOST_ROUNDS):
            anchor = yield self._request(start, "ordinary")
            if anchor is None:
                return
            best = min(best, self._merit(anchor))
            last = settled or number == MOST_ROUNDS - 1
            if last or (number > 1 and best > self.bar + HOPELESS):
                return
            end = yield from self._round(anchor, gap)
            gained = self._merit(anchor) - self._merit(end)
            wall = min(self._walls(end, anchor) - crossed, default="")
            if end is anchor and not wall:
                return
            crossed.add(wall)
            start = self._beyond(end, anchor, wall) if wall else end.variables
            settled = gained < WORTHWHILE and not wall

    def _round(self, anchor: Point, gap: GapSlope) -> Round:
        """Neighbours of one evaluation, each step from the best so far."""
        at, steps = anchor, _Steps(self, anchor, gap)
        for _ in range(MOST_STEPS):
            values = steps.next(at)
            if values is None:
                break
            point = yield self._request(values, anchor.design)
            if point is not None and point.ordinary and self._merit(point) < self._merit(at):
                return point  # no neighbour led there, but it is a good start for another round
            if point is None or point.ordinary:
                steps.radius /= 2
                continue
            gap.learn(at, point, self.variables)
            gain = self._merit(at) - self._merit(point)
            steps.taken(gain)
            at = point if gain > 0 else at
            if distance(anchor.design, at.design) > FAR * SEARCH_REACH or 0 < gain < WORTHWHILE / 3:
                break
        return at

    def _request(self, values: Reals, start: Design | Literal["ordinary"]) -> Request:
        return Request(self.variables, values, start, SEARCH_REACH, self.accuracy_percent)

    def _merit(self, point: Point) -> float:
        return self.goal.merit(point.values)

    def _walls(self, end: Point, anchor: Point) -> frozenset[str]:
        """Lengths that keep the body its faces and that the end of a round has come up against."""
        allowed = Allowed(self.variables, anchor.design)
        before, after = allowed.faces(anchor.design), allowed.faces(end.design)
        return frozenset(name for name in after if after[name] < AT_WALL < before[name])

    def _beyond(self, end: Point, anchor: Point, name: str) -> Reals:
        """Variables of a design on the other side of such a length, as near as possible.

        Those of the end itself where there is none.
        """
        value, slope = Allowed(self.variables, anchor.design).linearised(end)[name]
        towards = -slope / max(float(slope @ slope), 1e-12)
        values = end.variables * np.exp(towards * (value + 2 * CLEARANCE))
        values = np.clip(values, self.variables.lower, self.variables.upper)
        values = self.variables.rounded(self.variables.within_room(values))
        return end.variables if self.variables.exists(values) else values


class GapSlope:
    """What steps have shown of the gap's slope beyond what is known of it: Broyden's update."""

    def __init__(self, size: int) -> None:
        self.correction = np.zeros(size)

    def learn(self, before: Point, after: Point, variables: Variables) -> None:
        """Correct the slope so that it explains the change of the gap from one point to another."""
        step = np.log(after.variables / before.variables)
        if "gap" in before.values and "gap" in after.values and step.any():
            explained = float((gap_slope(before, variables) + self.correction) @ step)
            change = after.values["gap"] - before.values["gap"]
            self.correction += (change - explained) * step / float(step @ step)


class _Steps:
    """The steps of a round: the box they are taken in changes with what they bring."""

    def __init__(self, descent: Descent, anchor: Point, gap: GapSlope) -> None:
        self._descent, self._gap = descent, gap
        self._allowed = Allowed(descent.variables, anchor.design)
        self.radius = FIRST_RADIUS

    def next(self, at: Point) -> Reals | None:
        """Variables of the next design to be evaluated; None if there is no step."""
        if at.answer.derivatives is None:
            return None
        variables, goal = self._descent.variables, self._descent.goal
        slopes, margins = gradients(at, variables, goal), self._allowed.linearised(at)
        slopes["gap"] = slopes["gap"] + self._gap.correction
        while self.radius >= SMALLEST_RADIUS:
            step = linear_step(at, slopes, margins, variables, goal, self.radius)
            values = variables.rounded(step)
            if np.allclose(values, at.variables, rtol=SMALLEST_STEP):
                return None
            if not self._allowed.refused(values):
                return values
            self.radius /= 2
        return None

    def taken(self, gain: float) -> None:
        """Widen the box after a step that gained, narrow it after one that did not."""
        self.radius = min(1.5 * self.radius, LARGEST_RADIUS) if gain > 0 else self.radius / 3
