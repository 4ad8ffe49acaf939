"""The stages of an optimization: all choices roughly, a few by gradients, those around the best.

Global: designs of all choices, each by itself. Descents: by gradients, from the base and from those
of other choices that promise most. Around: choices that differ in one count from the best one's,
from its lengths, as long as that helps. Refined: the best few once more, on finer meshes. Front:
likewise, at lower and higher limits of the stress.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

from bellows_design.design.design import Design
from bellows_design.study.optimize.coordinator import Coordinator
from bellows_design.study.optimize.goal import Goal
from bellows_design.study.optimize.point import Point, Request
from bellows_design.study.optimize.search.descent import Descent, Search
from bellows_design.study.optimize.search.global_stage import GlobalStage
from bellows_design.study.optimize.search.promise import promise
from bellows_design.study.optimize.space.choices import Bounds, Choice, choices
from bellows_design.study.optimize.space.variables import Variables
from solver.arrays import Reals

WAVE = 4
"""Designs of the global stage that are chosen at once: the same whoever evaluates them."""

MOST_PROMISING = 3
"""Choices beside the best one's that are descended from at once."""

FINE_PERCENT = 2.0
"""Accuracy of the last descents: the least error of a stress that is stated. On usual meshes the
stress of one design differs by up to 4 %, and the angle that a limit allows by as much."""

FRONT_LIMITS = (0.95, 0.875, 0.8, 1.1)
"""Limits of the stress for the front, over the goal's."""


@dataclass(frozen=True)
class Effort:
    """How much is looked at, where time does not end it before.

    Attributes:
        global_designs: Of the global stage.
        starts: Descents after it.
        refined: Choices that are sought once more on finer meshes.
        front_limits: Limits of the stress for which the front is sought, over the goal's.
        gradients: Whether there are descents at all.
        seed: Of the global stage.
    """

    global_designs: int = 24
    starts: int = 4
    refined: int = 2
    front_limits: tuple[float, ...] = FRONT_LIMITS
    gradients: bool = True
    seed: int = 0


@dataclass(frozen=True)
class Optimization:
    """What is optimized: everything that decides which designs are asked for.

    Attributes:
        base: The design that all is taken from but the variables and counts.
        goal: What is sought.
        bounds: Of the counts.
        effort: How much is looked at.
    """

    base: Design
    goal: Goal
    bounds: Bounds = field(default_factory=Bounds)
    effort: Effort = field(default_factory=Effort)

    def variables(self, choice: Choice) -> Variables:
        """Those of one choice."""
        return Variables(self.base, choice, self.bounds)

    @cached_property
    def choices(self) -> tuple[Choice, ...]:
        """All combinations of counts for which there is a design."""
        found = choices(self.base, self.bounds)
        return tuple(each for each in found if self.variables(each).possible)

    def search(self, at: Coordinator) -> None:
        """Go through all stages; the points are the coordinator's."""
        all_choices = self.choices
        base = self._request(nearest_choice(self.base, all_choices), self.base)
        first = at.evaluated([base])[0] if base.possible else None
        self._global(at, all_choices)
        if self.effort.gradients:
            at.lead(self._descent_from(each, at) for each in self._starts(at, first))
            self._around_the_best(at, all_choices)
            self._refined(at)
            self._front(at)

    def descent(self, start: Reals, choice: Choice, at: Coordinator) -> Descent:
        """Of one choice from values of its variables, on meshes of the usual accuracy."""
        return Descent(self.variables(choice), self.goal, start, self._bar(at))

    def fine_descent(self, start: Point, goal: Goal) -> Descent:
        """Of one choice from a point, on finer meshes."""
        variables = self.variables(start.choice)
        return Descent(variables, goal, start.variables, accuracy_percent=FINE_PERCENT)

    def _global(self, at: Coordinator, all_choices: Sequence[Choice]) -> None:
        stage = GlobalStage(all_choices, self.variables, self.effort.seed)
        left = self.effort.global_designs
        while left > 0 and not at.late:
            wave = stage.suggestions(min(WAVE, left))
            if not wave:
                return
            left -= len(wave)
            requests = [Request(each.variables, each.values, "ordinary") for each in wave]
            for each, point in zip(wave, at.evaluated(requests), strict=True):
                stage.tell(each, None if point is None else self.goal.merit(point.values))

    def _descent_from(self, point: Point, at: Coordinator) -> Search:
        return self.descent(point.variables, point.choice, at).search()

    def _starts(self, at: Coordinator, first: Point | None) -> list[Point]:
        """The base, and those of other choices that promise most."""
        starts = [] if first is None else [first]
        taken = {each.choice for each in starts}
        others = self._by_promise((p for p in at.points if p.choice not in taken), at)
        return [*starts, *others][: self.effort.starts]

    def _by_promise(self, points: Iterable[Point], at: Coordinator) -> list[Point]:
        """The point of each choice that promises most, the best first.

        Of those only that promise more than the best is already.
        """
        ordinary = [each for each in points if each.ordinary]
        merits = [promise(each, self.variables(each.choice), self.goal) for each in ordinary]
        found: dict[Choice, Point] = {}
        for place in sorted(range(len(ordinary)), key=merits.__getitem__):
            if merits[place] < self._bar(at):
                found.setdefault(ordinary[place].choice, ordinary[place])
        return list(found.values())

    def _bar(self, at: Coordinator) -> float:
        """The best merit so far."""
        best = at.most_promising(1)
        return min((self.goal.merit(each.values) for each in best), default=math.inf)

    def _around_the_best(self, at: Coordinator, all_choices: Sequence[Choice]) -> None:
        """Descents of the choices beside the best one's that promise most, while that helps.

        Each of these is evaluated once, at the best one's lengths as far as they fit, to tell what
        it promises.
        """
        looked_at: set[Choice] = set()
        while not at.late:
            best = next(iter(at.most_promising(1)), None)
            if best is None:
                return
            others = [each for each in beside(best.choice, all_choices) if each not in looked_at]
            if not others:
                return
            looked_at.update({best.choice, *others})
            requests = [self._request(each, best.design) for each in others]
            points = at.evaluated([each for each in requests if each.possible])
            chosen = self._by_promise((each for each in points if each is not None), at)
            at.lead(self._descent_from(each, at) for each in chosen[:MOST_PROMISING])

    def _request(self, choice: Choice, design: Design) -> Request:
        """A design evaluated by itself, as near as a choice allows."""
        variables = self.variables(choice)
        return Request(variables, variables.rounded(variables.values(design)), "ordinary")

    def _refined(self, at: Coordinator) -> None:
        """Descents on finer meshes, from the best of a few choices."""
        at.lead(
            self.fine_descent(each, self.goal).search()
            for each in at.most_promising(self.effort.refined)
        )

    def _front(self, at: Coordinator) -> None:
        """Descents from the best at other limits of the stress, on finer meshes."""
        best = at.best()
        if best is None or self.goal.quantity != "angle":
            return
        limits = [share * self.goal.most_stress_mpa for share in self.effort.front_limits]
        goals = [replace(self.goal, most_stress_mpa=limit) for limit in limits]
        at.lead(self.fine_descent(best, goal).search() for goal in goals)


def nearest_choice(design: Design, all_choices: Sequence[Choice]) -> Choice:
    """The choice that differs least from a design in its counts."""
    profile, p = design.profile(), design.bellows
    depth = 0.0 if design.indent is None else design.indent.depth
    wanted = (
        p.bubble_count,
        p.bubble_thickness / profile.line_width,
        p.tendon_thickness / profile.line_width,
        depth / profile.layer_height,
        float(p.chamber_fillet >= p.chamber_length / 2 - 1e-9),
    )

    def apart(choice: Choice) -> float:
        counts = (
            choice.bubbles,
            choice.bubble_lines,
            choice.tendon_lines,
            choice.indent_layers,
            float(choice.full_round),
        )
        return sum(abs(one - other) for one, other in zip(wanted, counts, strict=True))

    return min(all_choices, key=apart)


def beside(choice: Choice, all_choices: Sequence[Choice]) -> tuple[Choice, ...]:
    """Choices that differ in one count: a bubble or a line more or less, an indent or none."""
    found = []
    for other in all_choices:
        differing = [
            (getattr(choice, name), getattr(other, name))
            for name in Choice.__dataclass_fields__
            if getattr(choice, name) != getattr(other, name)
        ]
        steps = [abs(one - another) for one, another in differing]
        indent = choice.indent_layers != other.indent_layers
        if len(differing) == 1 and (indent or steps[0] == 1):
            found.append(other)
    return tuple(found)
