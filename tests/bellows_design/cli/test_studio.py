"""The command from its address to its end: statuses, processes, what it refuses."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import urllib.request
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import psutil
import pytest

ROOT = Path(__file__).parents[3]
COMMAND = [sys.executable, "-m", "bellows_design", "studio"]

pytestmark = pytest.mark.skipif(os.name == "nt", reason="signals of POSIX")


@contextmanager
def started(folder: Path, *options: str) -> Iterator[tuple[subprocess.Popen[str], str]]:
    """The running command, and the address that it printed."""
    with subprocess.Popen(
        [*COMMAND, "finger", "--no-browser", *options],
        cwd=folder,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    ) as command:
        try:
            assert command.stderr is not None
            address = next(word for word in command.stderr.readline().split() if "http" in word)
            yield command, address
        finally:
            command.kill()


def wait_until_gone(processes: list[psutil.Process]) -> None:
    _, alive = psutil.wait_procs(processes, timeout=10)
    assert not alive


@pytest.mark.parametrize(
    ("number", "status", "said"),
    [
        (signal.SIGINT, 0, "The studio has ended.\n"),
        (signal.SIGTERM, 143, "nothing half-done was left behind"),
    ],
)
@pytest.mark.thorough
def test_a_signal_ends_server_and_processes_and_leaves_nothing(
    number: int, status: int, said: str, tmp_path: Path
) -> None:
    with started(tmp_path) as (command, address):
        with urllib.request.urlopen(address) as page:
            assert page.status == 200 and b"<html" in page.read()
        processes = psutil.Process(command.pid).children(recursive=True)
        assert len(processes) == 3
        command.send_signal(number)
        output, errors = command.communicate(timeout=30)
        assert command.returncode == status
        assert said in (output or errors) and "Traceback" not in errors
        wait_until_gone(processes)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.thorough
def test_a_server_that_is_killed_takes_its_processes_along(tmp_path: Path) -> None:
    with started(tmp_path) as (command, _):
        processes = psutil.Process(command.pid).children(recursive=True)
        command.kill()
        wait_until_gone(processes)


@pytest.mark.thorough
def test_each_address_has_a_port_and_a_token_of_its_own(tmp_path: Path) -> None:
    with started(tmp_path) as (_, one), started(tmp_path) as (_, other):
        assert one.startswith("http://127.0.0.1:") and "?token=" in one
        assert one.split(":")[2] != other.split(":")[2]


def refused(folder: Path, *options: str) -> str:
    done = subprocess.run(
        [*COMMAND, "--no-browser", *options],
        cwd=folder,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert done.returncode == 2
    return done.stderr


@pytest.mark.thorough
def test_a_port_that_is_taken_or_none_is_refused_in_a_sentence(tmp_path: Path) -> None:
    with started(tmp_path) as (_, address):
        port = address.split(":")[2].split("/")[0]
        assert f"port {port} cannot be had" in refused(tmp_path, "--port", port)
    assert "must be 0 to 65535" in refused(tmp_path, "--port", "70000")


def test_a_design_that_is_none_is_refused_before_anything_is_served(tmp_path: Path) -> None:
    assert "unknown design" in refused(tmp_path, "fingr")
    assert "bubble_width" in refused(tmp_path, "finger", "--set", "bubble_width=1")
