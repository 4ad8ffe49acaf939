"""Every verification case: within tolerance, of the right order, and as documented."""

from __future__ import annotations

import pytest
from case import Case
from catalogue import DOCUMENT, all_cases
from sections import bound, section, summary

CASES = [
    pytest.param(case, id=case.name, marks=[pytest.mark.slow] if case.slow else [])
    for case in all_cases()
]


@pytest.mark.parametrize("case", CASES)
def test_a_case_meets_its_reference_and_its_order_as_the_document_says(case: Case) -> None:
    outcome = case.run()
    assert outcome.rows
    outside = [row for row in outcome.rows if not row.error <= row.tolerance]
    assert not outside
    assert not [order for order in outcome.orders if not order.observed >= order.least]
    document = DOCUMENT.read_text(encoding="utf-8")
    assert section(case, outcome) in document
    assert summary(case, outcome) in document


def test_the_document_has_one_section_for_each_case_and_no_other() -> None:
    lines = DOCUMENT.read_text(encoding="utf-8").splitlines()
    assert [line[4:] for line in lines if line.startswith("### ")] == [c.name for c in all_cases()]


@pytest.mark.parametrize(
    ("error", "printed"), [(3e-3, 5e-3), (5e-3, 5e-3), (1.1e-3, 2e-3), (0.0, 1e-5), (7e-4, 1e-3)]
)
def test_an_error_is_printed_as_a_bound_that_holds(error: float, printed: float) -> None:
    assert bound(error, tolerance=1e-2) == pytest.approx(printed)
