"""Whether an optimum holds: its part, a finer mesh of the cell, and the half actuator.

A search goes by three meshes of a cell. What it found is decided upon as ``bellows run`` does, on
as many meshes as its limits need, but for the leak test, and compared with the half actuator, which
has its own ends.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from bellows_design.budget import DEFAULT, Budget
from bellows_design.design.design import Design
from bellows_design.progress import SILENCE, Progress
from bellows_design.study.optimize.goal import Goal

if TYPE_CHECKING:
    from bellows_design.analysis.evaluation import Evaluation, LoadedState
    from bellows_design.approval import Verdict
    from bellows_design.force.law.half_bubble import CellLaw
    from bellows_design.force.result import ForceCurve, SceneResult
    from printers import PrintabilityReport

ACCURACY_PERCENT = 2.0
"""The cell's meshes are refined to this estimated error of angle and stress, the least there is of
a stress, or as far as the budget allows."""


NOT_SLICED = "an optimisation slices nothing; bellows run does"
"""Why the leak test is not judged."""

HALF_PERCENT = 4.0
"""The same for the half actuator: on two meshes its stress is known to 10 %, on three to 3.5 %."""

HALF_MEMORY, HALF_SECONDS = 8.0, 900.0
"""GiB and s that the half actuator may take, if the machine has twice that memory: three meshes, of
some 110 000 tetrahedra."""


@dataclass(frozen=True)
class Verification:
    """What speaks for and against an optimum.

    Attributes:
        design: The design.
        goal: Whose limits it must keep.
        report: Printability of its part.
        cell: The usual model on finer meshes.
        verdict: By both.
        half: The half actuator; None if it was not asked for, or gave no result.
        failure: Why the half actuator gave no result; empty if it did, or was not asked for.
        force: Blocked at the design pressure, where the goal asks for a force; else None, and
            where there is no result.
    """

    design: Design
    goal: Goal
    report: PrintabilityReport
    cell: Evaluation
    verdict: Verdict
    half: Evaluation | None = None
    failure: str = ""
    force: ForceCurve | None = None

    @property
    def least_force_n(self) -> float:
        """What the blocked finger exerts, its estimated error deducted, N; 0 if unknown."""
        return exerted_at_least(self.force)

    @property
    def strong(self) -> bool:
        """Whether it exerts the force that the goal asks for."""
        return self.least_force_n >= (self.goal.least_force_n or 0.0)

    @property
    def stress_with_error_mpa(self) -> float:
        """Highest stress of any model that was solved, including its estimated error.

        Infinite where an error is unknown.
        """
        return max(_stress_with_error(each) for each in self._states)

    @property
    def holds(self) -> bool:
        """Whether it is approved, and keeps the goal's limits by every model, errors included."""
        kept = all(_keeps(each, self.goal) for each in self._states)
        return self.verdict.approved and not self.failure and kept and self.strong

    @property
    def _states(self) -> list[Evaluation]:
        return [each for each in (self.cell, self.half) if each is not None]

    def to_dict(self) -> dict[str, Any]:
        """Plain values for JSON."""
        return {
            "holds": self.holds,
            **self.verdict.to_dict(),
            "cell": _summary(self.cell),
            "half": None if self.half is None else _summary(self.half),
            "half_failure": self.failure or None,
            **self._force_dict(),
        }

    def _force_dict(self) -> dict[str, Any]:
        """The blocked force, where the goal asks for one."""
        if self.goal.least_force_n is None:
            return {}
        return {
            "force": None if self.force is None else self.force.summary(),
            "least_force_n": self.least_force_n,
        }


def verified(
    design: Design,
    goal: Goal,
    half: bool = True,
    progress: Progress = SILENCE,
    budget: Budget = DEFAULT,
) -> Verification:
    """Check the part, and evaluate the design on finer meshes.

    Args:
        design: What was found.
        goal: Whose limits it must keep.
        half: Also by the half actuator, which takes about a minute.
        progress: Listens to stages and load.
        budget: Of each evaluation.

    Raises:
        BellowsError, MeshingError: As checks and evaluations.
    """
    from bellows_design import pipeline
    from bellows_design.approval import open_question
    from bellows_design.evaluation import evaluate
    from bellows_design.force.required_scenes import required_scenes

    def question(state: LoadedState) -> str:
        return open_question(design, report, state)

    progress.stage(f"check of {design.name}")
    report = pipeline.check(design, pipeline.build_part(design))
    cell = evaluate(
        design,
        accuracy_percent=ACCURACY_PERCENT,
        progress=progress,
        budget=budget,
        open_question=question,
    )
    asked = cell.converged and (goal.least_force_n is not None or design.limits.scenes)
    law = law_of(design, progress, budget) if asked else None
    scenes = required_scenes(design, progress, budget, law=law) if cell.converged else ()
    found = Verification(design, goal, report, cell, verdict_of(design, report, cell, scenes))
    if goal.least_force_n is not None and law is not None:
        found = replace(found, force=blocked(design, progress, budget, law))
    return _with_half(found, progress, budget) if half else found


def law_of(
    design: Design, progress: Progress = SILENCE, budget: Budget = DEFAULT
) -> CellLaw | None:
    """The law that all scenes of a design share; None where there is none."""
    from bellows_design.force.law.cell_law import cell_law
    from bellows_design.force.required_scenes import FAILURES

    progress.stage(f"section's law of {design.name}")
    try:
        return cell_law(design, progress=progress, budget=budget)
    except FAILURES:
        return None


def blocked(
    design: Design,
    progress: Progress = SILENCE,
    budget: Budget = DEFAULT,
    law: CellLaw | None = None,
) -> ForceCurve | None:
    """What a design exerts on a load cell at its pressure; None where there is no result.

    ``law`` is that of its unit cell where it is at hand.
    """
    from bellows_design.design.scenes.blocked import Blocked
    from bellows_design.errors import BellowsError
    from bellows_design.force.curve import force_curve
    from solver.errors import MeshingError, SolverError

    progress.stage(f"blocked force of {design.name}")
    asked = (design, Blocked(), (design.load.pressure,), law)
    try:
        return force_curve(*asked, by_distance=False, progress=progress, budget=budget)
    except (BellowsError, SolverError, MeshingError):
        return None


def exerted_at_least(force: ForceCurve | None) -> float:
    """A force with its estimated error deducted, N; 0 where it is not known."""
    if force is None or not force.converged or force.last.error is None:
        return 0.0
    return force.last.force_n * (1 - force.last.error.total / 100)


def verdict_of(
    design: Design,
    report: PrintabilityReport,
    state: LoadedState,
    scenes: Sequence[SceneResult] = (),
) -> Verdict:
    """The verdict of a search, which slices nothing.

    The leak test is not judged, as the setting of the design says: one that requires it is not
    approved.
    """
    from bellows_design.approval import decide, with_leak_test
    from bellows_design.leak_test.record import SWITCHED_OFF, LeakTest

    setting = design.limits.leak_test
    why = SWITCHED_OFF if setting == "off" else NOT_SLICED
    return with_leak_test(decide(design, report, state, scenes), LeakTest(setting, why=why))


def _with_half(found: Verification, progress: Progress, budget: Budget) -> Verification:
    from bellows_design.errors import BellowsError
    from bellows_design.evaluation import evaluate
    from solver.errors import MeshingError, SolverError

    try:
        half = evaluate(
            found.design, "half", HALF_PERCENT, progress=progress, budget=_for_half(budget)
        )
    except (BellowsError, MeshingError, SolverError) as error:
        return replace(found, failure=str(error))
    if not half.converged:
        return replace(found, failure=half.message)
    return replace(found, half=half)


def _for_half(budget: Budget) -> Budget:
    """A budget that suffices for the half actuator, as far as the machine's memory allows."""
    from bellows_design.machine import memory_gib

    memory = min(HALF_MEMORY, (memory_gib() or 0.0) / 2)
    return replace(
        budget,
        memory=max(memory, budget.memory),
        seconds=max(HALF_SECONDS, budget.seconds),
    )


def _stress_with_error(state: Evaluation) -> float:
    percent = state.error_estimate.max_von_mises_percent
    return math.inf if percent is None else state.max_von_mises_mpa * (1 + percent / 100)


def _keeps(state: Evaluation, goal: Goal) -> bool:
    """Whether a state keeps a goal's limits, its stress with its own error."""
    strain, gap = goal.most_strain, state.contact.min_gap_mm
    touching = goal.least_gap_mm is not None and gap is not None and gap <= 0
    return (
        _stress_with_error(state) <= goal.most_stress_mpa
        and (goal.least_angle_deg or 0.0) <= state.bending_angle_deg
        and (strain is None or state.strain.highest <= strain)
        and not (touching and state.contact.detected)
    )


def _summary(found: Evaluation) -> dict[str, Any]:
    return {
        "bending_angle_deg": found.bending_angle_deg,
        "max_von_mises_mpa": found.max_von_mises_mpa,
        "error_estimate": {
            "bending_angle_percent": found.error_estimate.bending_angle_percent,
            "max_von_mises_percent": found.error_estimate.max_von_mises_percent,
        },
        "elements": found.mesh.elements,
        "converged": found.converged,
        "message": found.message,
        "contact": found.contact.detected,
        "min_gap_mm": found.contact.min_gap_mm,
        "seconds": found.seconds.to_dict(),
    }
