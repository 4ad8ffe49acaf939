"""Rows of cells: what separates the cells of a text, which decimal sign its numbers have."""

from __future__ import annotations

import csv
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

from bellows_design.errors import DesignError
from bellows_design.materials.measurements.options import DECIMALS, ReadingOptions
from bellows_design.materials.measurements.table.numbers import (
    decimal_sign,
    looks_like_a_number,
    number,
)
from bellows_design.validation.quoting import quoted

MOST_ROWS = 200_000
MOST_CELLS = 200
LINES_COMPARED, LONGEST_COMPARED = 2000, 2000
"""Lines, and characters of each, that the separator is chosen by."""

SPACES = " "
SEPARATORS = {";": "semicolons", "\t": "tabs", "|": "bars", ",": "commas", SPACES: "spaces"}
"""Those that come first are chosen where several separate the numbers of as many lines."""

_COMMENT = re.compile(r"(?:^|(?<=\s))#(?=\s|$|[A-Za-z#])|^\s*#")
_TWO_NUMBERS = re.compile(
    r"[-+.,\deE%\u2212]*\d[;|\t ]\s*[-+.,\deE%\u2212]*\d[-+.,\deE%\u2212;|\t ]*"
)
_RANGE = re.compile(r"(\d{1,7})(?:(-)(\d{1,7})?)?", re.ASCII)


class Row(NamedTuple):
    """The cells of a line, which has that number from 1."""

    number: int
    cells: tuple[str, ...]


@dataclass(frozen=True)
class Sheet:
    """Rows of a table in which something is written, and how they were told apart.

    Attributes:
        rows: In the order of the file.
        comments: What stood after ``#`` at the beginning of lines, as rows.
        decimal: Decimal sign of its numbers.
        notes: Sentences on separators and decimal sign.
    """

    rows: tuple[Row, ...]
    comments: tuple[Row, ...] = ()
    decimal: str = "."
    notes: tuple[str, ...] = ()

    def number(self, cell: str) -> float | None:
        """The number in a cell; None if there is none."""
        return number(cell, self.decimal)

    def numbers_in(self, row: Row) -> int:
        """How many cells of a row hold numbers."""
        return sum(self.number(cell) is not None for cell in row.cells)


def sheet_of_text(text: str, place: str, options: ReadingOptions) -> Sheet:
    """The rows of ``text``, without the lines that are to be skipped. Raises ``DesignError``."""
    skipped = skipped_lines(options.skip)
    lines, comments = [], []
    for line_number, line in enumerate(re.split(r"\r\n|\r|\n", text), 1):
        if any(low <= line_number <= high for low, high in skipped):
            continue
        content, comment = _uncommented(line)
        if content.strip():
            lines.append((line_number, content))
        elif comment.strip():
            comments.append((line_number, comment))
    if not lines:
        raise DesignError(f"{place} is empty: it has no line to read.")
    if len(lines) > MOST_ROWS:
        raise DesignError(f"{place} has more than {MOST_ROWS} lines, the most that are read.")
    separator = _separator([line for _, line in lines])
    sheet = Sheet(
        tuple(_filled(_split(lines, separator, place))),
        tuple(_split(comments, separator, place)),
        notes=(f"{SEPARATORS[separator]} separate the columns",),
    )
    return with_decimal(sheet, place, options)


def with_decimal(sheet: Sheet, place: str, options: ReadingOptions) -> Sheet:
    """The same with the decimal sign that is asked for, or that its numbers have."""
    if not sheet.rows:
        raise DesignError(f"{place} is empty: it has no line to read.")
    if options.decimal is not None:
        sign = DECIMALS[options.decimal]
    else:
        tabular = _tabular(sheet.rows)
        cells = (cell for row in tabular for cell in row.cells if looks_like_a_number(cell))
        sign = decimal_sign(cells, place)
    notes = (*sheet.notes, *(("numbers have a decimal comma",) if sign == "," else ()))
    return replace(sheet, decimal=sign, notes=notes)


def skipped_lines(text: str | None) -> list[tuple[float, float]]:
    """Ranges of line numbers, both ends within. Raises ``DesignError``."""
    ranges = []
    for part in (text or "").split(",") if text is not None else ():
        found = _RANGE.fullmatch(part.strip())
        if found is None:
            raise DesignError(
                f"--skip is {quoted(str(text))} but must be a number of lines at the beginning "
                "(4), or lines (3-5, 70-), separated by commas."
            )
        first, dash, last = found.groups()
        low = float(first) if dash else 1.0
        high = float(last) if last else float("inf") if dash else float(first)
        ranges.append((low, high))
    return ranges


def _tabular(rows: Sequence[Row]) -> list[Row]:
    """Rows with as many cells of numbers as the most: not the preamble's."""
    counts = [sum(map(looks_like_a_number, row.cells)) for row in rows]
    usual = max(set(counts), key=lambda count: (counts.count(count), count)) if counts else 0
    return [row for row, count in zip(rows, counts, strict=True) if count == usual]


def _uncommented(line: str) -> tuple[str, str]:
    """A line without its comment, and the comment."""
    if "#" not in line:
        return line, ""
    found = _COMMENT.search(line)
    return (line[: found.start()], line[found.end() :]) if found else (line, "")


def _separator(lines: Sequence[str]) -> str:
    sample = [line[:LONGEST_COMPARED] for line in lines[:LINES_COMPARED]]
    counts = {sign: sum(map(_has_numbers, _each_split(sample, sign))) for sign in SEPARATORS}
    most = max(counts.values())
    if most:
        return next(sign for sign, count in counts.items() if count >= 0.9 * most)
    return next((sign for sign in SEPARATORS if sign != SPACES and sign in sample[0]), ",")


def _has_numbers(cells: Sequence[str]) -> bool:
    """True if a line split like this has two numbers or more and none is a pair of them."""
    several = sum(map(looks_like_a_number, cells)) >= 2
    return several and not any(len(cell) < 80 and _TWO_NUMBERS.fullmatch(cell) for cell in cells)


def _each_split(lines: Sequence[str], separator: str) -> Iterator[list[str]]:
    return (_cells(line, separator) for line in lines)


def _split(lines: Sequence[tuple[int, str]], separator: str, place: str) -> Iterator[Row]:
    for line_number, line in lines:
        cells = _cells(line, separator)
        if len(cells) > MOST_CELLS:
            raise DesignError(
                f"{place} line {line_number} has {len(cells)} cells; at most {MOST_CELLS} are read."
            )
        yield Row(line_number, tuple(cells))


def _cells(line: str, separator: str) -> list[str]:
    if separator == SPACES:
        parts = re.split(r"\s{2,}|\t", line.strip())
        numbers = any(map(looks_like_a_number, line.split()))
        return line.split() if len(parts) < 2 or numbers else [part.strip() for part in parts]
    if '"' in line:
        try:
            quoted_cells = next(csv.reader([line], delimiter=separator, skipinitialspace=True), [])
        except csv.Error:
            quoted_cells = line.split(separator)
        return [cell.strip().strip('"').strip() for cell in quoted_cells]
    return [cell.strip() for cell in line.split(separator)]


def _filled(rows: Iterator[Row]) -> Iterator[Row]:
    """Rows with anything in them, without the empty cells at their end."""
    for row in rows:
        cells = row.cells
        while cells and not cells[-1]:
            cells = cells[:-1]
        if cells:
            yield Row(row.number, cells)
