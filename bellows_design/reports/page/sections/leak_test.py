"""The leak test on a slicer's G-code: its result, its rules, the layer in question."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from bellows_design.reports.page.blocks import (
    Block,
    Cell,
    Fact,
    Facts,
    Grid,
    Layers,
    Section,
    Sentences,
    Tone,
)
from bellows_design.reports.page.wording import (
    TONES,
    capitalised,
    headings,
    number,
    shown,
    with_unit,
)

if TYPE_CHECKING:
    from bellows_design.leak_test.record import LeakOutcome, LeakTest
    from bellows_design.reports.page.findings import Findings
    from printers.report import RuleResult

CAPTION = (
    "The beads as the slicer lays them down, layer by layer; marks are where the part leaks, or "
    "where its seal is thinnest."
)

TITLES = ("", "rule", "measured", "required", "where", "what it says")


def leak_test(findings: Findings) -> Section:
    """What became of the leak test."""
    return Section("leak-test", "Leak test on the G-code", tuple(_blocks(findings)))


def _blocks(findings: Findings) -> Iterator[Block]:
    test = findings.outcome.leak_test
    if test.outcome is None:
        yield Sentences((f"It was not run: {test.why}.",), "warn" if test.failed else "")
        return
    yield Facts(tuple(_facts(test, test.outcome)))
    if test.outcome.layers is not None:
        yield Layers(test.outcome.layers, CAPTION)
    right = ("measured", "required")
    yield Grid(headings(*TITLES, right=right), tuple(map(_row, test.rules)))
    notes = test.outcome.figures.get("notes", ())
    if notes:
        yield Sentences(tuple(capitalised(str(note)) for note in notes), "info")


def _facts(test: LeakTest, outcome: LeakOutcome) -> Iterator[Fact]:
    tones: dict[str, Tone] = {"pass": "good", "warn": "warn", "fail": "bad"}
    yield Fact("result", test.result, tone=tones.get(test.result, ""))
    yield Fact("sliced with", test.slicer or "", note=f"settings {outcome.profile_sha256[:16]}")
    yield Fact("time", f"{outcome.seconds:.1f} s")


def _row(rule: RuleResult) -> tuple[Cell, ...]:
    uncertain = f" ± {rule.uncertainty:.2g}" if rule.uncertainty else ""
    measured = with_unit(rule.measured, rule.unit)
    if not isinstance(rule.measured, str):
        measured = f"{shown(rule.measured)}{uncertain} {rule.unit}".strip()
    return (
        Cell(rule.verdict, TONES[rule.verdict]),
        Cell(rule.rule),
        number(measured),
        number(shown(rule.required)),
        Cell(rule.where),
        Cell(capitalised(rule.message)),
    )
