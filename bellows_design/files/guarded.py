"""Files of a user read with a bound: neither devices nor pipes, which may never end, nor too much.

What a path leads to is looked at once it is open, and opened without waiting: a pipe waits for a
writer, and some files of the kernel's, such as ``/proc/kmsg``, call themselves regular and wait for
ever.
"""

from __future__ import annotations

import os
import stat
from pathlib import Path

from bellows_design.errors import DesignError
from bellows_design.validation.quoting import near_file, quoted_path

PIECE = 2**20
"""Bytes that are read at once."""


def read_file(path: Path, noun: str, most: int, shown: str = "") -> bytes:
    """The content of the regular file at ``path``, of at most ``most`` bytes.

    Raises ``DesignError`` for anything else; messages call the file the ``noun`` ``shown``, or by
    its path.
    """
    given = quoted_path(shown or path)
    try:
        descriptor = os.open(path, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | _BINARY)
        try:
            _require_regular(os.fstat(descriptor).st_mode, given, noun)
            return _content(descriptor, given, noun, most)
        finally:
            os.close(descriptor)
    except FileNotFoundError:
        raise DesignError(f"there is no file {given}{near_file(path) or '.'}") from None
    except (OSError, ValueError) as error:  # ValueError: a null byte in the path
        if isinstance(error, DesignError):
            raise
        reason = getattr(error, "strerror", None) or error
        raise DesignError(f"{noun} {given} cannot be read: {reason}.") from None


def decoded(content: bytes, subject: str) -> str:
    """``content`` as text in UTF-8, with or without a byte order mark, and lines ended by ``\\n``.

    Raises ``DesignError`` with a sentence on ``subject``.
    """
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError:
        raise DesignError(f"{subject} is not a text file in UTF-8.") from None
    return text.replace("\r\n", "\n").replace("\r", "\n")


_BINARY = getattr(os, "O_BINARY", 0)
_KINDS = (
    (stat.S_ISDIR, "a folder"),
    (stat.S_ISFIFO, "a pipe"),
    (stat.S_ISSOCK, "a socket"),
    (lambda mode: stat.S_ISCHR(mode) or stat.S_ISBLK(mode), "a device"),
)


def _require_regular(mode: int, given: str, noun: str) -> None:
    for is_kind, kind in _KINDS:
        if is_kind(mode):
            raise DesignError(f"{given} is {kind}, not a {noun} file.")


def _content(descriptor: int, given: str, noun: str, most: int) -> bytes:
    content = bytearray()
    while len(content) <= most:
        try:
            piece = os.read(descriptor, PIECE)
        except BlockingIOError:
            raise DesignError(f"{given} has no end, as a {noun} file has.") from None
        if not piece:
            return bytes(content)
        content += piece
    raise DesignError(f"{noun} {given} is larger than {most // 10**6} MB.")
