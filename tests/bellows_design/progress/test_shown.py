"""Progress as it is shown: a line of a terminal with a bar, lines of a log, or nothing."""

from __future__ import annotations

import io
import os
import pty
import re
import select
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from rendered import Screen

from bellows_design.progress import on_stderr, shown_as
from bellows_design.progress.bar import ProgressBar, duration
from bellows_design.progress.course import Course, Stage
from bellows_design.progress.estimate import Estimate
from bellows_design.progress.shown import Shown

ROOT = Path(__file__).parents[3]
COURSE: Course = (Stage("solve 1", 10.0, 1000), Stage("ends", 30.0))


def test_a_log_gets_a_line_for_each_stage_and_note() -> None:
    log = io.StringIO()
    with on_stderr(log) as progress:
        progress.stage("solve 1, 1000 tetrahedra")
        progress.load(0.5, 20.0)  # within two seconds
        progress.note("something to know")
    assert re.sub(r"\[ *[\d.]+ s\]", "[]", log.getvalue()).splitlines() == [
        "[] solve 1, 1000 tetrahedra",
        "[] something to know",
    ]


@pytest.mark.parametrize("stream", [io.StringIO(), Screen()])
def test_quiet_is_quiet(stream: io.StringIO) -> None:
    with shown_as(Shown(quiet=True)), on_stderr(stream) as progress:
        progress.stage("solve 1")
        progress.note("something to know")
    assert stream.getvalue() == ""


def test_a_terminal_that_knows_no_controls_gets_lines(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("TERM", "dumb")
    screen = Screen()
    with on_stderr(screen) as progress:
        progress.stage("solve 1")
    assert "\x1b" not in screen.getvalue() and "solve 1" in screen.getvalue()


@pytest.mark.parametrize("width", [30, 40, 60, 80, 120])
def test_the_line_is_narrower_than_the_terminal(width: int) -> None:
    from rich.console import Console

    console = Console(file=Screen(), width=width)
    now = [0.0]
    bar = ProgressBar(console, Estimate([COURSE], lambda: now[0]))
    bar.stage("solve 1, 1000 tetrahedra")
    bar.load(0.4, 123.0, 0.3)
    now[0] = 5.0
    line = bar.__rich__().plain
    assert len(line) < width and re.search(r"\d+ %, (about )?\d+ s left", line)
    assert ("━" in line) == (width > 50)


def test_a_run_that_ended_well_teaches_its_course(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("TERM", "xterm")
    learnt: list[Course] = []
    with shown_as(Shown(learn=learnt.append)), on_stderr(Screen()) as progress:
        progress.stage("mesh 1")
        progress.stage("solve 1, 1000 tetrahedra")
    assert [(each.key, each.size) for each in learnt[0]] == [("mesh 1", 0), ("solve 1", 1000)]
    with (
        pytest.raises(ValueError),
        shown_as(Shown(learn=learnt.append)),
        on_stderr(Screen()) as progress,
    ):
        progress.stage("mesh 1")
        raise ValueError
    assert len(learnt) == 1


@pytest.mark.parametrize(
    ("seconds", "words"),
    [(0.2, "1 s"), (7.4, "7 s"), (43, "45 s"), (94, "95 s"), (150, "2 min"), (9000, "2 h 30 min")],
)
def test_the_longer_the_coarser(seconds: float, words: str) -> None:
    assert duration(seconds) == words


WORK = """
import sys, time
from bellows_design.cli.answer import Answer, answer
from bellows_design.progress import on_stderr

def work():
    with on_stderr() as progress:
        progress.stage("solve 1, 1000 tetrahedra")
        progress.note("begun")
        {wait}
    return Answer({{}}, ["done"])

try:
    answer(work, False)
except Exception as end:  # as the command line takes it
    sys.exit(end.exit_code)
"""
STUBBORN = "hashlib.pbkdf2_hmac('sha256', b'x', b'y', 10**9)"
"""Takes minutes in C, where no exception of Python's gets through."""


@pytest.mark.parametrize("wait", ["time.sleep(60)", f"import hashlib; {STUBBORN}"])
@pytest.mark.thorough
def test_an_interrupted_bar_leaves_the_terminal_as_it_was(wait: str, tmp_path: Path) -> None:
    """The cursor is shown again, and the sentence stands on a line of its own."""
    ours, theirs = pty.openpty()
    environment = {**os.environ, "TERM": "xterm", "PYTHONPATH": str(ROOT), "COLUMNS": "80"}
    environment["BELLOWS_CACHE"] = str(tmp_path)
    process = subprocess.Popen(
        [sys.executable, "-c", WORK.format(wait=wait)],
        stdin=theirs, stdout=theirs, stderr=theirs, env=environment, close_fds=True,
    )  # fmt: skip
    os.close(theirs)
    said = _read_until(ours, b"solve 1", 60)
    time.sleep(0.5)
    process.send_signal(signal.SIGINT)
    said += _read_until(ours, b"left behind.", 30)
    assert process.wait(30) == 130
    hidden, shown = said.rfind(b"\x1b[?25l"), said.rfind(b"\x1b[?25h")
    assert 0 <= hidden < shown
    last = said.split(b"bellows: interrupted")[0].split(b"\n")[-1]
    visible = re.sub(rb"\x1b\[[\d;?]*[A-Za-z]", b"", last.split(b"\x1b[2K")[-1]).strip()
    assert visible == b"", said[-400:]


def _read_until(source: int, words: bytes, seconds: float) -> bytes:
    """What comes from a terminal until it has these words, or ends."""
    said, end = b"", time.monotonic() + seconds
    while words not in said and time.monotonic() < end:
        if not select.select([source], [], [], 0.2)[0]:
            continue
        try:
            piece = os.read(source, 4096)
        except OSError:  # the other end is closed
            break
        if not piece:
            break
        said += piece
    assert words in said, said
    return said
