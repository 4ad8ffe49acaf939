"""A cell's law goes as far as a scene needs it."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import pytest
from linear_finger import DESIGN, linear_law

from bellows_design.budget import DEFAULT
from bellows_design.design.design import Design
from bellows_design.design.scenes.blocked import Blocked
from bellows_design.force import law_of_design
from bellows_design.force.curve import force_curve
from bellows_design.force.law.cell_law import TOLERANCE
from bellows_design.force.law.errors import LawError
from bellows_design.force.scene.exerted import force_of
from bellows_design.progress import SILENCE
from bellows_design.store.key import Key
from solver.arrays import Reals


@dataclass(frozen=True)
class Reach:
    """Stands for a law: the moment up to which it was computed, N mm."""

    moment: float
    design: Design = DESIGN
    error: LawError = field(default_factory=lambda: LawError(0.0, 0.0, 0.0, None))

    def moments(self, loads: Reals) -> Reals:
        """Moments by which it goes, N mm."""
        return loads[:, 0]


def test_a_law_is_extended_to_the_moments_of_a_scene_and_the_path_followed_again(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    asked: list[tuple[float, float]] = []

    def extended(reach: Any, moments: tuple[float, float], *_: object) -> Reach:
        asked.append(moments)
        return Reach(max(abs(each) for each in moments))

    monkeypatch.setattr(law_of_design, "cell_law", lambda *_, **__: Reach(20.0))
    monkeypatch.setattr(law_of_design, "extended", extended)
    monkeypatch.setattr(law_of_design, "finger_law", lambda law: linear_law(reach=law.moment))
    solved = law_of_design.solved_with_its_law(DESIGN, Blocked(), (0.1,), SILENCE, DEFAULT, None)
    (moments,) = asked
    borne = [state.loads[:, 0].min() for state in solved.path.steps]
    assert moments[0] == pytest.approx(1.15 * min(borne)) and moments[1] == 0
    assert not solved.beyond and not solved.warnings


def test_a_law_that_goes_no_further_is_extrapolated_and_that_is_said(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(law_of_design, "cell_law", lambda *_, **__: Reach(20.0))
    monkeypatch.setattr(law_of_design, "extended", lambda reach, *_: reach)
    monkeypatch.setattr(law_of_design, "finger_law", lambda law: linear_law(reach=law.moment))
    solved = law_of_design.solved_with_its_law(DESIGN, Blocked(), (0.1,), SILENCE, DEFAULT, None)
    (warning,) = solved.warnings
    assert "it is extrapolated there" in warning


def test_root_and_tip_beyond_their_laws_are_told_and_not_extended(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(law_of_design, "cell_law", lambda *_, **__: Reach(1000.0))
    monkeypatch.delattr(law_of_design, "extended")
    known = linear_law(reach=1000.0, ends_reach=5.0)
    monkeypatch.setattr(law_of_design, "finger_law", lambda _: known)
    solved = law_of_design.solved_with_its_law(DESIGN, Blocked(), (0.1,), SILENCE, DEFAULT, None)
    (warning,) = solved.warnings
    assert "root or tip bears moments beyond" in warning
    assert force_curve(DESIGN, Blocked(), (0.1,), known).extrapolated


def test_an_extended_law_is_kept_and_found_by_the_same_scene_only(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """In a store that is a table of keys: laws are the moments that they reach."""
    shelf: dict[str, Any] = {law_of_design.key_of_law(DESIGN, TOLERANCE, DEFAULT).text: Reach(20.0)}
    computed: list[float] = []

    def extended(_: Any, moments: tuple[float, float], *__: object) -> Reach:
        computed.append(min(moments))
        return Reach(max(abs(each) for each in moments))

    def keep(_: object, key: Key, law: Reach, __: object) -> None:
        shelf[key.text] = law

    monkeypatch.setattr(law_of_design, "cell_law", lambda *_, **__: Reach(20.0))
    monkeypatch.setattr(law_of_design, "extended", extended)
    monkeypatch.setattr(law_of_design, "finger_law", lambda law: linear_law(reach=law.moment))
    monkeypatch.setattr(law_of_design, "find", lambda _, key, __: shelf.get(key.text))
    monkeypatch.setattr(law_of_design, "keep_noted", keep)

    def solve(pressure: float) -> float:
        store: Any = object()
        solved = law_of_design.solved_with_its_law(
            DESIGN, Blocked(), (pressure,), SILENCE, DEFAULT, store
        )
        assert not solved.beyond
        return force_of(Blocked(), solved.path.last)

    first = solve(0.1)
    assert len(computed) == 1 and solve(0.1) == first
    assert len(computed) == 1
    solve(0.08)
    assert len(computed) == 2


def test_an_extended_law_is_not_kept_where_the_law_itself_is_not(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """The time was over when it was computed."""
    kept: list[object] = []
    monkeypatch.setattr(law_of_design, "cell_law", lambda *_, **__: Reach(20.0))
    monkeypatch.setattr(law_of_design, "extended", lambda *_: Reach(1000.0))
    monkeypatch.setattr(law_of_design, "finger_law", lambda law: linear_law(reach=law.moment))
    monkeypatch.setattr(law_of_design, "find", lambda *_: None)
    monkeypatch.setattr(law_of_design, "keep_noted", lambda *each: kept.append(each))
    store: Any = object()
    law_of_design.solved_with_its_law(DESIGN, Blocked(), (0.1,), SILENCE, DEFAULT, store)
    assert not kept
