"""Previews by continuation: the ordinary evaluations that they start from."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass
from typing import TYPE_CHECKING

from bellows_design.design.design import Design
from bellows_design.errors import BellowsError
from bellows_design.neighbours.distance import distance
from bellows_design.studio.previews.light import FAR, LightNeighbourhood, TakenOver
from bellows_design.studio.workers.reporting import Report
from solver.errors import SolverError

if TYPE_CHECKING:
    from bellows_design.analysis.evaluation import Evaluation
    from bellows_design.neighbours.record import NeighbourEvaluation

MOST = 8
"""Evaluations that are started from; each holds the factors of two tangents of a coarse mesh."""


PROVISIONAL = 0.1
"""A coarse mesh alone counts as so much farther away."""


@dataclass(frozen=True)
class Found:
    """A preview, where it was continued from, and how in a sentence."""

    state: NeighbourEvaluation
    near: LightNeighbourhood
    how: str


class Anchors:
    """The evaluations that previews start from, the last used ones last."""

    def __init__(self) -> None:
        self._all: list[LightNeighbourhood] = []

    def add(self, found: Evaluation, report: Report) -> None:
        """Start from an ordinary evaluation too, if it can be started from."""
        same = [each for each in self._all if each.anchor.design.digest == found.design.digest]
        if any(not each.provisional for each in same):
            return
        report.require_wanted()
        with suppress(BellowsError, SolverError):  # not reached, or void: no start for others
            others = [each for each in self._all if each not in same]
            self._all = [*others, LightNeighbourhood(found)][-MOST:]

    def add_provisional(self, found: Evaluation, taken_over: TakenOver) -> None:
        """Start from a coarse mesh too, until its design is evaluated."""
        with suppress(BellowsError, SolverError):
            near = LightNeighbourhood(found, taken_over, provisional=True)
            self._all = [*self._all, near][-MOST:]

    def nearest(self, design: Design) -> LightNeighbourhood | None:
        """That of the least distance, whatever faces its body has; None without any."""
        return min(self._all, key=lambda each: distance(each.anchor.design, design), default=None)

    def continued(self, design: Design, report: Report) -> Found | None:
        """The preview from the nearest evaluation; None if it cannot be reached from there."""
        near = min(self._all, key=lambda each: _length(each, design), default=None)
        if near is None or near.distance(design) > FAR:
            return None
        report.require_wanted()
        try:
            state = near.found(design, report)
        except (BellowsError, SolverError):
            return None
        self._all = [*(each for each in self._all if each is not near), near]
        return Found(state, near, _how(near, design))


def _length(near: LightNeighbourhood, design: Design) -> float:
    """What is known of a design's meshes and ends is worth a longer way."""
    return near.distance(design) + (PROVISIONAL if near.provisional else 0.0)


def _how(near: LightNeighbourhood, design: Design) -> str:
    what = "a coarse mesh of a design" if near.provisional else "an evaluated design"
    far = near.distance(design)
    away = f", {100 * far:.2g} % away" if far else " with the same cell"
    sentence = f"continued from {what}{away}"
    count, before = design.bellows.bubble_count, near.anchor.design.bellows.bubble_count
    return sentence if count == before else f"{sentence}; {count} bubbles instead of {before}"
