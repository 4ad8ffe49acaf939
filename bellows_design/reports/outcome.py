"""The outcome of a run as text for people."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from rich.console import RenderableType
from rich.text import Text

from bellows_design.reports.check import check_table
from bellows_design.reports.evaluation import evaluation_table
from bellows_design.reports.force.tables import force_tables

if TYPE_CHECKING:
    from bellows_design.approval import Verdict
    from bellows_design.force.result import SceneResult
    from bellows_design.leak_test.record import LeakTest
    from bellows_design.pipeline import Outcome


def outcome_table(outcome: Outcome) -> Sequence[RenderableType]:
    """Check, evaluation, leak test, and the verdict with its reasons."""
    return [
        *check_table(outcome.design, outcome.report),
        *(() if outcome.evaluation is None else evaluation_table(outcome.evaluation)),
        *_scenes(outcome.scenes),
        *_leak_test(outcome.leak_test),
        *_verdict(outcome),
    ]


def _scenes(results: Sequence[SceneResult]) -> list[RenderableType]:
    """The force in each of the scenes that approval must hold."""
    tables: list[RenderableType] = []
    for each in results:
        if each.found is None:
            tables.append(Text(f"scene {each.scene}: {each.failure}", style="bold red"))
        else:
            tables += force_tables(each.found)
    return tables


def _leak_test(test: LeakTest) -> list[RenderableType]:
    """With what it was made, and each of its rules."""
    if test.outcome is None:
        return []
    made = f"leak test with {test.outcome.slicer} {test.outcome.version}: {test.result}"
    return ["", *(f"{rule.verdict}: {rule.message}" for rule in test.rules), made]


def _verdict(outcome: Outcome) -> list[RenderableType]:
    return [*_not_judged(outcome.verdict), *_decision(outcome)]


def _not_judged(verdict: Verdict) -> list[RenderableType]:
    """What the verdict says nothing about."""
    return [Text(f"not judged: {rule.rule}, as {rule.why}") for rule in verdict.not_judged]


def _decision(outcome: Outcome) -> list[RenderableType]:
    if outcome.verdict.approved:
        told = [] if outcome.page is None else [Text(f"report: {outcome.page}")]
        told += [Text(f"no report: {outcome.no_page}", "yellow")] if outcome.no_page else []
        return [*told, Text(f"APPROVED: {outcome.folder}", style="bold green")]
    lines: list[RenderableType] = [Text(f"REFUSED: {outcome.design.name}", style="bold red")]
    lines += [f"  - {reason.rule}: {reason.message}" for reason in outcome.verdict.reasons]
    if outcome.withdrawn is not None:
        lines.append(f"The earlier export {outcome.withdrawn} was withdrawn.")
    return lines
