"""The words of G-code: lines of bytes as commands with their numbers."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from printers.arrays import Floats, Ints
from printers.compilation import njit
from printers.errors import PrintersError

LETTERS = "XYZEFIJRSDP"
"""Of the words that mean something here; column by column of `Lines.words`."""

COMMENT, TOOL = 0, 1
G, M = 100_000, 200_000
"""A command is its letter and ten times its number: G1 is G + 10, G92.1 is G + 921."""

MEANT = np.array(
    [G + 10 * n for n in (0, 1, 2, 3, 5, 10, 11, 17, 18, 19, 20, 21, 28, 90, 91, 92)]
    + [M + 10 * n for n in (82, 83, 200)]
)
"""Commands that move the nozzle or change what moves mean; others are passed over unread."""

LONGEST_LINE = 100_000
"""Bytes. The start code of some printers stands in one line of the settings, of 20 kB."""

_COLUMN_OF = np.full(256, -1, dtype=np.int64)
for _column, _letter in enumerate(LETTERS):
    _COLUMN_OF[ord(_letter)] = _COLUMN_OF[ord(_letter.lower())] = _column

_TOO_LONG, _NO_NUMBER, _NO_LETTER = 1, 2, 3
_FAULTS = {
    _TOO_LONG: f"is longer than {LONGEST_LINE // 1000} kB",
    _NO_NUMBER: "has a letter without a number",
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
        words: Numbers by `LETTERS`; NaN where the line does not have the letter.
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
def _lex(data, meant, column_of, number, command, words, comment):  # type: ignore[no-untyped-def]
    """Fill the rows; their count, and the kind and line of a fault."""
    row, line, at, size = 0, 0, 0, len(data)
    while at < size:
        end = at
        while end < size and data[end] != 10:
            end += 1
        if end - at > 100_000:
            return row, 1, line
        while at < end and (data[at] == 32 or data[at] == 9 or data[at] == 13):
            at += 1
        if at < end and (data[at] == 78 or data[at] == 110):  # N: the line's number
            at += 1
            while at < end and (48 <= data[at] <= 57 or data[at] == 32):
                at += 1
        if at < end and data[at] == 59:  # ;
            number[row], command[row] = line, 0
            comment[row, 0], comment[row, 1] = at + 1, end
            row += 1
        elif at + 1 < end and 48 <= data[at + 1] <= 57:
            letter = data[at] & 223  # in capitals
            at += 1
            code = 0
            while at < end and 48 <= data[at] <= 57 and code < 10_000:
                code = 10 * code + data[at] - 48
                at += 1
            code *= 10
            if at + 1 < end and data[at] == 46 and 48 <= data[at + 1] <= 57:
                code += data[at + 1] - 48
                at += 2
            kind = -1
            if letter == 84:  # T
                kind = 1
                words[row, 8] = code / 10
            elif letter == 71 or letter == 77:  # G, M
                code += 100_000 if letter == 71 else 200_000
                for known in meant:
                    if code == known:
                        kind = code
            if at < end and (48 <= data[at] <= 57 or data[at] == 95):  # a macro's name: G1_CLEAN
                kind = -1
            if kind > 1:
                while at < end:
                    sign = data[at]
                    if sign == 59 or sign == 42 or sign == 13:  # comment, checksum, end
                        break
                    if sign == 32 or sign == 9:
                        at += 1
                        continue
                    if sign == 40:  # (comment)
                        while at < end and data[at] != 41:
                            at += 1
                        at += 1
                        continue
                    if not 65 <= sign & 223 <= 90:
                        return row, 3, line
                    column = column_of[sign]
                    at += 1
                    while at < end and data[at] == 32:
                        at += 1
                    negative = at < end and data[at] == 45
                    if at < end and (data[at] == 45 or data[at] == 43):
                        at += 1
                    digits, value, scale = 0, 0.0, 1.0
                    while at < end and 48 <= data[at] <= 57:
                        value = 10 * value + data[at] - 48
                        digits += 1
                        at += 1
                    if at < end and data[at] == 46:
                        at += 1
                        while at < end and 48 <= data[at] <= 57:
                            value = 10 * value + data[at] - 48
                            scale *= 10
                            digits += 1
                            at += 1
                    if digits == 0:
                        if kind != 100_280:  # G28 X names an axis
                            return row, 2, line
                        value = 0.0
                    if column >= 0:
                        value /= scale
                        words[row, column] = -value if negative else value
            if kind > 0:
                number[row], command[row] = line, kind
                row += 1
            elif kind == -1:
                words[row, 8] = np.nan
        at = end + 1
        line += 1
    return row, 0, line
