"""What a worker keeps between questions, while other studies come to it."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

pytest.importorskip("distributed")

from answering_stub import stub

from bellows_design.batch.question import Question
from bellows_design.batch.workers import Answering
from bellows_design.design.shipped import load_design

FINGER = Question(load_design("finger"))


def test_an_answerer_is_made_once_and_goes_when_another_study_comes():
    made = []
    one, other = Answering(lambda: made.append(1) or stub()()), Answering(stub())
    worker = SimpleNamespace(plugins={one.name: one, other.name: other})
    one.setup(worker)
    for _ in range(2):
        assert one.answer(FINGER).done
    assert made == [1]
    other.setup(worker)
    assert one.answer(FINGER).done and made == [1, 1]


def test_a_question_at_work_does_not_fail_when_another_study_comes_just_then():
    class Taken(Answering):
        """What it keeps is taken away at once, as by the setup of another study."""

        def __setattr__(self, name, value):
            super().__setattr__(name, None if name == "_answerer" else value)

    plugin = Taken(stub())
    plugin.setup(SimpleNamespace(plugins={}))
    assert plugin.answer(FINGER).done
