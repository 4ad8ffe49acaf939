"""What the verification of an optimum says of the leak test, which it does not make."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from fakes import FakeEvaluation

from bellows_design.design.overrides import with_overrides
from bellows_design.design.shipped import load_design
from bellows_design.study.optimize import verification
from bellows_design.study.optimize.goal import Goal
from bellows_design.study.optimize.verification import verified


@pytest.mark.parametrize(
    ("setting", "approved", "why"),
    [
        ("off", True, "the design switches it off"),
        ("if-available", True, verification.NOT_SLICED),
        ("required", False, None),
    ],
)
def test_an_optimum_is_not_judged_by_a_leak_test_that_was_not_made(
    setting: str,
    approved: bool,
    why: str | None,
    stub_stages: Callable[..., None],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    stub_stages(None)
    monkeypatch.setattr("bellows_design.evaluation.evaluate", lambda *_, **__: FakeEvaluation())
    design = with_overrides(load_design("finger"), [f"limits.leak_test={setting}"])
    found = verified(design, Goal("angle", 4.0), half=False)
    assert (found.verdict.approved, found.holds) == (approved, approved)
    not_judged = {each.rule: each.why for each in found.verdict.not_judged}
    assert not_judged.get("leak_test") == why
    assert [each.rule for each in found.verdict.reasons] == ([] if approved else ["leak_test"])
