"""One process that computes, as the server holds it: started, written to, listened to, ended."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import threading
from collections.abc import Callable
from contextlib import suppress
from io import FileIO
from queue import SimpleQueue
from typing import Any, cast

from solver.meshing.messages import Message, receive, send

MODULE = "bellows_design.studio.workers.main"

LAST_WORDS = 2000
"""Bytes of what a process wrote to stderr that are kept when it ends by itself."""

EXIT_SECONDS = 2.0
"""Time to remove what is unfinished, after which the process is killed."""

Heard = Callable[[Message | None], None]
"""Is called with every message, and with None at the end, in another thread."""


class Handle:
    """A running process; see ``workers.main``.

    It has a session of its own, so that Ctrl-C in the terminal meets the server alone, and ends by
    itself once the server is gone, however that ends.
    """

    def __init__(self, tasks: str, heard: Heard) -> None:
        """``tasks``: the module of what it can do."""
        self._errors = tempfile.TemporaryFile()  # noqa: SIM115
        self._process = _launched(tasks, self._errors.fileno())
        self._requests: SimpleQueue[Message | None] = SimpleQueue()
        self._halted: list[Any] = []
        self._spoke = False
        for work in (self._write, lambda: self._listen(heard)):
            threading.Thread(target=work, daemon=True).start()

    @property
    def number(self) -> int:
        """Of the process."""
        return self._process.pid

    def send(self, message: Message) -> None:
        """Send without waiting."""
        self._requests.put(message)

    def pause(self) -> None:
        """Halt the process and those it started, until ``resume``.

        Only on Linux, where one that is halted is woken when the server is killed, and so ends as
        well; elsewhere it goes on. So does one that has said nothing yet: it may still be loading
        what wakes it.
        """
        if sys.platform == "linux" and self._spoke and self._process.poll() is None:
            self._halted = _family(self._process.pid)
            _each(self._halted, "suspend")

    def resume(self) -> None:
        """Let them go on, also those that outlived the process."""
        _each(self._halted, "resume")
        self._halted = []

    def end(self) -> None:
        """End the process and those it started, without waiting. It is not paused."""
        self._requests.put(None)
        threading.Thread(target=self._end, daemon=True).start()

    def end_now(self) -> None:
        """The same, and wait for it."""
        self._requests.put(None)
        self._end()

    def last_words(self) -> str:
        """The end of what the process wrote to stderr."""
        with suppress(OSError, ValueError):
            size = self._errors.seek(0, os.SEEK_END)
            self._errors.seek(max(0, size - LAST_WORDS))
            return self._errors.read().decode("utf-8", "replace").strip()
        return ""

    def _end(self) -> None:
        """Close its input, upon which it leaves in order; kill it with its children if not."""
        with suppress(subprocess.TimeoutExpired):
            self._process.wait(EXIT_SECONDS)
        if self._process.poll() is None:
            _each(_family(self._process.pid), "kill")
            self._process.wait()

    def _write(self) -> None:
        stream = cast(FileIO, self._process.stdin)
        while (message := self._requests.get()) is not None:
            try:
                send(stream, message)
            except OSError:
                break
        with suppress(OSError):
            stream.close()

    def _listen(self, heard: Heard) -> None:
        stream = cast(FileIO, self._process.stdout)
        while (message := receive(stream)) is not None:
            self._spoke = True
            heard(message)
        self._process.wait()
        heard(None)


def _launched(tasks: str, errors: int) -> subprocess.Popen[bytes]:
    """With the module search path of this process; -P: nothing from the current folder."""
    places = os.pathsep.join(os.path.abspath(place) for place in sys.path if place)
    return subprocess.Popen(
        [sys.executable, "-P", "-m", MODULE, tasks],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=errors,
        bufsize=0,
        env={**os.environ, "PYTHONPATH": places},
        start_new_session=True,
        creationflags=getattr(subprocess, "CREATE_NEW_PROCESS_GROUP", 0),
    )


def _family(number: int) -> list[Any]:
    """A process and all it started, as ``psutil.Process``, itself last."""
    import psutil

    with suppress(psutil.Error):
        process = psutil.Process(number)
        return [*process.children(recursive=True), process]
    return []


def _each(family: list[Any], action: str) -> None:
    """Call a method of each; none is mistaken for a later process of the same number."""
    import psutil

    for each in family:
        with suppress(psutil.Error):
            getattr(each, action)()
