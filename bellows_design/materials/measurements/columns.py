"""Which columns of a table are the strain and the stress, of how many specimens."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import NamedTuple

from bellows_design.errors import DesignError
from bellows_design.materials.measurements.table.header import Table
from bellows_design.materials.measurements.table.headings import Heading, may_be
from bellows_design.validation.quoting import did_you_mean, quoted
from solver.material.homogeneous import MODES

STRESSES = ("stress", "force")


class Pair(NamedTuple):
    """Columns, counted from 0, of one specimen's strain and stress."""

    strain: int
    stress: int


class Columns(NamedTuple):
    """What is read of a table.

    Attributes:
        pairs: Strain and stress of each specimen that has columns of its own.
        mode, specimen, time: Columns of these, None where there is none.
        notes: Which were chosen, which were left out.
    """

    pairs: tuple[Pair, ...]
    mode: int | None
    specimen: int | None
    time: int | None
    notes: tuple[str, ...] = ()


def columns_of(table: Table) -> Columns:
    """The columns to read. Raises ``DesignError`` where several or none may be meant."""
    strains = _strains(table)
    stresses = _of_kind(table, STRESSES)
    pairs = _pairs(table, strains, stresses)
    _require_no_rival(table, pairs[0])
    mode, specimen, time = (_only(table, name) for name in ("mode", "specimen", "time"))
    used = {*strains, *stresses, mode, specimen, time}
    _require_no_hidden_mode(table, [k for k in range(len(table.headings)) if k not in used])
    return Columns(pairs, mode, specimen, time, _notes(table, pairs, {mode, specimen}))


def _strains(table: Table) -> list[int]:
    """Columns of the strain: strain or stretch before extension."""
    for each in table.headings:
        if each.quantity == "elongation":
            raise DesignError(
                f"{table.named}: the column {quoted(each.text)} has no unit; "
                "--units elongation=% or elongation=mm tells it."
            )
    found = {name: _of_kind(table, (name,)) for name in ("strain", "stretch", "extension")}
    if found["strain"] and found["stretch"]:
        raise DesignError(
            f"{table.named} has both columns stretch and strain; exactly one of them must be given"
            ": --columns leaves one out."
        )
    chosen = found["strain"] or found["stretch"] or found["extension"]
    if not chosen:
        raise DesignError(
            f"{table.named} lacks a column of strain, stretch or extension; --columns names it."
        )
    return chosen


def _of_kind(table: Table, quantities: Sequence[str]) -> list[int]:
    """Columns of the first of these quantities there is, nominal ones before true ones."""
    for quantity in quantities:
        found = [k for k, each in enumerate(table.headings) if each.quantity == quantity]
        nominal = [k for k in found if not table.headings[k].true]
        if found:
            return nominal or found
    return []


def _pairs(table: Table, strains: list[int], stresses: list[int]) -> tuple[Pair, ...]:
    if not stresses:
        raise DesignError(
            f"{table.named} lacks a column of stress or force; --columns names it, such as "
            "stress_mpa."
        )
    if len(strains) == len(stresses) == 1:
        return (Pair(strains[0], stresses[0]),)
    alike = _alike(table, strains) and _alike(table, stresses)
    if alike and len(strains) == len(stresses):
        return tuple(map(Pair, strains, stresses))
    if alike and len(strains) == 1:
        return tuple(Pair(strains[0], each) for each in stresses)
    several = strains if len(strains) > 1 else stresses
    raise DesignError(_several(table, several, Pair(strains[0], stresses[0])))


def _require_no_rival(table: Table, pair: Pair) -> None:
    """Refuse to pass over a column that is not known but has the word for what is read."""
    for chosen in pair:
        quantity = table.headings[chosen].quantity or ""
        unknown = [k for k, each in enumerate(table.headings) if each.quantity is None]
        rivals = [k for k in unknown if may_be(table.headings[k].text, quantity)]
        if rivals:
            raise DesignError(_several(table, [chosen, *rivals], pair))


def _several(table: Table, columns: Sequence[int], pair: Pair) -> str:
    names = ", ".join(f"{quoted(table.headings[k].text)} ({k + 1})" for k in columns[:4])
    strain, stress = (table.headings[k].quantity for k in pair)
    return (
        f"{table.named} has several columns that may be meant, {names}; name those to read by "
        f"their numbers, as in --columns {strain}={pair.strain + 1},{stress}={pair.stress + 1}, "
        "with a unit behind the name (strain_percent, stress_mpa)."
    )


def _alike(table: Table, columns: Sequence[int]) -> bool:
    """True if the columns hold the same quantity: their names differ at most by a number."""
    headings = [table.headings[k] for k in columns]
    names = {re.sub(r"\d+", "", each.text.lower().replace(" ", "")) for each in headings}
    return len(names) == 1 and len({(each.quantity, each.unit) for each in headings}) == 1


def _only(table: Table, quantity: str) -> int | None:
    found = _of_kind(table, (quantity,))
    if len(found) > 1 and quantity != "time":
        raise DesignError(f"{table.named} names the column {quoted(quantity)} more than once.")
    return found[0] if found else None


def _require_no_hidden_mode(table: Table, others: Sequence[int]) -> None:
    """Refuse to leave out a column that says which test a point is from."""
    for k in others:
        name = table.headings[k].text
        words = {row.cells[k].lower() for row in table.rows[:1000] if k < len(row.cells)}
        if words & set(MODES):
            raise DesignError(
                f"{table.named} has the unknown column {quoted(name)}"
                f"{did_you_mean(name.lower(), ('mode',))}"
            )


def _notes(table: Table, pairs: Sequence[Pair], labels: set[int | None]) -> tuple[str, ...]:
    used = {*(k for pair in pairs for k in pair), *labels}
    left_out = [
        quoted(each.text)
        for k, each in enumerate(table.headings)
        if k not in used and each.text != "-"
    ]
    notes = list(table.notes)
    if left_out:
        notes.append(f"not read: the column{'s' * (len(left_out) > 1)} {', '.join(left_out)}")
    return tuple(notes)


def shown(found: Heading) -> str:
    """A column as sentences call it."""
    return f"the column {quoted(found.text)}"
