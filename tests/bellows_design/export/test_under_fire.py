"""Exports to a disk that is full, a folder that is gone, and by several runs at once."""

from __future__ import annotations

import hashlib
import json
import os
import shutil
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
from real_command import ROOT, bellows

from bellows_design.approval import Verdict
from bellows_design.errors import DesignError
from bellows_design.export import approved
from bellows_design.export.approved import export_approved, require_place
from bellows_design.export.formats import WRITERS, Part, write_part
from bellows_design.files.atomic import MARK, require_writable
from bellows_design.files.errors import CannotWrite
from bellows_design.files.locks import locked

POSIX = pytest.mark.skipif(sys.platform == "win32", reason="limits and names of POSIX")
APPROVED = Verdict(())
STRANGE = os.fsdecode(b"\xff\xfe")
"""No text in UTF-8."""


@POSIX
@pytest.mark.parametrize("suffix", WRITERS)
def test_a_limit_of_a_files_size_is_a_sentence_and_leaves_nothing(
    suffix: str, cube_part: Part, tmp_path: Path
) -> None:
    """Raised where a disk would be full; the library of 3MF aborted the process."""
    import resource

    usual = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (100, usual[1]))
    try:
        with pytest.raises(CannotWrite, match="cannot be written: File too large"):
            write_part(cube_part, tmp_path / f"cube{suffix}")
        with pytest.raises(CannotWrite, match="File too large; it is approved, but not exported"):
            export_approved(cube_part, APPROVED, {}, tmp_path / "not" / "there")
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, usual)
    assert list(tmp_path.iterdir()) == []


@POSIX
@pytest.mark.slow
@pytest.mark.parametrize("suffix", WRITERS)
def test_the_command_says_so(suffix: str, tmp_path: Path) -> None:
    output = f"part{suffix}"
    ended = bellows("design", "finger", "-o", output, limits="ulimit -f 20;", folder=tmp_path)
    assert (ended.status, ended.out) == (2, "")
    assert f"bellows: “{output}” cannot be written: File too large.\n" in ended.err
    assert list(tmp_path.iterdir()) == []


@POSIX
@pytest.mark.parametrize("suffix", WRITERS)
@pytest.mark.parametrize("name", [STRANGE, "čć", "名前", "with space", "-o"])
def test_any_name_that_a_file_may_have_can_be_written(
    name: str, suffix: str, cube_part: Part, tmp_path: Path
) -> None:
    write_part(cube_part, tmp_path / f"{name}{suffix}")
    assert os.listdir(tmp_path) == [f"{name}{suffix}"]


@POSIX
@pytest.mark.slow
@pytest.mark.parametrize("suffix", WRITERS)
def test_names_are_no_matter_of_the_locale(suffix: str, tmp_path: Path) -> None:
    plain = {"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"}
    ended = bellows("design", "finger", "-o", f"č{suffix}", variables=plain, folder=tmp_path)
    assert ended.status == 0, ended.err
    assert os.listdir(tmp_path) == [f"č{suffix}"]
    assert bellows("design", "finger", "-o", f"{STRANGE}{suffix}", folder=tmp_path).status == 0


@POSIX
def test_an_export_may_stand_in_a_folder_whose_name_is_no_text(
    cube_part: Part, tmp_path: Path
) -> None:
    grounds = {"folder": tmp_path / STRANGE}
    folder = export_approved(cube_part, APPROVED, grounds, tmp_path / STRANGE)
    assert json.loads((folder / "manifest.json").read_text("utf-8"))["folder"].endswith("??")


def test_a_folder_that_vanishes_before_the_export_is_made_again_or_named(
    cube_part: Part, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    root = tmp_path / "out"
    root.mkdir()
    require_place("cube", root)
    root.rmdir()
    assert export_approved(cube_part, APPROVED, {}, root).is_dir()
    monkeypatch.setattr(approved, "_require_written", lambda *_: shutil.rmtree(root))
    with pytest.raises(CannotWrite, match=r"cube” cannot be written: No such file"):
        export_approved(cube_part, APPROVED, {}, root)
    assert list(tmp_path.iterdir()) == []


@POSIX
def test_what_a_killed_run_left_goes_with_the_next_of_any_name(
    cube_part: Part, tmp_path: Path
) -> None:
    code = (
        "import os, signal, sys\n"
        "from pathlib import Path\n"
        "from bellows_design.files.atomic import at_work\n"
        "with at_work(Path(sys.argv[1])) as folder:\n"
        "    folder.mkdir()\n"
        "    (folder / 'half').touch()\n"
        "    os.kill(os.getpid(), signal.SIGKILL)\n"
    )
    subprocess.run([sys.executable, "-c", code, str(tmp_path / "another")], cwd=ROOT)
    assert [MARK in path.name for path in tmp_path.iterdir()] == [True]
    export_approved(cube_part, APPROVED, {}, tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["cube"]


RUNS = """
import sys
from dataclasses import replace
from pathlib import Path
import cadquery as cq
from bellows_design.approval import Verdict
from bellows_design.export.approved import export_approved, withdraw
from bellows_design.export.part import Part
from bellows_design.geometry.tessellation import tessellate
number, root = int(sys.argv[1]), Path(sys.argv[2])
solid = cq.Solid.makeBox(10 + number, 10, 10)
part = Part("cube", "", f"{number:064d}", solid, tessellate(solid))
for turn in range(6):
    export_approved(part, Verdict(()), {"run": number}, root)
    if turn == 3:
        withdraw("cube", root)
"""


@POSIX
def test_exports_of_one_name_at_once_take_turns(cube_part: Part, tmp_path: Path) -> None:
    def export(number: int) -> Path:
        return export_approved(cube_part, APPROVED, {"run": number}, tmp_path)

    with ThreadPoolExecutor(3) as threads:
        assert set(threads.map(export, range(6))) == {tmp_path / "cube"}
    assert [path.name for path in tmp_path.iterdir()] == ["cube"]
    assert len(read_through_one_folder(tmp_path / "cube")) == 3


@POSIX
def test_a_run_that_others_keep_waiting_too_long_says_so(
    cube_part: Part, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(approved, "PATIENCE", 0.2)
    with locked(tmp_path), pytest.raises(CannotWrite, match="another run is at work there"):
        export_approved(cube_part, APPROVED, {}, tmp_path)
    assert list(tmp_path.iterdir()) == []


@POSIX
@pytest.mark.slow
def test_runs_of_one_name_at_once_take_turns(tmp_path: Path) -> None:
    """Whoever opens the folder once finds one export in it, or one that is withdrawn."""
    runs = [
        subprocess.Popen(
            [sys.executable, "-c", RUNS, str(number), str(tmp_path)],
            cwd=ROOT,
            stderr=subprocess.PIPE,
        )
        for number in range(3)
    ]
    seen = 0
    while any(run.poll() is None for run in runs):
        seen += len(read_through_one_folder(tmp_path / "cube"))
        time.sleep(0.005)
    assert [run.communicate()[1] for run in runs] == [b"", b"", b""] and seen > 0
    assert [path.name for path in tmp_path.iterdir()] == ["cube"]
    assert len(read_through_one_folder(tmp_path / "cube")) == 3


def read_through_one_folder(folder: Path) -> list[str]:
    """Names of the files whose hashes are the manifest's; a wrong one fails the test."""
    found = []
    try:
        descriptor = os.open(folder, os.O_RDONLY)
    except FileNotFoundError:
        return []

    def content(name: str) -> bytes:
        with open(os.open(name, os.O_RDONLY, dir_fd=descriptor), "rb") as file:
            return file.read()

    try:
        for name, fingerprint in json.loads(content("manifest.json"))["files"].items():
            assert hashlib.sha256(content(name)).hexdigest() == fingerprint["sha256"], name
            found.append(name)
    except FileNotFoundError:  # withdrawn meanwhile
        pass
    finally:
        os.close(descriptor)
    return found


@POSIX
def test_a_place_that_cannot_be_written_is_found_before_the_work(tmp_path: Path) -> None:
    for target in (Path("/proc/part.stl"), tmp_path / ("x" * 300 + ".stl")):
        with pytest.raises(CannotWrite, match="cannot be written"):
            require_writable(target)
    with pytest.raises(CannotWrite, match="cannot be written"):
        require_place("cube", Path("/proc/nowhere/exports"))
    (tmp_path / "file").touch()
    with pytest.raises((CannotWrite, DesignError)):
        require_place("cube", tmp_path / "file" / "exports")
    require_place("cube", tmp_path / "not" / "there")
    require_writable(tmp_path / "part.stl")
    assert [path.name for path in tmp_path.iterdir()] == ["file"]


@POSIX
@pytest.mark.parametrize(
    "arguments",
    [
        ("run", "finger", "--output", "/proc/nowhere"),
        ("design", "finger", "-o", "/proc/part.step"),
        ("evaluate", "finger", "--vtu", "/proc/bent.vtu"),
        ("benchmark", "--output", "/proc/speed.json"),
        ("benchmark", "--plot", "/proc/speed.png"),
        ("fit", "data.csv", "-o", "/proc/mine.toml", "--yield-strength", "4"),
        ("fit", "data.csv", "--plot", "/proc/fit.png"),
    ],
    ids=lambda words: f"{words[0]} {words[-1]}",
)
def test_every_command_finds_it_before_the_work(
    arguments: tuple[str, ...],
) -> None:
    from typer.testing import CliRunner

    from bellows_design.cli.commands import app

    done = CliRunner().invoke(app, list(arguments))
    assert done.exit_code == 2 and "cannot be written" in done.stderr
    assert "geometry" not in done.stderr and "data.csv" not in done.stderr
