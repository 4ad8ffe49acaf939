"""A cell's law goes as far as a scene needs it."""

from __future__ import annotations

from typing import Any

import pytest
from linear_finger import DESIGN, linear_law

from bellows_design.budget import DEFAULT
from bellows_design.design.scenes.blocked import Blocked
from bellows_design.force import law_of_design
from bellows_design.progress import SILENCE


def test_a_law_is_extended_to_the_moments_of_a_scene_and_the_path_followed_again(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    asked: list[tuple[float, float]] = []

    def extended(reach: Any, moments: tuple[float, float], *_: object) -> float:
        asked.append(moments)
        return max(abs(each) for each in moments)

    monkeypatch.setattr(law_of_design, "cell_law", lambda *_, **__: 20.0)
    monkeypatch.setattr(law_of_design, "extended", extended)
    monkeypatch.setattr(law_of_design, "finger_law", lambda reach: linear_law(reach=reach))
    solved = law_of_design.solved_with_its_law(DESIGN, Blocked(), (0.1,), SILENCE, DEFAULT, None)
    (moments,) = asked
    borne = [state.loads[:, 0].min() for state in solved.path.steps]
    assert moments[0] == pytest.approx(1.15 * min(borne)) and moments[1] == 0
    assert not solved.beyond and not solved.warnings


def test_a_law_that_goes_no_further_is_extrapolated_and_that_is_said(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(law_of_design, "cell_law", lambda *_, **__: 20.0)
    monkeypatch.setattr(law_of_design, "extended", lambda reach, *_: reach)
    monkeypatch.setattr(law_of_design, "finger_law", lambda reach: linear_law(reach=reach))
    solved = law_of_design.solved_with_its_law(DESIGN, Blocked(), (0.1,), SILENCE, DEFAULT, None)
    (warning,) = solved.warnings
    assert "it is extrapolated there" in warning
