"""Where the workers are: processes of this machine, or a scheduler that is there already."""

from __future__ import annotations

import logging
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from dataclasses import dataclass
from importlib import import_module
from importlib.util import find_spec
from typing import Any, Protocol

from bellows_design.errors import ClusterError, DesignError
from bellows_design.validation.quoting import quoted

LOOPBACK = "127.0.0.1"

CONNECT_SECONDS = 10.0
"""s. So long a scheduler may take to answer for the first time."""


class Place(Protocol):
    """Where workers are."""

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

    @asynccontextmanager
    async def connected(self) -> AsyncIterator[Any]:
        """A client of the new workers. Raises ``ClusterError``."""
        import dask

        from bellows_design.batch.workers import ENVIRONMENT

        distributed = _distributed()
        with dask.config.set({"distributed.nanny.pre-spawn-environ": ENVIRONMENT}):
            async with (
                distributed.LocalCluster(
                    n_workers=self.workers,
                    processes=True,
                    threads_per_worker=1,
                    host=LOOPBACK,
                    scheduler_kwargs={"dashboard": False, "dashboard_address": f"{LOOPBACK}:0"},
                    memory_limit=None,  # an evaluation has its own limit
                    silence_logs=logging.CRITICAL,
                    asynchronous=True,
                ) as cluster,
                distributed.Client(cluster, asynchronous=True) as client,
            ):
                yield client


@dataclass(frozen=True)
class Elsewhere:
    """The workers of a scheduler at an address such as ``tcp://host:8786``."""

    scheduler: str

    @asynccontextmanager
    async def connected(self) -> AsyncIterator[Any]:
        """A client of that scheduler. Raises ``ClusterError`` if none answers."""
        distributed = _distributed()
        try:
            client = await distributed.Client(
                self.scheduler, asynchronous=True, timeout=CONNECT_SECONDS
            )
        except (OSError, ValueError) as error:
            raise ClusterError(
                f"no scheduler answers at {quoted(self.scheduler)} within {CONNECT_SECONDS:g} s."
            ) from error
        async with client:
            yield client


def _distributed() -> Any:
    """The library, which carries no usable types, and speaks only of what is fatal."""
    logging.getLogger("distributed").setLevel(logging.CRITICAL)
    return import_module("distributed")
