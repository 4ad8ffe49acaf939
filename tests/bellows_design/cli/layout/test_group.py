"""The help by tasks, and mistakes of usage as one sentence that names what is near."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from typing import Any

import pytest
from typer.main import get_command

from bellows_design.cli.commands import app
from bellows_design.cli.layout.panels import OPTION_PANELS, ORDER_OF_USE, PANELS

Bellows = Callable[..., tuple[int, str, str]]
GROUP: Any = get_command(app)
HIDDEN = {"list", "cache", "doctor", "study"}
"""Commands that need no examples."""


def commands(group: Any = GROUP) -> Iterator[tuple[str, Any]]:
    for name, command in group.commands.items():
        yield name, command
        yield from commands(command) if hasattr(command, "commands") else ()


def test_every_command_stands_in_a_panel_and_main_ones_show_examples() -> None:
    for name, command in GROUP.commands.items():
        assert command.rich_help_panel in PANELS, name
        assert name in HIDDEN or "bellows " in (command.epilog or ""), name


def test_every_example_is_a_command_with_options_that_it_has() -> None:
    known = dict(commands())
    for name, command in known.items():
        for line in (command.epilog or "").split("\n")[1:]:
            program, first, *words = line.split()
            named = known[words[0]] if first == "study" else known[first]
            assert program == "bellows" and (first == name or name == "study")
            options = {option for each in named.params for option in each.opts}
            assert {word for word in words if word.startswith("-")} <= options, line


def test_options_stand_in_panels_that_there_are() -> None:
    panels = {
        parameter.rich_help_panel
        for _, command in commands()
        for parameter in command.params
        if getattr(parameter, "rich_help_panel", None)
    }
    assert panels == set(OPTION_PANELS)


def test_the_help_names_commands_by_task(bellows: Bellows, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "80")
    status, out, _ = bellows("--help")
    titles = [out.find(f"─ {panel} ─") for panel in PANELS if f"─ {panel} ─" in out]
    assert status == 0 and len(titles) >= 5 and titles == sorted(titles)
    assert "─ Commands ─" not in out and "<bool>" not in out
    assert max(map(len, out.splitlines())) <= 80


@pytest.mark.parametrize("command", ["check", "study sweep"])
def test_the_help_of_a_command_gives_flags_no_value(bellows: Bellows, command: str) -> None:
    status, out, _ = bellows(*command.split(), "--help")
    assert status == 0 and "--json" in out and "<bool>" not in out


@pytest.mark.parametrize(
    ("command", "usage"),
    [
        ("evaluate", "evaluate [OPTIONS] DESIGN"),
        ("init", "init [OPTIONS] KIND FILE"),
        ("list", "list [OPTIONS] [WHAT]"),
        ("schema", "schema [OPTIONS] [COMMAND]..."),
        ("plate", "plate [OPTIONS] DESIGN..."),
        ("study sweep", "study sweep [OPTIONS] DESIGN"),
    ],
)
def test_arguments_are_shown_by_their_names_alone(
    command: str, usage: str, bellows: Bellows, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("COLUMNS", "60")
    _, out, _ = bellows(*command.split(), "--help")
    assert f" {usage} " in out and not {"<str>", "<design|"} & set(out.split())


def test_within_a_panel_commands_stand_in_the_order_of_use() -> None:
    shown = GROUP.list_commands(None)
    assert sorted(shown) == sorted(ORDER_OF_USE)
    for panel in PANELS:
        inside = [name for name in shown if GROUP.commands[name].rich_help_panel == panel]
        assert inside == [name for name in ORDER_OF_USE if name in inside]
    assert shown.index("design") < shown.index("plate") < shown.index("evaluate")


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ("evalute finger", "unknown command “evalute”; did you mean evaluate?"),
        ("study swep finger", "unknown command “swep”; did you mean sweep?"),
        ("evaluate finger --presure 1", "unknown option “--presure”; did you mean --pressure?"),
        (
            "evaluate finger --model haf",
            "--model is “haf”; it can be auto, unit-cell, half or full",
        ),
        ("init desing x.toml", "KIND is “desing”; it can be design, scene,"),
        ("init", "KIND is missing; it can be design, scene,"),
        ("list desings", "did you mean designs?"),
        ("evaluate", "DESIGN is missing."),
        ("design finger", "--output is missing."),
        ("evaluate finger --accuracy abc", "--accuracy is “abc” but must be a number."),
        ("evaluate finger --accuracy=abc", "--accuracy is “abc” but must be a number."),
        ("study sweep finger --seed 1.5", "--seed is “1.5” but must be a whole number."),
        ("evaluate finger --set", "--set needs a value."),
        ("evaluate finger --no-cache=1", "--no-cache takes no value."),
        ("evaluate finger other", "“other” is one argument too many."),
        ("study sweep finger --sample ldhs", "did you mean lhs?"),
    ],
)
@pytest.mark.parametrize("as_json", [False, True])
def test_a_mistake_of_usage_is_one_sentence(
    arguments: str, words: str, as_json: bool, bellows: Bellows
) -> None:
    given = ["--json"] * as_json
    first, *others = arguments.split()
    status, out, err = bellows(first, *others, *(given if others[-1:] != ["--set"] else []))
    assert status == 2 and words in err and err.startswith("bellows: ") and err.count("\n") == 1
    assert "Usage" not in err and "╭" not in err
    if out:
        assert json.loads(out)["exit_status"] == 2 and words in json.loads(out)["error"]


def test_signs_that_a_terminal_obeys_are_not_repeated(bellows: Bellows) -> None:
    status, _, err = bellows("\x1b[31mred")
    assert status == 2 and "\x1b" not in err
