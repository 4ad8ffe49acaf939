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
        raise KeyboardInterrupt  # as of Ctrl-C in the block: nobody waits
    assert ended.wait(LONG)
