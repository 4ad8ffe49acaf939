"""Numbers as people and machines write them: decimal points or commas, thousands, per cent."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable

from bellows_design.errors import DesignError

LONGEST_NUMBER = 40

_PLAIN = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d{1,3})?", re.ASCII)
_GROUPED = {
    ",": re.compile(r"[+-]?[1-9]\d{0,2}(,\d{3})+(\.\d*)?", re.ASCII),
    ".": re.compile(r"[+-]?[1-9]\d{0,2}(\.\d{3})+(,\d*)?", re.ASCII),
}
"""Sign between thousands -> numbers that have it."""
_LIKE_A_NUMBER = re.compile(r"[+-]?(?=[.,]*\d)[\d.,]+([eE][+-]?\d{1,3})?", re.ASCII)


def bare(cell: str) -> str:
    """The number in a cell without a sign of per cent, and with an ASCII minus."""
    text = cell.removesuffix("%").rstrip() if cell.endswith("%") else cell
    return text.replace("\u2212", "-") if "\u2212" in text else text


def looks_like_a_number(cell: str) -> bool:
    """True if the cell holds a number with one decimal sign or the other."""
    return 0 < len(cell) <= LONGEST_NUMBER and bool(_LIKE_A_NUMBER.fullmatch(bare(cell)))


def number(cell: str, decimal: str) -> float | None:
    """The finite number in a cell, None if it holds none; per cent are not divided."""
    if len(cell) > LONGEST_NUMBER:
        return None
    text = bare(cell)
    thousands = "." if decimal == "," else ","
    if thousands in text:
        if not _GROUPED[thousands].fullmatch(text):
            return None
        text = text.replace(thousands, "")
    if decimal == ",":
        text = text.replace(",", ".")
    if not _PLAIN.fullmatch(text):
        return None
    value = float(text)
    return value if math.isfinite(value) else None


def decimal_sign(cells: Iterable[str], place: str) -> str:
    """The decimal sign of a table's numbers, ``.`` or ``,``. Raises ``DesignError`` where open."""
    texts = [bare(cell) for cell in cells]
    commas = [text for text in texts if "," in text]
    if not commas:
        return "."
    points = [text for text in texts if "." in text]
    comma_possible = all(_decimal_comma(text) for text in texts)
    point_possible = all(_decimal_point(text) for text in texts)
    proven = not points or any("," in text and "." in text for text in texts)
    if comma_possible and not point_possible and proven:
        return ","
    if point_possible and not comma_possible and proven:
        return "."
    if comma_possible or point_possible:
        shown = next((text for text in commas if "." not in text), commas[0])
        raise DesignError(
            f"{place} has numbers such as “{shown}”"
            f"{f' and “{points[0]}”' if points else ''}, whose commas may be decimal commas or "
            "stand between thousands; --decimal comma or --decimal point tells which."
        )
    other = points[0] if points else commas[-1]
    raise DesignError(f"{place} mixes decimal signs: it has “{commas[0]}” and “{other}”.")


def _decimal_comma(text: str) -> bool:
    return number(text, ",") is not None or not looks_like_a_number(text)


def _decimal_point(text: str) -> bool:
    return number(text, ".") is not None or not looks_like_a_number(text)
