"""Options that several studies share."""

from __future__ import annotations

from typing import Annotated

import typer

from bellows_design.cli.layout import panels

Workers = Annotated[
    int | None,
    typer.Option(
        metavar="N",
        help="Processes of this machine; without it one for each processor; 0: this one only.",
        rich_help_panel=panels.LIMITS,
    ),
]
Scheduler = Annotated[
    str | None,
    typer.Option(
        metavar="ADDRESS",
        help="The workers of this dask scheduler instead, tcp://host:8786. Only one that you "
        "trust: whoever reaches it can run programs on it and here.",
        rich_help_panel=panels.LIMITS,
    ),
]
