"""How a command ends at Ctrl-C, a kill or a closed terminal: one sentence, a status, no leftovers.

While a command works, a signal raises an exception, so that every temporary file is removed. Before
and after there is nothing to remove, and exceptions would meet half-imported modules: the process
ends at once. Where the exception does not get through in time, in an import or in code written in C
that takes long, such as a compiler, another thread removes what there is and ends the process.
"""

from __future__ import annotations

import _thread
import os
import signal
import sys
import threading
import time
import weakref
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from types import FrameType

from bellows_design.cli.early_signals import SIGNALS

Handler = Callable[[int, FrameType | None], None]

SAME_INTERRUPTION = 1.0
"""s. A second signal within that belongs to the first; it does not interrupt removing files."""

LONGEST = 1.0
"""s. So long a command may take to end by the exception of a signal."""

AGAIN = 0.05
"""s. A signal that comes at a bad moment is looked at again after that."""

UNINTERRUPTED = ("<frozen importlib", weakref.__file__)
"""Begin the names of files whose functions, and what they call, no signal interrupts."""


class Interrupted(KeyboardInterrupt):
    """A signal came. Libraries that let Ctrl-C through let this through as well."""

    def __init__(self, number: int) -> None:
        super().__init__(number)
        self.number = number


@dataclass
class Signals:
    """Signals that came while a command worked."""

    received: list[int] = field(default_factory=list)
    _latest: float = -SAME_INTERRUPTION

    def receive(self, number: int, frame: FrameType | None) -> None:
        """Raise ``Interrupted``: once for one interruption, where it does no harm."""
        if _must_end_first(frame):
            _repeat_soon(number)
            return
        now = time.monotonic()
        if now - self._latest >= SAME_INTERRUPTION:
            self._latest = now
            self.received.append(number)
            raise Interrupted(number)

    def forget(self) -> None:
        """The latest interruption was dropped: the next one counts, however soon it comes."""
        self._latest = -SAME_INTERRUPTION


@contextmanager
def raising_signals() -> Iterator[Signals]:
    """Within the block the signals raise ``Interrupted``; afterwards they do what they did."""
    signals = Signals()
    with _handled_by(signals.receive), _repeated_where_dropped(signals):
        yield signals


@contextmanager
def ended_in_time(leave: Callable[[int], object]) -> Iterator[None]:
    """Within the block, if a signal does not end it in time, call ``leave`` in another thread."""
    if not _handled_signals():
        yield
        return
    over, last_word, (reader, writer) = threading.Event(), threading.Lock(), os.pipe()
    os.set_blocking(writer, False)
    usual = signal.set_wakeup_fd(writer, warn_on_full_buffer=False)
    threading.Thread(target=_watch, args=(reader, over, last_word, leave), daemon=True).start()
    try:
        yield
    finally:
        with last_word:  # the other thread has it: the process is about to end
            over.set()
        signal.set_wakeup_fd(usual)
        os.close(writer)


def interruption_in(error: BaseException | None) -> int | None:
    """The signal behind ``error``, also where a C extension made an ImportError of it."""
    while error is not None and not isinstance(error, KeyboardInterrupt):
        error = error.__cause__ or error.__context__
    return None if error is None else int(getattr(error, "number", signal.SIGINT))


def _watch(
    reader: int,
    over: threading.Event,
    last_word: threading.Lock,
    leave: Callable[[int], object],
) -> None:
    """Wait for a signal, whose number comes through the pipe, and then for the end of the block."""
    with open(reader, "rb", buffering=0) as numbers:
        while number := numbers.read(1):
            if number[0] in SIGNALS and not over.wait(LONGEST):
                with last_word:
                    if not over.is_set():
                        leave(number[0])


def _must_end_first(frame: FrameType | None) -> bool:
    """True if ``frame`` serves an import or a finalizer.

    An exception crashes some modules written in C while they are imported; out of a finalizer it
    does not come, and what was to be released stays.
    """
    while frame is not None and not frame.f_code.co_filename.startswith(UNINTERRUPTED):
        frame = frame.f_back
    return frame is not None


def _repeat_soon(number: int) -> None:
    """Let the signal come again in a moment."""
    later = threading.Timer(AGAIN, _thread.interrupt_main, (number,))
    later.daemon = True
    later.start()


@contextmanager
def _repeated_where_dropped(signals: Signals) -> Iterator[None]:
    """Where Python drops exceptions (callbacks from C, ``__del__``), the signal comes again."""
    usual = sys.unraisablehook

    def repeat(dropped: sys.UnraisableHookArgs) -> None:
        if isinstance(dropped.exc_value, Interrupted):
            signals.forget()
            _repeat_soon(dropped.exc_value.number)
        else:
            usual(dropped)

    sys.unraisablehook = repeat
    try:
        yield
    finally:
        sys.unraisablehook = usual


@contextmanager
def _handled_by(handler: Handler) -> Iterator[None]:
    before = {number: signal.getsignal(number) for number in _handled_signals()}
    try:
        for number in before:
            signal.signal(number, handler)
        yield
    finally:
        for number, usual in before.items():
            signal.signal(number, usual)


def _handled_signals() -> tuple[int, ...]:
    """Signals to handle: none outside the main thread, and none that is to be ignored (nohup)."""
    if threading.current_thread() is not threading.main_thread():
        return ()
    usual = {number: signal.getsignal(number) for number in SIGNALS}
    return tuple(number for number, now in usual.items() if now not in (signal.SIG_IGN, None))
