"""The group of commands: panels in the order of the tasks, and one sentence for a mistake of usage.

Of the library below it uses only what its versions have in common: a mistake is an exception with
``format_message`` and ``exit_code``.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from functools import partial
from typing import Any

from typer.core import TyperGroup

from bellows_design.cli.layout.asked import remember
from bellows_design.cli.layout.mistakes import sentence_on
from bellows_design.cli.layout.panels import ORDER_OF_USE, PANELS
from bellows_design.cli.layout.said import print_error

ABORTED = 130


class Commands(TyperGroup):
    """A group whose mistakes are sentences, and whose help shows commands by task."""

    def __init__(self, **settings: Any) -> None:
        super().__init__(**settings)
        for command in (self, *self.commands.values()):
            _show_plainly(command.params)

    def list_commands(self, ctx: Any) -> list[str]:
        """Names by panel; within a panel in the order of use."""
        panels = {panel: number for number, panel in enumerate(PANELS)}
        places = {name: number for number, name in enumerate(ORDER_OF_USE)}

        def place(name: str) -> tuple[int, int]:
            panel = getattr(self.commands[name], "rich_help_panel", "")
            return panels.get(panel, -1), places.get(name, len(places))

        return sorted(super().list_commands(ctx), key=place)

    def get_params(self, ctx: Any) -> list[Any]:
        """The parameters with ``--help``, which is a flag like others."""
        found = list(super().get_params(ctx))
        _show_plainly(found)
        return found

    def resolve_command(self, ctx: Any, args: list[str]) -> Any:
        """The command that ``args`` begin with, which is remembered."""
        self.suggest_commands = False  # our sentence does
        found = super().resolve_command(ctx, args)
        if found[1] is not None:
            _show_plainly(found[1].get_params(ctx))
        above = "" if ctx.parent is None else f"{ctx.info_name} "
        remember(f"{above}{found[0]}")
        return found

    def main(self, *positional: Any, **settings: Any) -> Any:
        """Run the command and end with its status; a mistake of usage is one sentence."""
        args = positional[0] if positional else settings.pop("args", None)
        standalone = settings.pop("standalone_mode", True)
        given = list(sys.argv[1:] if args is None else args)
        remember("")
        try:
            status = super().main(args=given, standalone_mode=False, **settings)
        except Exception as error:
            status = self._mistaken(error, given)
            if status is None:
                raise
        if not standalone:
            return status
        sys.exit(status if isinstance(status, int) else 0)

    def _mistaken(self, error: Exception, given: Sequence[str]) -> int | None:
        """The status after a sentence on the mistake; None if ``error`` is none of usage."""
        if type(error).__name__ == "Abort":
            return ABORTED
        if not hasattr(error, "format_message"):
            return None
        status = int(getattr(error, "exit_code", 2))
        if type(error).__name__ == "NoArgsIsHelpError":
            print(error.format_message(), file=sys.stderr)
            return status
        print_error(sentence_on(error, given), status, "--json" in given)
        return status


def _show_plainly(parameters: Sequence[Any]) -> None:
    """Flags have no values; of an argument its name says what it is, and its type nothing more."""
    for parameter in parameters:
        if getattr(parameter, "is_flag", False) and parameter.metavar is None:
            parameter.metavar = ""
        if parameter.param_type_name == "argument":
            parameter.display_type_rich = lambda ctx: ""
            parameter.get_usage_pieces = partial(_in_usage, parameter)


def _in_usage(argument: Any, ctx: Any) -> list[str]:
    """The argument as the usage has it: in brackets if it may be left out, never in braces."""
    name = str(argument.metavar or argument.name.upper()).removesuffix("...")
    name = name if argument.required else f"[{name}]"
    return [f"{name}{'...' * (argument.nargs != 1)}"]
