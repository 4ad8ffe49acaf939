"""Programs that do not end, talk too much, or cannot be started."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from printers.errors import PrintersError
from printers.slicing.guardian import RUNNING
from printers.slicing.running import OUTPUT_KEPT, run


def is_running(process: int) -> bool:
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    return Path(f"/proc/{process}/stat").read_text().split()[2] != "Z"


def test_status_and_words_of_both_streams_are_kept(
    program: Callable[..., Path], tmp_path: Path
) -> None:
    ended = run([str(program("echo one; echo two >&2; exit 3"))], tmp_path, 10)
    assert (ended.status, ended.output) == (3, "one\ntwo\n")


def test_after_the_time_limit_the_program_and_its_children_are_gone(
    program: Callable[..., Path], tmp_path: Path
) -> None:
    path = program("sleep 60 & echo $! > child; wait")
    with pytest.raises(PrintersError, match=r"did not end within 0\.5 s and was stopped"):
        run([str(path)], tmp_path, 0.5)
    child = int((tmp_path / "child").read_text())
    deadline = time.monotonic() + 10  # the kernel's, not ours
    while is_running(child) and time.monotonic() < deadline:
        time.sleep(0.01)
    assert not is_running(child)


def test_children_that_a_program_leaves_behind_are_ended_too(
    program: Callable[..., Path], tmp_path: Path
) -> None:
    run([str(program("sleep 60 > /dev/null 2>&1 & echo $! > child"))], tmp_path, 10)
    child = int((tmp_path / "child").read_text())
    deadline = time.monotonic() + 10
    while is_running(child) and time.monotonic() < deadline:
        time.sleep(0.01)
    assert not is_running(child)


KILLED = """
import sys
from pathlib import Path
from printers.slicing.running import run
from printers.slicing.working_folder import working_folder
with working_folder() as folder:
    run(["sh", "-c", "sleep 60 & echo $$ $! > part.gcode; wait"], folder, 60)
"""


def _written(folder: Path, name: str) -> str:
    """What stands in the file of that name in a subfolder; empty until there is one."""
    return "".join(path.read_text() for path in folder.glob(f"*/{name}"))


def test_after_a_kill_the_slicer_its_children_and_its_folder_are_gone(tmp_path: Path) -> None:
    """SIGKILL leaves a program no time to clear up."""
    surroundings = {**os.environ, "TMPDIR": str(tmp_path)}
    killed = subprocess.Popen([sys.executable, "-c", KILLED], env=surroundings)
    deadline = time.monotonic() + 60
    # the program writes before its number is noted: only a noted one is found by who clears up
    while not (_written(tmp_path, RUNNING) and (said := _written(tmp_path, "part.gcode"))):
        assert killed.poll() is None and time.monotonic() < deadline
        time.sleep(0.01)
    processes = [int(number) for number in said.split()]
    assert len(processes) == 2 and all(is_running(each) for each in processes)
    killed.kill()
    killed.wait()
    while (any(map(is_running, processes)) or any(tmp_path.iterdir())) and (
        time.monotonic() < deadline
    ):
        time.sleep(0.01)
    assert not any(is_running(each) for each in processes)
    assert list(tmp_path.iterdir()) == []


def test_of_endless_words_the_last_are_kept(program: Callable[..., Path], tmp_path: Path) -> None:
    ended = run([str(program("yes words | head -c 1000000; echo end"))], tmp_path, 30)
    assert len(ended.output) <= OUTPUT_KEPT and ended.output.endswith("end\n")


def test_a_program_gets_no_input(program: Callable[..., Path], tmp_path: Path) -> None:
    assert run([str(program("read line || echo none"))], tmp_path, 10).output == "none\n"


def test_what_cannot_be_started_is_named(tmp_path: Path) -> None:
    (tmp_path / "text").write_text("no program")
    for name in ("none", "text"):
        with pytest.raises(PrintersError, match=f"{name}' cannot be started"):
            run([str(tmp_path / name)], tmp_path, 10)


def test_a_program_that_ends_by_a_signal_is_told_by_its_number(
    program: Callable[..., Path], tmp_path: Path
) -> None:
    assert run([str(program("kill -6 $$"))], tmp_path, 10).status == -6
