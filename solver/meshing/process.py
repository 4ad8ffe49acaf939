"""Gmsh in a process of its own, which can be ended, and whose crash does not end the program.

One such process makes all meshes of a program, one after the other. It is started in advance by
``start``, or with the first mesh. It ends with the program, however that ends. It gets no Ctrl-C of
a terminal: the program, which is interrupted, ends it.
"""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
import weakref
from collections.abc import Iterator, Sequence
from contextlib import suppress
from functools import cache
from io import FileIO
from pathlib import Path
from queue import Empty, SimpleQueue
from typing import IO, cast

from solver.meshing.limits import cause_of_end
from solver.meshing.messages import Message, receive, send

DEFAULT_SECONDS = 120.0
"""Time limit of one mesh, s. The largest that fits into 8 GiB takes half of that."""

POLL_SECONDS = 0.2
"""Interval, s, at which a waiting program checks for interrupts that do not end the wait."""

EXIT_SECONDS = 2.0
"""Time, s, to clean up and exit, after which the process is killed."""


class MesherTimeout(Exception):
    """The mesh was not finished in time; the process was ended."""


class MesherCrash(Exception):
    """The process ended by itself; the message says how.

    Attributes:
        cause: A sentence on what ended it if that was not the solid; None if it may have been.
    """

    def __init__(self, how: str, cause: str | None = None) -> None:
        super().__init__(how)
        self.cause = cause


def start() -> None:
    """Start the process, which then loads Gmsh in parallel to the program."""
    _mesher(os.getpid()).start()


def ask(job: Message, seconds: float) -> Message:
    """The process's answer to ``job``; calls of several threads take turns.

    Raises ``MesherTimeout`` after ``seconds`` and ``MesherCrash``; the next job gets a new process.
    """
    return _mesher(os.getpid()).ask(job, seconds)


def kill() -> None:
    """Kill the process and remove its folder: this program ends at once, by any of its threads."""
    _mesher(os.getpid()).kill()


@cache
def _mesher(process: int) -> _Mesher:
    """The mesher of this program; a forked copy of the program gets its own."""
    return _Mesher()


class _Mesher:
    """Keeps one process running, and starts another after a failure."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._process: _Process | None = None

    def start(self) -> int:
        with self._lock:
            return self._running().number

    def ask(self, job: Message, seconds: float) -> Message:
        with self._lock:
            process = self._running()
            try:
                return process.ask(job, seconds)
            except (
                BaseException
            ):  # an interrupt too: its answer would be taken for that of the next job
                self._process = None
                process.end()
                raise

    def kill(self) -> None:
        process = self._process  # another thread, which waits for an answer, has the lock
        if process is not None:
            process.kill()

    def _running(self) -> _Process:
        if self._process is None or not self._process.alive:
            if self._process is not None:
                self._process.end()
            self._process = _Process()
        return self._process


class _Process:
    """One process, its pipes and its folder."""

    def __init__(self) -> None:
        self._folder = Path(tempfile.mkdtemp(prefix="solver-mesher-"))
        try:
            self._process = _launched(self._folder)
        except BaseException:
            shutil.rmtree(self._folder, ignore_errors=True)
            raise
        self._requests = cast(FileIO, self._process.stdin)
        self._answers: SimpleQueue[Message | None] = SimpleQueue()
        listener = threading.Thread(
            target=_queue_answers, args=(self._process.stdout, self._answers), daemon=True
        )
        listener.start()
        self.end = weakref.finalize(self, _end, os.getpid(), self._process, self._folder, listener)

    @property
    def number(self) -> int:
        return self._process.pid

    @property
    def alive(self) -> bool:
        return self._process.poll() is None

    def kill(self) -> None:
        self._process.kill()
        self._process.wait()
        shutil.rmtree(self._folder, ignore_errors=True)

    def ask(self, job: Message, seconds: float) -> Message:
        deadline = time.monotonic() + seconds
        with suppress(OSError):  # it ended before it had read all, and so ends the queue of answers
            send(self._requests, job)
        answer = self._awaited(deadline)
        if answer is None:
            how = self._exit_description()
            raise MesherCrash(how, cause_of_end(how))
        return answer

    def _awaited(self, deadline: float) -> Message | None:
        while (rest := deadline - time.monotonic()) > 0:
            try:
                return self._answers.get(timeout=min(rest, POLL_SECONDS))
            except Empty:
                continue
        raise MesherTimeout

    def _exit_description(self) -> str:
        """How the process ended, as text."""
        try:
            status = self._process.wait(EXIT_SECONDS)
        except subprocess.TimeoutExpired:
            return "it closed its output"
        if status < 0:
            return signal.Signals(-status).name
        errors = (self._folder / "stderr.txt").read_text("utf-8", "replace").strip().splitlines()
        return f"exit status {status:#x}" + (f": {errors[-1][:200]}" if errors else "")


def _launched(folder: Path) -> subprocess.Popen[bytes]:
    """A process in a session of its own, with the module search path of this one."""
    places = os.pathsep.join(_absolute(sys.path))
    with (folder / "stderr.txt").open("wb") as errors:
        return subprocess.Popen(
            # -P: nothing from the current folder, which may hold a file of any name
            [sys.executable, "-P", "-m", "solver.meshing.worker", str(folder)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=errors,
            bufsize=0,
            env={**_environment(), "PYTHONPATH": places, "OPENBLAS_NUM_THREADS": "1"},
            start_new_session=True,
            creationflags=getattr(subprocess, "CREATE_NEW_PROCESS_GROUP", 0),
        )


def _environment() -> dict[str, str]:
    """This process's; warnings of Gmsh's libraries are no reason to stop."""
    return {name: value for name, value in os.environ.items() if name != "PYTHONWARNINGS"}


def _absolute(places: Sequence[str]) -> Iterator[str]:
    """Absolute paths; relative ones lead nowhere once the working folder was deleted."""
    for place in places:
        with suppress(FileNotFoundError):
            yield os.path.abspath(place)


def _queue_answers(stream: IO[bytes], answers: SimpleQueue[Message | None]) -> None:
    """Queue the process's answers, and None after the last."""
    while (answer := receive(cast(FileIO, stream))) is not None:
        answers.put(answer)
    answers.put(None)


def _end(
    owner: int, process: subprocess.Popen[bytes], folder: Path, listener: threading.Thread
) -> None:
    """End the process and remove its folder; not in a forked copy of its owner."""
    if os.getpid() != owner:
        return
    assert process.stdin is not None and process.stdout is not None
    process.stdin.close()  # on which it exits by itself, also while it makes a mesh
    try:
        process.wait(EXIT_SECONDS)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()
    listener.join(EXIT_SECONDS)
    process.stdout.close()
    shutil.rmtree(folder, ignore_errors=True)
