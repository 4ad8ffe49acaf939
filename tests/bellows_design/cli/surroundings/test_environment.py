"""Settings of the environment that are no reason to stop, and folders that are not there."""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from real_command import ROOT, bellows

from bellows_design.cli.surroundings import environment

POSIX = pytest.mark.skipif(sys.platform == "win32", reason="processes of POSIX")
pytestmark = POSIX


@pytest.mark.parametrize("width", ["0", "-5", "1", "garbage", "9" * 20])
def test_a_width_that_is_none_is_ignored(width: str, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in environment.WIDTHS:
        monkeypatch.setenv(name, width)
    environment.use_plain_environment()
    assert not {*environment.WIDTHS} & {*os.environ}


def test_a_terminal_without_columns_still_shows_the_answer() -> None:
    ended = bellows("list", variables={"COLUMNS": "0", "TERMINAL_WIDTH": "x"})
    assert ended.status == 0 and "prototype_1" in ended.out


@pytest.mark.parametrize("layer", ["omp", "workqueue"])
def test_what_may_be_chosen_is_left(layer: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("NUMBA_THREADING_LAYER", layer)
    monkeypatch.setenv("COLUMNS", "100")
    environment.use_plain_environment()
    assert (os.environ["NUMBA_THREADING_LAYER"], os.environ["COLUMNS"]) == (layer, "100")


@pytest.mark.slow
@pytest.mark.parametrize(
    "variables",
    [
        {"PYTHONWARNINGS": "error"},
        {"TERM": "dumb", "NO_COLOR": "1"},
        {"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"},
        {"NUMBA_THREADING_LAYER": "garbage"},
        {"NUMBA_NUM_THREADS": "garbage", "OMP_NUM_THREADS": "garbage"},
        {"HOME": "/proc/nowhere"},
    ],
    ids=str,
)
def test_such_an_environment_is_no_reason_to_stop(variables: dict[str, str]) -> None:
    ended = bellows("check", "finger", variables=variables)
    assert ended.status == 0, ended.err
    assert "printability: pass" in ended.out


@pytest.mark.slow
@pytest.mark.parametrize(
    "variables",
    [
        *({"MKL_INTERFACE_LAYER": name} for name in ("GNU", "ILP64", "GNU,ILP64")),
        *({"MKL_THREADING_LAYER": name} for name in ("GNU", "TBB", "PGI", "SEQUENTIAL")),
        {"NUMBA_THREADING_LAYER": "garbage"},
        {"PYTHONWARNINGS": "error"},
    ],
    ids=str,
)
def test_libraries_are_used_as_we_use_them_whatever_others_asked_for(
    variables: dict[str, str],
) -> None:
    ended = bellows("evaluate", "prototype_1", variables=variables)
    assert ended.status == 0, ended.err
    assert "223.8°" in ended.out


@pytest.mark.slow
@pytest.mark.skipif(shutil.which("setpriv") is None, reason="no setpriv to give up rights with")
def test_an_installation_that_nobody_may_write_to_works_without_a_home(tmp_path: Path) -> None:
    """As of a daemon, or in a container: kernels are compiled and kept nowhere."""
    packages = ("bellows_design", "solver", "printers")
    for name in packages:
        shutil.copytree(ROOT / name, tmp_path / name, ignore=shutil.ignore_patterns("__pycache__"))
    for path in (tmp_path, *tmp_path.rglob("*")):
        path.chmod(0o555 if path.is_dir() else 0o444)
    rights = "-dac_override,-dac_read_search,-fowner" if os.geteuid() == 0 else ""
    without = ["setpriv", f"--bounding-set={rights}"] if rights else []
    variables = {"HOME": "/proc/nowhere", "PYTHONPATH": str(tmp_path)}
    environ = {k: v for k, v in os.environ.items() if k != "NUMBA_CACHE_DIR"}
    done = subprocess.run(
        [*without, sys.executable, "-m", "bellows_design", "check", "finger"],
        cwd="/",
        env={**environ, **variables},
        capture_output=True,
        encoding="utf-8",
        timeout=300,
    )
    assert done.returncode == 0, done.stderr
    assert "printability: pass" in done.stdout
    assert not [*tmp_path.rglob("__pycache__")]
    for path in (tmp_path, *tmp_path.rglob("*")):
        path.chmod(0o755)


@pytest.mark.parametrize(
    "arguments",
    [("evaluate", "prototype_1"), ("design", "finger", "-o", "part.stl"), ("run", "finger")],
    ids=lambda words: words[0],
)
def test_a_working_folder_that_was_deleted_is_named_and_nothing_left(
    arguments: tuple[str, ...], tmp_path: Path
) -> None:
    (tmp_path / "gone").mkdir()
    rooms = tmp_path / "temporary"
    rooms.mkdir()
    ended = bellows(
        *arguments,
        folder=tmp_path / "gone",
        limits=f"rmdir '{tmp_path}/gone';",
        variables={"TMPDIR": str(rooms)},
    )
    assert ended.status == 2 and "the working folder was deleted" in ended.err
    assert "geometry" not in ended.err
    assert list(rooms.iterdir()) == []


@pytest.mark.slow
@pytest.mark.parametrize("moment", [0.5, 1.5, 4.0, 10.0, 18.0])
def test_ctrl_c_answers_soon_also_while_kernels_compile(moment: float, tmp_path: Path) -> None:
    """The bound is that of a machine that does nothing else; the test allows for others."""
    rooms = tmp_path / "temporary"
    rooms.mkdir()
    program = subprocess.Popen(
        [sys.executable, "-m", "bellows_design", "evaluate", "prototype_1", "--json"],
        cwd=tmp_path,
        env={
            **os.environ,
            "PYTHONPATH": str(ROOT),
            "NUMBA_CACHE_DIR": str(tmp_path / "none_yet"),
            "TMPDIR": str(rooms),
        },
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        encoding="utf-8",
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )
    time.sleep(moment)
    struck = time.monotonic()
    program.send_signal(signal.SIGINT)
    out, err = program.communicate(timeout=60)
    assert time.monotonic() - struck < 5.0
    assert program.returncode == 130 and err.count("bellows: interrupted") == 1, err
    assert '"exit_status": 130' in out or moment < 1
    deadline = time.monotonic() + 10
    while any(rooms.iterdir()) and time.monotonic() < deadline:
        time.sleep(0.05)
    assert list(rooms.iterdir()) == []
