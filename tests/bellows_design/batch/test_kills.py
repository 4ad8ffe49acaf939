"""Coordinators, workers and schedulers that are killed: nothing is lost, nothing is doubled."""

from __future__ import annotations

import json
import os
import random
import signal
import sqlite3
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import closing, contextmanager, suppress
from pathlib import Path

import psutil
import pytest
import stub_sweep
from answering_stub import CRASHING, stub

from bellows_design.batch.answer import Answer
from bellows_design.batch.cluster import ALLOWED_FAILURES, Cluster
from bellows_design.batch.dealing import answers
from bellows_design.batch.places import ThisMachine
from bellows_design.batch.question import Question
from bellows_design.batch.results import reading
from bellows_design.batch.schema import Row
from bellows_design.design.shipped import load_design
from bellows_design.design.variation import varied
from bellows_design.errors import DesignError
from bellows_design.files.errors import CannotWrite

ROOT = Path(__file__).parents[3]
KILLS, KILLS_OF_WORKERS = int(os.environ.get("BELLOWS_KILLS", "9")), 2
"""The default is a sample; the whole proof has 24."""

DESIGNS, SECONDS, WORKERS = 100 * KILLS + 100, 0.05, 2
AT_RISK = 2 * WORKERS
"""Answers that are given but not written, at most, when something is killed."""

END_SECONDS = 30.0


def environment() -> dict[str, str]:
    paths = [str(ROOT), str(ROOT / "tests/support")]
    return {**os.environ, "PYTHONPATH": os.pathsep.join(paths)}


def hear_signals() -> None:
    """In a new process: what a shell runs in its background may be deaf to them."""
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, signal.SIG_DFL)


@contextmanager
def program(*arguments: object) -> Iterator[subprocess.Popen[str]]:
    """A Python program in a session of its own, of which nothing is left after the block."""
    words = [sys.executable, *map(str, arguments)]
    process = subprocess.Popen(
        words,
        env=environment(),
        text=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        start_new_session=True,
        preexec_fn=hear_signals,
    )
    try:
        yield process
    finally:
        with suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)
        process.communicate()


def coordinator(file: Path, scheduler: str = "", seconds: float = SECONDS):
    script = ROOT / "tests/support/stub_sweep.py"
    log = file.with_suffix(".log")
    return program(
        script, file, DESIGNS, WORKERS, seconds, log, *([scheduler] if scheduler else [])
    )


def children(process: subprocess.Popen[str]) -> list[psutil.Process]:
    with suppress(psutil.NoSuchProcess):
        return psutil.Process(process.pid).children(recursive=True)
    return []


def workers_of(process: subprocess.Popen[str]) -> list[psutil.Process]:
    """Its own children: those of a worker, such as one that makes a mesh, are none."""
    found = []
    with suppress(psutil.NoSuchProcess):
        for child in psutil.Process(process.pid).children():
            with suppress(psutil.Error):
                if "spawn_main" in " ".join(child.cmdline()):
                    found.append(child)
    return found


def kept(file: Path) -> dict[str, Row]:
    try:
        with reading(file) as results:
            return {row.answer.key: row for row in results.rows()}
    except (DesignError, CannotWrite):  # not begun yet
        return {}


def wait_until(condition, seconds: float = 60.0) -> None:
    deadline = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < deadline, "it did not come about"
        time.sleep(0.05)


def require_whole(file: Path) -> None:
    """Every question is answered once, and the database says that it is intact."""
    with closing(sqlite3.connect(file)) as connection:
        assert connection.execute("PRAGMA integrity_check").fetchall() == [("ok",)]
        keys = [key for (key,) in connection.execute("SELECT key FROM answer")]
    assert sorted(keys) == sorted(stub_sweep.plan_of(DESIGNS).keys)


def nothing_lost(before: dict[str, Row], after: dict[str, Row]) -> bool:
    return all(after.get(key) == row for key, row in before.items())


@pytest.mark.slow
def test_nothing_is_lost_or_doubled_when_all_is_killed_at_random_moments(tmp_path):
    """`KILLS` kills, of the coordinator and of workers, at any moment from the start on."""
    chance, file = random.Random(15), tmp_path / "sweep.sqlite"
    rows: dict[str, Row] = {}
    kills = 0
    while kills < KILLS:
        with coordinator(file) as process:
            for _ in range(KILLS_OF_WORKERS):
                time.sleep(chance.uniform(0.5, 3.5))
                for worker in chance.sample(found, 1) if (found := workers_of(process)) else []:
                    worker.kill()
                    kills += 1
            time.sleep(chance.uniform(0.0, 2.0))
            left = children(process)
            assert process.poll() is None, "it was done before it was killed"
            process.kill()
            kills += 1
            assert not psutil.wait_procs(left, timeout=END_SECONDS)[1], "workers stay"
        found_now = kept(file)
        assert nothing_lost(rows, found_now)
        rows = found_now
    with coordinator(file) as process:
        assert process.wait(300) == 0
    assert nothing_lost(rows, kept(file))
    require_whole(file)
    assert all(row.answer.done for row in kept(file).values())
    answered = len(file.with_suffix(".log").read_text().splitlines())
    assert DESIGNS <= answered <= DESIGNS + AT_RISK * kills
    assert {path.name for path in tmp_path.iterdir()} == {"sweep.sqlite", "sweep.log"}


@pytest.mark.slow
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_no_process_stays_when_the_coordinator_is_interrupted(tmp_path, number):
    file = tmp_path / "sweep.sqlite"
    with coordinator(file) as process:
        wait_until(lambda: len(kept(file)) > 10)
        left = children(process)
        os.kill(process.pid, number)
        process.wait(END_SECONDS)
        assert not psutil.wait_procs(left, timeout=END_SECONDS)[1]


@pytest.mark.slow
def test_a_design_that_crashes_its_worker_fails_and_no_other_one_does():
    finger = load_design("finger")
    widths = [18.0 + 0.05 * step for step in range(20)]
    questions = [Question(varied(finger, {"bubble_width": width})) for width in widths]
    crashing = Question(varied(finger, {"bubble_width": CRASHING, "tendon_width": 5.0}))
    with closing(Cluster(stub(0.05), ThisMachine(2))) as cluster:
        asked = [*questions[:5], crashing, *questions[5:]]
        found = dict(pair for came in answers(asked, cluster) for pair in came)
    assert [place for place, answer in found.items() if not answer.done] == [5]
    assert found[5].reason == f"its worker died {ALLOWED_FAILURES + 1} times."


def address_in(place: Path) -> str:
    """The scheduler's in its file; '' while it is not written to its end."""
    with suppress(FileNotFoundError, json.JSONDecodeError):
        return str(json.loads(place.read_text())["address"])
    return ""


@contextmanager
def scheduler_with_worker(folder: Path) -> Iterator[tuple[str, subprocess.Popen[str]]]:
    """A dask scheduler and a worker as a user starts them; the address, and the scheduler."""
    place = folder / "scheduler.json"
    options = ["--host", "127.0.0.1", "--port", "0", "--no-dashboard", "--dashboard-address"]
    begun = ["-m", "distributed.cli.dask_scheduler", *options, "127.0.0.1:0"]
    with program(*begun, "--scheduler-file", place) as scheduler:
        wait_until(lambda: address_in(place))
        address = address_in(place)
        worker = ["-m", "distributed.cli.dask_worker", address, "--nthreads", "1"]
        with program(*worker, "--host", "127.0.0.1", "--death-timeout", "60"):
            yield address, scheduler


@pytest.mark.slow
def test_a_scheduler_that_is_killed_is_told_of_and_the_sweep_goes_on_with_another(tmp_path):
    file = tmp_path / "sweep.sqlite"
    with (
        scheduler_with_worker(tmp_path) as (address, scheduler),
        coordinator(file, address) as process,
    ):
        wait_until(lambda: len(kept(file)) > 10)
        scheduler.kill()
        assert process.wait(60) == 3
        assert process.stderr is not None
        assert "the same command goes on from there" in process.stderr.read()
    rows = kept(file)
    assert 10 < len(rows) < DESIGNS
    with coordinator(file, seconds=0.0) as process:
        assert process.wait(300) == 0
    assert nothing_lost(rows, kept(file))
    require_whole(file)


def sweep(file: Path, workers: int):
    """The real command with real evaluations of six designs."""
    grid = ("--vary", "bubble_width=19.4:20:3", "--vary", "tendon_width=5.8:6:2")
    command = ("-m", "bellows_design", "study", "sweep", "finger", *grid, "--json")
    return program(*command, "--file", file, "--workers", workers)


@pytest.mark.slow
def test_results_agree_within_their_estimates_with_one_or_two_workers_killed_or_not(tmp_path):
    one, two = tmp_path / "one.sqlite", tmp_path / "two.sqlite"
    with sweep(one, 1) as process:
        out, _ = process.communicate(timeout=600)
        assert json.loads(out)["done"] == 6
    with sweep(two, 2) as process:
        wait_until(lambda: kept(two), 300)
        wait_until(lambda: workers_of(process))
        for worker in workers_of(process)[:1]:
            with suppress(psutil.NoSuchProcess):
                worker.kill()
        already = len(kept(two))
        wait_until(lambda: len(kept(two)) > already, 300)
        process.kill()
    before = kept(two)
    with sweep(two, 2) as process:
        out, _ = process.communicate(timeout=600)
        found = json.loads(out)
    assert (found["done"], found["asked"]) == (6, 6 - len(before))
    first, second = kept(one), kept(two)
    assert first.keys() == second.keys() and nothing_lost(before, second)
    for key, row in first.items():
        require_agreement(row.answer, second[key].answer)


def require_agreement(one: Answer, other: Answer) -> None:
    for value, error in (
        ("bending_angle_deg", "bending_angle_error_percent"),
        ("max_von_mises_mpa", "max_von_mises_error_percent"),
    ):
        allowed = (getattr(one, error) + getattr(other, error)) / 100
        assert getattr(one, value) == pytest.approx(getattr(other, value), rel=allowed)


@pytest.mark.slow
@pytest.mark.parametrize(("number", "status"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_the_command_ends_at_a_signal_with_its_status_and_leaves_no_process(
    tmp_path, number, status
):
    with sweep(tmp_path / "a.sqlite", 2) as process:
        wait_until(lambda: len(workers_of(process)) == 2)
        time.sleep(4)  # amid imports or an evaluation
        left = children(process)
        os.killpg(process.pid, number)  # as a terminal does it
        out, err = process.communicate(timeout=END_SECONDS)
        assert not psutil.wait_procs(left, timeout=END_SECONDS)[1]
    assert process.returncode == status, err
    assert json.loads(out)["exit_status"] == status
    assert "Traceback" not in err, err
