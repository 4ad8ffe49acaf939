"""Questions are dealt in pieces that stay together, each once, and nobody is idle."""

from __future__ import annotations

from concurrent.futures import Future

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bellows_design.batch.answer import Answer
from bellows_design.batch.dealing import AHEAD, Dealing, answers
from bellows_design.batch.question import Question
from bellows_design.design.shipped import load_design
from bellows_design.errors import ClusterError

FINGER = load_design("finger")


@settings(deadline=None)  # other work on the machine is no fault
@given(st.integers(0, 200), st.integers(1, 8), st.randoms())
def test_every_question_is_dealt_once_whoever_asks(number, lanes, chance):
    dealing, dealt = Dealing(number, lanes), []
    waiting = set(range(lanes + 1))  # one lane more than at the beginning
    while waiting:
        lane = chance.choice(sorted(waiting))
        place = dealing.next(lane)
        waiting -= {lane} if place is None else set()
        dealt += [] if place is None else [place]
    assert sorted(dealt) == list(range(number))


def test_a_lane_takes_half_of_the_longest_rest_once_it_is_done():
    dealing = Dealing(40, 2)
    assert [dealing.next(0) for _ in range(20)] == list(range(20))
    assert [dealing.next(0) for _ in range(10)] == list(range(30, 40))
    assert dealing.next(1) == 20


class Lanes:
    """Answers at once, in the thread of the caller, and remembers who was asked what."""

    def __init__(self, lanes: int, lost_after: int = 10**9) -> None:
        self.lanes, self.lost_after, self.asked = lanes, lost_after, []

    def submit(self, question, lane):
        self.asked.append((lane, question))
        future = Future()
        if len(self.asked) > self.lost_after:
            future.set_exception(ClusterError("gone"))
        else:
            future.set_result(Answer(key=question, digest=""))
        return future

    def close(self):
        pass


def test_answers_come_with_the_place_of_their_question():
    lanes = Lanes(3)
    questions = [f"question {place}" for place in range(50)]
    found = {place: answer.key for came in answers(questions, lanes) for place, answer in came}
    assert found == dict(enumerate(questions))
    assert {lane for lane, _ in lanes.asked} == {0, 1, 2}


def test_a_lane_has_no_more_than_two_questions_at_once():
    class Slow(Lanes):
        def submit(self, question, lane):
            future = super().submit(question, lane)
            return Future() if len(self.asked) > 4 else future

    lanes = Slow(2)
    next(answers(list(range(100)), lanes))
    outstanding = [lane for lane, _ in lanes.asked[4:]]
    assert all(outstanding.count(lane) == AHEAD for lane in (0, 1))


def test_lanes_that_come_later_are_used():
    lanes = Lanes(1)
    found = answers(list(range(20)), lanes)
    next(found)
    lanes.lanes = 2
    assert sum(map(len, found)) == 18
    assert 1 in {lane for lane, _ in lanes.asked}


def test_what_was_answered_comes_before_it_is_said_that_nobody_works_any_more():
    found = answers(list(range(20)), Lanes(1, lost_after=7))
    places = []
    with pytest.raises(ClusterError):
        for came in found:
            places += [place for place, _ in came]
    assert places == list(range(7))


def test_what_comes_together_with_a_fault_is_not_lost():
    class OneIsLost(Lanes):
        """All answers come at once; one in their midst is a fault."""

        def submit(self, question, lane):
            self.lost_after = 0 if question == 18 else 10**9
            return super().submit(question, lane)

    came, places = answers(list(range(20)), OneIsLost(10)), []
    with pytest.raises(ClusterError):
        for together in came:
            places += [place for place, _ in together]
    assert sorted(places) == [*range(18), 19]


def test_no_question_no_answer():
    assert list(answers([], Lanes(2))) == []


def test_questions_of_a_design_reach_the_executor_as_they_are():
    lanes = Lanes(1)
    question = Question(FINGER)
    list(answers([question], lanes))
    assert lanes.asked == [(0, question)]
