"""A computation beside another one: its result, its errors, its end."""

from __future__ import annotations

import threading
import time

import pytest

from bellows_design.beside import Abandoned, beside
from bellows_design.progress import SILENCE, Progress

LONG = 30.0
"""s. More than a thread of these tests takes on any machine."""


def number_of_thread(progress: Progress) -> int:
    progress.stage("it works")
    return threading.get_ident()


def test_the_result_is_that_of_another_thread_only_where_it_was_begun_at_once() -> None:
    for at_once in (True, False):
        with beside(number_of_thread, at_once) as other:
            found, seconds = other.result(SILENCE)
        assert (found != threading.get_ident()) is at_once
        assert seconds >= 0 and not other.running


def test_an_error_is_raised_where_the_result_is_asked_for() -> None:
    def refuse(progress: Progress) -> int:
        raise ValueError("no such body")

    for at_once in (True, False):
        with beside(refuse, at_once) as other, pytest.raises(ValueError, match="no such body"):
            other.result(SILENCE)


def test_what_nobody_needs_ends_at_its_next_step() -> None:
    ended = threading.Event()

    def endless(progress: Progress) -> int:
        try:
            while True:
                progress.load(0.5, 10.0)
                time.sleep(0.001)
        except Abandoned:
            ended.set()
            raise

    with beside(endless, at_once=True) as other:
        assert other.running
    assert ended.is_set() and not other.running
    ended.clear()
    with pytest.raises(KeyboardInterrupt), beside(endless, at_once=True):
        raise KeyboardInterrupt  # as of Ctrl-C in the block
    assert ended.wait(LONG)


def test_no_error_leaves_the_thread_at_work() -> None:
    """It would work on in libraries that the end of the program takes from under it."""

    def one_long_step(progress: Progress) -> None:
        time.sleep(0.5)
        progress.stage("next")

    with pytest.raises(ValueError, match="of the caller"), beside(one_long_step, True) as other:
        raise ValueError("an error of the caller")
    assert not other.running


def test_an_interrupt_does_not_wait_for_a_long_step(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("bellows_design.beside.INTERRUPTED_SECONDS", 0.01)
    step = threading.Event()

    def stuck(_: Progress) -> None:
        step.wait(LONG)

    with pytest.raises(KeyboardInterrupt), beside(stuck, True) as other:
        raise KeyboardInterrupt
    assert other.running
    step.set()
    other.wait()
    assert not other.running
