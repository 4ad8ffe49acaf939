"""Who answers the questions of a study."""

from __future__ import annotations

import pytest
from fakes import FakeEvaluation

from bellows_design.batch.question import Question
from bellows_design.design.shipped import load_design
from bellows_design.study.sensitivity.answers import in_this_process


def test_the_session_begins_with_the_evaluation_at_hand_and_answers_one_by_one(
    monkeypatch: pytest.MonkeyPatch,
):
    done: list[object] = []
    session = "bellows_design.batch.session.Session"
    monkeypatch.setattr(f"{session}.begin", lambda _, found: done.append(found))
    monkeypatch.setattr(f"{session}.answer", lambda _, question: done.append(question) or question)
    found = FakeEvaluation()
    answers = in_this_process(found)
    questions = [Question(load_design("finger")), Question(load_design("prototype_1"))]
    answered = answers(iter(questions))
    assert done == [found]
    assert next(answered) is questions[0]
    assert done == [found, questions[0]]  # the second is asked when its answer is wanted
    assert list(answered) == questions[1:]
