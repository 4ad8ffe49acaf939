"""Made-up results of the slow stages, so that decisions and files can be tested by themselves."""

from __future__ import annotations

from dataclasses import dataclass, field
from types import SimpleNamespace
from typing import Any

from bellows_design.analysis.computation import Seconds
from bellows_design.analysis.evaluation import Evaluation, MeshReading, MeshSize, SolverEffort
from bellows_design.analysis.material_range import ReachedStrain
from bellows_design.analysis.wall_contact import WallContact
from bellows_design.analysis.whole_actuator import Reading
from bellows_design.design import Design, load_design
from printers import PrintabilityReport, RuleResult


@dataclass(frozen=True)
class FakeEstimate:
    max_von_mises_percent: float | None = 1.0
    bending_angle_percent: float | None = 1.0


@dataclass(frozen=True)
class FakeStrain(ReachedStrain):
    lowest: float = -0.2
    highest: float = 0.3
    elongation_at_break: float | None = 6.6


@dataclass(frozen=True)
class FakeContact(WallContact):
    detected: bool = False
    min_gap_mm: float | None = 0.5
    overlaps_itself: bool = False


MESHES = (MeshReading(MeshSize(1, 10, 34), Reading(0.1, 400.0, 3.0, 1000.0)),)


@dataclass(frozen=True, kw_only=True)
class FakeEvaluation(Evaluation):
    """An evaluation with made-up numbers."""

    design: Design = field(default_factory=lambda: load_design("prototype_1"))
    model: Any = field(default_factory=lambda: SimpleNamespace(name="half"))
    reason: str = "as asked for"
    converged: bool = True
    message: str = ""
    stable: bool | None = True
    pressure_mpa: float = 0.1
    limit_pressure_mpa: float | None = None
    touch_pressure_mpa: float | None = None
    bending_angle_deg: float = 400.0
    max_von_mises_mpa: float = 3.0
    max_von_mises_position_mm: tuple[float, float, float] = (1.0, 2.0, 3.0)
    cavity_volume_mm3: float = 1000.0
    error_estimate: Any = field(default_factory=FakeEstimate)
    strain: ReachedStrain = field(default_factory=FakeStrain)
    warnings: tuple[str, ...] = ()  # type: ignore[assignment]
    contact: Any = field(default_factory=FakeContact)
    meshes: tuple[MeshReading, ...] = MESHES
    solver: SolverEffort = field(default_factory=lambda: SolverEffort(1, 2, 2, "none"))
    seconds: Seconds = field(default_factory=Seconds)
    path: tuple[Reading, ...] = ()
    curve: tuple[Reading, ...] = ()
    computation: Any = field(default_factory=lambda: SimpleNamespace(in_time=False))


def fake_report(*rules: RuleResult) -> PrintabilityReport:
    """A report in which every rule passes but those given."""
    passed = [rule for rule in RULES if rule.rule not in {other.rule for other in rules}]
    return PrintabilityReport("prusa_i3", (*passed, *rules))


RULES = tuple(
    RuleResult(name, "pass", "ok", "ok", "", "part", f"{name} holds.")
    for name in ("watertight", "airtightness", "cross_section", "minimum_lines")
)
