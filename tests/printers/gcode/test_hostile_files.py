"""Files that are no G-code, or would take all memory or time: one sentence."""

from __future__ import annotations

import os
import tracemalloc
from collections.abc import Callable
from pathlib import Path

import pytest

from printers.errors import PrintersError
from printers.gcode.reading import GCode, read_gcode


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"GCDE\1\0\0\0" + bytes(100), "binary G-code; convert it to text"),
        (b"PK\3\4" + bytes(100), "zip archive; unpack it"),
        (b"\x7fELF" + bytes(100), "no text, so no G-code"),
        (bytes(1000), "no text, so no G-code"),
        (b"", "lays down no plastic"),
        (b"G1 X5 F900\n", "lays down no plastic"),
        (b"solid part\nfacet normal 0 0 1\n", "lays down no plastic"),
        (b"\n" * 100_000, "lays down no plastic"),
        (";" + "a" * 200_000 + "\n", "line 1 of the G-code is longer than 100 kB"),
        ("G1 X1\n" + "G1 " * 500_000, "a line longer than 100 kB"),
        (b"G1 X\xff E1\n", "line 1 of the G-code has a letter without a number"),
        (b"G1 \xff E1\n", "line 1 of the G-code has a number without a letter"),
        (b"M83\nG1 Z.2\nG1 X5 E1\n\0", "no text"),
    ],
)
def test_what_is_no_gcode_is_named(
    read: Callable[..., GCode], content: str | bytes, message: str
) -> None:
    with pytest.raises(PrintersError, match=message):
        read(content)


def test_a_missing_file_a_folder_and_a_pipe_are_named(tmp_path: Path) -> None:
    with pytest.raises(PrintersError, match="cannot be read: No such file"):
        read_gcode(tmp_path / "none.gcode")
    with pytest.raises(PrintersError, match="it is no file"):
        read_gcode(tmp_path)
    os.mkfifo(tmp_path / "pipe")
    with pytest.raises(PrintersError, match="it is no file"):
        read_gcode(tmp_path / "pipe")
    with pytest.raises(PrintersError, match="cannot be read"):
        read_gcode("a\0b")


def test_a_file_beyond_the_largest_is_refused_before_it_is_read(
    read: Callable[..., GCode], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("printers.gcode.pieces.LARGEST_FILE", 1_000_000)
    with pytest.raises(PrintersError, match="larger than 1 MB"):
        read("; long\n" * 200_000)


def test_more_beads_than_are_kept_are_refused(
    read: Callable[..., GCode], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("printers.gcode.reading.MOST_BEADS", 99)
    with pytest.raises(PrintersError, match="more than 99 beads"):
        read("M83\nG1 Z.2\n" + "G1 X5 E1\nG1 X0 E1\n" * 50)


@pytest.mark.parametrize("line", ["; key_{} = value\n", ";TYPE:Feature {}\n", "; plain {}\n"])
def test_comments_of_a_hostile_file_take_no_memory_beyond_a_bound(
    read: Callable[..., GCode], line: str
) -> None:
    text = "M83\nG1 Z.2\nG1 X5 E1\n" + "".join(line.format(number) for number in range(30_000))
    tracemalloc.start()
    code = read(text)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert len(code.settings) <= 5_000 and sum(map(len, code.notes)) < 3_000
    assert peak < 60e6  # the rows of a piece of short lines, mostly


@pytest.mark.parametrize(
    "comment",
    [
        ";HEIGHT:nan",
        ";HEIGHT:-1",
        ";HEIGHT:1e9",
        ";WIDTH:inf",
        ";WIDTH:",
        ";HEIGHT:0",
        ";TYPE:",
        "; filament used [mm] = none",
        ";TIME:soon",
        "; estimated printing time (normal mode) = never",
        ";Generated with",
    ],
)
def test_comments_that_make_no_sense_are_passed_over(
    read: Callable[..., GCode], comment: str
) -> None:
    code = read(f"{comment}\nM83\nG1 Z.2\nG1 X5 E1\n")
    assert code.beads.height.tolist() == [0.2]
    assert code.estimated_time is None and code.stated_filament_length is None


@pytest.mark.parametrize(
    ("limit", "message"),
    [
        ("comments.MOST_COMMENTS", "more than 5 lines of comments"),
        ("pieces.MOST_LINES", "more than 0 million lines"),
    ],
)
def test_more_lines_than_a_print_has_are_refused(
    read: Callable[..., GCode], monkeypatch: pytest.MonkeyPatch, limit: str, message: str
) -> None:
    monkeypatch.setattr(f"printers.gcode.{limit}", 5)
    with pytest.raises(PrintersError, match=message):
        read("; comment\n" * 6)
