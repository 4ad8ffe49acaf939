"""Rows of an Excel workbook, read with openpyxl from the extra ``xlsx``."""

from __future__ import annotations

import io
import zipfile
from collections.abc import Iterator
from dataclasses import replace
from importlib.util import find_spec
from typing import Any

from bellows_design.errors import DesignError
from bellows_design.materials.measurements.options import ReadingOptions
from bellows_design.materials.measurements.table.rows import (
    MOST_CELLS,
    MOST_ROWS,
    Row,
    Sheet,
    skipped_lines,
    with_decimal,
)
from bellows_design.validation.quoting import quoted

LARGEST_UNPACKED = 300_000_000
"""Bytes of all that a workbook holds, unpacked."""


def sheet_of_workbook(content: bytes, place: str, options: ReadingOptions) -> Sheet:
    """The only sheet of a workbook that holds anything. Raises ``DesignError``."""
    if find_spec("openpyxl") is None:
        raise DesignError(
            f"{place} is a workbook, which needs openpyxl of the extra “xlsx”: "
            "pip install -e '.[xlsx]', or save the sheet as CSV."
        )
    name, rows = _only_sheet(_tables(content, place), place)
    skipped = skipped_lines(options.skip)
    kept = [row for row in rows if not any(low <= row.number <= high for low, high in skipped)]
    sheet = Sheet(tuple(kept), notes=(f"the sheet {quoted(name)} is read",))
    own = replace(options, decimal=None)  # its numbers are no text
    return with_decimal(sheet, place, own)


def _tables(content: bytes, place: str) -> dict[str, list[Row]]:
    """Sheet -> its rows, without empty ones."""
    from openpyxl import load_workbook

    try:
        with zipfile.ZipFile(io.BytesIO(content)) as archive:
            if sum(each.file_size for each in archive.infolist()) > LARGEST_UNPACKED:
                raise DesignError(f"{place} unpacks to more than 300 MB.")
        book = load_workbook(io.BytesIO(content), read_only=True, data_only=True)
        return {sheet.title: list(_rows(sheet, place)) for sheet in book.worksheets}
    except DesignError:
        raise
    except Exception as error:  # whatever openpyxl makes of a damaged file
        raise DesignError(
            f"{place} cannot be read as a workbook ({type(error).__name__})."
        ) from None


def _rows(sheet: Any, place: str) -> Iterator[Row]:
    for number, cells in enumerate(sheet.iter_rows(), 1):
        if number > MOST_ROWS:
            raise DesignError(f"{place} has more than {MOST_ROWS} rows, the most that are read.")
        texts = [_text(cell) for cell in cells[:MOST_CELLS]]
        while texts and not texts[-1]:
            texts.pop()
        if texts and not texts[0].startswith("#"):
            yield Row(number, tuple(texts))


def _text(cell: Any) -> str:
    """A cell as text; numbers in full, and those shown as per cent in per cent."""
    value = cell.value
    if value is None:
        return ""
    if isinstance(value, bool) or not isinstance(value, int | float):
        return " ".join(str(value).split())
    if "%" in str(cell.number_format):
        return f"{100 * value:.12g}%"
    return repr(float(value)) if isinstance(value, float) else str(value)


def _only_sheet(tables: dict[str, list[Row]], place: str) -> tuple[str, list[Row]]:
    filled = {name: rows for name, rows in tables.items() if len(rows) > 1}
    if len(filled) == 1:
        return next(iter(filled.items()))
    if not filled:
        raise DesignError(f"{place} is empty: none of its sheets holds a table.")
    names = ", ".join(quoted(name) for name in list(filled)[:5])
    raise DesignError(
        f"{place} has several sheets with tables, {names}; save the one to be read as CSV."
    )
