"""Pressures from the command line: one number, or START:STOP:STEP; negative ones are a vacuum."""

from __future__ import annotations

import math

from bellows_design.errors import DesignError
from bellows_design.validation.quoting import quoted

MOST = 200
"""So many points describe any curve; more are a mistaken unit."""


def parse_pressures(text: str) -> tuple[float, ...]:
    """Pressures away from zero, MPa: ``0.1``, ``0.02:0.1:0.02`` or ``-0.02:-0.08:-0.02``.

    Both ends are included. Raises ``DesignError`` unless the text is one number or a range of
    numbers with one sign.
    """
    parts = [_number(part, text) for part in text.split(":")]
    if len(parts) == 1:
        return (parts[0],)
    if len(parts) != 3:
        raise DesignError(f"--pressure {quoted(text)} must be a number or START:STOP:STEP, in MPa.")
    start, stop, step = parts
    sign = math.copysign(1.0, start)
    return tuple(sign * size for size in _range(sign * start, sign * stop, sign * step, text))


def _range(start: float, stop: float, step: float, text: str) -> tuple[float, ...]:
    if not (0 < start <= stop and step > 0):
        raise DesignError(
            f"--pressure {quoted(text)} must go away from 0 MPa: 0 < START <= STOP and STEP > 0, "
            "or all three negative for a vacuum."
        )
    steps = (stop - start) / step
    if not steps < MOST:
        raise DesignError(f"--pressure {quoted(text)} has too many values; at most {MOST}.")
    count = math.floor(steps + 1e-9)
    inner = [start + index * step for index in range(count + 1)]
    return (*(p for p in inner if p < stop * (1 - 1e-9)), stop)


def _number(part: str, text: str) -> float:
    try:
        value = float(part)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        from printers.toml_errors import value_hint  # not at the start: it comes with NumPy

        reason = value_hint(part.strip(), "MPa") or f"{quoted(part)} is no number of MPa"
        raise DesignError(f"--pressure {quoted(text)}: {reason}.")
    return value
