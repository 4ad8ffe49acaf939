"""Where text is printed, how wide, and whether in colours.

On a terminal lines are as wide as that. Elsewhere (a pipe, a file) they are as long as they are and
have no colours: whatever reads them wraps them. ``COLUMNS`` sets the width of both.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, TextIO

if TYPE_CHECKING:
    from rich.console import Console, RenderableType

ENDLESS = 1_000_000
"""Columns of what is no terminal."""


def print_for_people(lines: Sequence[RenderableType], stream: TextIO | None = None) -> None:
    """Print texts and tables, none of them wider than the terminal."""
    from bellows_design.cli.terminal.fitting import fitted

    console = console_on(sys.stdout if stream is None else stream)
    for line in lines:
        for each in fitted(line, console):
            console.print(each, soft_wrap=console.width == ENDLESS)


def console_on(stream: TextIO, environment: Mapping[str, str] | None = None) -> Console:
    """A console for the stream, as the terminal and the environment ask for it."""
    from rich.console import Console

    _tolerate_any_terminal(stream)
    known = os.environ if environment is None else environment
    columns, coloured = known.get("COLUMNS", ""), wants_colours(known)
    width = int(columns) if columns.isascii() and columns.isdigit() else None
    return Console(
        file=stream,
        highlight=False,
        markup=False,
        width=width or (None if stream.isatty() else ENDLESS),
        force_terminal=coloured,
        color_system=None if coloured is False else "auto",
    )


def wants_colours(environment: Mapping[str, str]) -> bool | None:
    """True or False as variables of the environment ask for; None: where there is a terminal.

    ``NO_COLOR`` wins over ``FORCE_COLOR`` and ``CLICOLOR_FORCE``, whose value 0 says nothing.
    """
    if environment.get("NO_COLOR"):
        return False
    forced = (environment.get(name, "") for name in ("FORCE_COLOR", "CLICOLOR_FORCE"))
    if any(value not in ("", "0") for value in forced):
        return True
    return False if environment.get("CLICOLOR") == "0" else None


def _tolerate_any_terminal(stream: TextIO) -> None:
    """Where the terminal's encoding lacks a character (° µ Ć), print ? rather than fail."""
    reconfigure = getattr(stream, "reconfigure", None)
    if reconfigure is not None:
        reconfigure(errors="replace")
