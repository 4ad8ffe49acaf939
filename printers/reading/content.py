"""The bytes of a file that is one, and not too long."""

from __future__ import annotations

import os
import stat
from pathlib import Path

from printers.errors import PrintersError
from printers.reading.limits import LARGEST_FILE


def content_of(path: Path, largest: int = LARGEST_FILE) -> bytes:
    """All bytes of a regular file.

    Raises PrintersError for a folder, a pipe, a device, an empty file and one of more than
    `largest` bytes; OSError where it cannot be read.
    """
    # Without O_NONBLOCK a pipe would wait here for someone to write into it.
    number = os.open(path, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0))
    try:
        found = os.fstat(number)
        _require_regular(found, largest)
        with open(number, "rb", closefd=False) as file:
            content = file.read(found.st_size + 1)  # a place for all of this is taken at once
    finally:
        os.close(number)
    if not content:
        raise PrintersError("it is empty")
    _require_size(len(content), largest)
    return content


def _require_regular(found: os.stat_result, largest: int) -> None:
    if stat.S_ISDIR(found.st_mode):
        raise PrintersError("it is a folder, not a file")
    if not stat.S_ISREG(found.st_mode):
        raise PrintersError("it is a pipe or a device, not a file")
    _require_size(found.st_size, largest)


def _require_size(size: int, largest: int) -> None:
    if size > largest:
        raise PrintersError(
            f"it has {size / 2**20:.0f} MiB; at most {largest / 2**20:.0f} MiB are read"
        )
