"""The outcome of a run as text for people."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from rich.console import RenderableType
from rich.text import Text

from bellows_design.reports.check import check_table
from bellows_design.reports.evaluation import evaluation_table

if TYPE_CHECKING:
    from bellows_design.approval import Verdict
    from bellows_design.pipeline import Outcome


def outcome_table(outcome: Outcome) -> Sequence[RenderableType]:
    """Check, evaluation, and the verdict with its reasons."""
    return [
        *check_table(outcome.design, outcome.report),
        *evaluation_table(outcome.evaluation),
        *_verdict(outcome),
    ]


def _verdict(outcome: Outcome) -> list[RenderableType]:
    return [*_not_judged(outcome.verdict), *_decision(outcome)]


def _not_judged(verdict: Verdict) -> list[RenderableType]:
    """What the verdict says nothing about."""
    return [Text(f"not judged: {rule.rule}, as {rule.why}") for rule in verdict.not_judged]


def _decision(outcome: Outcome) -> list[RenderableType]:
    if outcome.verdict.approved:
        return [Text(f"APPROVED: {outcome.folder}", style="bold green")]
    lines: list[RenderableType] = [Text(f"REFUSED: {outcome.design.name}", style="bold red")]
    lines += [f"  - {reason.rule}: {reason.message}" for reason in outcome.verdict.reasons]
    if outcome.withdrawn is not None:
        lines.append(f"The earlier export {outcome.withdrawn} was withdrawn.")
    return lines
