"""A process that computes for the studio: ``python -m bellows_design.studio.workers.main MODULE``.

MODULE has a function ``tasks()``: names -> functions of values, arrays and a report.

Jobs come through stdin, what they report goes to stdout, both as ``solver.meshing.messages``. A
second thread reads, so that a job can be told to stop while it runs. Libraries in C that print to
stdout reach stderr. The end of stdin is the end of the process, in whatever it is.
"""

from __future__ import annotations

import os
import signal
import sys
import threading
from collections.abc import Callable
from contextlib import suppress
from importlib import import_module
from io import FileIO
from queue import SimpleQueue
from typing import Any

from bellows_design.studio.workers.reporting import Arrays, Cancelled, Report, Send
from solver.meshing.messages import Message, receive, send

PARENT_DEATH_SIGNAL = 1
"""PR_SET_PDEATHSIG of Linux's <sys/prctl.h>."""

Task = Callable[[dict[str, Any], dict[str, Any], Report], None]


class Desk:
    """What comes in: jobs in their order, and which of them became stale."""

    def __init__(self, stream: FileIO) -> None:
        self.jobs: SimpleQueue[Message] = SimpleQueue()
        self._stale: dict[int, threading.Event] = {}
        self._lock = threading.Lock()
        threading.Thread(target=self._read, args=(stream,), daemon=True).start()

    def stale(self, job: int) -> threading.Event:
        """Set once the job is cancelled."""
        with self._lock:
            return self._stale.setdefault(job, threading.Event())

    def forget(self, job: int) -> None:
        """The job has ended."""
        with self._lock:
            self._stale.pop(job, None)

    def _read(self, stream: FileIO) -> None:
        while (message := receive(stream)) is not None:
            if "cancel" in message.values:
                self.stale(message.values["cancel"]).set()
            else:
                self.jobs.put(message)
        _leave()


def main() -> None:
    """Do one job after the other."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    _wake_with_the_end_of_the_server()
    requests, results = FileIO(os.dup(0), "r"), FileIO(os.dup(1), "w")
    os.dup2(2, 1)
    sys.stdout = sys.stderr
    desk = Desk(requests)
    tasks: dict[str, Task] = import_module(sys.argv[1]).tasks()
    while True:
        message = desk.jobs.get()
        number = message.values["job"]
        outcome, why = _done(tasks, message, Report(_sender(results, number), desk.stale(number)))
        desk.forget(number)
        send(results, Message({"job": number, "outcome": outcome, "why": why}))


def _wake_with_the_end_of_the_server() -> None:
    """Should the server be killed while this process is halted, the end of stdin is noticed."""
    if sys.platform == "linux":
        import ctypes

        with suppress(OSError, AttributeError):
            ctypes.CDLL(None).prctl(PARENT_DEATH_SIGNAL, signal.SIGCONT)


def _done(tasks: dict[str, Task], message: Message, report: Report) -> tuple[str, str]:
    """Do a job; its outcome, and a sentence if it failed."""
    try:
        report.require_wanted()
        tasks[message.values["task"]](dict(message.values), dict(message.arrays), report)
    except Cancelled:
        return "cancelled", ""
    except Exception as error:
        return "failed", _sentence(error)
    return "done", ""


def _sentence(error: Exception) -> str:
    """One sentence for people."""
    from bellows_design.errors import BellowsError
    from printers.errors import PrintersError
    from solver.errors import MeshingError, SolverError

    if isinstance(error, BellowsError | PrintersError | MeshingError | SolverError | OSError):
        return str(error)
    import traceback

    traceback.print_exception(error)
    return f"internal error, {type(error).__name__}: {str(error)[:300]}"


def _sender(results: FileIO, job: int) -> Send:
    lock = threading.Lock()

    def send_event(event: dict[str, Any], arrays: Arrays) -> None:
        with lock:
            send(results, Message({"job": job, "event": event}, arrays))

    return send_event


def _leave() -> None:
    """The server is gone or wants it: remove what is unfinished and end at once."""
    for module, function in (
        ("solver.meshing.process", "kill"),
        ("bellows_design.files.atomic", "remove_unfinished"),
    ):
        if module in sys.modules:  # the main thread may be importing it: to import it would wait
            getattr(sys.modules[module], function, int)()
    os._exit(0)


if __name__ == "__main__":
    main()
