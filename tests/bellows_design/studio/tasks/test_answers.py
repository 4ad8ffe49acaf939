"""What the page says of a result: figures, and what speaks against the design."""

from __future__ import annotations

from typing import Any

import pytest
from fakes import FakeEstimate, FakeEvaluation

from bellows_design.design.overrides import with_overrides
from bellows_design.design.shipped import load_design
from bellows_design.studio.tasks.answers import answer_of
from printers import PrintabilityReport, RuleResult

DESIGN = load_design("prototype_1")  # 4 MPa at most


def answer(report: PrintabilityReport | None = None, **found: Any) -> dict[str, Any]:
    return answer_of(DESIGN, FakeEvaluation(**found), "refined", "how", 1.0, report)


def test_figures_are_those_of_the_result_with_their_errors() -> None:
    found = answer()
    assert found["bending_angle_deg"] == 400.0 and found["angle_error_percent"] == 1.0
    assert found["max_von_mises_mpa"] == 3.0 and found["stress_limit_mpa"] == 4.0
    assert found["cavity_volume_mm3"] == 1000.0 and found["converged"]


@pytest.mark.parametrize(
    ("stress", "error", "verdict"),
    [(3.0, 1.0, "pass"), (5.0, 1.0, "fail"), (3.9, 10.0, "undecided"), (3.0, None, "undecided")],
)
def test_verdict_counts_the_error_of_the_stress(
    stress: float, error: float | None, verdict: str
) -> None:
    found = answer(max_von_mises_mpa=stress, error_estimate=FakeEstimate(error))
    assert found["verdict"] == verdict
    assert bool(found["reasons"]) == (verdict != "pass")


def test_scenes_that_approval_must_hold_are_told_to_be_judged_elsewhere() -> None:
    assert not [text for text in answer()["warnings"] if "scene" in text]
    design = with_overrides(DESIGN, ["limits.scenes=['blocked']"])
    found = answer_of(design, FakeEvaluation(), "refined", "how", 1.0)
    assert found["verdict"] == "pass"
    assert [text for text in found["warnings"] if "“blocked” is judged by the whole run" in text]


def test_without_a_print_check_the_verdict_is_about_the_load_alone() -> None:
    assert answer()["reasons"] == []


def test_a_failed_rule_speaks_against_the_design_once_it_is_measured() -> None:
    rule = RuleResult("airtightness", "fail", 1, 0, "", "whole mesh", "it leaks")
    found = answer(PrintabilityReport("prusa_i3", (rule,)))
    assert found["verdict"] == "fail" and "it leaks" in found["reasons"]


def test_a_load_that_is_not_reached_fails() -> None:
    found = answer(converged=False, pressure_mpa=0.05, message="the walls touch.")
    assert found["verdict"] == "fail" and not found["converged"]
