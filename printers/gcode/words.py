"""The words of G-code: lines of bytes as commands with their numbers."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from printers.arrays import Floats, Ints
from printers.compilation import njit
from printers.errors import PrintersError

Bytes: TypeAlias = NDArray[np.uint8]

LETTERS = "XYZEFIJRSDP"
"""Of the words that mean something here; column by column of `Lines.words`."""

COMMENT, TOOL = 0, 1
G, M = 100_000, 200_000
"""A command is its letter and ten times its number: G1 is G + 10, G92.1 is G + 921."""

HOME, FLOW = G + 280, M + 2210

MEANT = np.array(
    [G + 10 * n for n in (0, 1, 2, 3, 5, 10, 11, 17, 18, 19, 20, 21, 28, 90, 91, 92)]
    + [G + 901, G + 911]
    + [M + 10 * n for n in (82, 83, 200, 221)]
)
"""Commands that move the nozzle or change what moves mean; others are passed over unread."""

LONGEST_LINE = 100_000
"""Bytes. The start code of some printers stands in one line of the settings, of 20 kB."""

_COLUMN_OF = np.full(256, -1, dtype=np.int64)
for _column, _letter in enumerate(LETTERS):
    _COLUMN_OF[ord(_letter)] = _COLUMN_OF[ord(_letter.lower())] = _column

_NEW_LINE, _SEMICOLON, _BRACKET, _CLOSING_BRACKET = 10, 59, 40, 41
_ASTERISK, _PLUS, _MINUS, _POINT, _UNDERSCORE = 42, 43, 45, 46, 95
_CAPITAL = 0b1101_1111  # what of a letter's byte is the same in capitals
_G, _M, _N, _T = 71, 77, 78, 84
_TOOL_COLUMN = LETTERS.index("S")

_TOO_LONG, _NO_NUMBER, _NO_LETTER, _TWICE = 1, 2, 3, 4
_FAULTS = {
    _TOO_LONG: f"is longer than {LONGEST_LINE // 1000} kB",
    _NO_NUMBER: "has a letter without a number",
    _TWICE: "has a letter twice (G-code knows no exponents, as in 1e-5)",
    _NO_LETTER: "has a number without a letter, or a sign that G-code does not have",
}


@dataclass(frozen=True, eq=False)
class Lines:
    """The lines of a piece of a file that mean something, or are a comment alone.

    Attributes:
        number: Of the line in the file, from 1.
            *Shape:* `(n,)`
        command: Number of the command, `COMMENT` or `TOOL`.
            *Shape:* `(n,)`
        words: Numbers by `LETTERS`; NaN where the line does not have the letter. That of a tool
            stands at S.
            *Shape:* `(n, 11)`
        comment: First byte of the comment in the piece and the one after its last.
            *Shape:* `(n, 2)`
        passed: Lines of the piece.
    """

    number: Ints
    command: Ints
    words: Floats
    comment: Ints
    passed: int


def read_lines(piece: bytes, first: int) -> Lines:
    """The lines of a piece of a file whose first line has the number `first`.

    Raises:
        PrintersError: A line is too long, or a command in it cannot be read.
    """
    data = np.frombuffer(piece, dtype=np.uint8)
    passed = piece.count(b"\n") + (not piece.endswith(b"\n"))
    number, command = np.empty(passed, dtype=np.int64), np.empty(passed, dtype=np.int64)
    words = np.full((passed, len(LETTERS)), np.nan)
    comment = np.zeros((passed, 2), dtype=np.int64)
    count, fault, line = _lex(data, MEANT, _COLUMN_OF, number, command, words, comment)
    if fault:
        raise PrintersError(f"line {first + line} of the G-code {_FAULTS[fault]}")
    return Lines(number[:count] + first, command[:count], words[:count], comment[:count], passed)


@njit(cache=True)
def _number_at(data: Bytes, at: int, end: int) -> tuple[float, int, int]:
    """The number that begins at a byte, the byte after it, and how many digits it has."""
    negative = at < end and data[at] == _MINUS
    if at < end and (data[at] == _MINUS or data[at] == _PLUS):
        at += 1
    digits, value, scale, fraction = 0, 0.0, 1.0, False
    while at < end and (48 <= data[at] <= 57 or (data[at] == _POINT and not fraction)):
        if data[at] == _POINT:
            fraction = True
        else:
            value = 10 * value + (data[at] - 48)
            scale *= 10.0 if fraction else 1.0
            digits += 1
        at += 1
    return (-value if negative else value) / scale, at, digits


@njit(cache=True)
def _after_blanks(data: Bytes, at: int, end: int) -> int:
    while at < end and (data[at] == 32 or data[at] == 9 or data[at] == 13):
        at += 1
    return at


@njit(cache=True)
def _after_line_number(data: Bytes, at: int, end: int) -> int:
    """The first byte of the command: hosts number lines, `N12 G1 X3 *71`."""
    at = _after_blanks(data, at, end)
    if at + 1 < end and data[at] & _CAPITAL == _N and 48 <= data[at + 1] <= 57:
        at = _after_blanks(data, _number_at(data, at + 1, end)[1], end)
    return at


@njit(cache=True)
def _command_at(data: Bytes, at: int, end: int) -> tuple[int, int]:
    """The command's number, and the byte after it; -1 for what is none, as a macro's name."""
    letter = data[at] & _CAPITAL
    value, at, digits = _number_at(data, at + 1, end)
    if digits == 0 or value >= 10_000 or (at < end and data[at] == _UNDERSCORE):
        return -1, at
    if letter == _T:
        return TOOL, at
    if letter in (_G, _M):
        return (G if letter == _G else M) + int(10 * value + 0.5), at
    return -1, at


@njit(cache=True)
def _words_from(data: Bytes, at: int, end: int, kind: int, row: Floats, column_of: Ints) -> int:
    """Fill the row with the words up to a comment or checksum; the kind of a fault, or 0.

    Letters may stand without a number in `G28 X`, and in `M221 S` of Bambu, which says nothing of
    the flow.
    """
    flags = kind in (HOME, FLOW)
    at = _after_blanks(data, at, end)
    while at < end and data[at] != _SEMICOLON and data[at] != _ASTERISK:
        if data[at] == _BRACKET:
            while at < end and data[at] != _CLOSING_BRACKET:
                at += 1
            at = _after_blanks(data, at + 1, end)
            continue
        if not 65 <= data[at] & _CAPITAL <= 90:
            return _NO_LETTER
        column = column_of[data[at]]
        value, at, digits = _number_at(data, _after_blanks(data, at + 1, end), end)
        if (digits == 0 and not flags) or np.isnan(value):  # NaN: hundreds of digits
            return _NO_NUMBER
        if column >= 0:
            if not np.isnan(row[column]):
                return _TWICE
            row[column] = np.nan if digits == 0 and kind == FLOW else value
        at = _after_blanks(data, at, end)
    return 0


@njit(cache=True)
def _lex(
    data: Bytes,
    meant: Ints,
    column_of: Ints,
    number: Ints,
    command: Ints,
    words: Floats,
    comment: Ints,
) -> tuple[int, int, int]:
    """Fill the rows; their count, and the kind and line of a fault."""
    count, line, at, size = 0, 0, 0, len(data)
    while at < size:
        end = at
        while end < size and data[end] != _NEW_LINE:
            end += 1
        if end - at > LONGEST_LINE:
            return count, _TOO_LONG, line
        at = _after_line_number(data, at, end)
        number[count] = line
        if at < end and data[at] == _SEMICOLON:
            command[count] = COMMENT
            comment[count, 0], comment[count, 1] = at + 1, end
            count += 1
        elif at < end:
            kind, after = _command_at(data, at, end)
            command[count] = kind
            if kind == TOOL:
                words[count, _TOOL_COLUMN] = _number_at(data, at + 1, end)[0]
                count += 1
            elif (meant == kind).any():
                fault = _words_from(data, after, end, kind, words[count], column_of)
                if fault:
                    return count, fault, line
                count += 1
        at, line = end + 1, line + 1
    return count, 0, line
