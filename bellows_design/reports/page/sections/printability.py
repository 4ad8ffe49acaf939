"""The rules of the printer: measured, required, margin, where; and where on the part."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from bellows_design.reports.page.blocks import (
    Block,
    Cell,
    Fact,
    Facts,
    Grid,
    Picture,
    Pictures,
    Section,
    Sentences,
)
from bellows_design.reports.page.places import marked_rules, place_drawings
from bellows_design.reports.page.wording import (
    TONES,
    capitalised,
    headings,
    number,
    shown,
    with_unit,
)

if TYPE_CHECKING:
    from bellows_design.reports.page.findings import Findings
    from printers.report import RuleResult

CAPTIONS = (
    "From the side, cut through the middle. Numbers are those of the table's last column.",
    "From above, cut at half the tendon's height.",
)

TITLES = ("", "rule", "measured", "required", "margin", "where", "mark")


def printability(findings: Findings) -> Section:
    """Verdict and orientation, pictures of the places, the table, and what did not pass."""
    return Section("printability", "Printability", tuple(_blocks(findings)))


def _blocks(findings: Findings) -> Iterator[Block]:
    found = findings.outcome
    report, marked = found.report, marked_rules(found.report.rules)
    yield Facts(tuple(_facts(findings)))
    against = [rule for rule in report.rules if _tells(rule)]
    for tone in ("bad", "warn", "info", "good"):
        texts = [_sentence(rule) for rule in against if TONES[rule.verdict] == tone]
        if texts:
            yield Sentences(tuple(texts), "" if tone == "good" else TONES[_verdict_of(tone)])
    if marked:
        pictures = place_drawings(found.design, found.part.mesh, marked)
        yield Pictures(tuple(map(Picture, pictures, CAPTIONS)))
    numbers = {id(rule): each.number for each in marked for rule in each.rules}
    rows = tuple(_row(rule, numbers.get(id(rule), 0)) for rule in report.rules)
    yield Grid(headings(*TITLES, right=("measured", "required", "margin", "mark")), rows)


def _verdict_of(tone: str) -> str:
    return next(verdict for verdict, its in TONES.items() if its == tone)


def _facts(findings: Findings) -> Iterator[Fact]:
    found = findings.outcome
    profile, report = found.design.profile(), found.report
    fails, warns = len(report.failures), len(report.warnings)
    verdict = f"{report.verdict}: {fails} of {len(report.rules)} results fail, {warns} warn"
    yield Fact("verdict", verdict, tone="bad" if fails else "good")
    yield Fact("printer", f"{profile.description} ({report.printer})")
    yield Fact(
        "orientation", "as designed: its flat lower side on the bed, z up; do not turn it over"
    )


def _tells(rule: RuleResult) -> bool:
    """Whether its sentence says more than its row: also of a pass that needed its tolerance."""
    return rule.verdict != "pass" or (rule.margin is not None and rule.margin < 0)


def _sentence(rule: RuleResult) -> str:
    return f"{rule.rule}: {capitalised(rule.message)}"


def _row(rule: RuleResult, mark: int) -> tuple[Cell, ...]:
    margin = "" if rule.margin is None else f"{rule.margin:+.3g} {rule.unit}".strip()
    uncertain = f" ± {rule.uncertainty:.2g}" if rule.uncertainty else ""
    return (
        Cell(rule.verdict, TONES[rule.verdict]),
        Cell(rule.rule),
        number(_measured(rule, uncertain)),
        number(shown(rule.required)),
        number(margin, "warn" if rule.margin is not None and rule.margin < 0 else ""),
        Cell(rule.where),
        number(str(mark) if mark else ""),
    )


def _measured(rule: RuleResult, uncertain: str) -> str:
    if isinstance(rule.measured, str):
        return with_unit(rule.measured, rule.unit)
    return f"{shown(rule.measured)}{uncertain} {rule.unit}".strip()
