"""All that a report shows: what a run found out, and what is computed for the report alone."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from bellows_design.errors import BellowsError

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from bellows_design.analysis.evaluation import Evaluation
    from bellows_design.deformed.surface import SurfaceFrames
    from bellows_design.force.result import SceneResult
    from bellows_design.neighbours.sensitivities import Sensitivities
    from bellows_design.pipeline import Outcome
    from bellows_design.progress import Progress

LEFT_OUT = "they were left out; bellows report without --no-sensitivities computes them"
"""Why there are no sensitivities, as the end of a sentence."""

FRAMES, FEW_FRAMES = 11, 6
"""Of the deformed actuator, from rest to the pressure reached; few where time counts, as each takes
about as long as a load step."""


@dataclass(frozen=True)
class Findings:
    """What a report is made of.

    Attributes:
        outcome: What a run, or an examination, found out.
        sensitivities: Those of the evaluation, or why there are none.
        deformed: The surface of the whole actuator along its load path, or why there is none.
        further: Force in scenes beside those of the outcome.
        files: Name -> SHA-256 and bytes of the files beside the report; empty without an export.
    """

    outcome: Outcome
    sensitivities: Sensitivities | str = LEFT_OUT
    deformed: SurfaceFrames | str = "it was left out"
    further: tuple[SceneResult, ...] = ()
    files: Mapping[str, Mapping[str, object]] = field(default_factory=dict)


def findings_of(
    outcome: Outcome,
    derivatives: bool = True,
    further: Sequence[SceneResult] = (),
    progress: Progress | None = None,
    frames: int = FRAMES,
) -> Findings:
    """What a report on ``outcome`` shows; what cannot be computed says why.

    Args:
        outcome: Of a run or an examination.
        derivatives: Whether sensitivities are computed.
        further: Scenes beside those of the outcome.
        progress: Listens to stages.
        frames: Of the deformed actuator.
    """
    from bellows_design.progress import SILENCE

    tell = SILENCE if progress is None else progress
    found = Findings(outcome, further=tuple(further))
    evaluation = outcome.evaluation
    if evaluation is None:
        why = "the design was refused before it was evaluated"
        return replace(found, sensitivities=why, deformed=why)
    tell.stage("shapes along the path")
    found = replace(found, deformed=deformed_of(evaluation, frames))
    if derivatives:
        tell.stage("sensitivities")
        found = replace(found, sensitivities=sensitivities_of(evaluation))
    return found


def sensitivities_of(found: Evaluation) -> Sensitivities | str:
    """Those of an evaluation, or why there are none, as the end of a sentence."""
    from bellows_design.neighbours.sensitivities import sensitivities
    from solver.errors import SolverError

    if not found.converged:
        return "the pressure was not reached"
    if found.contact.void:
        return "walls run through each other"
    try:
        return sensitivities(found)
    except (BellowsError, SolverError) as error:
        return str(error).rstrip(".")


def deformed_of(found: Evaluation, frames: int = FRAMES) -> SurfaceFrames | str:
    """The surface of the whole actuator along its path, or why there is none.

    On the coarsest mesh, whose path takes a second or two to follow once more; on the finest it
    would take longer than the evaluation did.
    """
    from bellows_design.deformed.frames import surface_frames
    from solver.errors import SolverError

    try:
        return surface_frames(found, frames, finest=False)
    except (BellowsError, SolverError) as error:
        return str(error).rstrip(".")
