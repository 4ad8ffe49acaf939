"""The tutorial shows what its commands print, but for numbers, which differ by machine."""

from __future__ import annotations

import re

import pytest
from snippets import ROOT

from rerun import SHOWN, rerun

TUTORIAL = (ROOT / "docs/tutorial.md").read_text("utf-8")


def words(page: str) -> list[list[str]]:
    """The words of each output, without numbers and rules of tables."""
    blocks = [block["text"] for block in SHOWN.finditer(page)]
    return [re.findall(r"[A-Za-z_]{2,}", block) for block in blocks]


def test_every_output_of_the_tutorial_is_there() -> None:
    outputs = words(TUTORIAL)
    assert len(outputs) > 4 and all(outputs)


def test_an_output_is_replaced_by_the_last_lines_of_the_new_one() -> None:
    page = "```sh\nbellows list\n```\n\n<!-- output: last 2 -->\n```text\nold\n```\n"
    (shown,) = [block["text"] for block in SHOWN.finditer(rerun(page))]
    assert len(shown.splitlines()) == 2 and "old" not in shown


def test_commands_without_an_output_are_not_run() -> None:
    page = "```sh\nbellows studio finger\n```\n\nprints an address.\n\n"
    page += "```sh\nbellows list\n```\n\n<!-- output -->\n```text\nold\n```\n"
    (found,) = SHOWN.finditer(page)
    assert found["commands"] == "bellows list\n" and found["text"] == "old\n"


@pytest.mark.slicer
@pytest.mark.slow
def test_the_commands_of_the_tutorial_print_what_stands_there() -> None:
    assert words(rerun(TUTORIAL)) == words(TUTORIAL)
