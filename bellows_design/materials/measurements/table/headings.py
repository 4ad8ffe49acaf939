"""What a column holds, by its name: quantity, unit, and of which specimen.

Names are in English, German, French, Italian or Spanish, with units in brackets or behind the
name: ``Tensile strain (%)``, ``stress_mpa``, ``Kraft in N``, ``Spannung / MPa``.
"""

from __future__ import annotations

import re
from typing import NamedTuple

from bellows_design.materials.measurements.table.units import plain_unit
from bellows_design.materials.measurements.table.vocabulary import TENSION, Vocabulary

_OF_SOMETHING_ELSE = {"rate", "speed", "max", "maximum", "min", "break", "yield", "energy", "cell"}
_COMPRESSED = {"compressive", "compression"}
_NO_ENDINGS = ("1", "-")
"""Units that are none without brackets: ``Strain 1`` is the first of several."""

_BRACKETS = re.compile(r"[\[({<]([^\[\](){}<>]*)[\])}>]")
_LONGEST_NAME = 100


class Heading(NamedTuple):
    """What the name of a column says.

    Attributes:
        text: The name as it stands there.
        quantity: One of ``strain stress stretch force extension elongation time mode specimen
            cycle other``; None if the name is not known.
        unit: In the spelling of ``units``; None if it has none.
        true: The strain is logarithmic, the stress over present area.
        nominal: The name says that it is nominal.
        compressive: The name says that compression counts as positive.
        told: An option says so, not the file.
    """

    text: str
    quantity: str | None = None
    unit: str | None = None
    true: bool = False
    nominal: bool = False
    compressive: bool = False
    told: bool = False


def heading(text: str, vocabulary: Vocabulary = TENSION) -> Heading:
    """What a column called ``text`` holds."""
    plain = text[:_LONGEST_NAME].lower().replace("\u03bc", "µ")
    name, unit = _without_brackets(plain, vocabulary)
    for words, trailing in _readings(name, vocabulary):
        found = _known(text, words, unit if trailing is None else trailing, vocabulary)
        if found is not None and (trailing is None or unit is None):
            return found
    return Heading(text, None, unit)


def may_be(text: str, quantity: str, vocabulary: Vocabulary = TENSION) -> bool:
    """True if a name that is not known has a word for the quantity, and none for its rate."""
    words = {word for word in re.split(r"[\W\d_]+", text[:_LONGEST_NAME].lower()) if word}
    return not words & _OF_SOMETHING_ELSE and any(
        quantity in vocabulary.quantities.get(word, ()) for word in words
    )


def _without_brackets(name: str, vocabulary: Vocabulary) -> tuple[str, str | None]:
    """The name with the words in its brackets but the unit among them, and the unit."""
    units = vocabulary.known_units

    def kept(inner: str) -> str:
        return " " if plain_unit(inner) in units or not inner.strip() else f" {inner} "

    unit = None
    for inner in _BRACKETS.findall(name):
        if plain_unit(inner) in units:
            unit = plain_unit(inner)
            name = _BRACKETS.sub(lambda found: kept(found.group(1)), name)
            break
    return _BRACKETS.sub(r" \1 ", name), unit


def _readings(name: str, vocabulary: Vocabulary) -> list[tuple[str, str | None]]:
    """(name, unit) in every way in which the end of a name may be a unit."""
    results: list[tuple[str, str | None]] = []
    for found in re.finditer(r"[\s_,/]+(?:in[\s_]+)?|(?=%)", name):
        rest, unit = name[: found.start()], plain_unit(name[found.end() :])
        if unit in vocabulary.known_units and unit not in _NO_ENDINGS:
            results.append((rest, unit))
    return [*results, (name, None)]


def _known(text: str, name: str, unit: str | None, vocabulary: Vocabulary) -> Heading | None:
    words = [word for word in re.split(r"[\W_]+", name) if word and not word.isdigit()]
    words = [word.rstrip("0123456789") or word for word in words]
    meanings = [vocabulary.quantities.get(word, frozenset()) for word in words]
    for quantity in (each for each in vocabulary.words if any(each in one for one in meanings)):
        beside = vocabulary.beside[quantity]
        known = (
            quantity in one or word in beside for word, one in zip(words, meanings, strict=True)
        )
        if all(known):
            return _of(text, quantity, unit, set(words), vocabulary)
    return None


def _of(
    text: str, quantity: str, unit: str | None, words: set[str], vocabulary: Vocabulary
) -> Heading | None:
    meant = quantity if unit is None else vocabulary.with_unit(quantity, unit)
    if meant is None:
        return None
    true = bool(words & vocabulary.trues.get(meant, frozenset()))
    nominal = bool(words & {"nominal", "engineering", "eng", "technical", "technische"})
    return Heading(text, meant, unit, true, nominal, bool(words & _COMPRESSED))
