"""Measured curves from files, with a record of how they were read.

What is not certain is asked in one sentence, which names the option that settles it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

import numpy as np

from bellows_design.errors import DesignError
from bellows_design.materials.measurements.options import ReadingOptions
from bellows_design.materials.measurements.points import Reading
from bellows_design.materials.measurements.table.cells import number_at, require_width
from bellows_design.materials.measurements.table.file import sheet_of_file
from bellows_design.materials.measurements.table.header import Table, table_of
from bellows_design.materials.measurements.table.headings import Heading
from bellows_design.materials.measurements.table.rows import Row, Sheet
from bellows_design.materials.measurements.table.units import shown_unit
from bellows_design.measured.quantities import QUANTITIES, Quantity
from bellows_design.measured.reading.branches import BRANCHES, LOADING, on_branch
from bellows_design.measured.reading.curve import MeasuredCurve
from bellows_design.measured.reading.merging import merged
from bellows_design.measured.reading.vocabulary import INFLATION
from bellows_design.validation.quoting import did_you_mean, quoted, quoted_path
from solver.arrays import Reals

FEWEST_POINTS = 2
HIGHEST_PRESSURE, LEAST_HIGHEST = 2.0, 1e-4
"""MPa. No soft actuator bears more; less as the highest of a file moves none."""
LARGEST = {"angle": 1080.0, "force": 1000.0}
"""Of a value, in its unit; of a displacement 2000 mm."""
STRAY = 0.02
"""Part of the highest pressure up to which one of the other sign is the sensor's zero."""


@dataclass(frozen=True)
class CurveOptions:
    """What a file of measurements leaves open.

    Attributes:
        quantity: Name of the quantity to read; None for the only one there is.
        branch: ``loading``, ``unloading`` or ``all``; None for loading.
        table: Columns, units, lines and decimal sign.

    Raises:
        DesignError: A value is none of these.
    """

    quantity: str | None = None
    branch: str | None = None
    table: ReadingOptions = field(default_factory=ReadingOptions)

    def __post_init__(self) -> None:
        for option, value, known in (
            ("--quantity", self.quantity, tuple(QUANTITIES)),
            ("--branch", self.branch, BRANCHES),
        ):
            if value is not None and value not in known:
                raise DesignError(f"{option} is {quoted(value)}{did_you_mean(value, known)}")


class Columns(NamedTuple):
    """Columns that are read, counted from 0; ``values`` are repeats of the same quantity."""

    quantity: Quantity
    pressure: int
    values: tuple[int, ...]
    spread: int | None
    branch: int | None


def load_curve(path: Path, options: CurveOptions | None = None) -> MeasuredCurve:
    """The curve in a table of text or an Excel workbook.

    Returns:
        Pressures in MPa and values in the quantity's unit, of one branch, in order of pressure.

    Raises:
        DesignError: The file cannot be read, is open to several readings, or a value is out of
            bounds; one sentence.
    """
    options = options or CurveOptions()
    place = quoted_path(path)
    sheet = sheet_of_file(path, place, options.table)
    table = table_of(sheet, place, options.table, INFLATION)
    columns = _columns(table, options.quantity)
    curve, names = _curve(table, columns, sheet, place, path.name)
    chosen, note = on_branch(curve.pressure, options.branch or LOADING, names)
    curve = curve.at(chosen).noted(*((note,) if note else ()))
    return merged(_of_one_sign(curve, place))


def _columns(table: Table, wanted: str | None) -> Columns:
    pressures = _of(table, "pressure")
    if not pressures:
        raise DesignError(f"{table.named} lacks a column of pressure; --columns names it.")
    if len(pressures) > 1:
        raise DesignError(_several(table, pressures, "pressure"))
    found = {name: _of(table, name) for name in QUANTITIES if _of(table, name)}
    if wanted is not None and wanted not in found:
        raise DesignError(
            f"--quantity {wanted}: {table.named} has no such column, only "
            f"{', '.join(found) or 'none of a quantity'}."
        )
    if wanted is None and len(found) > 1:
        raise DesignError(
            f"{table.named} has columns of {' and '.join(found)}; --quantity tells which to "
            "compare."
        )
    name = wanted or next(iter(found), "")
    if not name:
        raise DesignError(
            f"{table.named} lacks a column of an angle, a displacement or a force; --columns "
            "names it."
        )
    values = found[name]
    if len({(table.headings[k].unit, _stem(table.headings[k])) for k in values}) > 1:
        raise DesignError(_several(table, values, name))
    spreads = _spreads(table, name)
    if len(spreads) > 1:
        raise DesignError(_several(table, spreads, "spread"))
    branches = _of(table, "branch")
    return Columns(
        QUANTITIES[name],
        pressures[0],
        tuple(values),
        spreads[0] if spreads else None,
        branches[0] if branches else None,
    )


def _stem(found: Heading) -> str:
    """A name without numbers: those of repeats are alike."""
    return "".join(sign for sign in found.text.lower() if not (sign.isdigit() or sign.isspace()))


def _of(table: Table, quantity: str) -> list[int]:
    return [k for k, each in enumerate(table.headings) if each.quantity == quantity]


def _spreads(table: Table, quantity: str) -> list[int]:
    """Columns of the spread that may be that quantity's, by their units."""
    units = INFLATION.units[quantity]
    return [
        k for k in _of(table, "spread") if (table.headings[k].unit or next(iter(units))) in units
    ]


def _several(table: Table, columns: Sequence[int], quantity: str) -> str:
    names = ", ".join(f"{quoted(table.headings[k].text)} ({k + 1})" for k in columns[:4])
    return (
        f"{table.named} has several columns of {quantity}, {names}; name those to read by their "
        f"numbers, as in --columns {INFLATION.numbered}."
    )


def _curve(
    table: Table, columns: Columns, sheet: Sheet, place: str, name: str
) -> tuple[MeasuredCurve, list[str] | None]:
    """All points in the order of the file, and the names of their branches if it has any."""
    rows = _rows(table, columns, place)
    pressure_heading, heading = (table.headings[k] for k in (columns.pressure, columns.values[0]))
    pressure = _numbers(rows, columns.pressure, table, sheet, place)
    pressure = pressure * _factor(table, pressure_heading, "pressure")
    repeats = np.array([_numbers(rows, k, table, sheet, place) for k in columns.values])
    repeats *= _factor(table, heading, columns.quantity.name)
    _require_bounds(pressure, repeats, columns.quantity, place)
    spread, notes = _spread(table, columns, rows, sheet, place, repeats)
    notes = [*sheet.notes, *table.notes, *_taken(table, columns), *notes]
    curve = MeasuredCurve(
        name, columns.quantity, pressure, repeats.mean(axis=0), spread, heading.told,
        Reading(tuple(notes)),
    )  # fmt: skip
    branch = columns.branch
    return curve, None if branch is None else [row.cells[branch] for row in rows]


def _rows(table: Table, columns: Columns, place: str) -> list[Row]:
    read = [columns.pressure, *columns.values, columns.spread, columns.branch]
    last = max(k for k in read if k is not None)
    for row in table.rows:
        require_width(row, table, last, place)
    if len(table.rows) < FEWEST_POINTS:
        count = len(table.rows)
        raise DesignError(
            f"{place} has {count} point{'s' * (count != 1)} but must have at least {FEWEST_POINTS}."
        )
    return list(table.rows)


def _numbers(rows: Sequence[Row], column: int, table: Table, sheet: Sheet, place: str) -> Reals:
    return np.array([number_at(row, column, table, sheet, place) for row in rows])


def _factor(table: Table, found: Heading, quantity: str) -> float:
    """From numbers as given to MPa or the quantity's unit. Raises ``DesignError`` without one."""
    units = INFLATION.units[quantity]
    if found.unit is None:
        spelled = {"pressure": "kPa", "angle": "deg", "force": "N"}.get(quantity, "mm")
        raise DesignError(
            f"{table.named}: the column {quoted(found.text)} has no unit; --units "
            f"{quantity}={spelled} tells it (known are {', '.join(units)})."
        )
    return units[found.unit]


def _spread(
    table: Table,
    columns: Columns,
    rows: Sequence[Row],
    sheet: Sheet,
    place: str,
    repeats: Reals,
) -> tuple[Reals | None, list[str]]:
    """Of repeats, or of a column; None without."""
    if len(columns.values) > 1:
        count = len(columns.values)
        return repeats.std(axis=0, ddof=1), [f"values are means of {count} columns"]
    if columns.spread is None:
        return None, []
    heading = table.headings[columns.spread]
    unit = heading.unit or table.headings[columns.values[0]].unit or ""
    size = np.abs(_numbers(rows, columns.spread, table, sheet, place))
    note = f"the column {quoted(heading.text)} is the standard deviation of the values"
    return size * INFLATION.units[columns.quantity.name][unit], [note]


def _taken(table: Table, columns: Columns) -> list[str]:
    """Which columns were taken for what, and which were not read."""
    read = {columns.pressure, *columns.values, columns.spread, columns.branch}
    pressure, value = table.headings[columns.pressure], table.headings[columns.values[0]]
    notes = [
        f"the column {quoted(each.text)} is read as {words} in {shown_unit(each.unit or '')}"
        for each, words in ((pressure, "pressure"), (value, columns.quantity.words))
    ]
    others = [
        quoted(each.text)
        for k, each in enumerate(table.headings)
        if k not in read and each.text not in ("-", "")
    ]
    if others:
        notes.append(f"not read: the column{'s' * (len(others) > 1)} {', '.join(others)}")
    return notes


def _require_bounds(pressure: Reals, values: Reals, quantity: Quantity, place: str) -> None:
    highest = float(np.abs(pressure).max())
    if not LEAST_HIGHEST <= highest <= HIGHEST_PRESSURE:
        raise DesignError(
            f"{place} has a highest pressure of {highest:.6g} MPa but it must lie between "
            f"{LEAST_HIGHEST:g} and {HIGHEST_PRESSURE:g} MPa; is it in another unit? --units "
            "pressure=Pa (kPa, MPa, bar, psi) tells it."
        )
    largest, bound = float(np.abs(values).max()), LARGEST.get(quantity.name, 2000.0)
    if largest > bound:
        raise DesignError(
            f"{place} has a {quantity.words} of {largest:.6g} {quantity.unit} but at most "
            f"{bound:g} {quantity.unit} are read; is it in another unit? --units "
            f"{quantity.name}=UNIT tells it."
        )


def _of_one_sign(curve: MeasuredCurve, place: str) -> MeasuredCurve:
    """Pressures of one sign; a few that are about zero may have the other, and are left out."""
    pressure = curve.pressure
    sign = float(np.sign(pressure[np.abs(pressure).argmax()]))
    against = sign * pressure < 0
    worst = float(-(sign * pressure).min())
    if worst > STRAY * float(np.abs(pressure).max()):
        raise DesignError(
            f"{place} has pressures from {pressure.min():.4g} to {pressure.max():.4g} MPa but they "
            "must have one sign: gauge pressures above 0, or a vacuum below."
        )
    if not against.any():
        return curve
    return curve.at(~against).noted(
        f"{int(against.sum())} points just on the other side of zero pressure are left out"
    )
