"""Indents that were tried, and which of them no other betters."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

from bellows_design.study.changes import Changes
from bellows_design.study.indent.kinds import numbers

if TYPE_CHECKING:
    from bellows_design.analysis.error_estimate import ErrorEstimate
    from bellows_design.analysis.evaluation import LoadedState
    from bellows_design.design.design import Design
    from bellows_design.design.indent import Indent


@dataclass(frozen=True)
class Trial:
    """A design with an indent, and what it changes against the design without.

    ``how``: ``spread`` over the room, a ``step`` from a neighbour, or ``found``. All but steps are
    ordinary evaluations.
    """

    indent: Indent | None
    how: str
    bending_angle_deg: float
    max_von_mises_mpa: float
    error_estimate: ErrorEstimate
    changes: Changes

    @staticmethod
    def of(design: Design, state: LoadedState, plain: LoadedState, how: str) -> Trial:
        """From the state of a design and that of the design without indent."""
        return Trial(
            design.indent,
            how,
            state.bending_angle_deg,
            state.max_von_mises_mpa,
            state.error_estimate,
            Changes.between(state, plain),
        )

    @property
    def label(self) -> str:
        """The indent in a few words."""
        indent = self.indent
        if indent is None:
            return "none"
        fillet = f", fillet {indent.fillet:.2f}" if indent.shape == "rectangular" else ""
        return f"{indent.shape}, {indent.side}, {indent.depth:.2f} × {indent.width:.2f}{fillet}"

    @property
    def summary(self) -> str:
        """Indent and changes in one line."""
        changes = self.changes
        return (
            f"{self.label}: angle {changes.bending_angle_percent:+.1f} %, "
            f"stress {changes.max_von_mises_percent:+.1f} %"
        )

    def to_dict(self) -> dict[str, Any]:
        """Plain values for JSON; docs/json.md says what they mean."""
        return {
            "indent": numbers(self.indent),
            "how": self.how,
            "bending_angle_deg": self.bending_angle_deg,
            "max_von_mises_mpa": self.max_von_mises_mpa,
            "error_estimate": asdict(self.error_estimate),
            "changes": asdict(self.changes),
        }


def front(trials: Sequence[Trial]) -> tuple[Trial, ...]:
    """Those that no other betters in both more angle and less stress, by ascending angle."""
    best: list[Trial] = []
    for trial in sorted(trials, key=_most_angle_first):
        if not best or trial.changes.max_von_mises_percent < best[-1].changes.max_von_mises_percent:
            best.append(trial)
    return tuple(reversed(best))


def _most_angle_first(trial: Trial) -> tuple[float, float]:
    return -trial.changes.bending_angle_percent, trial.changes.max_von_mises_percent
