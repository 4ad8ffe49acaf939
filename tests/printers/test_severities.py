"""The table of rules, and what a profile changes of it."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from printers import (
    RULES,
    PrintabilityReport,
    PrinterProfile,
    check_printability,
    load_profile,
)
from printers.rule_table import severity_problem


def checked(solids: SimpleNamespace, **rules: Any) -> PrintabilityReport:
    """A box with a wide roof and a free-hanging plate outside."""
    inner = (14.0, 14.0, 8.0)
    part = solids.hollow_box(inner=inner) + solids.block((6.0, 6.0, 1.2), (15.0, 4.0, 6.0))
    model = solids.model(part, openings=(solids.port_of(inner=inner),))
    return check_printability(model, load_profile("prusa_i3").model_copy(update={"rules": rules}))


def verdicts(report: PrintabilityReport) -> dict[str, str]:
    return {result.rule: result.verdict for result in report.rules}


def test_a_profile_changes_what_a_rule_does_that_is_not_kept(solids: SimpleNamespace) -> None:
    before = verdicts(checked(solids))
    assert (before["bridge"], before["overhang"]) == ("fail", "warn")
    after = verdicts(checked(solids, bridge="warn", overhang="info", build_volume="warn"))
    assert (after["bridge"], after["overhang"]) == ("warn", "info")
    assert after["build_volume"] == "pass", "a rule that is kept passes whatever its severity"


def test_an_overhang_that_a_profile_forbids_fails_the_part(solids: SimpleNamespace) -> None:
    assert "overhang" in {r.rule for r in checked(solids, overhang="fail").failures}


def test_every_result_states_severity_and_source_of_its_rule(solids: SimpleNamespace) -> None:
    for result in checked(solids, overhang="info").rules:
        rule = RULES[result.rule]
        assert result.source == rule.source
        assert result.severity == ("info" if result.rule == "overhang" else rule.severity)


def test_a_margin_below_zero_passes_within_the_tolerance_alone(solids: SimpleNamespace) -> None:
    for wall, verdict in ((1.19, "pass"), (1.17, "fail"), (1.3, "pass")):
        model = solids.model(solids.hollow_box(wall=wall), openings=(solids.port_of(wall=wall),))
        report = check_printability(model, load_profile("prusa_i3"))
        (result,) = [r for r in report.rules if r.rule == "minimum_lines"]
        assert result.verdict == verdict
        assert result.margin == pytest.approx(wall - 1.2, abs=0.002)
        assert result.tolerance == pytest.approx(0.021)
        assert ("within the 0.021 mm" in result.message) == (wall == 1.19)


@pytest.mark.parametrize("rule", RULES.values(), ids=RULES)
def test_every_rule_says_what_it_asks_and_where_that_comes_from(rule: Any) -> None:
    assert rule.description and len(rule.source) > 10
    assert rule.limit is None or hasattr(load_profile("prusa_i3"), rule.limit)


@pytest.mark.parametrize("name", RULES)
def test_what_seals_or_informs_keeps_its_severity(name: str) -> None:
    rule = RULES[name]
    assert bool(severity_problem(name)) == (rule.seals or rule.severity == "info")


def test_the_names_of_a_profile_s_limits_are_numbers_of_it(prusa: PrinterProfile) -> None:
    limits = {rule.limit for rule in RULES.values() if rule.limit}
    assert {"minimum_wall", "minimum_floor", "minimum_gap", "maximum_bridge"} <= limits
    assert all(isinstance(getattr(prusa, limit), float | int | tuple) for limit in limits)
