"""The columns of a table: which line names them, which units stand below, where numbers begin."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

from bellows_design.errors import DesignError
from bellows_design.materials.measurements.options import ReadingOptions
from bellows_design.materials.measurements.table.facts import facts
from bellows_design.materials.measurements.table.headings import Heading, heading
from bellows_design.materials.measurements.table.numbers import looks_like_a_number
from bellows_design.materials.measurements.table.rows import Row, Sheet
from bellows_design.materials.measurements.table.units import plain_unit
from bellows_design.materials.measurements.table.vocabulary import TENSION, Vocabulary
from bellows_design.validation.quoting import near, quoted

NO_COLUMN = Heading("-", "other")

_RUN = 3
"""Rows of numbers in the same columns after each other that make a table."""


@dataclass(frozen=True)
class Table:
    """Named columns over rows of cells.

    Attributes:
        headings: What each column holds.
        rows: The rows below them.
        named: Place and line of the names, for messages.
        facts: What lines above say of the specimen, see ``facts``.
        notes: How the columns were found.
        repeats: Lines in which the names stand again, each for a new specimen.
    """

    headings: tuple[Heading, ...]
    rows: tuple[Row, ...]
    named: str
    facts: Mapping[str, tuple[float, ...]] = field(default_factory=dict)
    notes: tuple[str, ...] = ()
    repeats: tuple[int, ...] = ()


def table_of(
    sheet: Sheet, place: str, options: ReadingOptions, vocabulary: Vocabulary = TENSION
) -> Table:
    """The table in a sheet. Raises ``DesignError`` where it is not certain."""
    if options.columns is not None:
        found = _as_told(sheet, place, options.columns, vocabulary)
    else:
        found = _with_header(sheet, place, vocabulary)
    return replace(found, headings=_with_units(found.headings, options.units, vocabulary))


def _with_header(sheet: Sheet, place: str, vocabulary: Vocabulary) -> Table:
    for index, row in enumerate(sheet.rows):
        headings = _headings(row.cells, vocabulary)
        if _names_a_test(headings, vocabulary) and not _has_number(row, sheet):
            return _below(sheet, index, headings, f"{place} line {row.number}", vocabulary)
    first = _first_of_run(sheet)
    for comment in reversed(sheet.comments):  # as numpy.savetxt writes headers
        headings = _headings(comment.cells, vocabulary)
        named = _names_a_test(headings, vocabulary)
        if named and len(headings) == len(sheet.rows[first].cells):
            return Table(headings, sheet.rows[first:], f"{place} line {comment.number}")
    raise DesignError(_no_header(sheet, first, place, vocabulary))


def _below(
    sheet: Sheet, index: int, headings: tuple[Heading, ...], named: str, vocabulary: Vocabulary
) -> Table:
    """The table below the names in that row, with the units of the next row if it has some."""
    rest, notes, units = sheet.rows[index + 1 :], [], None
    if rest and _are_units(rest[0].cells, vocabulary):
        units = rest[0].cells
        _require_one_unit(headings, units, f"{named} and {rest[0].number}")
        headings = _in_units(headings, units, vocabulary)
        notes.append(f"units are those of line {rest[0].number}")
        rest = rest[1:]
    kept, repeats = _without_repeats(sheet, rest, sheet.rows[index].cells, units)
    above = sheet.rows[:index]
    if above:
        notes.append(f"{_lines(above)} above the names of the columns {_are(above)} no data")
    lines = {row.number for row in kept}
    between = [row for row in rest if row.number not in lines]
    known = facts((*above, *between), sheet)
    return Table(headings, kept, named, known, tuple(notes), repeats)


def _without_repeats(
    sheet: Sheet, rows: tuple[Row, ...], names: Sequence[str], units: Sequence[str] | None
) -> tuple[tuple[Row, ...], tuple[int, ...]]:
    """The rows without those that repeat names and units, and what stands right above them.

    Only what holds no numbers is passed over; the second are the lines of the repeated names.
    """
    places = [k for k, row in enumerate(rows) if row.cells == names]
    dropped = set(places)
    for place in places:
        if units is not None and rows[place + 1 : place + 2] and rows[place + 1].cells == units:
            dropped.add(place + 1)
        above = place - 1
        while above >= 0 and sheet.numbers_in(rows[above]) < 2 and above not in dropped:
            dropped.add(above)
            above -= 1
    kept = tuple(row for k, row in enumerate(rows) if k not in dropped)
    return kept, tuple(rows[k].number for k in places)


def _as_told(sheet: Sheet, place: str, text: str, vocabulary: Vocabulary) -> Table:
    """The table with columns as ``--columns`` has them."""
    parts = [part.strip() for part in text.split(",")]
    width = max(len(row.cells) for row in sheet.rows)
    numbered = "=" in text
    headings = (
        _numbered(parts, width, vocabulary)
        if numbered
        else tuple(_told(part, vocabulary) for part in parts)
    )
    wanted = [index for index, each in enumerate(headings) if each.quantity != "other"]
    numeric = [index for index in wanted if headings[index].quantity not in vocabulary.texts]
    usable = [_all(row, numeric, sheet) for row in sheet.rows]
    start = next((k for k in range(len(usable)) if all(usable[k : k + _RUN])), None)
    if start is None:
        raise DesignError(f"{place} has no line with numbers in the columns of --columns {text}.")
    above = sheet.rows[:start]
    notes = (f"{_lines(above)} above the numbers {_are(above)} no data",) if above else ()
    rows = sheet.rows[start:]
    return Table(headings, rows, "--columns", facts(above, sheet), notes)


def _numbered(parts: Sequence[str], width: int, vocabulary: Vocabulary) -> tuple[Heading, ...]:
    headings = [NO_COLUMN] * width
    for part in parts:
        name, _, place = (piece.strip() for piece in part.partition("="))
        if not (place.isascii() and place.isdigit() and 1 <= int(place[:4]) <= width):
            raise DesignError(
                f"--columns has {quoted(part)} but must have a name and the number of a column, "
                f"from 1 to {width}, as in {vocabulary.numbered}."
            )
        headings[int(place[:4]) - 1] = _told(name, vocabulary)
    return tuple(headings)


def _told(name: str, vocabulary: Vocabulary) -> Heading:
    if name in ("-", ""):
        return NO_COLUMN
    found = heading(name, vocabulary)
    if found.quantity is None:
        hint = near(name.partition("_")[0], vocabulary.words)
        raise DesignError(f"--columns has {quoted(name)}{hint or f'; {vocabulary.names}'}")
    return found._replace(told=True)


def _headings(cells: Sequence[str], vocabulary: Vocabulary) -> tuple[Heading, ...]:
    return tuple(heading(cell, vocabulary) if cell else NO_COLUMN for cell in cells)


def _names_a_test(headings: Sequence[Heading], vocabulary: Vocabulary) -> bool:
    return vocabulary.names_a_test([each.quantity for each in headings])


def _has_number(row: Row, sheet: Sheet) -> bool:
    return sheet.numbers_in(row) > 0


def _all(row: Row, columns: Sequence[int], sheet: Sheet) -> bool:
    cells = row.cells
    return all(k < len(cells) and sheet.number(cells[k]) is not None for k in columns)


def _first_of_run(sheet: Sheet) -> int:
    """The first of three rows after each other with numbers in the same columns; else the first."""
    found = [tuple(map(looks_like_a_number, row.cells)) for row in sheet.rows]
    for index, columns in enumerate(found[: len(found) - _RUN + 1]):
        if sum(columns) >= 2 and all(each == columns for each in found[index : index + _RUN]):
            return index
    return 0


def _are_units(cells: Sequence[str], vocabulary: Vocabulary) -> bool:
    given = [cell.strip("[](){}<> ") for cell in cells if cell]
    known = vocabulary.known_units
    return bool(given) and all(not unit or plain_unit(unit) in known for unit in given)


def _require_one_unit(headings: Sequence[Heading], cells: Sequence[str], named: str) -> None:
    """Refuse a unit in a name that the row of units below contradicts."""
    for each, cell in zip(headings, cells, strict=False):
        unit = plain_unit(cell.strip("[](){}<> "))
        if unit and each.unit is not None and unit != each.unit:
            raise DesignError(
                f"{named}: {quoted(each.text)} has another unit below it, {quoted(cell)}; --units "
                f"{each.quantity}={cell.strip('[](){}<> ')} or {each.quantity}="
                f"{each.unit} tells which, with --skip for the row of units."
            )


def _in_units(
    headings: Sequence[Heading], cells: Sequence[str], vocabulary: Vocabulary
) -> tuple[Heading, ...]:
    units = [plain_unit(cell.strip("[](){}<> ")) or None for cell in cells]
    units += [None] * (len(headings) - len(units))
    return tuple(
        _in_unit(each, unit, vocabulary) if unit is not None else each
        for each, unit in zip(headings, units, strict=False)
    )


def _in_unit(found: Heading, unit: str, vocabulary: Vocabulary) -> Heading:
    """The heading with a unit that stands below it or in an option."""
    named = found.quantity
    quantity = None if named is None else vocabulary.with_unit(named, unit)
    return found._replace(quantity=quantity or named, unit=unit)


def _with_units(
    headings: Sequence[Heading], text: str | None, vocabulary: Vocabulary
) -> tuple[Heading, ...]:
    """The headings with the units of ``--units`` instead of theirs."""
    result = list(headings)
    for part in text.split(",") if text is not None else ():
        name, equals, unit = (piece.strip() for piece in part.partition("="))
        quantity = heading(name, vocabulary).quantity if equals else None
        known = vocabulary.units_of(quantity)
        if not known:
            raise DesignError(
                f"--units has {quoted(part.strip())} but must have a quantity and its unit, as in "
                f"{vocabulary.units_example}{near(name, vocabulary.words) or '.'}"
            )
        if plain_unit(unit) not in known:
            raise DesignError(
                f"--units has the unit {quoted(unit)} of {name}; known are {', '.join(known)}."
            )
        concerned = [k for k, each in enumerate(result) if each.quantity == quantity]
        if not concerned:
            raise DesignError(f"--units has a unit of {name} but there is no such column.")
        for k in concerned:
            result[k] = _in_unit(result[k], plain_unit(unit), vocabulary)._replace(told=True)
    return tuple(result)


def _no_header(sheet: Sheet, first: int, place: str, vocabulary: Vocabulary) -> str:
    """Why the columns are not known, with the option that settles it."""
    row = sheet.rows[first]
    above = sheet.rows[first - 1] if first else None
    if above is None and not _has_number(row, sheet):
        above = row
    if above is not None and not _has_number(above, sheet):
        known = ", ".join(each.quantity or "?" for each in _headings(above.cells, vocabulary))
        return (
            f"{place} line {above.number} names the columns "
            f"{quoted(', '.join(above.cells))} ({known}), of which {vocabulary.lacking}; name them "
            f"with --columns, such as --columns {vocabulary.examples[-1]}."
        )
    count = len(row.cells)
    told = [
        ",".join((*example.split(","), *["-"] * (count - 2))) for example in vocabulary.examples
    ]
    return (
        f"{place} names no columns above line {row.number}; what its {count} columns hold and in "
        f"which units, --columns tells: --columns {' or --columns '.join(told)}, - for a column to "
        "leave out."
    )


def _lines(rows: Sequence[Row]) -> str:
    ends = sorted({rows[0].number, rows[-1].number})
    return f"line{'s' * (len(ends) > 1)} {'–'.join(map(str, ends))}"


def _are(rows: Sequence[Row]) -> str:
    return "are" if len(rows) > 1 else "is"
