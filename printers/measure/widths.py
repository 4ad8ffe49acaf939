"""A width in mm as text, for people."""

from __future__ import annotations

WIDE = 0.1  # mm: from here on two decimals are two digits


def shown(width: float) -> str:
    """Two decimals, or two digits of what is narrower: a leak of 1 µm is none of 0.00 mm."""
    return f"{width:.2f}" if width >= WIDE else f"{width:.2g}"
