"""What a sweep has found, as text for people."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from rich.box import SIMPLE
from rich.console import RenderableType
from rich.table import Table
from rich.text import Text

if TYPE_CHECKING:
    from bellows_design.batch.answer import Answer
    from bellows_design.batch.results import Results
    from bellows_design.study.sweep.plan import Plan
    from bellows_design.study.sweep.run import Outcome

MOST_REASONS = 5


def sweep_tables(plan: Plan, results: Results, outcome: Outcome) -> Sequence[RenderableType]:
    """Counts and speed, the ranges of angle and stress, and why designs failed."""
    answers = list(results.answers())
    table = Table(box=SIMPLE, show_header=False)
    for name, value in _counts(outcome, answers):
        table.add_row(name, Text(value))
    for name, value in _ranges([each for each in answers if each.done]):
        table.add_row(name, Text(value))
    return [table, *(Text(line) for line in _reasons(answers))]


def _counts(outcome: Outcome, answers: Sequence[Answer]) -> Iterator[tuple[str, str]]:
    neighbours = sum(each.origin == "neighbour" for each in answers)
    yield "designs", str(outcome.designs)
    yield "done", f"{outcome.done}, {neighbours} of them from a neighbour"
    yield "failed", str(outcome.failed)
    if outcome.impossible:
        yield "no design", f"{outcome.impossible}, as their numbers do not fit together"
    if outcome.per_minute is not None:
        rate = f"{outcome.asked} in {outcome.seconds:.0f} s, {outcome.per_minute:.3g} a minute"
        yield "this run", f"{rate}, {outcome.workers} at work"


def _ranges(done: Sequence[Answer]) -> Iterator[tuple[str, str]]:
    angles = [each.bending_angle_deg for each in done if each.bending_angle_deg is not None]
    stresses = [each.max_von_mises_mpa for each in done if each.max_von_mises_mpa is not None]
    if angles and stresses:
        yield "bending angle", f"{min(angles):.0f}° … {max(angles):.0f}°"
        yield "highest stress", f"{min(stresses):.2f} … {max(stresses):.2f} MPa"


def _reasons(answers: Sequence[Answer]) -> Iterator[str]:
    """The most frequent reasons of failures."""
    reasons = Counter(each.reason for each in answers if not each.done)
    for reason, count in reasons.most_common(MOST_REASONS):
        yield f"{count} failed: {reason}"
    if len(reasons) > MOST_REASONS:
        yield f"and for {len(reasons) - MOST_REASONS} other reasons, which the file has."
