"""Width and colours, by the stream and the environment."""

from __future__ import annotations

import io
from pathlib import Path

import pytest
from rendered import Screen
from rich.text import Text

from bellows_design.cli.terminal.console import console_on, print_for_people, wants_colours

ESCAPE = "\x1b["


@pytest.mark.parametrize(
    ("environment", "wanted"),
    [
        ({}, None),
        ({"NO_COLOR": "1"}, False),
        ({"NO_COLOR": ""}, None),
        ({"NO_COLOR": "1", "FORCE_COLOR": "1"}, False),
        ({"FORCE_COLOR": "1"}, True),
        ({"FORCE_COLOR": "0"}, None),
        ({"CLICOLOR_FORCE": "1"}, True),
        ({"CLICOLOR_FORCE": "0"}, None),
        ({"CLICOLOR": "0"}, False),
        ({"CLICOLOR": "0", "CLICOLOR_FORCE": "1"}, True),
    ],
)
def test_colours_are_wanted_as_variables_say(
    environment: dict[str, str], wanted: bool | None
) -> None:
    assert wants_colours(environment) is wanted


@pytest.fixture(autouse=True)
def capable_terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("TERM", "xterm-256color")


def printed(stream: io.StringIO) -> str:
    print_for_people([Text("red " * 60, style="red")], stream)
    return stream.getvalue()


def test_a_pipe_gets_whole_lines_without_colours() -> None:
    out = printed(io.StringIO())
    assert out == "red " * 60 + "\n" or out.rstrip() == ("red " * 60).rstrip()
    assert ESCAPE not in out


def test_a_terminal_gets_colours_and_lines_of_its_width(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "50")
    out = printed(Screen())
    assert ESCAPE in out and out.count("\n") > 3


def test_colours_may_be_forced_and_forbidden(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("CLICOLOR_FORCE", "1")
    assert ESCAPE in printed(io.StringIO())
    monkeypatch.setenv("NO_COLOR", "1")
    assert ESCAPE not in printed(io.StringIO()) and ESCAPE not in printed(Screen())


def test_the_width_of_a_pipe_may_be_asked_for(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "60")
    assert console_on(io.StringIO()).width == 60
    assert max(map(len, printed(io.StringIO()).splitlines())) <= 60


def test_signs_that_an_encoding_lacks_are_replaced(tmp_path: Path) -> None:
    with open(tmp_path / "out.txt", "w", encoding="ascii") as stream:
        print_for_people(["20° of Ćurković"], stream)
    assert (tmp_path / "out.txt").read_text("ascii").startswith("20? of ?urkovi?")
