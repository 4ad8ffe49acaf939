"""Designs near to an evaluated one on its coarsest mesh: a fifth of the time of its finest.

What the finer meshes changed at the evaluated design is taken over in proportion.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from bellows_design.analysis.error_estimate import ErrorEstimate
from bellows_design.analysis.models import UNIT_CELL
from bellows_design.design.design import Design
from bellows_design.neighbours.bubbles import counts_alike, of_count, with_bubbles
from bellows_design.neighbours.carried import Carried
from bellows_design.neighbours.neighbourhood import Neighbourhood
from bellows_design.studio.workers.reporting import Report

if TYPE_CHECKING:
    from bellows_design.analysis.evaluation import Evaluation
    from bellows_design.deformed import Assembly, SurfaceFrames
    from bellows_design.neighbours.record import NeighbourEvaluation

FAR = 0.6
"""Distance up to which a preview is continued; docs/studio.md says what it is off by there."""

HALVINGS = 1
"""Of the way: where that does not suffice, a solve by itself is as fast."""

COARSE_GROWTH = 0.1
"""By how much the estimated error of angle and stress grows over a distance, as a fraction of the
value, for taking over what the finer meshes changed."""


@dataclass(frozen=True)
class Ratios:
    """What the finest mesh finds over what the coarsest finds, at the evaluated design."""

    rotation: float
    volume: float
    stress: float


class LightNeighbourhood:
    """A neighbourhood of an ordinary evaluation on its coarsest mesh."""

    def __init__(self, anchor: Evaluation) -> None:
        """Raises ``DesignError`` if the evaluation did not reach its pressure, or is void."""
        self.anchor = anchor
        computation = replace(anchor.computation, solved=anchor.computation.solved[:1])
        self._near = Neighbourhood(replace(anchor, computation=computation))
        self._carried = Carried.of(self._near.anchor)
        self._ratios = self._measured()
        self._assemblies: dict[int, Assembly] = {}

    def distance(self, design: Design) -> float:
        """How far a design is, whatever the number of its bubbles; infinite if no neighbour."""
        alike = self._alike(design)
        return float("inf") if alike is None else self._near.distance(alike)

    def found(self, design: Design, report: Report) -> NeighbourEvaluation:
        """The preview of a design. Raises ``BellowsError`` or ``SolverError``."""
        alike = self._alike(design)
        assert alike is not None
        found = self._near.continued(alike, report, reach=FAR, halvings=HALVINGS)
        return with_bubbles(self._refined(found), design)

    def surface(self, found: NeighbourEvaluation) -> SurfaceFrames:
        """The whole finger at rest and deformed."""
        count = found.design.bellows.bubble_count
        if count not in self._assemblies:
            from bellows_design.deformed import Assembly

            near = self._near.anchor
            counted = replace(near, design=of_count(near.design, count))
            self._assemblies[count] = Assembly.of(counted)
        return self._assemblies[count].surface(found)

    def _measured(self) -> Ratios:
        """The coarsest mesh's own solution is a rough one: it is solved again."""
        fine, anchor = self.anchor.computation, self.anchor
        coarse = self._near.continued(anchor.design)
        rough, exact = coarse.solution.path[-1], fine.finest.path[-1]
        return Ratios(
            _ratio(exact.rotation, rough.rotation),
            _ratio(exact.volume, rough.volume),
            _ratio(anchor.max_von_mises_mpa, coarse.max_von_mises_mpa),
        )

    def _refined(self, found: NeighbourEvaluation) -> NeighbourEvaluation:
        """With what finer meshes make of it."""
        carried, ratios = self._carried, self._ratios
        errors, grown = found.error_estimate, 100 * COARSE_GROWTH * found.distance
        cells, air = found.bending_angle_deg - carried.angle, found.cavity_volume_mm3
        return replace(
            found,
            bending_angle_deg=ratios.rotation * cells + carried.angle,
            cavity_volume_mm3=ratios.volume * (air - carried.volume) + carried.volume,
            max_von_mises_mpa=ratios.stress * found.max_von_mises_mpa,
            error_estimate=ErrorEstimate(
                _grown(errors.bending_angle_percent, grown),
                _grown(errors.max_von_mises_percent, grown),
            ),
        )

    def _alike(self, design: Design) -> Design | None:
        """The design with as many bubbles as the evaluated one; None if they are not comparable."""
        count = self.anchor.design.bellows.bubble_count
        if design.bellows.bubble_count == count:
            return design
        if self.anchor.model is not UNIT_CELL or not counts_alike(design, count):
            return None
        return of_count(design, count)


def _ratio(exact: float, rough: float) -> float:
    return exact / rough if rough else 1.0


def _grown(percent: float | None, more: float) -> float | None:
    return None if percent is None else percent + more
