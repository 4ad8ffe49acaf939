"""The documented example runs, and says what is true."""

from __future__ import annotations

import re
import runpy
from pathlib import Path

import pytest
from inertia import needs_inertia

BALLOON = Path(__file__).parents[2] / "examples/balloon.py"


@needs_inertia
def test_the_balloon_of_the_documentation_holds_as_much_as_the_closed_form_says(
    capsys: pytest.CaptureFixture[str],
) -> None:
    runpy.run_path(str(BALLOON), run_name="__main__")
    printed = capsys.readouterr().out
    computed, closed = map(float, re.findall(r"([\d.]+) MPa", printed.splitlines()[-1]))
    assert computed == pytest.approx(closed, rel=1e-3)
    rows = [line.split() for line in printed.splitlines()[1:-1]]
    assert len(rows) > 4
    for _, pressure, expected, _ in rows:
        assert float(pressure) == pytest.approx(float(expected), rel=2e-3)
    assert [row[3] for row in rows][:3] == ["True"] * 3 and rows[-1][3] == "False"
