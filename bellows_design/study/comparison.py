"""Every design of the paper as we compute it, beside its printed results."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

from bellows_design.budget import DEFAULT, Budget
from bellows_design.progress import SILENCE, Progress
from bellows_design.study.accounts import ACCOUNTS
from bellows_design.study.changes import Changes, change
from bellows_design.study.paper import DOI, TABLE_4, Result

if TYPE_CHECKING:
    from bellows_design.analysis.evaluation import Evaluation
    from bellows_design.store import Store

ANGLE_PERCENT, ANGLE_DEG = 7.0, 10.0
"""An angle agrees within the larger of both: the paper's look read off to 5 or 10°."""

CHANGE_OF_ANGLE, CHANGE_OF_STRESS = 4.0, 5.0
"""%. From these changes on, as the paper prints them, ours must have their sign."""


@dataclass(frozen=True)
class Row:
    """A design of the paper: what it printed and what we compute.

    ``changes`` are against ``reference``, our Prototype 1; ``seconds`` as the evaluation took when
    it was computed.
    """

    result: Result
    evaluation: Evaluation
    reference: Evaluation

    @property
    def changes(self) -> Changes:
        """Ours."""
        return Changes.between(self.evaluation, self.reference)

    @property
    def angle_off_percent(self) -> float:
        """Our angle against the paper's, %."""
        return change(self.evaluation.bending_angle_deg, self.result.bending_angle_deg)

    @property
    def stress_off_percent(self) -> float:
        """Our highest stress against the paper's, %."""
        return change(self.evaluation.max_von_mises_mpa, self.result.max_stress_mpa)

    @property
    def angle_agrees(self) -> bool:
        """Within 7 % or 10° of the paper's, whichever is larger."""
        printed = self.result.bending_angle_deg
        most = max(ANGLE_DEG, ANGLE_PERCENT / 100 * printed)
        return abs(self.evaluation.bending_angle_deg - printed) <= most

    @property
    def signs_agree(self) -> bool:
        """Changes have the paper's signs, where it prints more than 4 % of angle, 5 % of stress."""
        ours, theirs = self.changes, self.result
        return _same_sign(
            ours.bending_angle_percent, theirs.angle_change_percent, CHANGE_OF_ANGLE
        ) and _same_sign(ours.max_von_mises_percent, theirs.stress_change_percent, CHANGE_OF_STRESS)

    @property
    def agrees(self) -> bool:
        """Angle and signs do."""
        return self.angle_agrees and self.signs_agree

    @property
    def account(self) -> str:
        """Why it does not agree; empty where it does, or where nobody knows."""
        return "" if self.agrees else ACCOUNTS.get(self.result.label, "")

    def to_dict(self) -> dict[str, Any]:
        """Plain values for JSON; docs/json.md says what they mean."""
        ours, printed = self.evaluation, self.result
        return {
            "design": printed.label,
            "base": printed.design,
            "overrides": list(printed.overrides),
            "digest": ours.design.digest,
            "converged": ours.converged,
            "bending_angle_deg": ours.bending_angle_deg,
            "max_von_mises_mpa": ours.max_von_mises_mpa,
            "error_estimate": asdict(ours.error_estimate),
            "changes": asdict(self.changes),
            "paper": {
                "bending_angle_deg": printed.bending_angle_deg,
                "max_von_mises_mpa": printed.max_stress_mpa,
                "changes": asdict(
                    Changes(printed.angle_change_percent, printed.stress_change_percent)
                ),
            },
            "off": asdict(Changes(self.angle_off_percent, self.stress_off_percent)),
            "angle_agrees": self.angle_agrees,
            "signs_agree": self.signs_agree,
            "account": self.account,
            "seconds": ours.seconds.total,
            "from_cache": ours.from_cache or None,
        }


@dataclass(frozen=True)
class Comparison:
    """All rows, Prototype 1 first."""

    rows: tuple[Row, ...]

    @property
    def converged(self) -> bool:
        """True if every design reached its pressure."""
        return all(row.evaluation.converged for row in self.rows)

    def to_dict(self) -> dict[str, Any]:
        """Plain values for JSON; docs/json.md says what they mean."""
        return {
            "doi": DOI,
            "converged": self.converged,
            "rows": [row.to_dict() for row in self.rows],
            "seconds": sum(row.evaluation.seconds.total for row in self.rows),
        }


def compared(
    progress: Progress = SILENCE,
    store: Store | None = None,
    results: Sequence[Result] = TABLE_4,
    budget: Budget = DEFAULT,
) -> Comparison:
    """Evaluate ``results``, the first of which is what changes are against.

    Args:
        progress: Listens to stages and load.
        store: Where evaluations are looked for and kept.
        results: Designs of the paper.
        budget: Limits of each evaluation.

    Raises:
        BellowsError, MeshingError: As the evaluation.
    """
    from bellows_design.store import evaluated

    evaluations = []
    for number, result in enumerate(results, 1):
        progress.note(f"design {number} of {len(results)}: {result.label}")
        evaluations.append(evaluated(result.build(), progress=progress, budget=budget, store=store))
    reference = evaluations[0]
    rows = (Row(*pair, reference) for pair in zip(results, evaluations, strict=True))
    return Comparison(tuple(rows))


def _same_sign(ours: float, theirs: float, threshold: float) -> bool:
    return abs(theirs) <= threshold or ours * theirs > 0
