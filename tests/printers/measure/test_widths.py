"""Widths as text."""

from __future__ import annotations

import pytest

from printers.measure.widths import shown


@pytest.mark.parametrize(
    ("width", "text"),
    [(2.0, "2.00"), (0.2, "0.20"), (0.05, "0.05"), (0.0013, "0.0013"), (0.0002, "0.0002")],
)
def test_a_width_keeps_two_digits_however_narrow(width: float, text: str) -> None:
    assert shown(width) == text
