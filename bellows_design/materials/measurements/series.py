"""The numbers of each test and specimen in a table, as they stand there."""

from __future__ import annotations

import math
from bisect import bisect
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from bellows_design.errors import DesignError
from bellows_design.materials.measurements.columns import Columns, Pair
from bellows_design.materials.measurements.table.cells import no_number, number_at, require_width
from bellows_design.materials.measurements.table.header import Table
from bellows_design.materials.measurements.table.rows import Row, Sheet
from bellows_design.validation.quoting import did_you_mean, quoted
from solver.arrays import Reals
from solver.material.homogeneous import MODES

MOST_POINTS = 100_000


@dataclass(frozen=True, eq=False)
class Series:
    """Points of one test of one specimen, in the order of the file.

    Attributes:
        place: What messages call the file.
        mode: Number of the test along ``MODES``.
        specimen: What tells it from others.
        strain: As given, later the stretch. *Shape:* (n,).
        stress: As given, later nominal, MPa. *Shape:* (n,).
        lines: Their lines in the file. *Shape:* (n,).
        time: As given, NaN without one. *Shape:* (n,).
        percent: The strains have signs of per cent.
    """

    place: str
    mode: int
    specimen: str
    strain: Reals
    stress: Reals
    lines: Reals
    time: Reals
    percent: bool = False

    def at(self, chosen: object) -> Series:
        """Those points alone, by a mask or by indices."""
        names = ("strain", "stress", "lines", "time")
        return replace(self, **{name: getattr(self, name)[chosen] for name in names})

    def where(self, index: int) -> str:
        """Place and line of a point."""
        return f"{self.place} line {int(self.lines[index])}"


def series_of(table: Table, columns: Columns, sheet: Sheet, place: str) -> list[Series]:
    """The series of a table, their strains and stresses as given. Raises ``DesignError``."""
    if len(table.rows) > MOST_POINTS:
        raise DesignError(f"{place} has more than {MOST_POINTS} points, the most that are read.")
    points: dict[tuple[int, str], list[tuple[float, ...]]] = {}
    percents = set()
    for count, pair in enumerate(columns.pairs, 1):
        own = str(count) if len(columns.pairs) > 1 else ""
        for row in _rows(table, columns, pair, place):
            where = f"{place} line {row.number}"
            block = bisect(table.repeats, row.number)
            label = f"{own} {row.cells[columns.specimen]}" if columns.specimen is not None else own
            label = f"{label} {block + 1}" if table.repeats else label
            values, percent = _values(row, pair, table, sheet, place)
            key = (_mode(row, columns.mode, where), label.strip())
            time = _time(row, columns.time, sheet)
            points.setdefault(key, []).append((*values, row.number, time))
            percents.add(percent)
    if len(percents) > 1:
        raise DesignError(f"{place} has a sign of per cent behind some strains but not all.")
    return [
        _from_rows(place, mode, label, np.array(rows, float), True in percents)
        for (mode, label), rows in points.items()
    ]


def _from_rows(place: str, mode: int, label: str, rows: Reals, percent: bool) -> Series:
    strain, stress, lines, time = rows.T
    return Series(place, mode, label, strain, stress, lines, time, percent)


def _time(row: Row, column: int | None, sheet: Sheet) -> float:
    """NaN without one."""
    if column is None or column >= len(row.cells):
        return math.nan
    value = sheet.number(row.cells[column])
    return math.nan if value is None else value


def _rows(table: Table, columns: Columns, pair: Pair, place: str) -> Iterator[Row]:
    """Rows in which the pair has numbers; of several pairs the shorter ones end early."""
    needed = max(k for k in (*pair, columns.mode, columns.specimen) if k is not None)
    for row in table.rows:
        shared = _shared(columns, pair.strain)
        ended = not _has(row, pair.stress) and (shared or not _has(row, pair.strain))
        if ended and len(columns.pairs) > 1:
            continue
        require_width(row, table, needed, place)
        yield row


def _shared(columns: Columns, strain: int) -> bool:
    return sum(pair.strain == strain for pair in columns.pairs) > 1


def _has(row: Row, column: int | None) -> bool:
    return column is not None and column < len(row.cells) and bool(row.cells[column])


def _values(
    row: Row, pair: Pair, table: Table, sheet: Sheet, place: str
) -> tuple[tuple[float, float], bool]:
    """Strain and stress of a row, and if the strain has a sign of per cent."""
    strain, stress = (number_at(row, column, table, sheet, place) for column in pair)
    cell, name = row.cells[pair.stress], table.headings[pair.stress].text
    if cell.endswith("%"):
        raise DesignError(no_number(cell, row, name, sheet, place))
    return (strain, stress), row.cells[pair.strain].endswith("%")


def _mode(row: Row, column: int | None, where: str) -> int:
    if column is None:
        return 0
    name = row.cells[column].lower()
    if name not in MODES:
        raise DesignError(
            f"{where}: mode is {quoted(row.cells[column])}{did_you_mean(name, MODES)}"
        )
    return list(MODES).index(name)


def all_of(series: Sequence[Series], name: str) -> Reals:
    """The numbers of all series after each other."""
    result: Reals = np.concatenate([getattr(each, name) for each in series])
    return result
