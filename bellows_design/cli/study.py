"""The commands ``bellows study``: many evaluations that answer one question.

What a command does is in the module of its name in ``bellows_design.cli.studies``.
"""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from bellows_design.cli.answer import answer
from bellows_design.cli.options import (
    Accuracy,
    AsJson,
    DesignName,
    DesignOptions,
    NoCache,
    Settings,
)

study = typer.Typer(
    help="Studies: many evaluations that answer one question.",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
)

Output = Annotated[Path | None, typer.Option(help="Also write everything as .json.")]
Plot = Annotated[Path | None, typer.Option(help="Also draw it (.png); needs matplotlib.")]


@study.command()
def paper(
    output: Output = None, plot: Plot = None, no_cache: NoCache = False, as_json: AsJson = False
) -> None:
    """Compute every design of the paper and compare."""
    from bellows_design.cli.studies.paper import paper as compare

    answer(lambda: compare(output, plot, not no_cache), as_json)


@study.command()
def indent(
    name: DesignName = "prototype_2",
    points: Annotated[
        int, typer.Option(metavar="N", help="Indents of each kind that are spread over its room.")
    ] = 4,
    accuracy: Accuracy = None,
    settings: Settings = None,
    output: Output = None,
    plot: Plot = None,
    no_cache: NoCache = False,
    as_json: AsJson = False,
) -> None:
    """Search for the indent that does what the paper's did, and for the one of least stress."""
    from bellows_design.cli.studies.indent import IndentOptions
    from bellows_design.cli.studies.indent import indent as search

    options = DesignOptions(name, tuple(settings or ()))
    how = IndentOptions(points, accuracy, not no_cache)
    answer(lambda: search(options, how, output, plot), as_json)
