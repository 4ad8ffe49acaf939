"""Numbers in the cells of a row, and the sentences on those that are none."""

from __future__ import annotations

import re

from bellows_design.errors import DesignError
from bellows_design.materials.measurements.table.header import Table
from bellows_design.materials.measurements.table.rows import Row, Sheet
from bellows_design.validation.quoting import quoted

_NOT_FINITE = re.compile(r"[+-]?(nan|inf|infinity)", re.IGNORECASE | re.ASCII)


def require_width(row: Row, table: Table, last: int, place: str) -> None:
    """Refuse a row with more cells than columns, or without the column ``last`` (from 0).

    Raises ``DesignError``.
    """
    if last < len(row.cells) <= len(table.headings):
        return
    named, count = len(table.headings), len(row.cells)
    hint = (
        "; numbers with decimal commas need semicolons between them, not commas"
        if count > named
        else f"; --skip {row.number}- leaves out what follows the numbers"
    )
    who = "--columns" if table.named == "--columns" else "the header"
    raise DesignError(
        f"{place} line {row.number} has {_counted(count, 'value')} but {who} names "
        f"{_counted(named, 'column')}{hint}."
    )


def number_at(row: Row, column: int, table: Table, sheet: Sheet, place: str) -> float:
    """The number in a cell. Raises ``DesignError`` if there is none."""
    cell = row.cells[column]
    value = sheet.number(cell)
    if value is None:
        raise DesignError(no_number(cell, row, table.headings[column].text, sheet, place))
    return value


def no_number(cell: str, row: Row, name: str, sheet: Sheet, place: str) -> str:
    """Why the cell of the column called ``name`` is no number."""
    what, line = f"{place} line {row.number}: {name}", row.number
    other = "," if sheet.decimal == "." else "."
    if Sheet((), decimal=other).number(cell) is not None:
        right, wrong = ("point", "comma") if sheet.decimal == "." else ("comma", "point")
        return (
            f"{what} is {quoted(cell)} but needs a decimal {right}, not a {wrong}, as the others."
        )
    finite = "finite " if _NOT_FINITE.fullmatch(cell[:40]) else ""
    skip = f"; --skip {line}-{line} leaves the line out" if line > 1 else ""
    return f"{what} is {quoted(cell)} but must be a {finite}number{skip}."


def _counted(count: int, noun: str) -> str:
    return f"{count} {noun}" + ("" if count == 1 else "s")
