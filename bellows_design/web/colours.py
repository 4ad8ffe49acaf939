"""Colours as text."""

from __future__ import annotations

import re

from bellows_design.errors import BellowsError

_COLOUR = re.compile(r"#[0-9a-fA-F]{6}")


def require_colour(colour: str) -> None:
    """Raise `BellowsError` unless `colour` is empty or `#rrggbb`."""
    if colour and not _COLOUR.fullmatch(colour):
        raise BellowsError(f"“{colour}” is no colour: write #rrggbb, or nothing.")
