"""The commands ``bellows list``, ``init`` and ``schema``, and their options."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from bellows_design.cli.answer import answer
from bellows_design.cli.completion.options import complete_schema, complete_source
from bellows_design.cli.options import AsJson
from bellows_design.cli.starting.kinds import Kind, Listed


def list_known(
    what: Annotated[
        Listed,
        typer.Argument(
            metavar="WHAT", help="designs, materials, printers, filaments, scenes, keys or all."
        ),
    ] = Listed.DESIGNS,
    as_json: AsJson = False,
) -> None:
    """Name what ships: designs, materials, printers, filaments, scenes."""
    from bellows_design.cli.starting.listing import list_known

    answer(lambda: list_known(what), as_json)


def init(
    kind: Annotated[
        Kind,
        typer.Argument(metavar="KIND", help="design, scene, printer, filament, material or body."),
    ],
    file: Annotated[Path, typer.Argument(metavar="FILE", help="File to write: .toml.")],
    source: Annotated[
        str | None,
        typer.Option(
            "--from",
            metavar="NAME",
            help="Begin with the values of that design, printer …: a name, or a TOML file.",
            autocompletion=complete_source,
        ),
    ] = None,
    force: Annotated[
        bool, typer.Option("--force", help="Replace the file if it is there.")
    ] = False,
    as_json: AsJson = False,
) -> None:
    """Write a commented design, printer, material … to start from."""
    from bellows_design.cli.starting.init import init as write

    answer(lambda: write(kind, file, force, source), as_json)


def schema(
    command: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="COMMAND",
            help="A command, error, or a file of an export: manifest.json.",
            autocompletion=complete_schema,
        ),
    ] = None,
) -> None:
    """Print the JSON Schema of what a command answers with --json; without one name them all."""
    from bellows_design.cli.starting.schemas import schema as show

    answer(lambda: show(command or ()), bool(command))
