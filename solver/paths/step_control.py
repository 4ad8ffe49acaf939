"""Steps along a path to a given end: longer after a success, cut after a failure.

For paths whose position is prescribed, a load or a volume. The arc-length method, which has no
given end, controls its lengths by the number of Newton iterations.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Generic, Protocol, TypeVar

from solver.nonlinear.options import SolverOptions
from solver.results.solution import PathPoint


class Outcome(Protocol):
    """Result of a step: an equilibrium, or why there is none."""

    @property
    def failure(self) -> str: ...


Found = TypeVar("Found", bound=Outcome)


@dataclass(frozen=True)
class Segment(Generic[Found]):
    """A part of a path.

    ``reached``: the equilibrium at its end, ``position``: the load or volume there, ``step``:
    length of the next step, ``points``: those on it without its start, ``failure``: why it stopped,
    ``refused``: the step that failed last.
    """

    reached: Found
    position: float
    step: float
    points: tuple[PathPoint, ...] = ()
    failure: str = ""
    refused: Found | None = None


class Stepper(Protocol[Found]):
    """Steps for ``follow``."""

    def attempt(self, segment: Segment[Found], target: float) -> Found:
        """The equilibrium at ``target``, or why there is none."""

    def accepted(self, segment: Segment[Found]) -> Segment[Found]:
        """The segment after a successful step, with a point for its end."""

    def refused(self, segment: Segment[Found], refusals: int) -> Segment[Found]:
        """The segment to try a shorter step from, after so many failures at its end."""

    def exhausted(self) -> str:
        """Why no further step may be tried; empty if one may."""


@dataclass(frozen=True)
class StepControl:
    """After a success a step may grow by ``growth``; after a failure it is ``cut`` times as long.

    The path stops where a step would be shorter than ``smallest``; that is less by as much as the
    position is below ``scale``, so that a path which ends far below its goal is resolved too.
    """

    growth: float
    cut: float
    smallest: float
    scale: float = 0.0

    @staticmethod
    def of_loads(options: SolverOptions) -> StepControl:
        """For steps of the load, a fraction of the whole one."""
        return StepControl(options.growth, options.cut, options.smallest_step, RESOLVED_FROM)

    def smallest_at(self, position: float) -> float:
        """Shortest step from there."""
        if not self.scale:
            return self.smallest
        return self.smallest * min(1.0, max(abs(position) / self.scale, LEAST_SCALE))


RESOLVED_FROM = 0.2
"""Fraction of the load below which the smallest step is in proportion to the load reached: a limit
point at a thousandth of the load is found too."""

LEAST_SCALE = 1e-6
"""A path that ends at less than this fraction of its ``scale`` is not resolved."""


def follow(
    stepper: Stepper[Found], segment: Segment[Found], end: float, control: StepControl
) -> Segment[Found]:
    """Steps from a segment's end up or down to ``end``, as far as they succeed."""
    refusals = 0
    while segment.position != end:
        if reason := stepper.exhausted():
            return replace(segment, failure=reason)
        target = _next_position(segment.position, end, segment.step)
        taken = abs(target - segment.position)
        found = stepper.attempt(segment, target)
        if not found.failure:
            step = max(segment.step, control.growth * taken)
            segment = stepper.accepted(Segment(found, target, step, segment.points))
            refusals = 0
            continue
        segment = replace(segment, step=control.cut * taken, refused=found)
        if segment.step < control.smallest_at(segment.position):
            return replace(segment, failure=found.failure)
        refusals += 1
        segment = stepper.refused(segment, refusals)
    return segment


def _next_position(position: float, end: float, step: float) -> float:
    """``step`` further towards ``end``, or the end itself if it is no further away."""
    if abs(end - position) <= step * (1 + 1e-9):
        return end
    return position + math.copysign(step, end - position)
