"""The design that the page's values make of the one that was opened."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from contextlib import suppress
from functools import lru_cache
from typing import Any

from bellows_design.design.bellows_parameters import BellowsParameters
from bellows_design.design.design import Design, is_toml
from bellows_design.design.overrides import known_keys
from bellows_design.design.variation import followed
from bellows_design.errors import BellowsError, DesignError
from bellows_design.files.toml_files import Table, toml_table
from bellows_design.validation.quoting import did_you_mean, quoted

Values = Mapping[str, Any]
"""By dotted name as ``--set`` takes them; tables, numbers, text, or None for what may be absent."""

NAMED = ("material", "printer")
"""Keys that may be names of a library or tables, but no files: the page reads none."""

_WORDS = re.compile(r"[A-Za-z_][A-Za-z0-9_.]*")
DESCRIBED = {
    "chamber's length": "chamber_length",
    "chamber's width": "bubble_width",
    "chamber's height": "bubble_height",
    "bubble's length": "chamber_length",
    "bubble's width": "bubble_width",
    "bubble's height": "bubble_height",
    "unknown material": "material",
}
"""Words of sentences, and the parameters that they are about."""

_STATED = re.compile(r" (?:= |is |has |names |cannot )|:")
"""What follows a key of one plain word, which may be a word of the sentence as well."""


def opened_text(text: str) -> Design:
    """The design of a TOML text that came with a message. Raises ``DesignError``."""
    table = toml_table(text, "the design")
    _refuse_files(table)
    return Design.of(table)


@lru_cache(maxsize=8)
def design_of_text(text: str) -> Design:
    """The design that ``Design.to_toml`` wrote as ``text``."""
    return Design.from_toml(text)


def changed(base: Design, values: Values) -> Design:
    """``base`` with the page's values; fillets that are full rounds follow unless they are given.

    Raises ``DesignError`` with a sentence for each problem.
    """
    table = base.model_dump()
    for key, value in values.items():
        _put(table, key, value)
    _refuse_files({name: table[name] for name in NAMED})
    with suppress(TypeError, ValueError, ArithmeticError, LookupError):  # no numbers: refused next
        followed(base, table, _plain(values))
    return Design.of(table)


def _plain(values: Values) -> frozenset[str]:
    return frozenset(key.removeprefix("bellows.") for key in values)


def problems(error: BellowsError, changed_names: Values = {}) -> list[dict[str, Any]]:  # noqa: B006
    """The sentences of an error, each with the parameters that it names.

    ``parameter`` is the first of them that was changed, else the first; empty if it names none.
    """
    sentences = getattr(error, "sentences", None) or (str(error),)
    return [_problem(sentence, _plain(changed_names)) for sentence in sentences]


def _problem(sentence: str, moved: frozenset[str]) -> dict[str, Any]:
    names = tuple(dict.fromkeys(_named(sentence)))
    first = next((name for name in names if name in moved), names[0] if names else "")
    return {"parameter": first, "parameters": list(names), "message": sentence}


def _named(sentence: str) -> Iterator[str]:
    """The keys that a sentence names, in its order; then those behind what it describes."""
    if sentence.startswith("unknown key"):
        return
    yield from _spelled(sentence)
    yield from (name for words, name in DESCRIBED.items() if words in sentence)


def _spelled(sentence: str) -> Iterator[str]:
    known = set(known_keys()) - {"name", "description"}
    for found in _WORDS.finditer(sentence):
        name = found[0].rstrip(".").removeprefix("bellows.")
        plain = "_" not in name and "." not in name
        if name in known and (not plain or _STATED.match(sentence, found.end())):
            yield name


def _put(table: Table, key: str, value: Any) -> None:
    """Set what a dotted key names; tables that are absent are opened."""
    plain = key.removeprefix("bellows.")
    if plain in BellowsParameters.model_fields:
        table["bellows"] = table["bellows"] | {plain: value}
        return
    if key not in known_keys() or key in ("bellows", "scenes"):
        raise DesignError(f"unknown key {quoted(key)}{did_you_mean(key, known_keys())}")
    *parents, last = key.split(".")
    for parent in parents:
        inner = table.get(parent)
        table[parent] = dict(inner) if isinstance(inner, Mapping) else {}
        table = table[parent]
    table[last] = value


def _refuse_files(table: Mapping[str, Any]) -> None:
    """Raise ``DesignError`` where a material or printer is a path: a page opens no files."""
    for key in NAMED:
        for value in _named_in(table.get(key)):
            if is_toml(value) or "/" in value or "\\" in value:
                raise DesignError(
                    f"{key} is the file {quoted(value)}: the studio takes names and tables; start "
                    "it with the design's file to use it."
                )


def _named_in(value: Any) -> Iterator[str]:
    """The names that a material or printer is given by: itself, or what its table extends."""
    if isinstance(value, str):
        yield value
    if isinstance(value, Mapping):
        for key in ("extends", "filament"):
            yield from _named_in(value.get(key))
