"""Bounds that every machine prints the same."""

from __future__ import annotations

import math


def next_step(least: float) -> float:
    """The next of 1, 2, 5, 10, ... times a power of ten at or above a positive number."""
    decade = 10.0 ** math.floor(math.log10(least))
    return next(m * decade for m in (1, 2, 5, 10) if least <= m * decade * (1 + 1e-9))
