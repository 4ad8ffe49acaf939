"""What stands on top of a report: the verdict, all its reasons, and the figures that matter."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from bellows_design.print_sheet.figures import figures_of
from bellows_design.reports.page.blocks import Fact, Head, Tone
from bellows_design.reports.page.wording import (
    capitalised,
    plus_minus,
    pressure_text,
)

if TYPE_CHECKING:
    from bellows_design.analysis.evaluation import Evaluation
    from bellows_design.approval import Reason, Verdict
    from bellows_design.pipeline import Outcome
    from bellows_design.reports.page.findings import Findings


def head(findings: Findings) -> Head:
    """Name, verdict and key figures."""
    found = findings.outcome
    word, tone, summary = _decision(found.verdict)
    return Head(
        name=found.design.name,
        description=found.design.description,
        verdict=word,
        tone=tone,
        summary=summary,
        reasons=tuple(map(_reason, found.verdict.reasons)),
        warnings=tuple(map(capitalised, found.verdict.warnings)),
        not_judged=tuple(Fact(rule.rule, rule.why) for rule in found.verdict.not_judged),
        figures=tuple(_figures(found)),
        digest=found.design.digest,
    )


def _decision(verdict: Verdict) -> tuple[str, Tone, str]:
    """One word, its colour, and a sentence."""
    if verdict.approved:
        return "Approved", "good", "Nothing that was judged speaks against printing and loading it."
    if verdict.undecided:
        return "Not decided", "warn", "Only the accuracy of the computation stands in the way."
    count = len(verdict.reasons)
    return "Refused", "bad", f"{count} reason{'s' if count > 1 else ''} against it."


def _reason(reason: Reason) -> Fact:
    return Fact(reason.rule, capitalised(reason.message), note=reason.kind, tone="bad")


def _figures(found: Outcome) -> Iterator[Fact]:
    """Angle and stress with their errors, the load, and what printing takes."""
    evaluation = found.evaluation
    if evaluation is None:
        yield Fact("Design pressure", pressure_text(found.design.load.pressure))
        yield Fact("Bending angle", "not computed", note="refused before the evaluation")
        return
    yield from _computed(found, evaluation)
    printed = figures_of(found, evaluation)
    x, y, z = printed.extents
    yield Fact("Mass", f"{printed.mass:.1f} g", note=f"{printed.filament_length:.2f} m of filament")
    yield Fact(
        "Print time", f"over {printed.least_hours:.1f} h", note="plastic alone, without travels"
    )
    size = " × ".join(f"{round(each, 1):g}" for each in (x, y, z))
    yield Fact("Size", size, note="mm, as it stands on the bed")


def _computed(found: Outcome, evaluation: Evaluation) -> Iterator[Fact]:
    error, limit = evaluation.error_estimate, found.design.max_von_mises
    angle, stress = evaluation.bending_angle_deg, evaluation.max_von_mises_mpa
    yield Fact(
        "Bending angle", f"{angle:.1f}°", plus_minus(angle, error.bending_angle_percent, "°")
    )
    percent = error.max_von_mises_percent or 0.0
    over = stress * (1 + percent / 100) > limit
    yield Fact(
        "Highest von Mises stress",
        f"{stress:.2f} MPa",
        plus_minus(stress, error.max_von_mises_percent, " MPa", 2),
        f"{100 * stress / limit:.0f} % of the limit, {limit:.4g}\u00a0MPa",
        "bad" if over else "",
    )
    reached = evaluation.pressure_mpa / found.design.load.pressure >= 1 - 1e-9
    note = "design pressure" if reached else f"of {pressure_text(found.design.load.pressure)} asked"
    yield Fact(
        "Pressure", pressure_text(evaluation.pressure_mpa), note=note, tone="" if reached else "bad"
    )
