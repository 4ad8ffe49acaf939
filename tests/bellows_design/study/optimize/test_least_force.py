"""A least force: what the verification makes of it."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import pytest
from fakes import FakeEvaluation, fake_report
from linear_finger import DESIGN, Uncertainty, linear_law

from bellows_design.approval import decide
from bellows_design.budget import DEFAULT
from bellows_design.design import load_design, with_overrides
from bellows_design.design.scenes.blocked import Blocked
from bellows_design.errors import DesignError
from bellows_design.force.curve import force_curve
from bellows_design.force.result import ForceCurve
from bellows_design.progress import SILENCE
from bellows_design.study.optimize import run
from bellows_design.study.optimize.goal import Goal
from bellows_design.study.optimize.verification import Verification, verified

CELL = FakeEvaluation(design=DESIGN, max_von_mises_mpa=2.0)


def blocked_force() -> ForceCurve:
    """Of the linear finger, with an error of some percent."""
    law = linear_law(rotations=Uncertainty(mesh=0.01))
    return force_curve(DESIGN, Blocked(), (0.1,), law, by_distance=False)


def verification(least: float | None, force: ForceCurve | None) -> Verification:
    """Of a design that nothing else speaks against."""
    report = fake_report()
    goal = Goal("angle", 4.0, least_force_n=least)
    return Verification(DESIGN, goal, report, CELL, decide(DESIGN, report, CELL), force=force)


def test_a_force_counts_less_its_error() -> None:
    force = blocked_force()
    error = force.last.error
    assert error is not None and 1 < error.total < 50
    least = force.last.force_n * (1 - error.total / 100)
    assert verification(0.999 * least, force).holds
    assert not verification(1.001 * least, force).holds
    assert verification(least, force).least_force_n == pytest.approx(least)


def test_a_force_that_is_not_known_is_none() -> None:
    assert not verification(0.01, None).holds
    assert verification(None, None).holds
    ended = replace(blocked_force(), converged=False)
    assert not verification(0.01, ended).holds


def point(choice: str, merit: float, force: float, kept: bool = True) -> Any:
    """An evaluated design by its merit, and its blocked force."""
    values = {"merit": merit, "kept": kept}
    return SimpleNamespace(
        ordinary=True, values=values, values_with_error=values, choice=choice, design=force
    )


def test_the_best_design_that_is_strong_enough_takes_the_place_of_a_weak_one(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    whole = blocked_force()
    tried: list[float] = []

    def blocked(force: Any, *_: object) -> ForceCurve:
        tried.append(force)
        last = replace(whole.last, force_n=force, error=replace(whole.last.error, mesh=0.0))
        return replace(whole, curve=(last,))

    monkeypatch.setattr(run, "blocked", blocked)
    goal = SimpleNamespace(
        kept=lambda values: values["kept"], merit=lambda values: values["merit"], least_force_n=2.0
    )
    points = [
        point("a", 1.0, 1.0),
        point("a", 1.5, 9.0),  # another of the choice that was found too weak
        point("b", 3.0, 2.5),
        point("c", 2.0, 1.5),
        point("d", 0.5, 9.0, kept=False),
        point("e", 4.0, 9.0),
    ]
    at: Any = SimpleNamespace(goal=goal, points=points, late=False)
    found = run.strong_point(at, points[0], SILENCE, DEFAULT)
    assert found is points[2] and tried == [1.5, 2.5]
    at.late = True
    assert run.strong_point(at, points[0], SILENCE, DEFAULT) is None


def test_a_least_force_is_positive() -> None:
    with pytest.raises(DesignError, match="least force is -1 N but must be above 0 N"):
        Goal("angle", 4.0, least_force_n=-1.0)


@pytest.mark.slow
def test_a_verification_computes_the_force_that_is_asked_for() -> None:
    design = with_overrides(load_design("prototype_1"), ["load.pressure=0.04"])
    found = verified(design, Goal("angle", 4.0, least_force_n=0.1), half=False)
    assert found.force is not None and found.strong
    assert 0.1 < found.least_force_n < found.force.last.force_n
    assert found.to_dict()["force"]["scene"] == "blocked"
