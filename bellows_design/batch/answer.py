"""What was found for one design of many, as one row of plain values."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Literal

from bellows_design.neighbours.equilibrium import unusable

if TYPE_CHECKING:
    from bellows_design.analysis.evaluation import Evaluation
    from bellows_design.batch.question import Question
    from bellows_design.neighbours.record import NeighbourEvaluation
    from bellows_design.neighbours.sensitivities import Sensitivities

Derivatives = Mapping[str, Mapping[str, float]]
"""Of each response (° , mm³, MPa) by each parameter (mm or MPa): response -> parameter -> value."""


@dataclass(frozen=True, kw_only=True)
class Answer:
    """One design at its pressure, or why there is no result.

    Attributes:
        key: The question's.
        digest: The design's.
        status: ``done``; ``failed`` where there is no result, or none that holds.
        reason: Why it failed; empty if it did not.
        bending_angle_deg, bending_angle_error_percent: Angle and its estimated error.
        max_von_mises_mpa, max_von_mises_error_percent: Highest stress and its estimated error.
        cavity_volume_mm3: Air inside the deformed actuator.
        highest_strain: Largest principal strain, 1.
        smallest_gap_mm: Between walls that face each other outside; None if none do.
        warnings: Sentences on what makes the numbers less reliable than they look.
        origin: ``ordinary``, or ``neighbour`` if reached from another design.
        distance: From that design; 0 for an ordinary evaluation.
        fallback: Why no neighbour led to it; empty if one did, or none was asked for.
        factorizations: Of all solves.
        seconds: Time spent on it.
        derivatives: Where they were asked for.
    """

    key: str
    digest: str
    status: Literal["done", "failed"] = "done"
    reason: str = ""
    bending_angle_deg: float | None = None
    bending_angle_error_percent: float | None = None
    max_von_mises_mpa: float | None = None
    max_von_mises_error_percent: float | None = None
    cavity_volume_mm3: float | None = None
    highest_strain: float | None = None
    smallest_gap_mm: float | None = None
    warnings: tuple[str, ...] = ()
    origin: Literal["ordinary", "neighbour", ""] = ""
    distance: float = 0.0
    fallback: str = ""
    factorizations: int = 0
    seconds: float = 0.0
    derivatives: Derivatives | None = field(default=None, repr=False)

    @property
    def done(self) -> bool:
        """Whether there is a result."""
        return self.status == "done"


def failed(question: Question, reason: str, seconds: float = 0.0) -> Answer:
    """That a question has no answer, and why."""
    return Answer(
        key=question.key,
        digest=question.design.digest,
        status="failed",
        reason=reason,
        seconds=seconds,
    )


def answer_of(
    question: Question,
    found: Evaluation | NeighbourEvaluation,
    derivatives: Sensitivities | None,
    seconds: float,
) -> Answer:
    """The row of an evaluation; failed if it did not reach its pressure, or is void."""
    if reason := unusable(found):
        return failed(question, reason, seconds)
    errors = found.error_estimate
    fallback = getattr(found, "fallback", "")
    distance = getattr(found, "distance", 0.0)
    return Answer(
        key=question.key,
        digest=question.design.digest,
        bending_angle_deg=found.bending_angle_deg,
        bending_angle_error_percent=errors.bending_angle_percent,
        max_von_mises_mpa=found.max_von_mises_mpa,
        max_von_mises_error_percent=errors.max_von_mises_percent,
        cavity_volume_mm3=found.cavity_volume_mm3,
        highest_strain=found.strain.highest,
        smallest_gap_mm=found.contact.min_gap_mm,
        warnings=found.warnings,
        origin="ordinary" if found.ordinary or fallback else "neighbour",
        distance=distance,
        fallback=fallback,
        factorizations=found.solver.factorizations,
        seconds=seconds,
        derivatives=None if derivatives is None else _derivatives(derivatives),
    )


def _derivatives(found: Sensitivities) -> Derivatives:
    return {
        response: {each.parameter: each.derivatives[response] for each in found.parameters}
        for response in found.responses
    }
