"""Every hard case behaves well, and as the document says."""

from __future__ import annotations

import re

import pytest
from hard_case import HardCase, row
from hard_catalogue import DOCUMENT, all_cases
from inertia import needs_inertia


def _marks(case: HardCase) -> list[pytest.MarkDecorator]:
    marks = [pytest.mark.slow] if case.slow else []
    marks += [needs_inertia] if case.inertia else []
    return [*marks, pytest.mark.xfail(reason=case.missing)] if case.missing else marks


def _identity(case: HardCase) -> str:
    return re.sub(r"\W+", "-", case.name.lower())


CASES = [pytest.param(case, id=_identity(case), marks=_marks(case)) for case in all_cases()]


@pytest.mark.parametrize("case", CASES)
def test_a_hard_case_ends_well_and_as_the_document_says(case: HardCase) -> None:
    findings = case.run()
    assert findings
    bad = [f"{finding.text} (found {finding.detail})" for finding in findings if not finding.good]
    assert not bad
    assert row(case, findings) in DOCUMENT.read_text(encoding="utf-8").splitlines()


def test_the_document_has_one_row_for_each_case_and_no_other() -> None:
    lines = DOCUMENT.read_text(encoding="utf-8").splitlines()
    names = [line.split(" | ")[0][2:] for line in lines if line.startswith("| ")]
    assert [name for name in names if name != "case"] == [case.name for case in all_cases()]


def test_what_is_open_is_in_the_document_as_such() -> None:
    lines = DOCUMENT.read_text(encoding="utf-8").splitlines()
    for case in all_cases():
        if case.missing:
            assert row(case, ()) in lines
