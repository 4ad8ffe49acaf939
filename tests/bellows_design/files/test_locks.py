"""A lock keeps others out as long as its process lives."""

from __future__ import annotations

import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest

from bellows_design.files.atomic import remove_leftovers, temporary_beside
from bellows_design.files.locks import is_locked, locked

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="locks of POSIX")

HOLDER = """
import sys, time
from pathlib import Path
from bellows_design.files.locks import locked
with locked(Path(sys.argv[1])):
    print("held", flush=True)
    time.sleep(60)
"""


def test_a_folder_is_locked_until_its_holder_is_killed(tmp_path: Path) -> None:
    holder = subprocess.Popen(
        [sys.executable, "-c", HOLDER, str(tmp_path)],
        cwd=Path(__file__).parents[3],
        stdout=subprocess.PIPE,
    )
    assert holder.stdout is not None and holder.stdout.readline()
    assert is_locked(tmp_path)
    with pytest.raises(TimeoutError), locked(tmp_path):
        pass
    holder.kill()
    holder.wait()
    holder.stdout.close()
    assert not is_locked(tmp_path)
    assert list(tmp_path.iterdir()) == []


def test_whoever_waits_gets_it_next(tmp_path: Path) -> None:
    order: list[str] = []

    def second() -> None:
        with locked(tmp_path, seconds=20):
            order.append("second")

    with locked(tmp_path):
        thread = threading.Thread(target=second)
        thread.start()
        time.sleep(0.2)
        order.append("first")
    thread.join()
    assert order == ["first", "second"]


def test_what_is_locked_is_not_left_over_though_its_process_seems_gone(tmp_path: Path) -> None:
    """Another container may share folder and name, but not the numbers of processes."""
    path = temporary_beside(tmp_path / "out")
    machine, process = path.name.split("-tmp-")[1].split("-")[:2]
    strange = path.with_name(path.name.replace(f"{machine}-{process}-", f"{machine}-99999999-"))
    strange.mkdir()
    with locked(strange):
        remove_leftovers(tmp_path)
        assert strange.exists()
    remove_leftovers(tmp_path)
    assert not strange.exists()


def test_a_pipe_is_not_waited_for(tmp_path: Path) -> None:
    import os

    os.mkfifo(tmp_path / "pipe")
    assert not is_locked(tmp_path / "pipe")
