"""Jobs that wait, run, become stale, hang and crash; the processes compute nothing."""

from __future__ import annotations

import asyncio
import os
import signal
import subprocess
import sys
import time
from collections.abc import Awaitable, Callable
from pathlib import Path
from typing import Any

import psutil
import pytest

from bellows_design.studio.workers import lane as lanes
from bellows_design.studio.workers.lane import Job, Lane

STUB = "stub_tasks"
PAGE, OTHER = 1, 2


def in_loop(check: Callable[[Lane], Awaitable[None]], spare: bool = False) -> None:
    async def whole() -> None:
        lane = Lane(STUB, spare)
        try:
            await asyncio.wait_for(check(lane), 60)
        finally:
            lane.close()

    asyncio.run(whole())


def job(kind: str, heard: list[Any] | None = None, owner: int = PAGE, topic: str = "t") -> Job:
    found: list[Any] = [] if heard is None else heard
    values = {"values": {"stub": kind}}
    return Job(owner, topic, "preview", values, lambda event, _: found.append(dict(event)))


def answers(heard: list[Any]) -> list[Any]:
    return [event for event in heard if event["kind"] == "answer"]


def test_a_job_reports_what_it_finds_and_ends() -> None:
    async def check(lane: Lane) -> None:
        heard: list[Any] = []
        assert await lane.submit(job("", heard)).outcome == ("done", "")
        assert len(answers(heard)) == 1

    in_loop(check)


def test_of_jobs_that_wait_only_the_latest_of_a_page_and_topic_is_done() -> None:
    async def check(lane: Lane) -> None:
        heard: list[Any] = []
        first = lane.submit(job("", heard))
        waiting = [lane.submit(job("", heard)) for _ in range(20)]
        other = lane.submit(job("", heard, OTHER))
        outcomes = [(await each.outcome)[0] for each in (first, *waiting, other)]
        assert outcomes == ["done"] + 19 * ["cancelled"] + 2 * ["done"]
        assert len(answers(heard)) == 3

    in_loop(check)


def test_a_stale_job_that_listens_stops_and_its_process_goes_on() -> None:
    async def check(lane: Lane) -> None:
        heard: list[Any] = []
        await lane.submit(job("", heard)).outcome
        slow = lane.submit(job("slow", heard))
        await asyncio.sleep(0.3)
        began = time.perf_counter()
        lane.cancel(PAGE)
        assert (await slow.outcome)[0] == "cancelled"
        assert await lane.submit(job("", heard)).outcome == ("done", "")
        assert time.perf_counter() - began < 10  # slow takes that long
        assert len({event["process"] for event in answers(heard)}) == 1

    in_loop(check)


def test_what_a_stale_job_still_reports_is_dropped() -> None:
    async def check(lane: Lane) -> None:
        heard: list[Any] = []
        slow = lane.submit(job("slow", heard))
        await asyncio.sleep(0.5)
        lane.cancel(PAGE)
        count = len(heard)
        await lane.submit(job("", [], OTHER)).outcome
        assert len(heard) == count and slow.outcome.done()

    in_loop(check)


def test_a_stale_job_that_hears_nothing_is_ended_once_another_waits(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(lanes, "PATIENCE", 0.2)

    async def check(lane: Lane) -> None:
        heard: list[Any] = []
        await lane.submit(job("", heard)).outcome
        (former,) = {event["process"] for event in answers(heard)}
        hangs = lane.submit(job("hang", heard))
        await asyncio.sleep(0.2)
        lane.cancel(PAGE)
        assert (await hangs.outcome)[0] == "cancelled"
        assert await lane.submit(job("", heard)).outcome == ("done", "")
        assert {event["process"] for event in answers(heard)} > {former}
        await gone(former)

    in_loop(check, spare=True)


async def gone(process: int) -> None:
    for _ in range(200):
        if not psutil.pid_exists(process):
            return
        await asyncio.sleep(0.05)
    raise AssertionError(f"process {process} is still there")


def test_a_job_of_another_page_is_left_alone() -> None:
    async def check(lane: Lane) -> None:
        running = lane.submit(job("", [], OTHER))
        waiting = lane.submit(job("", [], OTHER, "other"))
        lane.cancel(PAGE)
        assert [(await each.outcome)[0] for each in (running, waiting)] == ["done", "done"]

    in_loop(check)


def test_a_crash_is_told_of_and_the_next_job_gets_a_new_process() -> None:
    async def check(lane: Lane) -> None:
        lane.on_start = lambda: [job("", [], OTHER, "first")]
        crashed, waiting = lane.submit(job("crash")), lane.submit(job("", [], OTHER))
        outcome, why = await crashed.outcome
        assert outcome == "crashed" and "another one was started" in why
        assert (await waiting.outcome)[0] == "done"
        assert (await lane.submit(job("")).outcome)[0] == "done"

    in_loop(check)


def test_a_fault_in_a_job_is_told_of_and_the_process_goes_on() -> None:
    async def check(lane: Lane) -> None:
        outcome, why = await lane.submit(job("fail")).outcome
        assert outcome == "failed" and "it cannot be" in why
        assert (await lane.submit(job("")).outcome)[0] == "done"

    in_loop(check)


def test_a_process_that_never_starts_fails_its_jobs_instead_of_starting_for_ever() -> None:
    async def whole() -> None:
        lane = Lane("no_such_module_of_tasks")
        try:
            for _ in range(2):
                outcome, why = await asyncio.wait_for(lane.submit(job("")).outcome, 60)
                assert outcome == "crashed" and why
        finally:
            lane.close()

    asyncio.run(whole())


def test_closing_ends_every_process_also_one_that_hangs(monkeypatch: pytest.MonkeyPatch) -> None:
    processes: list[int] = []

    async def check(lane: Lane) -> None:
        await lane.submit(job("")).outcome
        lane.submit(job("hang"))
        await asyncio.sleep(0.3)
        processes.extend(lane.numbers)

    in_loop(check, spare=True)
    assert len(processes) == 2
    assert not any(psutil.pid_exists(each) for each in processes)


SERVER = """
import asyncio
from contextlib import nullcontext
from bellows_design.studio.workers.lane import Job, Lane

async def main():
    lane = Lane("stub_tasks")
    begun = asyncio.Event()
    lane.submit(Job(1, "t", "preview", {"values": {"stub": "deaf"}}, lambda *_: begun.set()))
    await begun.wait()
    with lane.held() if HELD else nullcontext():
        print(*lane.numbers, flush=True)
        await asyncio.sleep(600)

asyncio.run(main())
"""


@pytest.mark.skipif(os.name == "nt", reason="signals of POSIX")
@pytest.mark.parametrize("held", [False, True])
@pytest.mark.thorough
def test_processes_end_with_a_server_that_is_killed(held: bool) -> None:
    places = os.pathsep.join([*sys.path])
    with subprocess.Popen(
        [sys.executable, "-c", f"HELD = {held}\n{SERVER}"],
        stdout=subprocess.PIPE,
        env={**os.environ, "PYTHONPATH": places},
        cwd=Path(__file__).parent,
    ) as server:
        assert server.stdout is not None
        (process,) = (int(word) for word in server.stdout.readline().split())
        assert psutil.pid_exists(process)
        server.send_signal(signal.SIGKILL)
        server.wait()
    asyncio.run(gone(process))


linux = pytest.mark.skipif(sys.platform != "linux", reason="only there jobs are held")


@linux
def test_a_job_that_is_held_stands_still_and_then_goes_on() -> None:
    async def check(lane: Lane) -> None:
        heard: list[Any] = []
        running = lane.submit(job("slow", heard))
        while not heard:
            await asyncio.sleep(0.01)
        with lane.held(), lane.held():
            await asyncio.sleep(0.1)  # what was on its way
            before = len(heard)
            await asyncio.sleep(0.4)
            assert len(heard) == before
            assert psutil.Process(lane.numbers[0]).status() == psutil.STATUS_STOPPED
        while len(heard) == before:
            await asyncio.sleep(0.01)
        lane.cancel(PAGE)
        assert await running.outcome == ("cancelled", "")

    in_loop(check)


def test_a_lane_that_is_held_can_be_closed_at_once() -> None:
    async def check(lane: Lane) -> None:
        heard: list[Any] = []
        lane.submit(job("slow", heard))
        while not heard:
            await asyncio.sleep(0.01)
        (number,) = lane.numbers
        with lane.held():
            lane.close()
        assert not psutil.pid_exists(number)

    in_loop(check)


async def started(lane: Lane, kind: str, owner: int = PAGE) -> Job:
    """A job that has begun to report."""
    heard: list[Any] = []
    running = lane.submit(job(kind, heard, owner))
    while not heard:
        await asyncio.sleep(0.01)
    return running


@linux
def test_a_process_that_is_killed_while_held_is_replaced() -> None:
    async def check(lane: Lane) -> None:
        running = await started(lane, "slow")
        (number,) = lane.numbers
        with lane.held():
            os.kill(number, signal.SIGKILL)
            assert (await running.outcome)[0] == "crashed"
            assert await lane.submit(job("")).outcome == ("done", "")
        assert await lane.submit(job("")).outcome == ("done", "")
        assert number not in lane.numbers

    in_loop(check)


@pytest.mark.parametrize("kind", ["slow", "deaf"])
@pytest.mark.thorough
def test_what_is_cancelled_while_held_makes_room_for_another_page(
    kind: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(lanes, "PATIENCE", 0.2)

    async def check(lane: Lane) -> None:
        running = await started(lane, kind, OTHER)
        with lane.held():
            lane.cancel(OTHER)
            assert await running.outcome == ("cancelled", "")
            waiting = lane.submit(job(""))
            await asyncio.sleep(0.5)
        assert await waiting.outcome == ("done", "")
        with lane.held():
            assert await lane.submit(job("")).outcome == ("done", "")

    in_loop(check)
