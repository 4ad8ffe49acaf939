"""A computation in a thread of its own, beside that of the caller who needs its result later."""

from __future__ import annotations

import math
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Generic, TypeVar

from bellows_design.progress import Progress

Result = TypeVar("Result")

POLL_SECONDS = 0.2
"""Interval, s, at which a waiting caller checks for interrupts that do not end the wait."""


INTERRUPTED_SECONDS = 2.0
"""s. So long an interrupt waits at most for the other thread to end."""


class Abandoned(Exception):
    """Nobody needs the result any more."""


@dataclass
class Beside(Generic[Result]):
    """Calls ``compute`` once: in a thread if it is ``begun``, else when the result is asked for.

    ``compute`` is given a progress that shows nothing, and ends it once the result is abandoned.
    """

    compute: Callable[[Progress], Result]
    _unwanted: threading.Event = field(default_factory=threading.Event)
    _thread: threading.Thread | None = None
    _found: list[Result] = field(default_factory=list)
    _error: BaseException | None = None

    def begin(self) -> None:
        """Start the thread; it does not keep the program from ending."""
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()

    @property
    def begun(self) -> bool:
        """Whether there is a thread."""
        return self._thread is not None

    @property
    def running(self) -> bool:
        """Whether the thread still works."""
        return self._thread is not None and self._thread.is_alive()

    def result(self, progress: Progress) -> tuple[Result, float]:
        """The result, and the seconds that the caller waited for it; raises what ``compute`` did.

        Where no thread was begun it is computed here, and ``progress`` is told of it.
        """
        start = time.perf_counter()
        if self._thread is None:
            return self.compute(progress), time.perf_counter() - start
        self.wait()
        if self._error is not None:
            raise self._error
        return self._found[0], time.perf_counter() - start

    def abandon(self) -> None:
        """Let the thread end at its next step, without a result."""
        self._unwanted.set()

    def wait(self, seconds: float = math.inf) -> None:
        """Until the thread, if there is one, has ended; ``seconds`` at most."""
        deadline = time.perf_counter() + seconds
        while self.running and (rest := deadline - time.perf_counter()) > 0:
            assert self._thread is not None
            self._thread.join(min(rest, POLL_SECONDS))

    def _run(self) -> None:
        try:
            self._found.append(self.compute(_Unshown(self._unwanted)))
        except BaseException as error:  # the caller's to raise, also an exit
            self._error = error


@dataclass(frozen=True)
class _Unshown:
    """Progress that nobody sees; ends a computation that nobody needs."""

    unwanted: threading.Event

    def stage(self, name: str) -> None:
        """Raise ``Abandoned`` if that is so."""
        if self.unwanted.is_set():
            raise Abandoned

    def load(self, fraction: float, angle: float, spent: float = 0.0) -> None:
        """Raise ``Abandoned`` if that is so."""
        self.stage("")

    def note(self, text: str) -> None:
        """Ignored."""


@contextmanager
def beside(compute: Callable[[Progress], Result], at_once: bool) -> Iterator[Beside[Result]]:
    """``compute`` in a thread for the length of the block if ``at_once``, else when asked for.

    At the end of the block a result that was not asked for is abandoned, and its thread has ended:
    one that works on while the program ends makes libraries in C crash. An interrupt does not wait
    for that longer than ``INTERRUPTED_SECONDS``.
    """
    other = Beside(compute)
    if at_once:
        other.begin()
    try:
        yield other
    except BaseException as error:
        _end(other, math.inf if isinstance(error, Exception) else INTERRUPTED_SECONDS)
        raise
    _end(other, math.inf)


def _end(other: Beside[Result], seconds: float) -> None:
    other.abandon()
    other.wait(seconds)
