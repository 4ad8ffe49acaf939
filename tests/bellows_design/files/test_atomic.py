"""What a killed process left is cleared up by the next; what is at work is left alone."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from bellows_design.files import atomic
from bellows_design.files.atomic import MARK, remove_leftovers, replacing, temporary_beside

KILLED = """
import os, signal, sys
from pathlib import Path
from bellows_design.files.atomic import replacing, temporary_beside
folder = temporary_beside(Path(sys.argv[1]))
folder.mkdir()
(folder / "inside").touch()
with replacing(Path(sys.argv[1])) as temporary:
    temporary.write_text("half")
    os.kill(os.getpid(), signal.SIGKILL)
"""


def leftovers_of_a_killed_process(target: Path) -> list[Path]:
    subprocess.run([sys.executable, "-c", KILLED, str(target)], cwd=Path(__file__).parents[3])
    return [path for path in target.parent.iterdir() if MARK in path.name]


@pytest.mark.skipif(sys.platform == "win32", reason="there is no SIGKILL")
def test_the_next_writer_clears_up_what_a_killed_one_left(tmp_path: Path) -> None:
    target = tmp_path / "bent.vtu"
    assert len(leftovers_of_a_killed_process(target)) == 2
    assert not target.exists()
    with replacing(target) as temporary:
        temporary.write_text("whole")
    assert list(tmp_path.iterdir()) == [target]
    assert target.read_text() == "whole"


def test_the_leftovers_of_others_stay(tmp_path: Path) -> None:
    target = tmp_path / "bent.vtu"
    running = temporary_beside(target)  # of this process: another thread may be at work on it
    machine, process, session, number = running.stem.split(f"{MARK}-")[1].split("-")
    kept = [
        running,
        temporary_beside(tmp_path / "other.vtu"),
        running.with_name(running.name.replace(machine, "elsewhere")),
        running.with_name(running.name.replace(f"-{process}-", f"-{os.getppid()}-")),
        running.with_name(f".bent.vtu.{MARK}-{number}.vtu"),
        tmp_path / ".bent.vtu.swp",
    ]
    gone = running.with_name(running.name.replace(session, "0" * 8))  # an earlier one, same number
    for path in (*kept, gone):
        path.touch()
    remove_leftovers(tmp_path)
    assert set(tmp_path.iterdir()) == set(kept)


def test_an_interrupt_at_any_step_leaves_the_old_file_and_nothing_else(tmp_path: Path) -> None:
    target = tmp_path / "part.stl"
    target.write_text("old")
    for step in ("touch", "block", "_settle", "os.replace"):
        with pytest.MonkeyPatch.context() as patch, pytest.raises(KeyboardInterrupt):
            if step == "touch":
                patch.setattr(Path, "touch", interrupted)
            elif step != "block":
                patch.setattr(f"bellows_design.files.atomic.{step}", interrupted)
            with replacing(target) as temporary:
                temporary.write_text("new")
                if step == "block":
                    interrupted()
        assert list(tmp_path.iterdir()) == [target] and target.read_text() == "old"


def interrupted(*_: object, **__: object) -> None:
    raise KeyboardInterrupt


@pytest.mark.parametrize("name", ["x" * 120 + ".vtu", "č" * 120 + ".vtu", "a." + "b" * 200])
def test_long_names_can_be_written(name: str, tmp_path: Path) -> None:
    with replacing(tmp_path / name) as temporary:
        assert temporary.suffix == Path(name).suffix or len(Path(name).suffix) > 40
        temporary.write_text("whole")
    assert [path.name for path in tmp_path.iterdir()] == [name]


def test_a_link_among_the_leftovers_is_removed_and_not_followed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "precious").mkdir()
    (tmp_path / "precious" / "thesis").touch()
    target = tmp_path / "out"
    temporary_beside(target).symlink_to(tmp_path / "precious")
    monkeypatch.setattr(atomic, "_is_left_over", lambda _: True)
    remove_leftovers(tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["precious"]
    assert (tmp_path / "precious" / "thesis").exists()
