"""What is wrong with a TOML file or a value in it, and how it is written right.

For files of every kind that people write by hand. Imports nothing of this package.
"""

from __future__ import annotations

import re
import tomllib

UNITS = {
    "nm": (1e-6, "mm"),
    "um": (1e-3, "mm"),
    "µm": (1e-3, "mm"),
    "μm": (1e-3, "mm"),
    "mm": (1.0, "mm"),
    "cm": (10.0, "mm"),
    "dm": (100.0, "mm"),
    "m": (1e3, "mm"),
    "in": (25.4, "mm"),
    "inch": (25.4, "mm"),
    "pa": (1e-6, "MPa"),
    "hpa": (1e-4, "MPa"),
    "kpa": (1e-3, "MPa"),
    "mpa": (1.0, "MPa"),
    "n/mm²": (1.0, "MPa"),
    "n/mm2": (1.0, "MPa"),
    "gpa": (1e3, "MPa"),
    "mbar": (1e-4, "MPa"),
    "bar": (0.1, "MPa"),
    "atm": (0.101325, "MPa"),
    "psi": (0.00689475729, "MPa"),
    "ksi": (6.89475729, "MPa"),
}
"""Unit in small letters -> its value in the unit that files are written in."""

_NUMBER = r"[+-]?(?:\d+(?:[.,]\d*)?|[.,]\d+)(?:[eE][+-]?\d+)?"
_WITH_UNIT = re.compile(rf"({_NUMBER})\s*([A-Za-zµμ°%\"'/²³0-9]*)")
_THOUSANDS = re.compile(r"[+-]?\d{1,3}(?:[ '  ]\d{3})+(?:[.,]\d+)?")
_PLACE = re.compile(r"\s*\(at (?:line (\d+), column (\d+)|end of document)\)$")
_ASSIGNMENT = re.compile(r"""\s*[\w."' -]+?\s*=\s*(.*)""")
_WORDS = {"True": "true", "False": "false", "yes": "true", "no": "false", "None": "", "null": ""}
_LONGEST = 60


def toml_error(error: tomllib.TOMLDecodeError, text: str) -> str:
    """The cause with its line and column, and a hint on the value there; no full stop."""
    cause = str(error)
    place = _PLACE.search(cause)
    if place is None:
        return cause.rstrip(".")
    cause = cause[: place.start()]
    cause = cause[:1].lower() + cause[1:]
    if place.group(1) is None:
        return f"at its end: {cause}"
    line, column = int(place.group(1)), int(place.group(2))
    hint = _hint_on(text.split("\n")[line - 1])
    return f"at line {line}, column {column}: {cause}{f'; {hint}' if hint else ''}"


def value_hint(text: str, unit: str | None = None) -> str:
    """How the value written as ``text`` is written in TOML; empty if there is nothing to say.

    ``unit`` is that of the field; empty for a field without one, None where it is not known.
    """
    value = text.strip()
    if value in _WORDS:
        right = _WORDS[value]
        return f"write {right}, not {value}" if right else f"leave the key out instead of {value}"
    if _THOUSANDS.fullmatch(value):
        plain = re.sub(r"[^\d.,+-]", "", value).replace(",", ".")
        return f"write {plain}, not {value}"
    found = _WITH_UNIT.fullmatch(value)
    return _number_hint(value, found.group(1), found.group(2), unit) if found else ""


def _number_hint(value: str, digits: str, unit: str, wanted: str | None) -> str:
    plain = _plain(digits)
    if not unit:
        return f"write {plain}, not {value}" if plain != value else ""
    factor, own = UNITS.get(unit.lower(), (None, ""))
    if factor is None or unit == "mPa" or wanted not in (None, own):
        return f"write the number alone, without “{unit}”{f', in {wanted}' if wanted else ''}"
    converted = f"{float(plain) * factor:.6g}"
    same = f"{value} is {converted} {own}: " if factor != 1 else ""
    return f"{same}write {converted}, in {own} and without the unit"


def _plain(digits: str) -> str:
    """The number with a decimal point and digits on both sides of it, as TOML wants it."""
    sign = digits[0] if digits[0] in "+-" else ""
    mantissa, letter, exponent = digits.removeprefix(sign).replace(",", ".").partition("e")
    if not letter:
        mantissa, letter, exponent = mantissa.partition("E")
    whole, point, rest = mantissa.partition(".")
    whole = whole.lstrip("0") or "0"
    return f"{sign}{whole}{point}{(rest or '0') if point else ''}{letter}{exponent}"


def _hint_on(line: str) -> str:
    """A hint on a line of a file that is no TOML."""
    found = _ASSIGNMENT.match(line)
    if found is None:
        return "TOML writes key = value" if re.match(r"\s*[\w.]+\s*:", line) else ""
    value = re.sub(r"\s+#.*$", "", found.group(1)).strip()
    if len(value) > _LONGEST:
        return ""
    if value[:1] in "“”„‘’«":
        return "text stands between straight quotes"
    hint = value_hint(value)
    if not hint and re.fullmatch(r"[A-Za-z_~./\\][\w./\\~-]*", value):
        return f'text stands in quotes: "{value}"'
    return hint
