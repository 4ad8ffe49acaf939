"""One process that answers questions about one design after another."""

from __future__ import annotations

from dataclasses import dataclass

import pytest
from fakes import FakeContact, FakeEvaluation

from bellows_design.batch.executor import Here
from bellows_design.batch.question import Question
from bellows_design.batch.session import Session
from bellows_design.budget import Budget
from bellows_design.design.shipped import load_design
from bellows_design.design.variation import varied
from bellows_design.errors import DesignError
from solver.errors import MeshingError, SolverError

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
    answer = Session(budget=Budget(mesh_seconds=0.01)).answer(Question(FINGER, "ordinary"))
    assert answer.status == "failed"
    assert "did not mesh the solid within" in answer.reason


@dataclass(frozen=True, kw_only=True)
class Neighbour(FakeEvaluation):
    ordinary: bool = False
    fallback: str = ""
    distance: float = 0.01


@pytest.fixture
def evaluated(monkeypatch):
    """Designs that are evaluated by themselves, in order; a neighbour costs nothing."""
    designs = []

    def evaluate(design, *_, **__):
        designs.append(design)
        void = design == FINGER
        return FakeEvaluation(design=design, contact=FakeContact(detected=void, where=("walls",)))

    class Around:
        def __init__(self, anchor):
            self.anchor = anchor

        def evaluate(self, design, **_):
            return Neighbour(design=design, max_von_mises_mpa=self.anchor.max_von_mises_mpa)

    monkeypatch.setattr("bellows_design.evaluation.evaluate", evaluate)
    monkeypatch.setattr("bellows_design.neighbours.neighbourhood.Neighbourhood", Around)
    return designs


def test_questions_that_start_from_the_evaluation_at_hand_find_it(evaluated):
    session = Session()
    session.begin(FakeEvaluation(design=FINGER, max_von_mises_mpa=1.25))
    for design in (NEAR, FINGER):
        answer = session.answer(Question(design, FINGER))
        assert (answer.origin, answer.max_von_mises_mpa) == ("neighbour", 1.25), answer
    assert evaluated == []


def test_what_is_no_start_is_evaluated_once(evaluated):
    widths = (19.5, 19.6, 19.7, 19.8, 19.9)
    designs = [varied(FINGER, {"bubble_width": width}) for width in widths]
    session = Session()
    answers = [session.answer(Question(design, FINGER)) for design in designs]
    assert {answer.origin for answer in answers} == {"ordinary"}
    assert evaluated == [FINGER, *designs]


@pytest.mark.parametrize("error", [DesignError, SolverError, MeshingError])
def test_sentences_of_evaluations_are_no_internal_errors(monkeypatch, error):
    def refuse(*_, **__):
        raise error("it cannot be meshed.")

    monkeypatch.setattr("bellows_design.evaluation.evaluate", refuse)
    assert Session().answer(Question(FINGER, "ordinary")).reason == "it cannot be meshed."


def test_a_thread_of_this_process_answers_in_order():
    class Stub:
        def answer(self, question):
            return question.key

    here = Here(Stub())
    questions = [Question(FINGER), Question(NEAR)]
    futures = [here.submit(question, 0) for question in questions]
    assert [future.result() for future in futures] == [question.key for question in questions]
    here.close()
