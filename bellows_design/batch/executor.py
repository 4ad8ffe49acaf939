"""Who works on questions: a thread of this process, or processes of a cluster."""

from __future__ import annotations

from concurrent.futures import Future, ThreadPoolExecutor
from typing import Protocol

from bellows_design.batch.answer import Answer
from bellows_design.batch.question import Question
from bellows_design.batch.session import Session


class Executor(Protocol):
    """Works on questions; each of its lanes takes one after the other, and remembers them."""

    @property
    def lanes(self) -> int:
        """How many questions are worked on at once."""

    def submit(self, question: Question, lane: int) -> Future[Answer]:
        """Ask a lane, from any thread; it answers in the order of its questions.

        The future raises ``BellowsError`` where nobody works any more.
        """

    def close(self) -> None:
        """Give up what is not begun, and end."""


class Here:
    """One lane, in a thread of this process."""

    lanes = 1

    def __init__(self, session: Session) -> None:
        self._session = session
        self._thread = ThreadPoolExecutor(1)

    def submit(self, question: Question, lane: int) -> Future[Answer]:
        """Ask it; there is one lane."""
        return self._thread.submit(self._session.answer, question)

    def close(self) -> None:
        """Give up what is not begun; waits for the question at work."""
        self._thread.shutdown(cancel_futures=True)
