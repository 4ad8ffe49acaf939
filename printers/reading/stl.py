"""STL: binary, or text of the same facets. It states no units.

A binary file may begin with the word "solid" like a text, so the length decides: 84 bytes and 50
for each facet that it declares.
"""

from __future__ import annotations

import re

import numpy as np

from printers.arrays import Floats
from printers.errors import PrintersError, quoted
from printers.reading.part import NOT_STATED, ReadPart, require_few

HEADER = 84  # bytes: 80 of anything, and the number of facets
FACET = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
"""A facet of a binary file."""

_NUMBER = rb"\s+(\S{1,60})"
_VERTEX = rb"\s+vertex" + 3 * _NUMBER
_TEXT_FACET = re.compile(
    rb"\s*facet\s+normal(?:\s+\S{1,60}){3}\s+outer\s+loop"
    + 3 * _VERTEX
    + rb"\s+endloop\s+endfacet(?!\S)",
    re.IGNORECASE,
)
_TEXT_LINE = re.compile(rb"\s*(solid|endsolid)(?![^\s])[^\r\n]*", re.IGNORECASE)
MOST_SOLIDS = 10_000  # in one text
_FACETS_AT_ONCE = 20_000


def read_stl(content: bytes) -> ReadPart:
    """The facets of an STL file. Raises PrintersError."""
    if _is_text(content):
        corners, notes = _text_corners(content)
        kind = "STL, text"
    else:
        corners, notes = _binary_corners(content)
        kind = "STL, binary"
    triangles = np.arange(3 * len(corners)).reshape(-1, 3)
    return ReadPart(corners.reshape(-1, 3), triangles, kind, NOT_STATED, notes)


def _is_text(content: bytes) -> bool:
    exact = len(content) >= HEADER and len(content) == HEADER + _declared(content) * FACET.itemsize
    start = content[:4096].removeprefix(b"\xef\xbb\xbf").lstrip().lower()
    text = start.startswith(b"solid") and (b"facet" in start or b"endsolid" in start)
    return not exact and text and b"\0" not in start


def _declared(content: bytes) -> int:
    return int.from_bytes(content[80:HEADER], "little")


def _binary_corners(content: bytes) -> tuple[Floats, tuple[str, ...]]:
    if len(content) < HEADER:
        raise PrintersError(f"it has {len(content)} bytes, and an STL at least {HEADER}")
    count = _declared(content)
    needed = HEADER + count * FACET.itemsize
    if len(content) < needed:
        raise PrintersError(
            f"it declares {count} triangles, which take {needed} bytes, but it has {len(content)}: "
            "it is cut short, or no STL"
        )
    require_few(count)
    notes = _after_last(content[needed:], count)
    corners = np.frombuffer(content, FACET, count, HEADER)["corners"]
    with np.errstate(invalid="ignore"):  # signalling NaN
        return corners.astype(np.float64), notes


def _after_last(rest: bytes, count: int) -> tuple[str, ...]:
    """Notes on bytes behind the last declared facet, which must not be facets themselves."""
    if not rest:
        return ()
    if len(rest) >= FACET.itemsize and any(rest):
        more = len(rest) // FACET.itemsize
        raise PrintersError(f"it declares {count} triangles, but holds {more} more behind them")
    return (f"{len(rest)} bytes behind its last triangle mean nothing",)


def _text_corners(content: bytes) -> tuple[Floats, tuple[str, ...]]:
    blocks: list[Floats] = []
    numbers: list[bytes] = []
    place = 3 if content.startswith(b"\xef\xbb\xbf") else 0
    solids = open_solids = 0
    while place < len(content):
        if facet := _TEXT_FACET.match(content, place):
            numbers.extend(facet.groups())
            if len(numbers) == 9 * _FACETS_AT_ONCE:
                blocks.append(_as_corners(numbers))
                numbers = []
                require_few(len(blocks) * _FACETS_AT_ONCE)
            place = facet.end()
        elif line := _TEXT_LINE.match(content, place):
            begins = line[1].lower() == b"solid"
            if solids > MOST_SOLIDS:
                raise PrintersError(f"it holds more than {MOST_SOLIDS} solids")
            solids, open_solids = solids + begins, open_solids + (1 if begins else -1)
            place = line.end()
        elif not content[place:].strip():
            break
        else:
            raise _unread(content, place)
    if open_solids:
        raise PrintersError("it ends before its last solid does: it is cut short")
    corners = np.concatenate([*blocks, _as_corners(numbers)])
    return corners, (f"{solids} solids in one file",) if solids > 1 else ()


def _as_corners(numbers: list[bytes]) -> Floats:
    try:
        return np.array(numbers, dtype=np.bytes_).astype(np.float64).reshape(-1, 3, 3)
    except ValueError:
        raise PrintersError("it holds a coordinate that is no number") from None


def _unread(content: bytes, place: int) -> PrintersError:
    rest = content[place : place + 400].lstrip()
    line = content.count(b"\n", 0, place + len(content[place : place + 400]) - len(rest)) + 1
    shown = quoted(rest.splitlines()[0][:40].decode("latin-1")) if rest else "blanks"
    return PrintersError(f"from its line {line} on it holds no whole facet: {shown}")
