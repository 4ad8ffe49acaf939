"""The document of validation: as its results say, with claims that hold, on what is computed."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest
from printed import document, report
from record import Case, Row
from stored import DOCUMENT, all_cases, results_of

CASES = [pytest.param(name, id=name) for name in all_cases()]
SAMPLED = [
    pytest.param(name, case, id=name, marks=[pytest.mark.slow] if case.slow else [])
    for name, case in all_cases().items()
    if case.sample
]


def test_the_document_is_what_the_stored_results_say() -> None:
    assert DOCUMENT.read_text(encoding="utf-8") == document()


@pytest.mark.parametrize("name", CASES)
def test_rows_agree_with_the_measurement_where_the_document_says_so(name: str) -> None:
    for row in report(name).rows:
        assert row.inside == row.agrees, row


@pytest.mark.parametrize("name", CASES)
def test_every_figure_that_the_document_shows_is_there(name: str) -> None:
    figure = report(name).figure
    assert not figure or (DOCUMENT.parent / figure).stat().st_size > 0
    assert bool(figure) == (all_cases()[name].draw is not None)


@pytest.mark.parametrize("name", CASES)
def test_every_computation_of_a_case_is_stored(name: str) -> None:
    assert list(results_of(name)) == list(all_cases()[name].computations)


@pytest.mark.parametrize(("name", "case"), SAMPLED)
def test_a_computation_that_is_repeated_gives_the_stored_readings(name: str, case: Case) -> None:
    found = list(leaves(case.computations[case.sample]().readings))
    stored = list(leaves(results_of(name)[case.sample].readings))
    texts, numbers = (
        [each for each in stored if isinstance(each, str) is text] for text in (True, False)
    )
    assert [each for each in found if isinstance(each, str)] == texts
    again = [each for each in found if not isinstance(each, str)]
    assert again == pytest.approx(numbers, rel=case.tolerance, abs=1e-6)


def leaves(value: Any) -> Iterator[float | str]:
    """All numbers and texts of nested readings, in order; iterations are not compared."""
    if isinstance(value, dict):
        for key, each in value.items():
            yield from leaves(each) if key != "newton_iterations" else ()
    elif isinstance(value, list | tuple):
        for each in value:
            yield from leaves(each)
    else:
        yield value


@pytest.mark.parametrize(
    ("ours", "beyond"),
    [((9.0, 9.0), 0.0), ((12.0, 14.0), 0.0), ((13.1, 14.0), 0.1), ((5.0, 7.6), -0.05)],
)
def test_a_row_lies_beyond_the_measurement_by_what_is_not_allowed(
    ours: tuple[float, float], beyond: float
) -> None:
    row = Row("angle", measured=(9.0, 11.0), ours=ours, allowed=0.1)
    assert row.band == pytest.approx((8.1, 12.1))
    assert row.beyond == pytest.approx(beyond)
    assert row.inside == (beyond == 0)
