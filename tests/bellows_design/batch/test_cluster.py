"""Worker processes of this machine: where they listen, their threads, how faults are told."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from contextlib import closing

import psutil
import pytest
from answering_stub import Faulty, Threads, stub

from bellows_design.batch.cluster import Cluster
from bellows_design.batch.places import MOST_WORKERS, Elsewhere, ThisMachine
from bellows_design.batch.question import Question
from bellows_design.budget import LEAST_MEMORY
from bellows_design.design.shipped import load_design
from bellows_design.design.variation import varied
from bellows_design.errors import BellowsError, ClusterError, DesignError

FINGER = Question(load_design("finger"))


def questions(number: int) -> list[Question]:
    widths = [19.0 + 0.01 * step for step in range(number)]
    return [Question(varied(FINGER.design, {"bubble_width": width})) for width in widths]


@pytest.mark.slow
def test_lanes_keep_to_their_workers_which_listen_on_the_loopback_only(monkeypatch):
    monkeypatch.setattr("bellows_design.batch.cluster.OTHERS_SECONDS", 100.0)  # on a busy machine
    with closing(Cluster(stub(0.02), ThisMachine(2))) as cluster:
        assert cluster.lanes == 2
        asked = [(place % 2, cluster.submit(q, place % 2)) for place, q in enumerate(questions(20))]
        workers = {(lane, future.result().max_von_mises_mpa) for lane, future in asked}
        this = psutil.Process(os.getpid())
        ports = [
            connection.laddr.ip
            for process in (this, *this.children(recursive=True))
            for connection in process.net_connections("inet")
            if connection.status == psutil.CONN_LISTEN
        ]
    assert len(workers) == len({process for _, process in workers}) == 2
    assert ports and set(ports) == {"127.0.0.1"}
    assert not psutil.Process(os.getpid()).children(recursive=True) or all(
        not psutil.pid_exists(int(process)) for _, process in workers
    )


@pytest.mark.slow
@pytest.mark.skipif(os.name != "posix", reason="only there a terminal interrupts a whole group")
def test_a_worker_does_not_hear_an_interruption():
    with closing(Cluster(stub(0.5), ThisMachine(1))) as cluster:
        first, second = questions(2)
        worker = int(cluster.submit(first, 0).result().max_von_mises_mpa or 0)
        os.kill(worker, signal.SIGINT)
        assert cluster.submit(second, 0).result().max_von_mises_mpa == worker


@pytest.mark.slow
def test_a_worker_has_one_thread_of_each_library():
    with closing(Cluster(Threads, ThisMachine(1))) as cluster:
        assert cluster.submit(FINGER, 0).result().reason == "1 1 1 1"


@pytest.mark.slow
def test_a_fault_outside_of_evaluations_ends_the_study_with_a_sentence():
    with closing(Cluster(Faulty, ThisMachine(1))) as cluster:
        futures = [cluster.submit(question, 0) for question in questions(3)]
        for future in futures:
            with pytest.raises(BellowsError, match="RuntimeError: no such luck"):
                future.result(30)
        with pytest.raises(BellowsError):
            cluster.submit(FINGER, 0).result(30)


@pytest.mark.slow
def test_after_the_end_whoever_waits_is_told():
    cluster = Cluster(stub(30.0), ThisMachine(1))
    waiting = [cluster.submit(question, 0) for question in questions(3)]
    cluster.close()
    for future in (*waiting, cluster.submit(FINGER, 0)):
        with pytest.raises(ClusterError, match="ended"):
            future.result(5)


@pytest.mark.slow
def test_workers_of_another_version_are_refused(monkeypatch):
    monkeypatch.setattr("bellows_design.__version__", "0.0")
    with pytest.raises(ClusterError, match=r"this process 0\.0; they must be the same"):
        Cluster(stub(), ThisMachine(1))


@pytest.mark.slow
def test_what_listens_but_is_no_scheduler_is_told_of():
    import socket

    with socket.create_server(("127.0.0.1", 0)) as server:
        address = f"tcp://127.0.0.1:{server.getsockname()[1]}"
        Elsewhere(address).require_listening()
        with pytest.raises(ClusterError, match="no scheduler answers"):
            Cluster(stub(), Elsewhere(address))


def test_as_many_workers_as_processors_if_the_memory_suffices(monkeypatch):
    monkeypatch.setattr("bellows_design.batch.places._processors", lambda: 64)
    for memory, workers in ((None, 64), (500.0, 64), (12.5, 6), (0.5, 1)):
        monkeypatch.setattr("bellows_design.batch.places.memory_gib", lambda gib=memory: gib)
        assert ThisMachine.of(None).workers == workers


@pytest.mark.parametrize("workers", [-1, 0, MOST_WORKERS + 1])
def test_a_number_of_workers_has_bounds(workers):
    with pytest.raises(DesignError, match=f"--workers is {workers}"):
        ThisMachine.of(workers)


def test_workers_share_the_memory_that_one_evaluation_may_take(monkeypatch):
    monkeypatch.setattr("bellows_design.batch.places.default_memory", lambda: 4.0)
    memory = [ThisMachine(workers).budget.memory for workers in (1, 2, 100)]
    assert memory == [4.0, 2.0, LEAST_MEMORY]


ENDING = """
import multiprocessing, os
from bellows_design.batch.cluster import release_semaphores

queue = multiprocessing.get_context("spawn").Queue()
if {released}:
    release_semaphores()
os._exit(0)
"""


@pytest.mark.thorough
@pytest.mark.skipif(os.name != "posix", reason="semaphores have names on POSIX systems only")
@pytest.mark.parametrize("released", [True, False])
def test_a_process_that_ends_at_once_leaks_no_semaphores(released: bool) -> None:
    command = [sys.executable, "-c", ENDING.format(released=released)]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert ("leaked" in done.stderr) is not released
