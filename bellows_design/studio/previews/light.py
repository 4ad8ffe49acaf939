"""Designs near to an evaluated one on its coarsest mesh: a fifth of the time of its finest.

What the finer meshes changed at the evaluated design is taken over in proportion, the ends as they
are. A coarse mesh alone is a start as well: it takes over what was found for another design.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from bellows_design.analysis.error_estimate import ErrorEstimate
from bellows_design.analysis.models import UNIT_CELL
from bellows_design.design.design import Design
from bellows_design.neighbours.bubbles import counts_alike, of_count, with_bubbles
from bellows_design.neighbours.carried import ANGLE_GROWTH, STRESS_GROWTH, Carried
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
"""By how much the estimated error of the stress grows over a distance, as a fraction of the value,
for taking over what the finer meshes changed. Of the angle they change little, and alike: what is
added for a neighbour on the finest mesh holds that too (`tests/benchmarks/preview_errors.py`)."""


@dataclass(frozen=True)
class TakenOver:
    """What a coarse mesh of the cell lacks, as it was found for another design.

    ``rotation``, ``volume`` and ``stress`` are the finest mesh's over the coarsest's; ``ends`` what
    root and tip add; ``errors`` of the design that is started from, None where they are carried.
    """

    rotation: float
    volume: float
    stress: float
    ends: Carried
    errors: ErrorEstimate | None = None

    @staticmethod
    def of(anchor: Evaluation, coarse: NeighbourEvaluation, ends: Carried) -> TakenOver:
        """From an ordinary evaluation and the same design on its coarsest mesh."""
        exact, rough = anchor.computation.finest.path[-1], coarse.solution.path[-1]
        return TakenOver(
            _ratio(exact.rotation, rough.rotation),
            _ratio(exact.volume, rough.volume),
            _ratio(anchor.max_von_mises_mpa, coarse.max_von_mises_mpa / ends.stress),
            replace(ends, stress=1.0),
        )


class LightNeighbourhood:
    """A neighbourhood of an evaluation on its coarsest mesh."""

    def __init__(
        self, anchor: Evaluation, taken_over: TakenOver | None = None, provisional: bool = False
    ) -> None:
        """``provisional``: of a coarse mesh alone; then what it lacks must be given.

        Raises ``DesignError`` if the evaluation did not reach its pressure, or is void.
        """
        self.anchor, self.provisional = anchor, provisional
        computation = replace(anchor.computation, solved=anchor.computation.solved[:1])
        self._near = Neighbourhood(replace(anchor, computation=computation))
        self._own = Carried.of(self._near.anchor)
        self.taken_over = taken_over or self._measured()
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
        return with_bubbles(self._completed(found), design)

    def surface(self, found: NeighbourEvaluation) -> SurfaceFrames:
        """The whole finger at rest and deformed."""
        count = found.design.bellows.bubble_count
        if count not in self._assemblies:
            from bellows_design.deformed import Assembly

            near = self._near.anchor
            counted = replace(near, design=of_count(near.design, count))
            self._assemblies[count] = Assembly.of(counted)
        assembly = self._assemblies[count]
        return assembly.surface(replace(found, anchor=assembly.anchor))

    def _measured(self) -> TakenOver:
        """The coarsest mesh's own solution is a rough one: it is solved again."""
        coarse = self._near.continued(self.anchor.design)
        return TakenOver.of(self.anchor, coarse, self._own)

    def _completed(self, found: NeighbourEvaluation) -> NeighbourEvaluation:
        """With what finer meshes and ends make of it."""
        more, own = self.taken_over, self._own
        cells, air = found.bending_angle_deg - own.angle, found.cavity_volume_mm3 - own.volume
        return replace(
            found,
            bending_angle_deg=more.rotation * cells + more.ends.angle,
            cavity_volume_mm3=more.volume * air + more.ends.volume,
            max_von_mises_mpa=more.stress * found.max_von_mises_mpa / own.stress,
            error_estimate=self._errors(found),
        )

    def _errors(self, found: NeighbourEvaluation) -> ErrorEstimate:
        errors, given = found.error_estimate, self.taken_over.errors
        far = 100 * found.distance
        angle, stress = errors.bending_angle_percent, errors.max_von_mises_percent
        if given is not None:
            angle = _more(given.bending_angle_percent, ANGLE_GROWTH * far)
            stress = _more(given.max_von_mises_percent, STRESS_GROWTH * far)
        return ErrorEstimate(angle, _more(stress, COARSE_GROWTH * far))

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


def _more(percent: float | None, more: float) -> float | None:
    return None if percent is None else percent + more
