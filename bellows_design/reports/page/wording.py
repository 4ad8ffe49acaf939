"""Values with their errors, as text."""

from __future__ import annotations

import math
import re

from bellows_design.reports.page.blocks import Cell, Tone

NAME = re.compile(r"\w+([._]\w+)+|\w+ =")
"""Such as bubble_thickness, load.pressure or "length = 50"."""

TONES: dict[str, Tone] = {"pass": "good", "info": "info", "warn": "warn", "fail": "bad"}
"""Of a rule's verdict."""


def plus_minus(value: float, percent: float | None, unit: str, digits: int = 1) -> str:
    """The estimated error of a value, in its unit and in percent."""
    if percent is None or not math.isfinite(percent):
        return "error not estimated"
    return f"± {abs(value) * percent / 100:.{digits}f}{unit} ({percent:.2g} %)"


def pressure_text(pressure: float) -> str:
    """A pressure over that outside, MPa."""
    kind = " vacuum" if pressure < 0 else ""
    return f"{abs(pressure):.4g} MPa{kind}"


def shown(value: float | int | str) -> str:
    """A measured or required value."""
    return f"{value:.4g}" if isinstance(value, float) else str(value)


def with_unit(value: float | int | str, unit: str) -> str:
    """A value and its unit; words have none."""
    text = shown(value)
    return f"{text} {unit}".strip() if any(sign.isdigit() for sign in text) else text


def headings(*texts: str, right: tuple[str, ...] = ()) -> tuple[Cell, ...]:
    """Headings of a table; those named by ``right`` stand above numbers."""
    return tuple(Cell(text, align="right" if text in right else "left") for text in texts)


def number(text: str, tone: Tone = "") -> Cell:
    """A cell with a number."""
    return Cell(text, tone, "right")


def capitalised(text: str) -> str:
    """A sentence with a full stop, and with a capital unless it begins with a name from a file."""
    text = text.strip()
    end = "" if text.endswith((".", "!", "?")) else "."
    first = text if NAME.match(text) else text[:1].upper() + text[1:]
    return first + end
