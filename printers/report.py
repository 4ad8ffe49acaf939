"""The outcome of a printability check."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from dataclasses import asdict, dataclass, replace
from typing import Any, Literal

from printers.rule_table import Severity

Verdict = Literal["pass", "info", "warn", "fail"]

Point = tuple[float, float, float]
"""x, y, z in mm."""

DECIMALS = 6
"""Of a point: more are rounding."""

_NUMBERS = ("measured", "required", "uncertainty", "tolerance", "margin")


@dataclass(frozen=True)
class RuleResult:
    """One rule applied to one thing.

    Attributes:
        rule: Name of the rule.
        verdict: "fail" forbids printing, "warn" does not, "info" is good to know.
        measured: What the part has, in `unit`, or in words.
        required: What the printer needs, in `unit`, or in words.
        unit: Empty where there is none.
        where: The wall, gap or place (mm) the rule was applied to.
        message: One sentence for people.
        uncertainty: How far `measured` may lie from the truth, in `unit`: what the facets of the
            mesh may hide, and what the measurement itself may miss. 0 where it is exact, None
            where `measured` is a declared number or no number.
        tolerance: By how much `measured` may miss `required` and pass, in `unit`; None where the
            rule has no such allowance.
        margin: How far `measured` lies on the good side of `required`, in `unit`; it is negative
            in a result that passes within its tolerance. None where either is no number.
        severity: What it means on this printer not to keep the rule; None until it is
            stated.
        source: Where the rule and its limit come from.
        points: The places that `where` and `message` name as `place` writes them, mm, in the order
            in which they do; see `at`.

    Examples:
        >>> from printers import RuleResult
        >>> found = RuleResult("gap", "pass", 1.2, 0.4, "mm", "outside", "The gap stays open.")
        >>> print(found.measured, found.unit)
        1.2 mm
    """

    rule: str
    verdict: Verdict
    measured: float | int | str
    required: float | int | str
    unit: str
    where: str
    message: str
    uncertainty: float | None = None
    tolerance: float | None = None
    margin: float | None = None
    severity: Severity | None = None
    source: str = ""
    points: tuple[Point, ...] = ()

    def __post_init__(self) -> None:
        for name in _NUMBERS:
            value = getattr(self, name)
            if isinstance(value, float):
                object.__setattr__(self, name, value + 0.0)  # no negative zero

    def at(self, *points: Iterable[float]) -> RuleResult:
        """The result with those of the points that its words name."""
        words = f"{self.where} {self.message}"
        found = {each: words.find(place(each)) for each in map(point_of, points)}
        named = [each for each in found if found[each] >= 0]
        return replace(self, points=tuple(sorted(named, key=lambda each: found[each])))

    def moved(self, to: Callable[[Point], Point]) -> RuleResult:
        """The result in other coordinates, its points and the words that name them."""
        if not self.points:
            return self
        points = {each: point_of(to(each)) for each in self.points}
        words = {place(old): place(new) for old, new in points.items()}
        old = re.compile("|".join(map(re.escape, words)))

        def said(text: str) -> str:
            return old.sub(lambda found: words[found[0]], text)

        there = tuple(points.values())
        return replace(self, where=said(self.where), message=said(self.message), points=there)


@dataclass(frozen=True)
class PrintabilityReport:
    """All rules applied to one part for one printer; it fails as soon as one rule fails.

    Attributes:
        printer: Name of the printer's profile.
        rules: One result for every rule and thing it was applied to, always in the same order.

    Examples:
        >>> from printers import PrintabilityReport, RuleResult
        >>> found = RuleResult("wall", "fail", 0.4, 0.8, "mm", "side", "The wall is too thin.")
        >>> report = PrintabilityReport("prusa_i3", (found,))
        >>> print(report.verdict, [failure.where for failure in report.failures])
        fail ['side']
    """

    printer: str
    rules: tuple[RuleResult, ...]

    @property
    def verdict(self) -> Literal["pass", "fail"]:
        """Whether the part may be printed."""
        return "fail" if self.failures else "pass"

    @property
    def failures(self) -> tuple[RuleResult, ...]:
        """Results that forbid printing."""
        return tuple(result for result in self.rules if result.verdict == "fail")

    @property
    def warnings(self) -> tuple[RuleResult, ...]:
        """Results that decide nothing."""
        return tuple(result for result in self.rules if result.verdict == "warn")

    def to_dict(self) -> dict[str, Any]:
        """The report for JSON.

        Returns:
            Plain values: `printer`, `verdict` and the list `rules`.
        """
        return {
            "printer": self.printer,
            "verdict": self.verdict,
            "rules": [asdict(result) for result in self.rules],
        }


def pass_or_fail(holds: bool) -> Verdict:
    """The verdict of a rule that forbids printing where it does not hold."""
    return "pass" if holds else "fail"


def at_least(
    rule: str, measured: float, required: float, tolerance: float, where: str, message: str
) -> RuleResult:
    """The result of a rule that `measured` mm keep if they miss `required` mm by no more than the
    `tolerance`, which is also how far they may be off."""
    verdict = pass_or_fail(measured >= required - tolerance)
    margin = round(measured - required, 3)
    shown = round(measured, 3), round(required, 3)
    return RuleResult(rule, verdict, *shown, "mm", where, message, tolerance, tolerance, margin)


def against(measured: float, required: float, tolerance: float) -> str:
    """In words: how `measured` mm compare with the `required` mm, of which facets may take some."""
    off = measured - required
    if off >= 0:
        return f"{off:.3f} mm more than needed"
    if off >= -tolerance:
        return f"{-off:.3f} mm less than needed, within the {tolerance:g} mm that facets may take"
    return f"{-off:.3f} mm less than needed"


def point_of(values: Iterable[float]) -> Point:
    """Three numbers in mm as a point, without the digits that are rounding."""
    x, y, z = (round(float(value), DECIMALS) + 0.0 for value in values)
    return x, y, z


def place(point: Iterable[float]) -> str:
    """A point in mm as text, for `where` and `message`."""
    return "(" + ", ".join(f"{round(value, 1) + 0.0:.1f}" for value in point_of(point)) + ") mm"
