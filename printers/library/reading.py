"""Reading a small TOML file that may be anything: what takes too long or too much is refused."""

from __future__ import annotations

import os
import tomllib
from importlib.resources.abc import Traversable
from pathlib import Path
from typing import Any

from printers.errors import PrintersError, near, quoted, shortened
from printers.toml_errors import toml_error

LARGEST_FILE = 1_000_000
"""Bytes. No such file is longer; a larger file was named by mistake."""

MOST_DOTS = 100
"""In a line. The time that TOML takes to read grows with the square of a dotted key's parts."""


def read_table(source: Traversable, noun: str, shown: str) -> dict[str, Any]:
    """The table in the file `source`, which sentences call the `noun` `shown`.

    Raises PrintersError with one sentence.
    """
    name = quoted(shown)
    try:
        return _parsed(_text(source))
    except FileNotFoundError:
        raise PrintersError(f"there is no {noun} file {name}{_near(source)}") from None
    except (OSError, ValueError, RecursionError) as error:
        reason = getattr(error, "strerror", None) or shortened(str(error)).rstrip(".")
        raise PrintersError(f"{noun} {name} cannot be read: {reason}") from None


def _near(source: Traversable) -> str:
    """The file beside the missing one whose name is most like its."""
    if not isinstance(source, Path) or not source.parent.is_dir():
        return ""
    return near(source.name, [each.name for each in source.parent.glob("*.toml")])


def _text(source: Traversable) -> str:
    """The file's text, a mark at its beginning left out; ValueError if it is none or too long."""
    if isinstance(source, Path) and source.exists() and not (source.is_file() or source.is_dir()):
        raise ValueError("it is no file")  # reading from a pipe would wait for a writer
    content = _content(source) if isinstance(source, Path) else source.read_bytes()
    if len(content) > LARGEST_FILE:
        raise ValueError("it is larger than 1 MB")
    return content.decode("utf-8-sig")


def _content(path: Path) -> bytes:
    """So much of the file that it is seen whether it is too long."""
    content = b""
    with open(path, "rb", buffering=0, opener=_without_waiting) as file:
        while len(content) <= LARGEST_FILE:
            piece = file.read(LARGEST_FILE)
            if piece is None:  # a file of the kernel's, such as /proc/kmsg
                raise ValueError("it has no end")
            if not piece:
                break
            content += piece
    return content


def _without_waiting(path: str, flags: int) -> int:
    return os.open(path, flags | getattr(os, "O_NONBLOCK", 0))


def _parsed(text: str) -> dict[str, Any]:
    if any(line.count(".") > MOST_DOTS for line in text.split("\n")):
        raise ValueError(f"it has a line with more than {MOST_DOTS} dots")
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise ValueError(toml_error(error, text)) from None
