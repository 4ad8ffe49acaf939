"""Made-up results of the slow stages, so that decisions and files can be tested by themselves."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from printers import PrintabilityReport, RuleResult


@dataclass(frozen=True)
class FakeEstimate:
    max_von_mises_percent: float | None = 1.0


@dataclass(frozen=True)
class FakeStrain:
    lowest: float = -0.2
    highest: float = 0.3
    elongation_at_break: float | None = 6.6

    @property
    def breaks(self) -> bool:
        return self.elongation_at_break is not None and self.highest > self.elongation_at_break


@dataclass(frozen=True)
class FakeEvaluation:
    """An evaluation with made-up numbers."""

    converged: bool = True
    can_refine: bool = False
    message: str = ""
    pressure_mpa: float = 0.1
    bending_angle_deg: float = 400.0
    max_von_mises_mpa: float = 3.0
    error_estimate: FakeEstimate = field(default_factory=FakeEstimate)
    curve: tuple[dict[str, float], ...] = ()
    strain: FakeStrain = field(default_factory=FakeStrain)
    warnings: tuple[str, ...] = ()

    def to_dict(self) -> dict[str, Any]:
        return {
            "design": "fake",
            "model": "half",
            "model_reason": "as asked for",
            "pressure_mpa": self.pressure_mpa,
            "converged": self.converged,
            "message": self.message,
            "bending_angle_deg": self.bending_angle_deg,
            "max_von_mises_mpa": self.max_von_mises_mpa,
            "max_von_mises_position_mm": [1.0, 2.0, 3.0],
            "cavity_volume_mm3": 1000.0,
            "strain": {"lowest": -0.2, "highest": self.strain.highest, "valid": None},
            "warnings": list(self.warnings),
            "contact": {"detected": False, "min_gap_mm": 0.5},
            "error_estimate": {
                "bending_angle_percent": 1.0,
                "max_von_mises_percent": self.error_estimate.max_von_mises_percent,
            },
            "mesh": {"elements": 1, "nodes": 10, "unknowns": 34},
            "solver": {"load_steps": 1, "newton_iterations": 2, "linear_solver": "none"},
            "seconds": {"total": 0.0},
            "curve": self.curve,
        }


def fake_report(*rules: RuleResult) -> PrintabilityReport:
    """A report in which every rule passes but those given."""
    passed = [rule for rule in RULES if rule.rule not in {other.rule for other in rules}]
    return PrintabilityReport("prusa_i3", (*passed, *rules))


RULES = tuple(
    RuleResult(name, "pass", "ok", "ok", "", "part", f"{name} holds.")
    for name in ("watertight", "airtightness", "cross_section", "minimum_lines")
)
