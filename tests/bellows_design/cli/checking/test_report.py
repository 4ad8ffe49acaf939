"""What the table of a check says beside its rows."""

from __future__ import annotations

import pytest

from bellows_design.reports.check import report_table
from printers.report import PrintabilityReport, at_least


@pytest.mark.parametrize(
    ("measured", "told"),
    [(1.21, False), (1.19, True), (1.15, True)],
    ids=["more", "within", "less"],
)
def test_a_pass_that_needed_its_tolerance_is_told_in_words(measured: float, told: bool) -> None:
    result = at_least("minimum_lines", measured, 1.2, 0.02, "here", "the weakest place")
    assert result.verdict == ("pass" if measured > 1.18 else "fail")
    said = report_table("box", PrintabilityReport("prusa_i3", (result,)))
    assert (f"{result.verdict}: the weakest place" in said) == told
