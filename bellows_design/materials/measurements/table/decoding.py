"""The content of a file of measurements as text, whatever its encoding; files are read bounded."""

from __future__ import annotations

import codecs
import re
from pathlib import Path

from bellows_design.errors import DesignError
from bellows_design.files.guarded import read_file

LARGEST_FILE = 20_000_000
"""Bytes."""

_MARKS = (
    (codecs.BOM_UTF8, "utf-8-sig"),
    (codecs.BOM_UTF32_LE, "utf-32"),
    (codecs.BOM_UTF32_BE, "utf-32"),
    (codecs.BOM_UTF16_LE, "utf-16"),
    (codecs.BOM_UTF16_BE, "utf-16"),
)
_CONTROL = re.compile(r"[\x00-\x08\x0e-\x1f\x7f]")
_LEGACY = "cp1252"
"""What Windows writes where it does not write UTF-8; of its letters Latin-1 has the same."""


def content_of(path: Path) -> bytes:
    """All bytes of the file. Raises ``DesignError``."""
    return read_file(path, "measurements", LARGEST_FILE)


def decoded(content: bytes, place: str) -> tuple[str, str | None]:
    """The text, and a note on an encoding other than UTF-8. Raises ``DesignError``."""
    encoding = _encoding(content)
    try:
        text = content.decode(encoding)
    except UnicodeDecodeError:
        raise DesignError(f"{place} is not a text file, as its byte order mark says.") from None
    if "\0" in text:
        raise DesignError(f"{place} is not a text file: it has a null character.")
    if encoding in (_LEGACY, "latin-1") and _CONTROL.search(text):
        raise DesignError(f"{place} is not a text file in UTF-8, UTF-16 or Latin-1.")
    return text, None if encoding.startswith("utf-8") else f"the text is read as {_shown(encoding)}"


def _encoding(content: bytes) -> str:
    for mark, encoding in _MARKS:
        if content.startswith(mark):
            return encoding
    half = len(content) // 2
    for start, encoding in ((1, "utf-16-le"), (0, "utf-16-be")):  # without a mark
        nulls, others = content[start::2].count(0), content[1 - start :: 2].count(0)
        if half >= 10 and nulls >= 0.9 * half and not others and len(content) % 2 == 0:
            return encoding
    try:
        content.decode("utf-8")
    except UnicodeDecodeError:
        return "latin-1" if _undefined_in_windows(content) else _LEGACY
    return "utf-8"


def _undefined_in_windows(content: bytes) -> bool:
    try:
        content.decode(_LEGACY)
    except UnicodeDecodeError:
        return True
    return False


def _shown(encoding: str) -> str:
    return "Latin-1" if encoding in (_LEGACY, "latin-1") else encoding.upper()
