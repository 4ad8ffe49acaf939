"""From a start to the best design of its choice, by exact gradients.

Rounds of sequential linear programming: a round begins with a design's evaluation by itself, goes
on from neighbour to neighbour on the moved mesh, and ends where it comes no further or too far for
its mesh. Steps are taken within a box, which shrinks where a step does not hold what it promised.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Literal

import numpy as np

from bellows_design.batch.answer import Answer
from bellows_design.batch.question import Question
from bellows_design.neighbours.carried import REACH
from bellows_design.neighbours.distance import distance
from bellows_design.study.optimize.allowed import CLEARANCE, Allowed
from bellows_design.study.optimize.goal import Goal
from bellows_design.study.optimize.linear_step import linear_step
from bellows_design.study.optimize.point import Point, gradients, point_of
from bellows_design.study.optimize.variables import Variables
from solver.arrays import Reals

Ask = Callable[[Question], Answer]
"""Answers a question, at once if it was answered before."""

FIRST_RADIUS, LARGEST_RADIUS, SMALLEST_RADIUS = 0.10, 0.16, 0.01
"""Of the box for one step, relative to the variables."""

MOST_ROUNDS, MOST_STEPS = 8, 8
"""Rounds of a descent, and steps of a round."""

FAR = 0.8
"""A round ends where its best design is so far away, as a fraction of what a neighbour may be."""

AT_WALL = 0.2 * CLEARANCE
"""mm. A design so near to other faces has come up against them."""

WORTHWHILE = 0.003
"""Least gain of a round, relative, for another one."""


@dataclass(frozen=True)
class Descent:
    """Looks for the best design of one choice."""

    variables: Variables
    goal: Goal
    ask: Ask

    def points(self, start: Reals) -> Iterator[Point]:
        """Every point evaluated, as it comes; the best of a round begins the next."""
        best: Point | None = None
        crossed: set[str] = set()
        for _ in range(MOST_ROUNDS):
            anchor = self._evaluated(start, "ordinary")
            if anchor is None:
                return
            yield anchor
            seen = [anchor]
            for point in self._round(anchor):
                seen.append(point)
                yield point
            end = min(seen, key=self._merit)
            wall = self._wall(end, anchor) - crossed
            gained = best is None or self._merit(end) < self._merit(best) - WORTHWHILE
            best = end if best is None or self._merit(end) < self._merit(best) else best
            if wall:
                name = min(wall)
                crossed.add(name)
                start = self._beyond(end, anchor, name)
            elif gained and end is not anchor:
                start = end.variables
            else:
                return

    def _round(self, anchor: Point) -> Iterator[Point]:
        """Neighbours of one evaluation, each step from the best so far."""
        at, radius = anchor, FIRST_RADIUS
        slopes = self._slopes(anchor, anchor)
        allowed = Allowed(self.variables, anchor.design)
        for _ in range(MOST_STEPS):
            if slopes is None:
                return
            step = self._step(at, slopes, allowed, radius)
            if step is None:
                return
            values, radius = step
            point = self._evaluated(values, anchor)
            if point is None or point.ordinary:  # no neighbour after all
                radius /= 2
                if radius < SMALLEST_RADIUS:
                    return
                continue
            yield point
            gain = self._merit(at) - self._merit(point)
            if gain <= 0:
                radius /= 3
            else:
                at, slopes = point, self._slopes(point, anchor)
                radius = min(radius * 1.5, LARGEST_RADIUS)
            far = distance(anchor.design, at.design) > FAR * REACH
            if far or radius < SMALLEST_RADIUS or 0 < gain < WORTHWHILE / 3:
                return

    def _step(
        self, at: Point, slopes: dict[str, Reals], allowed: Allowed, radius: float
    ) -> tuple[Reals, float] | None:
        """Variables of the next design and the radius they were found with; None for no step."""
        margins = allowed.linearised(at)
        while radius >= SMALLEST_RADIUS:
            values = linear_step(at, slopes, margins, self.variables, self.goal, radius)
            if np.allclose(values, at.variables, rtol=1e-4):
                return None
            if not allowed.refused(values):
                return values, radius
            radius /= 2
        return None

    def _evaluated(self, values: Reals, start: Point | Literal["ordinary"]) -> Point | None:
        """The point of these variables; None if its evaluation failed."""
        if self.variables.exists(values):
            return None
        design = self.variables.design(values)
        if isinstance(start, Point):
            question = Question(design, start.design, derivatives=True)
        else:
            question = Question(design, "ordinary", derivatives=True)
        answer = self.ask(question)
        return point_of(self.variables, values, answer, self.goal) if answer.done else None

    def _slopes(self, point: Point, anchor: Point) -> dict[str, Reals] | None:
        if point.answer.derivatives is None:
            return None
        return gradients(point, self.variables, self.goal)

    def _merit(self, point: Point) -> float:
        return self.goal.merit(point.values)

    def _wall(self, end: Point, anchor: Point) -> set[str]:
        """Lengths that keep the body its faces and that the end of a round has come up against."""
        allowed = Allowed(self.variables, anchor.design)
        before, after = allowed.faces(anchor.design), allowed.faces(end.design)
        return {name for name in after if after[name] < AT_WALL < before[name]}

    def _beyond(self, end: Point, anchor: Point, name: str) -> Reals:
        """Variables of a design on the other side of such a length, as near as possible."""
        value, slope = Allowed(self.variables, anchor.design).linearised(end)[name]
        towards = -slope / max(float(slope @ slope), 1e-12)
        values = end.variables * np.exp(towards * (value + 2 * CLEARANCE))
        values = np.clip(values, self.variables.lower, self.variables.upper)
        return self.variables.within_room(values)
