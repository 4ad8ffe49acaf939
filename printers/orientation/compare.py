"""Which way to stand prints best: the same rules for each, the cheap ones first."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from printers.measure.part import MeasuredPart
from printers.model import PrintedModel
from printers.orientation.candidates import Stance, stances
from printers.orientation.turning import in_file, turned
from printers.profile import PrinterProfile
from printers.report import PrintabilityReport
from printers.rules.envelope import check_bed_contact, check_build_volume

Judge = Callable[[PrintedModel], PrintabilityReport]
"""All rules, applied to a part as it stands."""

CHEAP = (check_build_volume, check_bed_contact)


@dataclass(frozen=True)
class JudgedStance:
    """A way to stand, and what the rules say to it.

    Attributes:
        stance: The way.
        report: All rules, or, where one of the cheap ones fails, those alone; places in the
            coordinates of the file.
        is_whole: Whether all rules were applied.
        layers: Printed in it.
    """

    stance: Stance
    report: PrintabilityReport
    is_whole: bool
    layers: int

    @property
    def rank(self) -> tuple[int, int, int, float, float]:
        """Lower is better: rules that fail, rules that warn, then the height, as time goes."""
        failed, warned = len(self.report.failures), len(self.report.warnings)
        return (
            not self.is_whole,
            failed,
            warned,
            round(self.stance.height, 1),
            -self.stance.contact,
        )

    @property
    def reason(self) -> str:
        """What speaks against it, in a line."""
        against = [rule.message for rule in (*self.report.failures, *self.report.warnings)]
        return "; ".join(dict.fromkeys(against)) or "passes every rule"

    def to_dict(self) -> dict[str, Any]:
        """Plain values for JSON."""
        return {
            "up": self.stance.turning.name,
            "contact_mm2": self.stance.contact,
            "height_mm": self.stance.height,
            "layers": self.layers,
            "alike": self.stance.alike,
            "all_rules": self.is_whole,
            "failed": [rule.rule for rule in self.report.failures],
            "warned": [rule.rule for rule in self.report.warnings],
            "reason": self.reason,
        }


def compare_orientations(
    model: PrintedModel, profile: PrinterProfile, judge: Judge
) -> tuple[JudgedStance, ...]:
    """The ways a part can stand, the best first.

    Args:
        model: The part, as it stands in its file.
        profile: The printer.
        judge: Applies all rules; only asked where the part fits and holds on the bed.

    Returns:
        At most a dozen; as it stands in its file is always among them.
    """
    surface = MeasuredPart(model, profile).surface
    judged = [_judged(model, profile, judge, stance) for stance in stances(surface)]
    return tuple(sorted(judged, key=lambda each: each.rank))


def _judged(
    model: PrintedModel, profile: PrinterProfile, judge: Judge, stance: Stance
) -> JudgedStance:
    placed = turned(model, stance.turning)
    part = MeasuredPart(placed, profile)
    report = PrintabilityReport(profile.name, tuple(r for rule in CHEAP for r in rule(part)))
    holds = report.verdict == "pass"
    if holds:
        report = judge(placed)
    layers = max(1, round(stance.height / profile.layer_height))
    return JudgedStance(stance, in_file(report, model, stance.turning), holds, layers)
