"""A file of G-code as pieces of whole lines, so that no file takes more memory than another."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from printers.errors import PrintersError
from printers.gcode.words import LONGEST_LINE

LARGEST_FILE = 300_000_000
"""Bytes; a print of a day has a tenth of it."""

MOST_LINES = 20_000_000
"""A day's print has a twentieth of it."""

PIECE = 1_000_000
"""Bytes read at a time."""


def pieces(path: Path) -> Iterator[bytes]:
    """Whole lines of the file, about a megabyte at a time."""
    if path.exists() and not path.is_file():
        raise PrintersError("it is no file")  # reading from a pipe would wait for a writer
    with path.open("rb") as file:
        rest, total, lines = b"", 0, 0
        while block := file.read(PIECE):
            total += len(block)
            _refuse_other_files(block, first=total == len(block))
            lines += block.count(b"\n")
            if lines > MOST_LINES:
                raise PrintersError(f"it has more than {MOST_LINES // 1_000_000} million lines")
            if total > LARGEST_FILE:
                raise PrintersError(f"it is larger than {LARGEST_FILE // 1_000_000} MB")
            whole, newline, tail = (rest + block).rpartition(b"\n")
            rest = tail
            if len(rest) > LONGEST_LINE:
                raise PrintersError(f"it has a line longer than {LONGEST_LINE // 1000} kB")
            if newline:
                yield whole + newline
        if rest:
            yield rest


def _refuse_other_files(block: bytes, first: bool) -> None:
    if first and block.startswith(b"GCDE"):
        raise PrintersError(
            "it is binary G-code; convert it to text in the slicer, or slice again with binary "
            "G-code switched off"
        )
    if first and block.startswith(b"PK\x03\x04"):
        raise PrintersError("it is a zip archive; unpack it, the G-code is inside (Metadata/)")
    if b"\0" in block:
        raise PrintersError("it is no text, so no G-code")
