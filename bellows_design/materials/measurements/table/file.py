"""The table in a file, whatever its format."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from bellows_design.materials.measurements.options import ReadingOptions
from bellows_design.materials.measurements.table.decoding import content_of, decoded
from bellows_design.materials.measurements.table.rows import Sheet, sheet_of_text

_ZIP = b"PK\x03\x04"


def sheet_of_file(path: Path, place: str, options: ReadingOptions) -> Sheet:
    """Rows of cells of a text or a workbook. Raises ``DesignError``."""
    content = content_of(path)
    if content.startswith(_ZIP):
        from bellows_design.materials.measurements.table.workbook import sheet_of_workbook

        return sheet_of_workbook(content, place, options)
    text, note = decoded(content, place)
    sheet = sheet_of_text(text, place, options)
    return replace(sheet, notes=(*((note,) if note else ()), *sheet.notes))
