"""What a sweep varies: parameters of a design, and between which values."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from bellows_design.design.design import Design
from bellows_design.design.variation import settable, varied
from bellows_design.errors import DesignError
from bellows_design.validation.quoting import did_you_mean, quoted

PERCENT = "%"
"""Ends the name of a fillet that is given in percent of the largest one that its edges allow."""

FRACTIONS = tuple(f"{name}{PERCENT}" for name in ("inner_fillet", "outer_fillet"))

MOST_ALONG = 10_000
"""Values of one parameter in a grid."""

MOST = 1e9
"""Of any value, mm, MPa or %: far beyond every design, and its differences are finite."""

FORM = "must have the form name=from:to, or name=from:to:number for a grid"


@dataclass(frozen=True)
class Axis:
    """A parameter, its lowest and highest value, and into how many a grid divides them.

    In the parameter's unit: mm, MPa, or % of the largest fillet possible.
    """

    name: str
    low: float
    high: float
    number: int | None = None

    def __str__(self) -> str:
        number = "" if self.number is None else f":{self.number}"
        return f"{self.name}={self.low!r}:{self.high!r}{number}"


def axes(texts: Iterable[str], base: Design) -> tuple[Axis, ...]:
    """The parameters to vary, each written as ``bubble_width=16:20`` or ``bubble_width=16:20:5``.

    Raises:
        DesignError: One of them is no parameter of ``base``, or is named twice; values are no
            range; nothing is varied.
    """
    found = tuple(_axis(text, base) for text in texts)
    names = [axis.name for axis in found]
    if not names:
        raise DesignError("nothing is varied: name a parameter, as in --vary bubble_width=16:20:5.")
    for name in names:
        if names.count(name) > 1:
            raise DesignError(f"{name} is varied twice.")
        if f"{name}{PERCENT}" in names:
            raise DesignError(f"{name} is varied twice, in mm and in percent of the largest.")
    return found


def design_at(base: Design, values: Mapping[str, float]) -> Design:
    """``base`` with other values of the parameters of axes. Raises ``DesignError``."""
    fillets = {name.removesuffix(PERCENT): values[name] for name in FRACTIONS if name in values}
    lengths = {name: value for name, value in values.items() if name not in FRACTIONS}
    if not fillets:
        return varied(base, lengths)
    sharp = varied(base, lengths | dict.fromkeys(fillets, 0.0))
    most = _largest_fillets(sharp)
    return varied(sharp, {name: most[name] * percent / 100 for name, percent in fillets.items()})


def _axis(text: str, base: Design) -> Axis:
    name, equals, written = (part.strip() for part in text.partition("="))
    known = (*settable(base), *FRACTIONS)
    if not equals:
        raise DesignError(f"--vary {quoted(text)} {FORM}.")
    if name not in known:
        raise DesignError(f"unknown parameter {quoted(name)}{did_you_mean(name, known)}")
    parts = written.split(":")
    if len(parts) not in (2, 3):
        raise DesignError(f"--vary {quoted(text)} {FORM}.")
    low, high = (_number(text, part) for part in parts[:2])
    if not low < high:
        raise DesignError(f"{name} goes from {low:g} to {high:g} but must go from less to more.")
    if name in FRACTIONS and not 0 <= low < high <= 100:
        raise DesignError(f"{name} goes from {low:g} to {high:g} but must stay within 0 and 100 %.")
    return Axis(name, low, high, _count(name, parts[2]) if len(parts) == 3 else None)


def _number(text: str, part: str) -> float:
    try:
        value = float(part)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise DesignError(f"--vary {quoted(text)}: {quoted(part)} is no finite number; it {FORM}.")
    if abs(value) > MOST:
        raise DesignError(f"--vary {quoted(text)}: {value:g} must lie within ±{MOST:g}.")
    return value


def _count(name: str, part: str) -> int:
    number = int(part) if part.isascii() and part.isdigit() and len(part) < 10 else 0
    if not 2 <= number <= MOST_ALONG:
        raise DesignError(
            f"{name} is divided into {quoted(part)} values but must be into 2 to {MOST_ALONG}."
        )
    return number


def _largest_fillets(design: Design) -> dict[str, float]:
    """mm. Half of the smallest side that each rounds."""
    bellows = design.bellows
    return {
        "inner_fillet": min(bellows.chamber_size) / 2,
        "outer_fillet": min(bellows.bubble_size) / 2,
    }
