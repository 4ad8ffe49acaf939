"""Measured stress over stretch, read from a table of text.

The first line that is neither blank nor a comment (``#``) names the columns:

    mode,stretch,stress_mpa      or      mode,strain,stress_mpa

separated by comma, semicolon or tab. Stretch is length over initial length, strain is stretch − 1
(a fraction, not per cent), the stress is nominal (force over initial area) in MPa, negative in
compression. ``mode`` is ``uniaxial``, ``biaxial`` (two equal stretches) or ``planar`` (pure
shear); without that column all is uniaxial. What does not fit is refused in one sentence.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from bellows_design.errors import DesignError
from bellows_design.files.guarded import decoded, read_file
from bellows_design.validation.quoting import did_you_mean, quoted, quoted_path
from solver.arrays import Reals
from solver.material.homogeneous import MODES

LARGEST_FILE = 20_000_000
"""Bytes."""

FEWEST_POINTS, MOST_POINTS = 5, 100_000

SMALLEST_STRETCH, LARGEST_STRETCH = 0.05, 20.0
"""No rubber is tested beyond; a larger number is a strain in per cent or a length in mm."""

LARGEST_STRESS = 1000.0
"""MPa. More is another unit."""

SMALLEST_PEAK = 1e-6
"""MPa. Below this nothing was measured, or in another unit."""

STRAY = 0.05
"""Part of a test's largest stress up to which a stress of the wrong sign may be noise."""

COLUMNS = ("mode", "stretch", "strain", "stress_mpa")

_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d{1,3})?", re.ASCII)
_DECIMAL_COMMA = re.compile(r"[+-]?\d*,\d+([eE][+-]?\d+)?", re.ASCII)
_NOT_FINITE = re.compile(r"[+-]?(nan|inf|infinity)", re.IGNORECASE | re.ASCII)
_LONGEST_NUMBER = 40


@dataclass(frozen=True, eq=False)
class Measurements:
    """Points of homogeneous tests. Made by ``load_measurements``, which checks every bound.

    Attributes:
        name: What messages call them.
        stretch: Length over initial length. *Shape:* (n,).
        stress: Nominal stress, MPa. *Shape:* (n,).
        mode: Number of each point's test along ``MODES``. *Shape:* (n,).
    """

    name: str
    stretch: Reals
    stress: Reals
    mode: NDArray[np.intp]

    @property
    def modes(self) -> tuple[str, ...]:
        """Names of the tests there are points of."""
        return tuple(name for number, name in enumerate(MODES) if (self.mode == number).any())

    def of(self, mode: str) -> tuple[Reals, Reals]:
        """Stretches and stresses of one test."""
        chosen = self.mode == list(MODES).index(mode)
        return self.stretch[chosen], self.stress[chosen]

    @property
    def scale(self) -> Reals:
        """(n,) the largest stress of each point's test, MPa."""
        peaks = [np.abs(self.of(name)[1]).max(initial=0.0) for name in MODES]
        return np.array(peaks)[self.mode]

    @property
    def valid_strain(self) -> tuple[float, float]:
        """Lowest and highest principal nominal strain that any of the tests reached."""
        stretches = np.concatenate(
            [MODES[name].principal_stretches(self.of(name)[0]).ravel() for name in self.modes]
        )
        return float(stretches.min()) - 1, float(stretches.max()) - 1


def load_measurements(path: str | Path) -> Measurements:
    """The measurements in the file at ``path``.

    Args:
        path: A table of text, see the head of this module.

    Returns:
        Stretches without unit and nominal stresses in MPa.

    Raises:
        DesignError: The file cannot be read, or a value is out of bounds; one sentence.
    """
    return parse_measurements(_read(Path(path)), quoted_path(Path(path)), Path(path).name)


def parse_measurements(text: str, place: str, name: str = "") -> Measurements:
    """The measurements written as ``text``; ``place`` is what messages call it."""
    rows = _rows(text)
    first = next(rows, None)
    if first is None:
        raise DesignError(f"{place} is empty; its first line must name columns, {_FORM}.")
    number, header = first
    delimiter = _delimiter(header, f"{place} line {number}")
    columns = _columns(_cells(header, delimiter), f"{place} line {number}")
    table = [
        _point(_cells(row, delimiter), columns, f"{place} line {number}")
        for number, row in _at_most(rows, place)
    ]
    return _checked(table, place, name)


_FORM = "mode,stretch,stress_mpa or mode,strain,stress_mpa"
_Point = tuple[int, float, float, str]


def _read(path: Path) -> str:
    given = quoted_path(path)
    text = decoded(read_file(path, "measurements", LARGEST_FILE), given)
    if "\0" in text:
        raise DesignError(f"{given} is not a text file: it has a null character.")
    return text


def _rows(text: str) -> Iterator[tuple[int, str]]:
    """(line number, text) of every line that says something, without its comment."""
    for number, line in enumerate(text.replace("\r\n", "\n").replace("\r", "\n").split("\n"), 1):
        content, comment, _ = line.partition("#")
        if content.strip():
            yield number, content.rstrip() if comment else content


def _at_most(rows: Iterator[tuple[int, str]], place: str) -> Iterator[tuple[int, str]]:
    for count, row in enumerate(rows, 1):
        if count > MOST_POINTS:
            raise DesignError(
                f"{place} has more than {MOST_POINTS} points, the most that are read."
            )
        yield row


def _delimiter(header: str, where: str) -> str:
    found = [sign for sign in (";", "\t", ",") if sign in header]
    if len(found) > 1:
        raise DesignError(
            f"{where} has {quoted(header)}, separated by more than one of comma, semicolon and tab."
        )
    return found[0] if found else ","


def _cells(row: str, delimiter: str) -> list[str]:
    return [_unquoted(cell.strip()) for cell in row.split(delimiter)]


def _unquoted(cell: str) -> str:
    if len(cell) >= 2 and cell[0] == cell[-1] == '"':
        return cell[1:-1].strip()
    return cell


def _columns(header: Sequence[str], where: str) -> tuple[str, ...]:
    columns = tuple(name.lower() for name in header)
    for name in columns:
        if name not in COLUMNS:
            hint = did_you_mean(name, COLUMNS)
            raise DesignError(f"{where} has the unknown column {quoted(name)}{hint}")
        if columns.count(name) > 1:
            raise DesignError(f"{where} names the column {quoted(name)} more than once.")
    if "stress_mpa" not in columns:
        raise DesignError(f"{where} lacks the column stress_mpa; the columns must be {_FORM}.")
    if ("stretch" in columns) == ("strain" in columns):
        both = "has both columns" if "strain" in columns else "lacks a column"
        raise DesignError(f"{where} {both} stretch and strain; exactly one of them must be given.")
    return columns


def _point(cells: Sequence[str], columns: Sequence[str], where: str) -> _Point:
    """(mode, stretch, stress, where) of one row."""
    if len(cells) != len(columns):
        hint = "; numbers need a decimal point, not a comma" if len(cells) > len(columns) else ""
        raise DesignError(
            f"{where} has {_counted(cells, 'value')} but the header names "
            f"{_counted(columns, 'column')}{hint}."
        )
    row = dict(zip(columns, cells, strict=True))
    stress = _number(row["stress_mpa"], f"{where}: stress_mpa", ", in MPa")
    if abs(stress) > LARGEST_STRESS:
        raise DesignError(
            f"{where}: stress_mpa is {stress:g} MPa but must lie between {-LARGEST_STRESS:g} and "
            f"{LARGEST_STRESS:g} MPa; is it given in another unit?"
        )
    return _mode(row.get("mode", "uniaxial"), where), _stretch(row, where), stress, where


def _mode(name: str, where: str) -> int:
    if name.lower() not in MODES:
        raise DesignError(f"{where}: mode is {quoted(name)}{did_you_mean(name.lower(), MODES)}")
    return list(MODES).index(name.lower())


def _stretch(row: dict[str, str], where: str) -> float:
    column, shift = ("stretch", 0.0) if "stretch" in row else ("strain", 1.0)
    value = _number(row[column], f"{where}: {column}", "")
    low, high = SMALLEST_STRETCH - shift, LARGEST_STRETCH - shift
    if not low <= value <= high:
        hint = "; is it given in per cent?" if value > high and column == "strain" else "."
        raise DesignError(
            f"{where}: {column} is {value:g} but must lie between {low:g} and {high:g} "
            f"({'a fraction' if shift else 'length over initial length'}, no unit){hint}"
        )
    return value + shift


def _number(cell: str, what: str, unit: str) -> float:
    if len(cell) <= _LONGEST_NUMBER and _NUMBER.fullmatch(cell):
        value = float(cell)
        if np.isfinite(value):
            return value
    if len(cell) <= _LONGEST_NUMBER and _DECIMAL_COMMA.fullmatch(cell):
        raise DesignError(f"{what} is {quoted(cell)} but needs a decimal point, not a comma.")
    finite = "finite " if _NOT_FINITE.fullmatch(cell[:_LONGEST_NUMBER]) else ""
    raise DesignError(f"{what} is {quoted(cell)} but must be a {finite}number{unit}.")


def _counted(things: Sequence[object], noun: str) -> str:
    return f"{len(things)} {noun}" + ("" if len(things) == 1 else "s")


def _checked(table: Sequence[_Point], place: str, name: str) -> Measurements:
    if len(table) < FEWEST_POINTS:
        count = _counted(table, "point")
        raise DesignError(f"{place} has {count} but must have at least {FEWEST_POINTS}.")
    modes, stretches, stresses, wheres = zip(*table, strict=True)
    result = Measurements(name, np.array(stretches), np.array(stresses), np.array(modes, np.intp))
    if np.abs(result.stress).max() < SMALLEST_PEAK:
        raise DesignError(
            f"{place} has no stress above {SMALLEST_PEAK:g} MPa; is it given in another unit?"
        )
    against = np.flatnonzero(result.stress * (result.stretch - 1) < 0)
    strays = against[np.abs(result.stress[against]) > STRAY * result.scale[against]]
    if strays.size:
        raise DesignError(_of_wrong_sign(result, int(strays[0]), wheres[strays[0]]))
    return result


def _of_wrong_sign(data: Measurements, index: int, where: str) -> str:
    stress, stretch = data.stress[index], data.stretch[index]
    rule = "positive in tension" if stretch > 1 else "negative in compression"
    return f"{where}: stress_mpa is {stress:g} MPa at stretch {stretch:g} but must be {rule}."
