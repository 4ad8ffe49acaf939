"""However a command ends, no half-written file stands under a final name."""

from __future__ import annotations

import json
import os
import random
import re
import signal
import subprocess
import sys
import time
import weakref
from collections.abc import Callable
from pathlib import Path
from typing import ClassVar

import pytest

from bellows_design.cli.answer import explained
from bellows_design.cli.interruption import Interrupted, Signals, raising_signals
from bellows_design.files.atomic import MARK, remove

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="signals of POSIX")

FAKES, ROOT = Path(__file__).parents[1], Path(__file__).parents[3]
GENTLE = {signal.SIGINT: 130, signal.SIGTERM: 143, signal.SIGHUP: 129}
CSV = "stretch,stress_mpa\n" + "".join(f"{1 + 0.1 * i},{0.2 * i:g}\n" for i in range(1, 9))
FIT = ("fit", "data.csv", "--model", "neo-hooke", "-o", "mine.toml", "--yield-strength", "4")

EARLY = {"__init__", "__main__", "early_signals"}
"""Modules that are imported before signals are handled."""

STRUCK_WHILE_WRITING = """
import os, sys, time
sys.path.insert(0, sys.argv.pop(1))
number = int(sys.argv.pop(1))
from types import SimpleNamespace
from fakes import FakeEvaluation, fake_report
from bellows_design import pipeline
from bellows_design.export import approved, contents, formats, statements
from bellows_design.export.formats import Part
from bellows_design.files import atomic

def struck(path):
    assert path.exists()
    os.kill(os.getpid(), number)
    time.sleep(60)

def struck_before(first, second, *_):
    struck(second if first.__class__ is Part else first)

def write(path):
    with atomic.replacing(path) as temporary:
        temporary.write_text("half")

atomic._settle = struck
approved._require_written = formats.require_same = struck_before
formats.WRITERS = contents.WRITERS = {".stl": lambda part: b"solid"}
statements.companions = lambda found: {}
body = SimpleNamespace(triangles=(), volume=0.0)
pipeline.build_part = lambda design: Part(design.name, "", design.digest, None, body)
pipeline.check = lambda *_: fake_report()
sys.modules["bellows_design.analysis.evaluate"] = SimpleNamespace(
    evaluate=lambda *_, **__: FakeEvaluation(),
    refined=None,
)
sys.modules["bellows_design.exchange.actuator"] = SimpleNamespace(
    write_actuator=lambda result, path: write(path),
)
study = SimpleNamespace(to_dict=lambda: {"meshes": []}, converged=True)
sys.modules["bellows_design.benchmark.study"] = SimpleNamespace(
    DEFAULT_MODELS=(), study=lambda *_, **__: study
)
from bellows_design.__main__ import main
main()
"""


def heeding() -> None:
    """In a new process: what a shell runs in its background may be deaf to signals."""
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.SIG_DFL)


def struck(folder: Path, number: int, *arguments: str) -> tuple[int, str, str]:
    """Run a command that gets a signal when its file is written but not yet in place."""
    (folder / "data.csv").write_text(CSV)
    done = subprocess.run(
        [sys.executable, "-c", STRUCK_WHILE_WRITING, str(FAKES), str(number), *arguments],
        cwd=folder,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        capture_output=True,
        encoding="utf-8",
        preexec_fn=heeding,
        timeout=60,
    )
    (folder / "data.csv").unlink()
    return done.returncode, done.stdout, done.stderr


COMMANDS = {
    "design": ("design", "prototype_1", "-o", "part.stl"),
    "evaluate": ("evaluate", "prototype_1", "--vtu", "bent.vtu", "--no-cache"),
    "run": ("run", "prototype_1", "--output", ".", "--no-cache"),
    "fit": FIT,
    "benchmark": ("benchmark", "--output", "speed.json"),
}


@pytest.mark.parametrize(
    ("command", "number"), [*zip(COMMANDS, [*GENTLE, *[*GENTLE][:2]], strict=True)]
)
@pytest.mark.thorough
def test_a_signal_while_a_file_is_written_leaves_nothing_and_says_so(
    command: str, number: signal.Signals, tmp_path: Path
) -> None:
    status, out, err = struck(tmp_path, number, *COMMANDS[command])
    assert status == GENTLE[number] and out == ""
    assert "nothing half-done was left behind" in err.splitlines()[-1]
    assert err.count("bellows: ") == 1 and "Traceback" not in err
    assert list(tmp_path.iterdir()) == []


@pytest.mark.thorough
def test_what_a_kill_leaves_has_no_final_name_and_the_next_run_removes_it(tmp_path: Path) -> None:
    assert struck(tmp_path, signal.SIGKILL, *COMMANDS["run"])[0] == -signal.SIGKILL
    (leftover,) = tmp_path.iterdir()
    assert leftover.name.startswith(".") and MARK in leftover.name
    assert struck(tmp_path, signal.SIGTERM, *COMMANDS["run"])[0] == 143
    assert list(tmp_path.iterdir()) == []


def test_a_signal_before_the_command_is_even_loaded_is_one_sentence_too() -> None:
    code = (
        "import os, signal, sys\n"
        "class Struck:\n"
        "    def find_spec(self, name, *_):\n"
        "        if name == 'typer': os.kill(os.getpid(), signal.SIGINT)\n"
        "sys.meta_path.insert(0, Struck())\n"
        "from bellows_design.__main__ import main\n"
        "main()"
    )
    done = subprocess.run(
        [sys.executable, "-c", code, "list"],
        cwd=ROOT,
        capture_output=True,
        encoding="utf-8",
        preexec_fn=heeding,
        timeout=60,
    )
    assert (done.returncode, done.stdout) == (130, "")
    assert done.stderr == "bellows: interrupted; nothing half-done was left behind.\n"


def test_a_second_signal_does_not_disturb_the_clearing_up() -> None:
    signals = Signals()
    with pytest.raises(Interrupted):
        signals.receive(signal.SIGTERM, None)
    signals.receive(signal.SIGTERM, None)  # at once: no second exception
    signals._latest -= 2.0
    with pytest.raises(Interrupted):  # later: the first was swallowed somewhere
        signals.receive(signal.SIGINT, None)
    assert signals.received == [signal.SIGTERM, signal.SIGINT]


def test_a_signal_within_an_import_waits_for_its_end(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """OCP, for one, crashes when its initialization is interrupted."""
    (tmp_path / "struck_module.py").write_text(
        "import os, signal, time\n"
        "os.kill(os.getpid(), signal.SIGTERM)\n"
        "time.sleep(0.2)\n"
        "whole = True\n"
    )
    monkeypatch.syspath_prepend(tmp_path)
    with pytest.raises(Interrupted), raising_signals():
        import struck_module  # type: ignore[import-not-found]

        for _ in range(100):
            time.sleep(0.05)
    assert sys.modules.pop("struck_module").whole
    assert struck_module.whole


class Released:
    """Is told in ``order`` when it goes, and raises a signal meanwhile."""

    order: ClassVar[list[str]] = []

    @classmethod
    def release(cls) -> None:
        signal.raise_signal(signal.SIGTERM)
        cls.order.append("released")

    def __del__(self) -> None:
        self.release()


class Finalized:
    def __init__(self) -> None:
        weakref.finalize(self, Released.release)


@pytest.mark.parametrize("kind", [Released, Finalized])
def test_a_signal_where_python_drops_exceptions_comes_again(
    kind: type, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """A command would go on as if nothing had come; what a finalizer releases is released."""
    monkeypatch.setattr(Released, "order", [])
    with pytest.raises(Interrupted), raising_signals() as signals:
        thing = kind()
        del thing
        for _ in range(100):
            time.sleep(0.05)
    assert set(signals.received) == {signal.SIGTERM}
    assert Released.order == (["released"] if kind is Finalized else [])
    assert capsys.readouterr().err == ""


def test_signals_do_afterwards_what_they_did() -> None:
    usual = [signal.getsignal(number) for number in GENTLE]
    with pytest.raises(Interrupted) as error, raising_signals():
        signal.raise_signal(signal.SIGTERM)
        time.sleep(1)
    assert [signal.getsignal(number) for number in GENTLE] == usual
    assert explained(error.value) == ("terminated; nothing half-done was left behind.", 143)


def test_a_signal_that_was_to_be_ignored_is_ignored() -> None:
    """As nohup and the shell's background jobs ask for."""
    usual = signal.signal(signal.SIGHUP, signal.SIG_IGN)
    try:
        with raising_signals() as signals:
            signal.raise_signal(signal.SIGHUP)
        assert signals.received == []
    finally:
        signal.signal(signal.SIGHUP, usual)


def complete(path: Path) -> bool:
    """True if a result is all there."""
    if path.is_dir():
        present = {file.name for file in path.iterdir()}
        listed = json.loads((path / "manifest.json").read_text("utf-8"))["files"]
        report = json.loads((path / "run.json").read_text("utf-8"))["report"]
        return len(listed) > 3 and present == {"manifest.json", "run.json", *report, *listed}
    content = path.read_bytes()
    if path.suffix == ".stl":
        return len(content) == 84 + 50 * int.from_bytes(content[80:84], "little")
    if path.suffix == ".json":
        return bool(json.loads(content))
    ending = {".vtu": b"</VTKFile>", ".toml": b"\n", ".step": b"END-ISO-10303-21;"}[path.suffix]
    return content.rstrip(b"\r\n ").endswith(ending.strip()) and len(content) > 100


SHORT = ("--set", "length=18", "--set", "number_of_bubbles=2")
REAL = {
    "design": ("design", "finger", "-o", "part.stl"),
    "evaluate": ("evaluate", "prototype_1", "--vtu", "bent.vtu"),
    "run": ("run", "finger", *SHORT, "--output", "."),
    "fit": FIT,
}


@pytest.mark.slow
@pytest.mark.parametrize("command", REAL)
def test_commands_struck_at_any_moment_leave_all_or_nothing(command: str, tmp_path: Path) -> None:
    """Signals at moments spread over the whole run, a kill among them; then one that may end."""
    chance = random.Random(command)
    whole = _struck_at(None, None, REAL[command], tmp_path)
    strikes = (signal.SIGINT, signal.SIGTERM, signal.SIGKILL, signal.SIGINT, signal.SIGTERM)
    for part, number in enumerate(strikes):
        moment = whole * (part + chance.random()) / len(strikes)
        _struck_at(number, moment, REAL[command], tmp_path)
    _struck_at(None, None, REAL[command], tmp_path)
    names = [path.name for path in tmp_path.iterdir() if MARK in path.name]
    assert names == []


def _struck_at(
    number: signal.Signals | None, moment: float | None, arguments: tuple[str, ...], folder: Path
) -> float:
    """Run a command in ``folder``, give it a signal at a moment, and look; seconds it took."""
    rooms = folder / "temporary"
    rooms.mkdir(exist_ok=True)
    (folder / "data.csv").write_text(CSV)
    before = {path for path in folder.iterdir() if MARK in path.name}
    begin = time.monotonic()
    program = subprocess.Popen(
        [sys.executable, "-m", "bellows_design", *arguments],
        cwd=folder,
        env={**os.environ, "PYTHONPATH": str(ROOT), "TMPDIR": str(rooms)},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        encoding="utf-8",
        preexec_fn=heeding,
    )
    if number is not None and moment is not None:
        time.sleep(moment)
        program.send_signal(number)
    _, err = program.communicate(timeout=300)
    seconds = time.monotonic() - begin
    seen = set(re.findall(r"bellows_design/(?:\w+/)*(\w+)\.py", err))
    python_starts = number == signal.SIGINT and seen <= EARLY
    assert "Traceback" not in err or python_starts, err
    if number is None:
        assert program.returncode in (0, 1), err
    elif program.returncode not in (0, 1) or "Traceback" in err:
        # Python itself, while it starts or ends, dies of the signal: to a shell that is the same.
        assert program.returncode in (-number, GENTLE.get(number), 1), (moment, err)
        said = program.returncode == GENTLE.get(number)
        assert err.count("bellows: ") == said, err
    assert _soon(lambda: not any(rooms.iterdir())), list(rooms.rglob("*"))
    left = {path for path in folder.iterdir() if MARK in path.name}
    assert number == signal.SIGKILL or left <= before, left
    results = {path for path in folder.iterdir() if path.name not in ("data.csv", "temporary")}
    assert all(complete(path) for path in results - left), results
    for path in results - left:
        remove(path)
    return seconds


def _soon(condition: Callable[[], bool], seconds: float = 20.0) -> bool:
    deadline = time.monotonic() + seconds
    while not condition() and time.monotonic() < deadline:
        time.sleep(0.05)
    return condition()
