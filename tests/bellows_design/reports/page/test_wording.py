"""Sentences and numbers of a report."""

from __future__ import annotations

import pytest

from bellows_design.reports.page.wording import capitalised


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("the part is closed", "The part is closed."),
        ("Is it?", "Is it?"),
        ("bubble_thickness 1.5 mm is 3.75 lines.", "bubble_thickness 1.5 mm is 3.75 lines."),
        ("load.pressure is not reached", "load.pressure is not reached."),
        ("length = 50 mm is short", "length = 50 mm is short."),
        ("walls of 1.5 mm are thin", "Walls of 1.5 mm are thin."),
    ],
)
def test_sentences_begin_with_a_capital_but_names_stay_as_files_write_them(
    text: str, said: str
) -> None:
    assert capitalised(text) == said
