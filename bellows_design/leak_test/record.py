"""The leak test on a slicer's G-code, as far as the verdict knows it.

A ``LeakTester`` slices the part with the settings of the design's printer and says whether air gets
out. Where there is none, ``Unavailable`` says why. What became of the test, also that it was not
run, is a ``LeakTest``.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass, field
from typing import TYPE_CHECKING, Any, Literal

from bellows_design.design.conditions import LeakTestSetting
from bellows_design.design.design import Design
from bellows_design.geometry.tessellation import ClosedMesh
from bellows_design.validation.quoting import reproducible
from printers.report import RuleResult

if TYPE_CHECKING:
    from bellows_design.web.layers import PrintLayers

RULE = "leak_test"
"""Name of the rule where the test itself is missing."""

REQUIRED_RULES = ("leak_path", "printed_depth")
"""Rules that every leak test applies: one that was not is no pass."""

SWITCHED_OFF = "the design switches it off"
"""Why there is no test, as the end of a sentence."""

Result = Literal["pass", "warn", "fail", "not run"]


@dataclass(frozen=True)
class LeakOutcome:
    """What a slicer made of the part, and what the leak test found in it.

    Attributes:
        slicer: Name of the program.
        version: Of the program.
        profile_sha256: Of the settings that it was given.
        rules: Every rule of the leak test: a failed one speaks against the design.
        figures: What was measured, plain values for JSON.
        seconds: What slicing and testing took, s.
        layers: What was laid down, and where it leaks, for a page; None where that was not kept.
    """

    slicer: str
    version: str
    profile_sha256: str
    rules: tuple[RuleResult, ...]
    figures: Mapping[str, Any] = field(default_factory=dict)
    seconds: float = 0.0
    layers: PrintLayers | None = field(default=None, repr=False, compare=False)


@dataclass(frozen=True)
class Unavailable:
    """There is no leak test here; ``why`` as the end of a sentence."""

    why: str


LeakTester = Callable[[Design, ClosedMesh], LeakOutcome]
"""Slices the printed part of a design and tests it. Raises ``PrintersError`` if it cannot."""


@dataclass(frozen=True)
class LeakTest:
    """What became of the leak test of a design.

    Attributes:
        setting: What the design asks for.
        outcome: What was found; None if it was not run.
        why: Why it was not run, as the end of a sentence; empty if it was.
        failed: True if it was begun and could not be finished.

    ``why`` may be a slicer's words: without folders and control characters, so that two runs write
    the same.
    """

    setting: LeakTestSetting
    outcome: LeakOutcome | None = None
    why: str = ""
    failed: bool = False

    def __post_init__(self) -> None:
        object.__setattr__(self, "why", reproducible(self.why))

    @property
    def result(self) -> Result:
        """The worst verdict among its rules; a required one that was not applied is a failure."""
        if self.outcome is None:
            return "not run"
        found = {rule.verdict for rule in self.rules}
        if "fail" in found or self.missing:
            return "fail"
        return "warn" if "warn" in found else "pass"

    @property
    def missing(self) -> tuple[str, ...]:
        """Required rules that were not applied though the test was run."""
        applied = {rule.rule for rule in self.rules}
        required = () if self.outcome is None else REQUIRED_RULES
        return tuple(name for name in required if name not in applied)

    @property
    def rules(self) -> tuple[RuleResult, ...]:
        """Those that were applied."""
        return () if self.outcome is None else self.outcome.rules

    @property
    def slicer(self) -> str | None:
        """Name and version of the program; None if the test was not run."""
        found = self.outcome
        return None if found is None else reproducible(f"{found.slicer} {found.version}", 100)

    def summary(self) -> dict[str, Any]:
        """Setting, result, slicer and, if it was not run, why: plain values for JSON."""
        return {
            "setting": self.setting,
            "result": self.result,
            "why": self.why or None,
            "slicer": self.slicer,
        }

    def reproducible(self) -> dict[str, Any]:
        """What another run says again, as plain values: no figures, as seams may be random."""
        if self.outcome is None:
            return self.summary()
        return self.summary() | {
            "profile_sha256": self.outcome.profile_sha256,
            "rules": [{"rule": rule.rule, "verdict": rule.verdict} for rule in self.rules],
        }

    def measured(self) -> dict[str, Any] | None:
        """What was measured in this run, plain values for JSON; None if it was not run."""
        if self.outcome is None:
            return None
        return {
            "rules": [asdict(rule) for rule in self.rules],
            "figures": dict(self.outcome.figures),
            "seconds": self.outcome.seconds,
        }

    def to_dict(self) -> dict[str, Any]:
        """All of it as plain values for JSON."""
        return self.reproducible() | (self.measured() or {})
