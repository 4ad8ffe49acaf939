"""Where workers are: addresses that cannot be used, and what this process keeps of its own."""

from __future__ import annotations

import asyncio
import os
from contextlib import asynccontextmanager
from types import SimpleNamespace

import pytest

from bellows_design.batch.places import Elsewhere, ThisMachine
from bellows_design.batch.workers import ENVIRONMENT
from bellows_design.errors import ClusterError

NAMES = (*ENVIRONMENT, "PYTHONHASHSEED")


def test_a_scheduler_that_wants_certificates_which_there_are_not_is_told_of():
    async def connect():
        async with Elsewhere("tls://127.0.0.1:8786").connected():
            pass

    with pytest.raises(ClusterError, match="cannot be connected to: TLS") as refused:
        asyncio.run(connect())
    assert len(str(refused.value).splitlines()) == 1


@asynccontextmanager
async def something(*_, **__):
    yield SimpleNamespace(address="tcp://127.0.0.1:1")


def spoiling(begun):
    """In the place of dask's nanny, which sets the environment of this process as well."""

    @asynccontextmanager
    async def nanny(*_, **__):
        os.environ.update(dict.fromkeys(NAMES, "1"))
        begun.set()
        yield SimpleNamespace(process=SimpleNamespace(is_alive=lambda: True))

    return nanny


@pytest.mark.parametrize("fails", [False, True])
def test_this_process_keeps_its_own_environment_and_threads(monkeypatch, fails):
    monkeypatch.setenv("OMP_NUM_THREADS", "7")
    for name in NAMES[1:]:
        monkeypatch.delenv(name, raising=False)

    async def connect():
        begun = asyncio.Event()
        fake = SimpleNamespace(Scheduler=something, Client=something, Nanny=spoiling(begun))
        monkeypatch.setattr("bellows_design.batch.places._distributed", lambda: fake)
        async with ThisMachine(1).connected():
            await begun.wait()
            if fails:
                raise RuntimeError

    try:
        asyncio.run(connect())
    except RuntimeError:
        assert fails
    assert {name: os.environ.get(name) for name in NAMES} == {
        **dict.fromkeys(NAMES),
        "OMP_NUM_THREADS": "7",
    }
