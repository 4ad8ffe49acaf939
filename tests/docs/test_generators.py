"""What the site's pages are made of: code stays code, usage says what may be left out."""

from __future__ import annotations

from generators.commands import page as commands_page
from generators.gallery import page as gallery_page
from generators.names import with_code


def test_indented_lines_of_a_docstring_are_code_once() -> None:
    text = "What it is.\n\n    first()\n\n    second()\n\nMore::\n\n    third()\n"
    shown = with_code(text)
    assert shown.count("::\n") == 2
    assert "::\n\n    first()\n\n    second()\n" in shown and "More::\n\n    third()" in shown


def test_commands_of_the_gallery_are_blocks() -> None:
    outside = "".join(gallery_page().split("```")[::2])
    assert "python examples/" not in outside and "--fingers" not in outside


def test_the_usage_has_what_may_be_left_out_in_brackets() -> None:
    page = commands_page()
    for usage in ("list [OPTIONS] [WHAT]", "fit [OPTIONS] FILE...", "init [OPTIONS] KIND FILE"):
        assert f"bellows {usage}\n" in page
