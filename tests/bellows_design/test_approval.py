"""What speaks against a design, and that silence never speaks for it."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest
from fakes import FakeContact, FakeEstimate, FakeEvaluation, FakeStrain, fake_report

from bellows_design.analysis.whole_actuator import NO_FOLDS, FoldedElements
from bellows_design.approval import REQUIRED_RULES, NotJudged, decide, open_question
from bellows_design.design.overrides import with_overrides
from bellows_design.design.shipped import load_design
from printers import PrintabilityReport, RuleResult

DESIGN = load_design("prototype_1")
GOOD = FakeEvaluation(max_von_mises_mpa=3.9, error_estimate=FakeEstimate(2.0))
WALL = RuleResult(
    "minimum_lines", "fail", 3.75, 3, "lines", "bubble_thickness", "1.5 mm is no wall."
)


def test_a_design_that_keeps_every_rule_is_approved() -> None:
    verdict = decide(DESIGN, fake_report(), GOOD)
    assert verdict.approved and verdict.reasons == ()


def test_a_failed_printing_rule_refuses_and_a_warning_does_not() -> None:
    verdict = decide(DESIGN, fake_report(WALL), GOOD)
    assert not verdict.approved and not verdict.undecided
    assert [(r.rule, r.measured, r.required, r.unit) for r in verdict.reasons] == [
        ("minimum_lines", 3.75, 3, "lines")
    ]
    assert decide(DESIGN, fake_report(replace(WALL, verdict="warn")), GOOD).approved


def test_a_result_reached_from_a_neighbour_never_approves() -> None:
    class Neighbour(FakeEvaluation):
        ordinary = False

    verdict = decide(DESIGN, fake_report(), Neighbour(max_von_mises_mpa=1.0))
    assert [reason.rule for reason in verdict.reasons] == ["history"]
    assert not verdict.approved


def test_a_rule_that_was_not_checked_is_not_a_pass() -> None:
    verdict = decide(DESIGN, PrintabilityReport("prusa_i3", ()), GOOD)
    assert {reason.rule for reason in verdict.reasons} == set(REQUIRED_RULES)


@pytest.mark.parametrize(
    ("stress", "percent", "kinds"),
    [
        (3.9, 2.0, []),  # 3.978
        (3.9, 2.7, ["accuracy"]),  # 4.005
        (4.0, 0.0, []),
        (4.1, 2.0, ["stress"]),  # 4.018 at least
        (4.1, 3.0, ["accuracy"]),  # 3.977 at least
        (4.1, -2.0, ["stress"]),
        (3.0, None, ["accuracy"]),
        (3.0, math.nan, ["accuracy"]),
        (math.nan, 1.0, ["accuracy"]),
    ],
)
def test_the_estimated_error_must_not_reach_across_the_stress_limit(
    stress: float, percent: float | None, kinds: list[str]
) -> None:
    found = replace(GOOD, max_von_mises_mpa=stress, error_estimate=FakeEstimate(percent))
    verdict = decide(DESIGN, fake_report(), found)
    assert [reason.kind for reason in verdict.reasons] == kinds
    assert verdict.undecided is (kinds == ["accuracy"])


def test_a_refusal_for_stress_says_by_how_much() -> None:
    verdict = decide(DESIGN, fake_report(), replace(GOOD, max_von_mises_mpa=4.547))
    (reason,) = verdict.reasons
    assert (reason.measured, reason.required) == (4.547, 4.0)
    assert "0.547 MPa above the limit of 4 MPa" in reason.message


def test_the_designs_own_limit_goes_before_the_yield_strength() -> None:
    strict = with_overrides(DESIGN, ["limits.max_von_mises=3.5"])
    assert not decide(strict, fake_report(), GOOD).approved


@pytest.mark.parametrize(
    "found",
    [
        replace(GOOD, converged=False, pressure_mpa=0.06, message="cut back eight times."),
        replace(GOOD, converged=True, pressure_mpa=0.06),
        replace(GOOD, converged=True, pressure_mpa=math.nan),
    ],
)
def test_a_load_that_was_not_reached_refuses(found: FakeEvaluation) -> None:
    verdict = decide(DESIGN, fake_report(), found)
    assert [reason.kind for reason in verdict.reasons] == ["convergence"]
    assert "of 0.1 MPa" in verdict.reasons[0].message
    assert found.message in verdict.reasons[0].message


def test_walls_that_run_through_each_other_refuse_whatever_the_numbers_say() -> None:
    """The load was reached, and the stress keeps its limit: of a shape that cannot be."""
    void = replace(GOOD, contact=FakeContact(detected=True, where=("inner walls",)))
    (reason,) = decide(DESIGN, fake_report(), void).reasons
    assert reason.kind == reason.rule == "contact"
    assert reason.message.startswith("Inner walls touch at 0.1 MPa")


def test_a_first_touch_names_the_pressure_up_to_which_the_design_may_be_judged() -> None:
    message = "stopped at 0.04 of 0.1 MPa: outer walls touch, and this model lets them."
    touched = replace(
        GOOD, converged=False, pressure_mpa=0.04, touch_pressure_mpa=0.04, message=message
    )
    verdict = decide(DESIGN, fake_report(), touched)
    (reason,) = verdict.reasons
    assert (reason.kind, reason.measured, reason.required) == ("contact", 0.04, 0.1)
    assert reason.message == (
        "Stopped at 0.04 of 0.1 MPa: outer walls touch, and this model lets them. "
        "The design may be judged at pressures up to 0.04 MPa."
    )
    assert not verdict.undecided
    at_once = replace(touched, pressure_mpa=2e-5, touch_pressure_mpa=2e-5)
    (reason,) = decide(DESIGN, fake_report(), at_once).reasons
    assert reason.message.endswith("Pressures below that, under 0.001 MPa, are not judged.")


def test_rules_without_data_are_listed_as_not_judged() -> None:
    """A rule that vanishes reads like a pass."""
    silent = FakeStrain(elongation_at_break=None, valid=None)
    verdict = decide(DESIGN, fake_report(), replace(GOOD, strain=silent, stable=None))
    name = DESIGN.material.name
    assert verdict.approved and verdict.not_judged == (
        NotJudged("elongation_at_break", f"the material {name} states no elongation at break"),
        NotJudged("tested_strain", f"the material {name} does not state the strains of its tests"),
        NotJudged("stability", "the linear solver cannot tell whether an equilibrium is stable"),
    )
    assert [rule["rule"] for rule in verdict.to_dict()["not_judged"]] == [
        "elongation_at_break", "tested_strain", "stability",
    ]  # fmt: skip
    told = replace(GOOD, strain=FakeStrain(valid=(-0.5, 1.0)))
    assert decide(DESIGN, fake_report(), told).not_judged == ()


@pytest.mark.parametrize(
    ("stress", "percent", "open_"),
    [
        (3.5, 20.0, True),
        (3.95, 5.0, False),  # nearer to 4 MPa than the 2 % that no mesh resolves
        (4.05, 5.0, False),
        (3.5, 1.0, False),  # decided
        (4.5, 1.0, False),
        (3.5, None, False),  # nothing to refine by
    ],
)
def test_a_finer_mesh_is_asked_for_only_where_it_can_decide(
    stress: float, percent: float | None, open_: bool
) -> None:
    found = replace(GOOD, max_von_mises_mpa=stress, error_estimate=FakeEstimate(percent))
    assert bool(open_question(DESIGN, fake_report(), found)) is open_


def test_a_stress_that_no_mesh_can_tell_from_its_limit_is_told_so() -> None:
    near = replace(GOOD, max_von_mises_mpa=3.95, error_estimate=FakeEstimate(5.0))
    (reason,) = decide(DESIGN, fake_report(), near).reasons
    assert reason.kind == "accuracy" and "2 % that no mesh resolves" in reason.message


def test_strain_beyond_the_elongation_at_break_refuses() -> None:
    verdict = decide(DESIGN, fake_report(), replace(GOOD, strain=FakeStrain(highest=6.7)))
    assert [reason.kind for reason in verdict.reasons] == ["strain"] and not verdict.undecided
    assert verdict.reasons[0].message == "The material is strained to 670 % but breaks at 660 %."
    unknown = replace(GOOD, strain=FakeStrain(highest=6.7, elongation_at_break=None))
    assert decide(DESIGN, fake_report(), unknown).approved


def test_a_warning_is_told_and_refuses_nothing() -> None:
    verdict = decide(DESIGN, fake_report(), replace(GOOD, warnings=("beyond the tests.",)))
    assert verdict.approved and verdict.to_dict()["warnings"] == ["beyond the tests."]


def test_doubt_about_the_material_is_told_with_the_verdict() -> None:
    poor = DESIGN.material.model_copy(update={"fit_error": 40.0})
    doubtful = DESIGN.model_copy(update={"material": poor})
    verdict = decide(doubtful, fake_report(), GOOD)
    assert verdict.approved and verdict.warnings == poor.warnings and "40 %" in poor.warnings[0]


def test_all_reasons_are_named_together() -> None:
    verdict = decide(DESIGN, fake_report(WALL), replace(GOOD, max_von_mises_mpa=5.0))
    assert [reason.kind for reason in verdict.reasons] == ["printability", "stress"]
    assert not verdict.undecided
    assert len(verdict.to_dict()["reasons"]) == 2


def test_a_vacuum_is_reached_from_above() -> None:
    """-0.03 MPa lies above the -0.05 MPa asked for, and yet is less of a load."""
    vacuum = with_overrides(DESIGN, ["load.pressure=-0.05"])
    reached, short = (replace(GOOD, pressure_mpa=pressure) for pressure in (-0.05, -0.03))
    assert decide(vacuum, fake_report(), reached).approved
    (reason,) = decide(vacuum, fake_report(), short).reasons
    assert reason.kind == "convergence" and "-0.03 MPa of -0.05 MPa" in reason.message


FOLDED = FoldedElements(3, (12.0, 1.5, 4.25), at_highest_stress=True)


def test_elements_that_fold_at_the_highest_stress_leave_it_undecided_whatever_it_is() -> None:
    """A finer mesh may decide; a stress far above its limit is not known either."""
    for stress in (0.5, 3.9, 40.0):
        found = replace(GOOD, max_von_mises_mpa=stress, folded=FOLDED)
        verdict = decide(DESIGN, fake_report(), found)
        (reason,) = verdict.reasons
        assert verdict.undecided and reason.kind == "accuracy"
        told = "3 elements of the mesh fold under the load, the nearest at (12.0, 1.5, 4.2) mm"
        assert told in reason.message
        assert told in open_question(DESIGN, fake_report(), found)


def test_elements_that_fold_elsewhere_are_a_warning() -> None:
    elsewhere = replace(FOLDED, count=1, at_highest_stress=False)
    (warning,) = elsewhere.warnings
    assert warning.startswith("1 element of the mesh folds under the load, at (12.0, 1.5, 4.2) mm")
    assert decide(DESIGN, fake_report(), replace(GOOD, folded=elsewhere)).approved
    assert FOLDED.warnings == NO_FOLDS.warnings == ()
