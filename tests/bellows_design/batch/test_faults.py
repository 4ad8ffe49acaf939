"""Whatever goes wrong in dask, whoever waits for the workers is told, and never waits for ever."""

from __future__ import annotations

import asyncio
from contextlib import asynccontextmanager, closing
from types import SimpleNamespace

import pytest

from bellows_design.batch.cluster import Cluster
from bellows_design.batch.question import Question
from bellows_design.batch.workers import installed_version
from bellows_design.design.shipped import load_design
from bellows_design.errors import ClusterError

FINGER = Question(load_design("finger"))
FAULTS = [RuntimeError("no such luck"), asyncio.CancelledError(), SystemExit(1)]
WORKERS = ("tcp://10.0.0.1:1", "tcp://10.0.0.2:1")


async def never() -> None:
    await asyncio.Event().wait()


class Client:
    """In the place of dask's: two workers that never answer; what is in ``faults`` is raised."""

    status = "running"
    workers = 1

    def __init__(self, **faults: BaseException) -> None:
        self.faults = faults
        self.versions: dict[str, object] = dict.fromkeys(WORKERS, installed_version())

    @asynccontextmanager
    async def connected(self):
        yield self

    def _at(self, name: str) -> None:
        if name in self.faults:
            raise self.faults[name]

    async def register_plugin(self, plugin):
        self._at("register")

    async def unregister_worker_plugin(self, name):
        self._at("unregister")

    async def nthreads(self):
        self._at("look")
        return dict.fromkeys(WORKERS, 1)

    async def run(self, function, on_error="raise"):
        self._at("run")
        for found in self.versions.values():
            if on_error == "raise" and isinstance(found, Exception):
                raise found
        return self.versions

    def submit(self, *_, **__):
        return SimpleNamespace(result=self._result, release=lambda: None)

    async def _result(self):
        self._at("result")
        await never()


@pytest.fixture(autouse=True)
def quick(monkeypatch):
    monkeypatch.setattr("bellows_design.batch.cluster.POLL_SECONDS", 0.01)


@pytest.mark.parametrize("fault", FAULTS, ids=repr)
@pytest.mark.parametrize("place", ["look", "result"])
def test_whoever_waits_is_told_of_every_fault(place, fault):
    client = Client()
    with closing(Cluster(object, client)) as cluster:
        if place == "look":
            waiting = cluster.submit(FINGER, 0)
            client.faults[place] = fault
        else:
            client.faults[place] = fault
            waiting = cluster.submit(FINGER, 0)
        for future in (waiting, cluster.submit(FINGER, 0)):
            with pytest.raises(ClusterError, match="cannot answer"):
                future.result(5)
        cluster._thread.join(5)
        with pytest.raises(ClusterError):
            cluster.submit(FINGER, 0).result(5)


def test_a_fault_of_the_end_keeps_nobody_waiting():
    with closing(Cluster(object, Client(unregister=RuntimeError("late")))) as cluster:
        waiting = cluster.submit(FINGER, 0)
    with pytest.raises(ClusterError, match="ended"):
        waiting.result(5)


@pytest.mark.parametrize("fault", FAULTS[:2], ids=repr)
@pytest.mark.parametrize("place", ["register", "look", "run"])
def test_a_fault_before_the_first_question_is_a_sentence(place, fault):
    with pytest.raises(ClusterError, match=f"cannot answer, {type(fault).__name__}"):
        Cluster(object, Client(**{place: fault}))


def test_a_worker_without_this_program_is_told_of():
    client = Client()
    client.versions[WORKERS[1]] = ModuleNotFoundError("No module named 'bellows_design'")
    with pytest.raises(ClusterError, match="No module named"):
        Cluster(object, client)


def test_a_worker_that_is_gone_has_no_version():
    client = Client()
    client.versions[WORKERS[1]] = OSError("closed")
    Cluster(object, client).close()


def test_a_scheduler_that_is_silent_at_the_beginning_is_told_of(monkeypatch):
    monkeypatch.setattr("bellows_design.batch.cluster.SILENCE_SECONDS", 0.05)
    for name in ("register_plugin", "run"):
        client = Client()
        setattr(client, name, lambda *_, **__: never())
        with pytest.raises(ClusterError, match=r"did not answer within 0\.05 s"):
            Cluster(object, client)
