"""A design that was evaluated on the way to the best, its responses and their gradients."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import cached_property
from typing import Literal

import numpy as np

from bellows_design.batch.answer import Answer
from bellows_design.batch.question import Question
from bellows_design.design.design import Design
from bellows_design.neighbours.carried import REACH
from bellows_design.study.optimize.goal import GAP_SCALE, MARGIN, Goal, responses
from bellows_design.study.optimize.space.choices import Choice
from bellows_design.study.optimize.space.variables import Variables
from solver.arrays import Reals

RESPONSES = {
    "angle": "bending_angle_deg",
    "stress": "max_von_mises_mpa",
    "volume": "cavity_volume_mm3",
}
"""Names here and in an answer's derivatives."""

CLOSING = 0.034
"""mm by degree that a bubble turns: by so much did the gap close, 0.031 to 0.035, in three steps
between designs of nine bubbles at 59 to 61 degrees each, besides the change of the distance."""

STEP = 1e-3
"""Relative step of the difference quotients of the volume of material."""


@dataclass(frozen=True)
class Point:
    """One evaluated design.

    Attributes:
        choice: Its counts.
        variables: Values of the choice's variables.
        design: The design.
        answer: What was found.
        values: Responses by name: ``angle`` (°), ``stress`` (MPa), ``volume`` (mm³), ``strain``,
            ``gap`` (``GAP_SCALE``) where bubbles face each other, and ``material`` (mm³) where the
            goal is about it.
    """

    choice: Choice
    variables: Reals = field(repr=False)
    design: Design = field(repr=False)
    answer: Answer
    values: dict[str, float]

    @property
    def ordinary(self) -> bool:
        """Whether its numbers depend on the design alone."""
        return self.answer.origin == "ordinary"

    @property
    def stress_with_error(self) -> float:
        """Highest stress and its estimated error, MPa; the least error where none is stated."""
        percent = self.answer.max_von_mises_error_percent
        return self.values["stress"] * (1 + (MARGIN if percent is None else percent / 100))

    @property
    def values_with_error(self) -> dict[str, float]:
        """The values, with a stress that its error and not the margin of a goal is added to."""
        return self.values | {"stress": self.stress_with_error / (1 + MARGIN)}


@dataclass(frozen=True)
class Request:
    """A design that a search wants evaluated, and from where.

    Attributes:
        variables: Of its choice.
        values: Theirs.
        start: ``ordinary``, or the design whose neighbour it is.
        reach: Distance up to which it is one.
        accuracy_percent: Of the evaluation by itself that it begins with.
    """

    variables: Variables
    values: Reals
    start: Design | Literal["ordinary"]
    reach: float = REACH
    accuracy_percent: float | None = None

    @property
    def possible(self) -> bool:
        """Whether there is such a design."""
        return not self.variables.exists(self.values)

    @cached_property
    def question(self) -> Question:
        """What is asked, with derivatives."""
        return Question(
            self.variables.design(self.values),
            self.start,
            derivatives=True,
            accuracy_percent=self.accuracy_percent,
            reach=REACH if isinstance(self.start, str) else self.reach,
        )

    def point(self, answer: Answer, goal: Goal) -> Point | None:
        """The point of an answer; None where the evaluation failed."""
        if not answer.done:
            return None
        design, found = self.question.design, responses(answer)
        if goal.quantity == "material":
            found["material"] = material_volume(design)
        return Point(self.variables.choice, self.values, design, answer, found)


def gradients(point: Point, variables: Variables, goal: Goal) -> dict[str, Reals]:
    """Of the logarithm of each response by the logarithm of each variable (elasticities).

    A strain changes as the stress does, which is all that is known of it: near enough for a step.
    Of the gap it is ``GAP_SCALE`` by a logarithm.
    """
    found = {
        name: _derivatives(point, variables, key) * point.variables / point.values[name]
        for name, key in RESPONSES.items()
    }
    found["strain"] = found["stress"]
    found["gap"] = gap_slope(point, variables)
    if goal.quantity == "material":
        found["material"] = _material_gradient(point, variables)
    return found


def gap_slope(point: Point, variables: Variables) -> Reals:
    """Of the gap under pressure by the logarithms of the variables, in ``GAP_SCALE``.

    It is wider by what the bubble distance is, and closes as bubbles turn against each other.
    """
    distance = np.array([name == "bubble_distance" for name in variables.names])
    turned = _derivatives(point, variables, "bending_angle_deg") / point.choice.bubbles
    slope: Reals = (distance - CLOSING * turned) * point.variables / GAP_SCALE
    return slope


def _derivatives(point: Point, variables: Variables, response: str) -> Reals:
    """Of a response by the variables."""
    derivatives = point.answer.derivatives
    assert derivatives is not None, "every question asks for them"
    return variables.gradient(point.variables, derivatives[response])


def material_volume(design: Design) -> float:
    """Material of the part as if its boxes were sharp, mm³; without the port.

    What fillets take, a few percent, hardly depends on the lengths that are varied.
    """
    p = design.bellows
    shells = p.bubble_count * (math.prod(p.bubble_size) - math.prod(p.chamber_size))
    between = p.length - p.bubble_count * p.bubble_length
    channel = p.channel_width * p.channel_height
    walls = p.bubble_count * 2 * p.bubble_thickness
    return shells + between * p.tendon_width * p.tendon_height - channel * (between + walls)


def _material_gradient(point: Point, variables: Variables) -> Reals:
    """By central differences of the sharp boxes."""
    found = np.zeros(len(point.variables))
    for index in range(len(found)):
        moved = np.array([point.variables, point.variables])
        moved[:, index] *= 1 + STEP, 1 - STEP
        ahead, behind = (_material_near(point, variables, values) for values in moved)
        found[index] = math.log(ahead / behind) / math.log((1 + STEP) / (1 - STEP))
    return found


def _material_near(point: Point, variables: Variables, values: Reals) -> float:
    """That of a design beside a point; the point's own where there is none."""
    exists = not variables.exists(values)
    return material_volume(variables.design(values)) if exists else point.values["material"]
