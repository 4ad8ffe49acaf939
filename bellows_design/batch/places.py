"""Where the workers are: processes of this machine, or a scheduler that is there already."""

from __future__ import annotations

import asyncio
import logging
import math
import os
import socket
from collections.abc import AsyncIterator, Coroutine, Iterable, Iterator
from contextlib import asynccontextmanager, contextmanager, suppress
from dataclasses import dataclass
from importlib import import_module
from importlib.util import find_spec
from typing import Any, Protocol
from urllib.parse import urlsplit

from bellows_design.budget import LEAST_MEMORY, Budget, default_memory
from bellows_design.errors import ClusterError, DesignError
from bellows_design.machine import memory_gib
from bellows_design.validation.quoting import quoted

LOOPBACK = "127.0.0.1"

MOST_WORKERS = 1000
"""On one machine."""

WORKER_GIB = 2.0
"""Memory of a worker: 1.67 GiB were measured with two neighbourhoods around ``finger``; a session
keeps three."""

LISTEN_SECONDS = 3.0
"""s. So long it is tried whether anything listens at an address."""

LOOK_SECONDS, RESTART_SECONDS = 0.5, 15.0
"""s. How often it is looked whether a worker process lives, and how long dask may take to start it
again before another one is started."""

CONNECT_SECONDS = 10.0
"""s. So long a scheduler may take to answer for the first time."""


class Place(Protocol):
    """Where workers are."""

    @property
    def workers(self) -> int:
        """How many to wait for at the beginning."""

    def connected(self) -> Any:
        """An asynchronous context with a client of dask, to be entered in a running loop."""


def require_dask() -> None:
    """Raise ``DesignError`` if it is not installed. Imports nothing."""
    if find_spec("distributed") is None:
        raise DesignError(
            "several workers need dask.distributed, which comes with the extra “studies”: "
            "pip install -e '.[studies]'; or use --workers 0."
        )


@dataclass(frozen=True)
class ThisMachine:
    """So many worker processes, which end with this one, and listen on the loopback only."""

    workers: int

    @classmethod
    def of(cls, workers: int | None) -> ThisMachine:
        """So many workers; without a number one for each processor, if the memory suffices.

        Raises ``DesignError`` for a number that is out of bounds.
        """
        if workers is None:
            memory = memory_gib() or math.inf
            return cls(max(1, min(_processors(), int(min(memory / WORKER_GIB, MOST_WORKERS)))))
        if not 1 <= workers <= MOST_WORKERS:
            raise DesignError(f"--workers is {workers} but must be 0 to {MOST_WORKERS}.")
        return cls(workers)

    @property
    def budget(self) -> Budget:
        """Of an evaluation in one of them: its part of the machine's memory."""
        return Budget(memory=max(LEAST_MEMORY, default_memory() / self.workers))

    @asynccontextmanager
    async def connected(self) -> AsyncIterator[Any]:
        """A client of a scheduler in this process; workers come as soon as they are started."""
        import dask

        from bellows_design.batch.workers import ENVIRONMENT

        distributed = _distributed()
        with (
            _environment_restored((*ENVIRONMENT, "PYTHONHASHSEED")),
            dask.config.set({"distributed.nanny.pre-spawn-environ": ENVIRONMENT}),
        ):
            async with (
                distributed.Scheduler(
                    host=LOOPBACK, port=0, dashboard=False, dashboard_address=f"{LOOPBACK}:0"
                ) as scheduler,
                distributed.Client(scheduler.address, asynchronous=True) as client,
                _in_background(_worker(scheduler.address) for _ in range(self.workers)),
            ):
                yield client


@dataclass(frozen=True)
class Elsewhere:
    """The workers of a scheduler at an address such as ``tcp://host:8786``."""

    scheduler: str
    workers: int = 1

    def require_listening(self) -> None:
        """Try it at once, before anything is written or computed.

        Raises ``DesignError`` for what is no address, ``ClusterError`` where nothing listens.
        """
        no_address = DesignError(
            f"--scheduler is {quoted(self.scheduler)} but must be an address such as "
            "tcp://host:8786."
        )
        try:
            address = urlsplit(self.scheduler if "://" in self.scheduler else f"//{self.scheduler}")
            host, port = address.hostname, address.port
        except ValueError:
            raise no_address from None
        if not host or not port or address.scheme not in ("", "tcp", "tls"):
            raise no_address
        try:
            socket.create_connection((host, port), LISTEN_SECONDS).close()
        except ValueError:  # no name that a host can have, as one with an empty part
            raise no_address from None
        except OSError as error:
            raise ClusterError(
                f"no scheduler listens at {quoted(self.scheduler)}: {error.strerror or error}."
            ) from error

    @asynccontextmanager
    async def connected(self) -> AsyncIterator[Any]:
        """A client of that scheduler. Raises ``ClusterError`` if none answers."""
        with self._refusals():
            client = _distributed().Client(
                self.scheduler, asynchronous=True, timeout=CONNECT_SECONDS
            )
            try:  # its own time does not count where something else listens and says nothing
                await asyncio.wait_for(_ready(client), CONNECT_SECONDS)
            except Exception:
                with suppress(Exception):
                    await asyncio.wait_for(client.close(), LOOK_SECONDS)
                raise
        async with client:
            yield client

    @contextmanager
    def _refusals(self) -> Iterator[None]:
        """Within the block what dask raises becomes ``ClusterError``."""
        try:
            yield
        except (OSError, ValueError, TimeoutError) as error:
            raise ClusterError(
                f"no scheduler answers at {quoted(self.scheduler)} within {CONNECT_SECONDS:g} s."
            ) from error
        except (TypeError, RuntimeError) as error:  # without certificates, or with unusable ones
            reason = " ".join(str(error).split()).rstrip(".")
            raise ClusterError(
                f"the scheduler at {quoted(self.scheduler)} cannot be connected to: {reason}."
            ) from error


async def _ready(client: Any) -> None:
    await client


@contextmanager
def _environment_restored(names: Iterable[str]) -> Iterator[None]:
    """After the block these are as before: dask sets them here too, whenever it starts a worker."""
    before = {name: os.environ.get(name) for name in names}
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                os.environ.pop(name, None)
            else:
                os.environ[name] = value


async def _worker(scheduler: str) -> None:
    """Keep a worker process alive: dask starts it again, but for one that died while it began."""
    while True:
        with suppress(Exception):
            async with _distributed().Nanny(
                scheduler,
                nthreads=1,
                host=LOOPBACK,
                memory_limit=None,  # an evaluation has its own
                dashboard=False,
                silence_logs=logging.CRITICAL,
            ) as nanny:
                away = 0.0
                while away < RESTART_SECONDS:
                    await asyncio.sleep(LOOK_SECONDS)
                    alive = nanny.process is not None and nanny.process.is_alive()
                    away = 0.0 if alive else away + LOOK_SECONDS
        await asyncio.sleep(LOOK_SECONDS)


@asynccontextmanager
async def _in_background(works: Iterable[Coroutine[Any, Any, None]]) -> AsyncIterator[None]:
    """Within the block they go on; then they are cancelled, and have ended after it."""
    tasks = [asyncio.create_task(work) for work in works]
    try:
        yield
    finally:
        for task in tasks:
            task.cancel()
        await asyncio.gather(*tasks, return_exceptions=True)


def _distributed() -> Any:
    """The library, which carries no usable types, and speaks only of what is fatal."""
    logging.getLogger("distributed").setLevel(logging.CRITICAL)
    return import_module("distributed")


def _processors() -> int:
    """Those that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1
