"""One process that answers questions about one design after another."""

from __future__ import annotations

import pytest

from bellows_design.batch.executor import Here
from bellows_design.batch.question import Question
from bellows_design.batch.session import Session
from bellows_design.budget import Budget
from bellows_design.design.shipped import load_design
from bellows_design.design.variation import varied

FINGER = load_design("finger")
NEAR = varied(FINGER, {"bubble_width": 19.7})


def test_the_key_of_a_question_depends_on_all_that_decides_its_answer():
    questions = [
        Question(FINGER),
        Question(NEAR),
        Question(FINGER, "ordinary"),
        Question(FINGER, NEAR),
        Question(FINGER, derivatives=True),
        Question(FINGER, accuracy_percent=1.0),
    ]
    assert len({question.key for question in questions}) == len(questions)
    assert Question(FINGER).key == Question(load_design("finger")).key


@pytest.mark.slow
def test_a_session_answers_from_the_start_that_is_asked_for():
    session = Session()
    near = session.answer(Question(NEAR, FINGER, derivatives=True))
    by_itself = session.answer(Question(FINGER, "ordinary"))
    assert (near.origin, by_itself.origin) == ("neighbour", "ordinary")
    change = near.bending_angle_deg - by_itself.bending_angle_deg
    slope = near.derivatives["bending_angle_deg"]["bubble_width"]
    assert change == pytest.approx(-0.3 * slope, rel=0.1)


@pytest.mark.slow
def test_a_design_that_cannot_be_evaluated_is_an_answer_too():
    answer = Session(budget=Budget(seconds=0.01)).answer(Question(FINGER, "ordinary"))
    assert answer.status == "failed"
    assert answer.reason


def test_a_thread_of_this_process_answers_in_order():
    class Stub:
        def answer(self, question):
            return question.key

    here = Here(Stub())
    questions = [Question(FINGER), Question(NEAR)]
    futures = [here.submit(question, 0) for question in questions]
    assert [future.result() for future in futures] == [question.key for question in questions]
    here.close()
