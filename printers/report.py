"""The outcome of a printability check."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import asdict, dataclass
from typing import Any, Literal

Verdict = Literal["pass", "warn", "fail"]


@dataclass(frozen=True)
class RuleResult:
    """One rule applied to one thing.

    `rule` names the rule, `where` the wall, gap or place (mm) it was applied to; `measured` and
    `required` are in `unit`; `message` is one sentence for people.
    """

    rule: str
    verdict: Verdict
    measured: float | int | str
    required: float | int | str
    unit: str
    where: str
    message: str


@dataclass(frozen=True)
class PrintabilityReport:
    """All rules applied to one part for one printer; it fails as soon as one rule fails."""

    printer: str
    rules: tuple[RuleResult, ...]

    @property
    def verdict(self) -> Literal["pass", "fail"]:
        return "fail" if self.failures else "pass"

    @property
    def failures(self) -> tuple[RuleResult, ...]:
        return tuple(result for result in self.rules if result.verdict == "fail")

    @property
    def warnings(self) -> tuple[RuleResult, ...]:
        return tuple(result for result in self.rules if result.verdict == "warn")

    def to_dict(self) -> dict[str, Any]:
        """Plain values ready for JSON: `printer`, `verdict`, `rules`."""
        return {
            "printer": self.printer,
            "verdict": self.verdict,
            "rules": [asdict(result) for result in self.rules],
        }


def place(point: Iterable[float]) -> str:
    """A point in mm as text, for `where`."""
    return "(" + ", ".join(f"{value + 0.0:.1f}" for value in point) + ") mm"
