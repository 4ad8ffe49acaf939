"""Worker processes that answer questions, on this machine or many: an executor on dask.distributed.

Each worker is given one question at once, and the next when it has answered. So where a worker
dies it is known at which question, and no other one is blamed.
"""

from __future__ import annotations

import asyncio
import signal
import threading
from collections.abc import AsyncIterator, Awaitable, Callable
from concurrent.futures import Future, InvalidStateError
from contextlib import asynccontextmanager, suppress
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any
from uuid import uuid4

from bellows_design.batch.answer import Answer, failed
from bellows_design.batch.places import Place, require_dask
from bellows_design.batch.question import Question
from bellows_design.errors import BellowsError, ClusterError

if TYPE_CHECKING:
    from bellows_design.batch.workers import Answerer, Answering

ALLOWED_FAILURES = 3
"""So many workers may die at a question; with one more it has failed."""

POLL_SECONDS = 0.25
"""s. Interval at which the scheduler is asked which workers are alive."""

SILENCE_SECONDS = 30.0
"""s. A scheduler that does not answer for so long is gone."""

WORKER_SECONDS = 120.0
"""s. So long all workers may be away: another one takes seconds to start."""

OTHERS_SECONDS = 10.0
"""s. So long the first workers are kept waiting for the others."""

END_SECONDS = 20.0
"""s. So long the end waits for workers; those that stay end with this process."""

RESUME = "finished results are kept, and the same command goes on from there"


@dataclass(eq=False)
class _Asked:
    """A question on its way, and how many workers died at it."""

    question: Question
    answer: Future[Answer] = field(default_factory=Future)
    deaths: int = 0


@dataclass(eq=False)
class _Lane:
    """Questions that wait for a worker, and the worker that knows the ones before."""

    address: str
    waiting: asyncio.Queue[_Asked] = field(default_factory=asyncio.Queue)


class Cluster:
    """An executor with a lane for each worker.

    A lane stays with its worker, which remembers what it solved; while that one is gone it takes
    any that is idle. All of dask runs in one event loop, in a thread of its own.
    """

    def __init__(
        self,
        make: Callable[[], Answerer],
        place: Place,
        allowed_failures: int = ALLOWED_FAILURES,
    ) -> None:
        """Workers answer by what ``make`` makes there, once in each; it goes there by pickle.

        Raises:
            DesignError: dask.distributed is not installed.
            ClusterError: There is no scheduler, no worker comes, or it has another version.
        """
        require_dask()
        self._make, self._place, self._allowed = make, place, allowed_failures
        self._lanes: list[_Lane] = []
        self._serving: set[asyncio.Task[None]] = set()
        self._alive: dict[str, asyncio.Event] = {}  # address -> that it is gone
        self._busy: set[str] = set()
        self._lock = threading.Lock()  # of the two below, which other threads use
        self._pending: set[_Asked] = set()
        self._ended: BellowsError | None = None
        self._begun: Future[None] = Future()
        self._thread = threading.Thread(target=self._run, name="cluster", daemon=True)
        self._thread.start()
        self._begun.result()

    @property
    def lanes(self) -> int:
        """As many as there were workers at once; more come with more workers."""
        return len(self._lanes)

    def submit(self, question: Question, lane: int) -> Future[Answer]:
        """Ask a lane, from any thread; it answers in the order of its questions.

        The future raises ``ClusterError`` where the scheduler is gone.
        """
        asked = _Asked(question)
        with self._lock:
            if self._ended is not None:
                asked.answer.set_exception(self._ended)
                return asked.answer
            self._pending.add(asked)
            queue = self._lanes[lane % len(self._lanes)].waiting
            self._loop.call_soon_threadsafe(queue.put_nowait, asked)
        return asked.answer

    def close(self) -> None:
        """Give up what is not answered, and end the workers that were started here."""
        self._end(ClusterError("the workers were ended."))
        self._thread.join(END_SECONDS)

    def _end(self, error: BellowsError) -> None:
        """Nobody answers any more: who waits is told why. The first reason counts."""
        with self._lock:
            if self._ended is None:
                self._ended = error
                with suppress(RuntimeError):  # its loop is closed
                    self._loop.call_soon_threadsafe(self._over.set)
            pending, self._pending = self._pending, set()
        for asked in pending:
            with suppress(InvalidStateError):  # it was answered just now
                asked.answer.set_exception(self._ended)

    def _run(self) -> None:
        """The thread of the event loop."""
        _leave_interruptions_to_the_main_thread()
        try:
            asyncio.run(self._work())
        except BaseException as error:  # of a thread: whoever waits hears of it, nobody else
            if self._begun.done():
                self._end(_faulty(error))
            else:
                self._begun.set_exception(_faulty(error))

    async def _work(self) -> None:
        from bellows_design.batch.workers import Answering

        self._loop, self._over = asyncio.get_running_loop(), asyncio.Event()
        self._loop.set_exception_handler(lambda *_: None)  # dask's own, of workers that are killed
        self._changed = asyncio.Condition()
        async with self._place.connected() as client:
            plugin = Answering(self._make)
            await _in_time(client.register_plugin(plugin))
            await self._meet_workers(client, plugin)
            self._begun.set_result(None)
            try:
                await self._watch(client, plugin)
            except BaseException as error:  # told while the loop lives
                self._end(_faulty(error))
                raise
            finally:
                for task in self._serving:
                    task.cancel()
                if client.status == "running":
                    await client.unregister_worker_plugin(plugin.name)

    async def _meet_workers(self, client: Any, plugin: Answering) -> None:
        """Wait for the workers. Raises ``ClusterError`` if none comes, or one is none of ours."""
        waited = 0.0
        while len(self._lanes) < (1 if waited > OTHERS_SECONDS else self._place.workers):
            await self._look(client, plugin)
            if waited > WORKER_SECONDS:
                raise ClusterError(f"no worker came within {WORKER_SECONDS:g} s.")
            await asyncio.sleep(POLL_SECONDS)
            waited += POLL_SECONDS
        await _require_own_version(client)

    async def _watch(self, client: Any, plugin: Answering) -> None:
        """Keep up with the workers until the end. Raises ``ClusterError`` if all stay away."""
        seen = self._loop.time()
        while not self._over.is_set():
            await self._look(client, plugin)
            now = self._loop.time()
            seen = now if self._alive else seen
            if now - seen > WORKER_SECONDS:
                raise ClusterError(f"all workers are gone; {RESUME}.")
            with suppress(TimeoutError):
                await asyncio.wait_for(self._over.wait(), POLL_SECONDS)

    async def _look(self, client: Any, plugin: Answering) -> None:
        """Find out which workers are alive; those beyond the lanes get another one."""
        addresses = await _addresses(client)
        for address in self._alive.keys() - addresses:
            self._gone(address)
        for address in addresses - self._alive.keys():
            self._alive[address] = asyncio.Event()
            if len(self._alive) > len(self._lanes):
                self._lanes.append(_Lane(address))
                serve = self._serve(self._lanes[-1], client, plugin.name)
                self._serving.add(asyncio.create_task(serve))
        async with self._changed:
            self._changed.notify_all()

    def _gone(self, address: str) -> None:
        event = self._alive.pop(address, None)
        if event is not None:
            event.set()

    async def _serve(self, lane: _Lane, client: Any, plugin: str) -> None:
        """Have the questions of a lane answered, one after the other."""
        try:
            while True:
                asked = await lane.waiting.get()
                if not asked.answer.done():  # by the end, or as nobody waits for it any more
                    asked.answer.set_running_or_notify_cancel()
                while not asked.answer.done():
                    async with self._worker_of(lane) as address:
                        await self._ask(client, plugin, address, asked)
                with self._lock:
                    self._pending.discard(asked)
        except (Exception, asyncio.CancelledError) as error:
            self._end(_faulty(error))  # says nothing new where the end cancelled it
            raise

    @asynccontextmanager
    async def _worker_of(self, lane: _Lane) -> AsyncIterator[str]:
        """The address of a worker for one question, which has no other one meanwhile."""
        async with self._changed:
            await self._changed.wait_for(lambda: self._idle(lane))
            address = self._idle(lane)
        self._busy.add(address)
        if lane.address not in self._alive and address not in self._owned():
            lane.address = address
        try:
            yield address
        finally:
            self._busy.discard(address)
            async with self._changed:
                self._changed.notify_all()

    def _idle(self, lane: _Lane) -> str:
        """An idle worker: the lane's own, else one that belongs to none, else any; '' if none."""
        if lane.address in self._alive and lane.address not in self._busy:
            return lane.address
        if lane.address in self._alive:
            return ""  # another lane has borrowed it for a question
        idle = [address for address in self._alive if address not in self._busy]
        owned = self._owned()
        return next((address for address in idle if address not in owned), "".join(idle[:1]))

    def _owned(self) -> set[str]:
        return {lane.address for lane in self._lanes}

    async def _ask(self, client: Any, plugin: str, address: str, asked: _Asked) -> None:
        """Ask one worker; where it dies nothing is answered, unless too many did."""
        from distributed import KilledWorker

        from bellows_design.batch.workers import answer

        task = client.submit(
            answer, asked.question, plugin, key=f"answer-{uuid4().hex}", pure=False,
            workers=[address], allow_other_workers=False,
        )  # fmt: skip
        found = asyncio.ensure_future(_result(task))
        gone = asyncio.ensure_future(self._alive[address].wait())
        try:
            await asyncio.wait({found, gone}, return_when=asyncio.FIRST_COMPLETED)
            if found.done() and not isinstance(found.exception(), KilledWorker):
                asked.answer.set_result(found.result())
                return
        finally:
            found.cancel()
            gone.cancel()
            task.release()
        self._gone(address)
        asked.deaths += 1
        if asked.deaths > self._allowed:
            reason = f"its worker died {asked.deaths} times."
            asked.answer.set_result(failed(asked.question, reason))


async def _result(task: Any) -> Answer:
    """What dask found. Raises ``ClusterError`` where it dropped the task: its scheduler is gone."""
    from concurrent.futures import CancelledError

    try:
        found: Answer = await task.result()
    except CancelledError as error:
        raise ClusterError(f"the scheduler dropped a question; {RESUME}.") from error
    return found


async def _require_own_version(client: Any) -> None:
    """Raise ``ClusterError`` for a worker that has another version of this program."""
    from bellows_design.batch.workers import installed_version

    own = installed_version()
    found = await _in_time(client.run(installed_version, on_error="return"))
    for address, version in found.items():
        if isinstance(version, OSError):  # it is gone; the next one registers anew
            continue
        if isinstance(version, Exception):
            raise version
        if version != own:
            raise ClusterError(
                f"the worker at {address} has version {version} of bellows-design, this "
                f"process {own}; they must be the same."
            )


async def _in_time(work: Awaitable[Any]) -> Any:
    """What the scheduler says. Raises ``ClusterError`` if it does not answer."""
    try:
        return await asyncio.wait_for(work, SILENCE_SECONDS)
    except TimeoutError as error:
        raise ClusterError(
            f"the scheduler or a worker did not answer within {SILENCE_SECONDS:g} s; {RESUME}."
        ) from error


async def _addresses(client: Any) -> set[str]:
    """Of the workers that are alive. Raises ``ClusterError`` if the scheduler does not answer."""
    try:
        if client.status == "running":
            return set(await asyncio.wait_for(client.nthreads(), SILENCE_SECONDS))
    except (OSError, TimeoutError):
        pass
    raise ClusterError(f"the scheduler is gone; {RESUME}.")


def _faulty(error: BaseException) -> BellowsError:
    """The sentence for what went wrong in dask, or in a worker outside of an evaluation."""
    if isinstance(error, BellowsError):
        return error
    what = f"{type(error).__name__}: {error}" if str(error) else type(error).__name__
    return ClusterError(f"a worker cannot answer, {what}; {RESUME}.")


def _leave_interruptions_to_the_main_thread() -> None:
    """Ctrl-C reaches all processes on a terminal: workers, which inherit this, do not hear it.

    They end with this process, where each of them would print where it was interrupted.
    """
    from multiprocessing import resource_tracker

    if hasattr(signal, "pthread_sigmask"):
        resource_tracker.ensure_running()  # later it would let SIGINT through again
        signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})


def release_semaphores() -> None:
    """Give back the semaphores of the queues to workers, where the process ends at once.

    Python does so at its own end. Otherwise its process that looks after them complains on stderr
    that they leaked.
    """
    from multiprocessing import synchronize, util  # loaded with dask.distributed

    cleanup = getattr(synchronize.SemLock, "_cleanup", None)
    for finalizer in list(getattr(util, "_finalizer_registry", {}).values()):
        if cleanup is not None and getattr(finalizer, "_callback", None) is cleanup:
            with suppress(OSError, RuntimeError):  # it is gone, or just being given back
                finalizer()
