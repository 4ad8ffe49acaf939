"""Tables and texts that fit, of which nothing is cut."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from rendered import WIDTHS, assert_fits_terminals, on_terminal
from rich.box import SIMPLE
from rich.table import Table
from rich.text import Text

NAMES = ("bubble_thickness", "tendon_thickness", "material.elongation_at_break")


def sensitivities() -> Table:
    """As ``evaluate --sensitivities`` prints them: names and numbers that do not wrap."""
    table = Table(title="sensitivities, % per % of the parameter", box=SIMPLE)
    table.add_column("parameter", no_wrap=True)
    for heading in ("value", "angle", "stress", "volume"):
        table.add_column(heading, justify="right", no_wrap=True)
    for name in NAMES:
        table.add_row(name, "1.2 mm", "+1.234", "-0.567", "+0.001")
    return table


@pytest.mark.parametrize("width", [*WIDTHS, 20])
def test_every_name_shows_in_full_at_any_width(width: int) -> None:
    shown = "\n".join(on_terminal([sensitivities()], width))
    assert "…" not in shown
    for name in NAMES:
        assert name in shown or width < len(name) + 4


def test_a_table_is_as_wide_as_its_cells_on_a_wide_terminal() -> None:
    lines = on_terminal([sensitivities()], 200)
    assert max(map(len, lines)) < 80


def test_rows_that_fit_no_way_become_lines_with_their_headings() -> None:
    shown = on_terminal([sensitivities()], 40)
    assert "bubble_thickness" in shown[2] and "  angle: +1.234" in shown


def test_a_sentence_wraps_between_words_below_its_beginning() -> None:
    shown = on_terminal(["  - stress: " + "word " * 20], 40)
    assert shown[0].startswith("  - stress") and shown[1].startswith("    word")
    assert all(set(line.split()) <= {"-", "stress:", "word"} for line in shown)


cells = st.text(st.characters(blacklist_categories=("C", "Z", "M")), min_size=1, max_size=40)
sentences = st.lists(cells, min_size=1, max_size=6).map(" ".join)


@settings(max_examples=60, deadline=None)
@given(st.lists(st.tuples(sentences, cells, sentences), min_size=1, max_size=5), st.booleans())
def test_nothing_of_any_table_is_lost(rows: list[tuple[str, ...]], with_heads: bool) -> None:
    table = Table(box=SIMPLE, show_header=with_heads)
    for number, heading in enumerate(("", "some\nheading", "rule")):
        table.add_column(heading, no_wrap=number == 1)
    for row in rows:
        table.add_row(*map(Text, row))
    assert_fits_terminals([table, *(row[0] for row in rows)])


def test_the_same_table_may_be_printed_again() -> None:
    table = sensitivities()
    narrow = on_terminal([table], 40)
    assert on_terminal([table], 120) == on_terminal([sensitivities()], 120) != narrow
