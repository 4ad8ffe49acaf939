"""A stream that is closed, full or not read takes no verdict with it."""

from __future__ import annotations

import json
import os
import sys
from pathlib import Path

import pytest
from real_command import bellows

from bellows_design.cli.surroundings.streams import Sink

pytestmark = pytest.mark.skipif(not Path("/dev/full").exists(), reason="no /dev/full")


@pytest.mark.parametrize(
    ("redirected", "status", "words"),
    [
        (">&-", 0, "it is closed; the command itself ended with status 0."),
        (">/dev/full", 2, "No space left on device; the command itself ended with status 0."),
    ],
)
def test_an_answer_that_is_lost_is_one_sentence(redirected: str, status: int, words: str) -> None:
    ended = bellows("list", redirected=redirected)
    assert (ended.status, ended.out) == (status, "")
    assert ended.err.count("\n") == 1 and words in ended.err


@pytest.mark.parametrize("redirected", ["2>/dev/full", "2>&-", "<&- 2>&-"])
def test_sentences_that_cannot_be_written_leave_answer_and_status(redirected: str) -> None:
    ended = bellows("check", "nowhere", "--json", redirected=redirected)
    assert (ended.status, ended.err) == (2, "")
    assert json.loads(ended.out)["exit_status"] == 2


@pytest.mark.slow
@pytest.mark.parametrize("redirected", ["2>/dev/full", "2>&-"])
@pytest.mark.parametrize(("wall", "status"), [("1.2", 0), ("1.3", 1)])
def test_a_verdict_is_not_lost_with_the_progress(redirected: str, wall: str, status: int) -> None:
    settings = ("--set", f"bubble_thickness={wall}")
    ended = bellows("check", "finger", *settings, "--json", redirected=redirected)
    assert ended.status == status
    assert json.loads(ended.out)["verdict"] == ("fail" if status else "pass")


@pytest.mark.slow
@pytest.mark.parametrize("arguments", [("--help",), ("--version",), ("list", "--json")])
@pytest.mark.parametrize("redirected", [">/dev/full", ">&-", "| head -0; exit ${PIPESTATUS[0]}"])
def test_no_stream_makes_a_refusal(arguments: tuple[str, ...], redirected: str) -> None:
    """Status 1 is a verdict, and nothing else."""
    ended = bellows(*arguments, redirected=redirected)
    assert ended.status == (2 if "full" in redirected else 0)
    assert "Traceback" not in ended.err


@pytest.mark.slow
@pytest.mark.parametrize("redirected", ["2>/dev/full", "2>&-", ">&- 2>&-"])
def test_a_mistaken_option_has_status_2_also_where_nobody_reads_of_it(redirected: str) -> None:
    assert bellows("nonsense", redirected=redirected).status == 2


@pytest.mark.slow
@pytest.mark.parametrize("encoding", ["ascii", "latin-1", "utf-8"])
def test_json_stays_the_same_in_any_encoding(encoding: str) -> None:
    usual = bellows("list", "--json")
    other = bellows("list", "--json", variables={"PYTHONIOENCODING": encoding})
    assert other.status == 0 and json.loads(other.out) == json.loads(usual.out)


def test_a_reader_that_leaves_is_no_failure_but_remembered(tmp_path: Path) -> None:
    reader, writer = os.pipe()
    os.close(reader)
    with Sink(writer, "w") as sink:
        assert sink.write(b"four") == 4 and sink.write(b"more") == 4
        assert isinstance(sink.failure, BrokenPipeError)


@pytest.mark.skipif(sys.platform == "win32", reason="pipes of POSIX")
def test_a_full_pipe_that_does_not_wait_is_waited_for() -> None:
    """Another program at the same terminal may have made stdout so."""
    import threading

    reader, writer = os.pipe()
    os.set_blocking(writer, False)
    content, found = b"x" * 300_000, bytearray()

    def read() -> None:
        while piece := os.read(reader, 4096):
            found.extend(piece)

    thread = threading.Thread(target=read)
    with Sink(writer, "w") as sink:
        rest = memoryview(content)
        thread.start()
        while len(rest):
            rest = rest[sink.write(rest) :]
        assert sink.failure is None
    thread.join()
    os.close(reader)
    assert bytes(found) == content
