"""The commands and their options, as the command line itself knows them."""

from __future__ import annotations

import inspect
from collections.abc import Iterator
from enum import Enum
from typing import Any, get_args

from generators.tables import prose, table

HEADER = """\
# Commands and options

Made from the program at the build of this page: what `bellows COMMAND --help` prints. What the
options mean, with examples, is in [commands](../commands.md).
"""


def page() -> str:
    """All commands, one section each."""
    return "\n".join([HEADER, *(_section(name, command) for name, command in commands())])


def commands() -> Iterator[tuple[str, Any]]:
    """Whole name and Click's command of each, those of groups too, in the order of the help."""
    from typer.main import get_command

    from bellows_design.cli.commands import app

    yield from _within(get_command(app), "bellows")


def _within(group: Any, name: str) -> Iterator[tuple[str, Any]]:
    for key in group.list_commands(None):
        command = group.commands[key]
        if getattr(command, "hidden", False):
            continue
        if hasattr(command, "commands"):
            yield from _within(command, f"{name} {key}")
        else:
            yield f"{name} {key}", command


def _section(name: str, command: Any) -> str:
    visible = [given for given in command.params if not getattr(given, "hidden", False)]
    arguments = [given for given in visible if given.param_type_name == "argument"]
    options = [given for given in visible if given.param_type_name == "option"]
    usage = " ".join([name, *["[OPTIONS]"][: len(options)], *map(_in_usage, arguments)])
    return "\n".join(
        [
            f"## `{name}`\n",
            f"```text\n{usage}\n```\n",
            prose(inspect.cleandoc(command.help or "")) + "\n",
            table(("argument", "meaning"), ((f"`{_metavar(a)}`", _help(a)) for a in arguments)),
            table(("option", "meaning", "default"), (_option(option) for option in options)),
        ]
    )


def _metavar(given: Any) -> str:
    return given.metavar or (given.human_readable_name or given.name).upper()


def _in_usage(argument: Any) -> str:
    """An argument as the usage in the terminal has it."""
    return " ".join(argument.get_usage_pieces(None))


def _help(given: Any) -> str:
    return prose(getattr(given, "help", None) or "")


def _option(option: Any) -> tuple[str, str, str]:
    names = ", ".join(f"`{name}`" for name in [*option.opts, *option.secondary_opts])
    default = option.default
    shown = default not in (None, [], ()) and not option.is_flag and not callable(default)
    default_text = f"`{getattr(default, 'value', default)}`" if shown else ""
    return f"{names} {_value(option)}".strip(), _help(option), default_text


def _value(option: Any) -> str:
    """What stands behind the name of an option; nothing behind that of a flag."""
    kind = _kind(option)
    if option.is_flag:
        return ""
    if option.metavar is None and isinstance(kind, type) and issubclass(kind, Enum):
        return ", ".join(f"`{choice.value}`" for choice in kind)
    return f"`{option.metavar or getattr(kind, '__name__', str(kind)).upper()}`"


def _kind(option: Any) -> Any:
    """The type of a value, that of one of several where an option is repeatable."""
    if hasattr(option, "type"):  # Typer before it had parameters of its own
        return option.type.name
    annotation = option.type_descriptor.annotation
    return next(iter(get_args(annotation)), annotation)
