"""Work for one process at a time: what waits, what runs, what has become stale.

Of one owner's jobs on one topic only the latest waits. A stale job that runs is asked to stop; if
it does not answer in time, its process is ended and a spare one takes over.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from itertools import count
from typing import Any, Literal

from bellows_design.studio.workers.handle import Handle
from solver.meshing.messages import Message

PATIENCE = 1.5
"""s. So long a job that was asked to stop may go on."""

MOST_ENDS = 3
"""Times in a row that a process may end before it has done anything; then no other is started."""

Outcome = Literal["done", "cancelled", "failed", "crashed"]

Event = Mapping[str, Any]

Arrays = Mapping[str, Any]

Listener = Callable[[Event, Arrays], None]
"""Is told what a job reports: plain values and arrays."""

CRASHED = "the process that computed this ended unexpectedly; another one was started"


def _nothing(_: Event, __: Arrays) -> None:
    pass


@dataclass(eq=False)
class Job:
    """Something to compute, for an ``owner``; ``topic`` tells which jobs replace each other."""

    owner: int
    topic: str
    task: str
    content: Mapping[str, Any]
    listener: Listener = _nothing
    arrays: Arrays = field(default_factory=dict)
    number: int = field(default_factory=count(1).__next__)
    stopping: bool = False
    outcome: asyncio.Future[tuple[Outcome, str]] = field(
        default_factory=lambda: asyncio.get_running_loop().create_future()
    )

    def end(self, outcome: Outcome, why: str = "") -> None:
        """Settle what became of it, once."""
        if not self.outcome.done():
            self.outcome.set_result((outcome, why))


class Lane:
    """A process, and the jobs for it. All methods are called in the event loop."""

    def __init__(self, tasks: str, spare: bool = False) -> None:
        """``tasks``: the module of what the process can do; ``spare``: keep a second one ready."""
        self._tasks, self._wants_spare = tasks, spare
        self._process: Handle | None = None
        self._spare: Handle | None = None
        self._waiting: list[Job] = []
        self._running: Job | None = None
        self._ends_in_a_row = 0
        self._closed = False
        self._holds = 0
        self._paused: Handle | None = None
        self.on_start: Callable[[], list[Job]] = list
        """Jobs that every new process is given first."""

    @property
    def busy(self) -> bool:
        """Whether a job runs."""
        return self._running is not None

    def start(self) -> None:
        """Start the process in advance."""
        if self._process is None and not self._closed:
            self._process, self._spare = self._spare or self._launched(), None
            self._waiting[:0] = self.on_start()

    def submit(self, job: Job) -> Job:
        """Queue a job; one of the same owner and topic that still waits is dropped for it."""
        self._drop(lambda each: (each.owner, each.topic) == (job.owner, job.topic))
        self._waiting.append(job)
        self._next()
        return job

    def cancel(self, owner: int, topics: tuple[str, ...] | None = None) -> None:
        """Drop what waits of an owner, and stop what runs; only of these topics, if they are given.

        A job that runs settles its outcome at once; its process is free once it has stopped.
        """

        def stale(job: Job) -> bool:
            return job.owner == owner and (topics is None or job.topic in topics)

        self._drop(stale)
        if self._running is not None and stale(self._running):
            self._stop(self._running)

    @contextmanager
    def held(self) -> Iterator[None]:
        """Within the block the job that runs gets no processor: something else is more urgent."""
        self._holds += 1
        if self._paused is None and self._running is not None and self._process is not None:
            self._paused = self._process
            self._paused.pause()
        try:
            yield
        finally:
            self._holds -= 1
            if not self._holds:
                self._go_on()

    def _go_on(self) -> None:
        if self._paused is not None:
            self._paused.resume()
            self._paused = None

    def close(self) -> None:
        """End all processes, and wait for that."""
        self._closed = True
        self._go_on()
        self._drop(lambda _: True)
        if self._running is not None:
            self._running.end("cancelled")
        processes = [each for each in (self._process, self._spare) if each is not None]
        self._process = self._spare = self._running = None
        for process in processes:
            process.end()
        for process in processes:
            process.end_now()

    @property
    def numbers(self) -> tuple[int, ...]:
        """Of the processes."""
        return tuple(each.number for each in (self._process, self._spare) if each is not None)

    def _next(self) -> None:
        if self._running is not None or not self._waiting or self._closed:
            return
        self.start()
        job = self._running = self._waiting.pop(0)
        assert self._process is not None
        values = {**job.content, "job": job.number, "task": job.task}
        self._process.send(Message(values, job.arrays))

    def _drop(self, unwanted: Callable[[Job], bool]) -> None:
        for job in [each for each in self._waiting if unwanted(each)]:
            self._waiting.remove(job)
            job.end("cancelled")

    def _stop(self, job: Job) -> None:
        job.end("cancelled")
        if job.stopping or self._process is None:
            return
        job.stopping = True
        self._process.send(Message({"cancel": job.number}))
        asyncio.get_running_loop().call_later(PATIENCE, self._replace_if_still, job)

    def _replace_if_still(self, job: Job) -> None:
        """End the process of a stale job that goes on, once another job waits for it."""
        if self._running is not job or self._process is None:
            return
        if not self._waiting or self._paused is self._process:
            asyncio.get_running_loop().call_later(PATIENCE, self._replace_if_still, job)
            return
        process, self._process, self._running = self._process, None, None
        process.end()
        self._next()

    def _launched(self) -> Handle:
        loop = asyncio.get_running_loop()

        def heard(message: Message | None) -> None:
            with suppress(RuntimeError):  # the loop has ended, and with it the studio
                loop.call_soon_threadsafe(self._heard, process, message)

        process = Handle(self._tasks, heard)
        return process

    def _heard(self, process: Handle, message: Message | None) -> None:
        if process is self._spare and message is None:
            self._spare = None
        if process is not self._process:
            return
        if message is None:
            self._ended(process)
        else:
            self._reported(message)

    def _reported(self, message: Message) -> None:
        job = self._running
        if job is None or message.values.get("job") != job.number:
            return
        event = message.values.get("event")
        if event is not None:
            if not job.outcome.done():
                job.listener(event, message.arrays)
            return
        job.end(message.values["outcome"], message.values.get("why", ""))
        self._running, self._ends_in_a_row = None, 0
        if self._wants_spare and self._spare is None:
            self._spare = self._launched()
        self._next()

    def _ended(self, process: Handle) -> None:
        """The process ended by itself: its job is lost, the others go on in another one."""
        self._process, job, self._running = None, self._running, None
        if self._paused is process:
            self._go_on()
        self._ends_in_a_row += 1
        process.end()
        if job is not None:
            job.end("crashed", CRASHED)
        if self._ends_in_a_row >= MOST_ENDS:
            words = process.last_words().splitlines()[-1:]
            why = f"the process for this does not start: {''.join(words) or 'it says nothing'}"
            for each in self._waiting:
                each.end("crashed", why)
            self._waiting.clear()
            self._ends_in_a_row = 0
            return
        if self._waiting:
            self._next()
        else:
            self.start()
            self._next()
