"""Previews by continuation: ordinary evaluations, and the designs that were reached from them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from bellows_design.analysis.models import UNIT_CELL
from bellows_design.design.design import Design
from bellows_design.errors import BellowsError
from bellows_design.neighbours.bubbles import counts_alike, of_count, with_bubbles
from bellows_design.neighbours.distance import distance
from bellows_design.neighbours.neighbourhood import Neighbourhood
from bellows_design.studio.tasks.reporting import Report
from solver.errors import SolverError

if TYPE_CHECKING:
    from bellows_design.analysis.evaluation import Evaluation
    from bellows_design.neighbours.record import NeighbourEvaluation

MOST = 4
"""Evaluations that are started from; each holds the factors of two tangents."""

FAR = 0.6
"""Distance up to which a preview is continued; see docs/studio.md for what it is off by there."""


@dataclass(frozen=True)
class Found:
    """A preview, and how it was found."""

    state: NeighbourEvaluation
    how: str


class Anchors:
    """The evaluations that previews start from, the last used ones last."""

    def __init__(self) -> None:
        self._all: list[Neighbourhood] = []

    def add(self, found: Evaluation, report: Report) -> None:
        """Start from an ordinary evaluation too, if it can be started from."""
        known = any(each.anchor.design.digest == found.design.digest for each in self._all)
        try:
            if not known:
                report.require_wanted()
                self._all = [*self._all, Neighbourhood(found)][-MOST:]
        except BellowsError:  # of a state that was not reached, nothing is continued
            return

    def nearest(self, design: Design) -> Neighbourhood | None:
        """That of the least distance, whatever faces its body has; None without any."""
        return min(self._all, key=lambda each: distance(each.anchor.design, design), default=None)

    def continued(self, design: Design, report: Report) -> Found | None:
        """The preview from the nearest evaluation; None if it cannot be reached from any."""
        reachable = sorted(
            (apart, index, near)
            for index, near in enumerate(self._all)
            if (apart := self._apart(near, design)) <= FAR
        )
        for apart, _, near in reachable:
            report.require_wanted()
            try:
                return self._found(near, design, apart, report)
            except (BellowsError, SolverError):
                continue
        return None

    def _apart(self, near: Neighbourhood, design: Design) -> float:
        alike = _alike(near, design)
        return float("inf") if alike is None else near.distance(alike)

    def _found(
        self, near: Neighbourhood, design: Design, apart: float, report: Report
    ) -> Found:
        alike = _alike(near, design)
        assert alike is not None
        found = near.continued(alike, report, reach=FAR)
        self._all = [*(each for each in self._all if each is not near), near]
        return Found(with_bubbles(found, design), _how(near, design, apart))


def _alike(near: Neighbourhood, design: Design) -> Design | None:
    """The design with the bubbles of a neighbourhood's; None if they are not comparable."""
    count = near.anchor.design.bellows.bubble_count
    if design.bellows.bubble_count == count:
        return design
    if near.anchor.model is not UNIT_CELL or not counts_alike(design, count):
        return None
    return of_count(design, count)


def _how(near: Neighbourhood, design: Design, apart: float) -> str:
    before = near.anchor.design
    sentence = f"continued from an evaluated design, {100 * apart:.2g} % away"
    count = design.bellows.bubble_count
    if count == before.bellows.bubble_count:
        return sentence
    return f"{sentence}; {count} of its bubbles instead of {before.bellows.bubble_count}"
