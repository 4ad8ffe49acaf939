"""What a column holds, by its name: quantity, unit, and of which specimen.

Names are in English, German, French, Italian or Spanish, with units in brackets or behind the
name: ``Tensile strain (%)``, ``stress_mpa``, ``Kraft in N``, ``Spannung / MPa``.
"""

from __future__ import annotations

import re
from typing import NamedTuple

from bellows_design.materials.measurements.table.units import ALL, UNITS, plain_unit

_WORDS = {
    "strain": "strain dehnung déformation deformación deformazione ε epsilon",
    "stress": "stress spannung zugspannung contrainte esfuerzo σ sigma",
    "stretch": "stretch λ lambda",
    "force": "force load kraft zugkraft standardkraft prüfkraft fuerza forza",
    "extension": "extension displacement weg standardweg traversenweg stroke crosshead position "
    "verlängerung längenänderung allongement",
    "elongation": "elongation",
    "time": "time zeit prüfzeit temps tiempo tempo",
    "mode": "mode",
    "specimen": "specimen sample probe probekörper éprouvette",
    "cycle": "cycle cycles zyklus",
    "other": "temperature temperatur temp index point nr no row",
}
_BASE = {word: quantity for quantity, words in _WORDS.items() for word in words.split()}

_QUALIFIERS = {
    "strain": "nominal engineering eng technical technische tensile axial longitudinal "
    "compressive extension displacement extensometer crosshead",
    "stress": "nominal engineering eng technical technische tensile axial longitudinal compressive "
    "standard",
    "stretch": "ratio axial longitudinal",
    "force": "standard axial tensile cell compressive",
    "extension": "tensile axial compressive standard",
    "elongation": "tensile axial",
    "time": "test elapsed total",
    "specimen": "id number name no",
    "cycle": "number count total elapsed no",
}
_TRUE = {
    "strain": "true log logarithmic hencky wahre natural",
    "stress": "true cauchy wahre",
}
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


def heading(text: str) -> Heading:
    """What a column called ``text`` holds."""
    name, unit = _without_brackets(text[:_LONGEST_NAME].lower().replace("\u03bc", "µ"))
    for words, trailing in _readings(name):
        found = _known(text, words, unit if trailing is None else trailing)
        if found is not None and (trailing is None or unit is None):
            return found
    return Heading(text, None, unit)


def may_be(text: str, quantity: str) -> bool:
    """True if a name that is not known has a word for the quantity, and none for its rate."""
    words = {word for word in re.split(r"[\W\d_]+", text[:_LONGEST_NAME].lower()) if word}
    return not words & _OF_SOMETHING_ELSE and any(_BASE.get(word) == quantity for word in words)


def _without_brackets(name: str) -> tuple[str, str | None]:
    """The name with the words in its brackets but the unit among them, and the unit."""
    unit = None
    for inner in _BRACKETS.findall(name):
        if plain_unit(inner) in ALL:
            unit = plain_unit(inner)
            name = _BRACKETS.sub(lambda found: _kept(found.group(1)), name)
            break
    return _BRACKETS.sub(r" \1 ", name), unit


def _kept(inner: str) -> str:
    return " " if plain_unit(inner) in ALL or not inner.strip() else f" {inner} "


def _readings(name: str) -> list[tuple[str, str | None]]:
    """(name, unit) in every way in which the end of a name may be a unit."""
    results: list[tuple[str, str | None]] = []
    for found in re.finditer(r"[\s_,/]+(?:in[\s_]+)?|(?=%)", name):
        rest, unit = name[: found.start()], plain_unit(name[found.end() :])
        if unit in ALL and unit not in _NO_ENDINGS:
            results.append((rest, unit))
    return [*results, (name, None)]


def _known(text: str, name: str, unit: str | None) -> Heading | None:
    words = [word for word in re.split(r"[\W_]+", name) if word and not word.isdigit()]
    words = [word.rstrip("0123456789") or word for word in words]
    bases = [_BASE[word] for word in words if word in _BASE]
    for quantity in sorted(set(bases), key=list(_WORDS).index):
        allowed = {*_QUALIFIERS.get(quantity, "").split(), *_TRUE.get(quantity, "").split()}
        if all(_BASE.get(word) == quantity or word in allowed for word in words):
            return _of(text, quantity, unit, set(words))
    return None


def _of(text: str, quantity: str, unit: str | None, words: set[str]) -> Heading | None:
    if quantity == "elongation" and unit is not None:
        quantity = "strain" if unit in UNITS["strain"] else "extension"
    if unit is not None and quantity in UNITS and unit not in UNITS[quantity]:
        if quantity == "strain" and unit in UNITS["extension"]:
            quantity = "extension"
        else:
            return None
    true = bool(words & set(_TRUE.get(quantity, "").split()))
    nominal = bool(words & {"nominal", "engineering", "eng", "technical", "technische"})
    return Heading(text, quantity, unit, true, nominal, bool(words & _COMPRESSED))
