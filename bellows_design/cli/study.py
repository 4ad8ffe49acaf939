"""The commands ``bellows study``: many evaluations that answer one question.

What a command does is in the module of its name in ``bellows_design.cli.studies``.
"""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from bellows_design.cli.answer import answer
from bellows_design.cli.layout import panels
from bellows_design.cli.layout.group import Commands
from bellows_design.cli.options import (
    Accuracy,
    AsJson,
    DesignName,
    DesignOptions,
    NoCache,
    Quiet,
    Settings,
)
from bellows_design.cli.studies.options import Scheduler, Workers


class Sample(StrEnum):
    """How a sweep chooses designs; ``bellows_design.study.sweep.sampling`` knows what they mean."""

    GRID = "grid"
    LATIN_HYPERCUBE = "lhs"
    RANDOM = "random"


study = typer.Typer(
    cls=Commands,
    help="Studies: many evaluations that answer one question.",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
)

Output = Annotated[
    Path | None,
    typer.Option(
        metavar="FILE", help="Also write everything as .json.", rich_help_panel=panels.FILES
    ),
]
Plot = Annotated[
    Path | None,
    typer.Option(
        metavar="FILE", help="Also draw it (.png); needs matplotlib.", rich_help_panel=panels.FILES
    ),
]


@study.command()
def paper(
    output: Output = None,
    plot: Plot = None,
    no_cache: NoCache = False,
    quiet: Quiet = False,
    as_json: AsJson = False,
) -> None:
    """Compute every design of the paper and compare."""
    from bellows_design.cli.studies.paper import paper as compare

    answer(lambda: compare(output, plot, not no_cache), as_json, quiet)


@study.command()
def sensitivity(
    name: DesignName,
    percent: Annotated[
        float,
        typer.Option("--range", metavar="PERCENT", help="Half width of the box around the design."),
    ] = 10.0,
    samples: Annotated[
        int | None, typer.Option(metavar="N", help="Designs of the box to evaluate; without it 20.")
    ] = None,
    wall: Annotated[
        float, typer.Option(metavar="MM", help="By how much walls may come out thicker or thinner.")
    ] = 0.05,
    modulus: Annotated[
        float,
        typer.Option(metavar="PERCENT", help="By how much constants of the material may be off."),
    ] = 10.0,
    seed: Annotated[int, typer.Option(metavar="N", help="Of the samples.")] = 0,
    no_sobol: Annotated[
        bool, typer.Option("--no-sobol", help="Leave the box and its Sobol indices out.")
    ] = False,
    settings: Settings = None,
    output: Output = None,
    plot: Plot = None,
    no_cache: NoCache = False,
    quiet: Quiet = False,
    as_json: AsJson = False,
) -> None:
    """How angle, stress and volume depend on every number, and within tolerances."""
    from bellows_design.cli.studies.sensitivity import sensitivity as examine

    options = DesignOptions(name, tuple(settings or ()))
    asked = (percent, samples, wall, modulus, seed, not no_sobol, output, plot, not no_cache)
    answer(lambda: examine(options, *asked), as_json, quiet)


@study.command()
def sweep(
    name: DesignName,
    vary: Annotated[
        list[str] | None,
        typer.Option(
            metavar="NAME=FROM:TO[:NUMBER]",
            help="A parameter and its range, with the number of values for a grid: "
            "bubble_width=16:20:5. Repeatable.",
        ),
    ] = None,
    file: Annotated[
        Path, typer.Option(help="Results, .sqlite; where it is there the sweep goes on.")
    ] = Path("sweep.sqlite"),
    sample: Annotated[
        Sample, typer.Option(help="grid, lhs (Latin hypercube) or random.")
    ] = Sample.GRID,
    number: Annotated[
        int | None, typer.Option("-n", "--number", help="Designs of a sample.")
    ] = None,
    seed: Annotated[int, typer.Option(help="Of a sample: the same number, the same designs.")] = 0,
    ordinary: Annotated[
        bool, typer.Option("--ordinary", help="Each design by itself, not from a neighbour.")
    ] = False,
    accuracy: Accuracy = None,
    workers: Workers = None,
    scheduler: Scheduler = None,
    retry_failed: Annotated[
        bool, typer.Option("--retry-failed", help="Ask again what failed.")
    ] = False,
    csv: Annotated[
        Path | None, typer.Option(metavar="FILE", help="Also write all results as .csv.")
    ] = None,
    parquet: Annotated[
        Path | None,
        typer.Option(metavar="FILE", help="Also write them as .parquet; needs pyarrow."),
    ] = None,
    settings: Settings = None,
    quiet: Quiet = False,
    as_json: AsJson = False,
) -> None:
    """Evaluate many designs around one: a grid or a sample."""
    from bellows_design.cli.studies.sweep import Files, SpaceOptions
    from bellows_design.cli.studies.sweep import sweep as look

    options = SpaceOptions(
        DesignOptions(name, tuple(settings or ())), tuple(vary or ()), sample.value, number, seed,
        ordinary, accuracy,
    )  # fmt: skip
    answer(
        lambda: look(options, Files(file, csv, parquet), workers, scheduler, retry_failed),
        as_json,
        quiet,
    )


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
    quiet: Quiet = False,
    as_json: AsJson = False,
) -> None:
    """Search for the indent that does what the paper's did, and for the one of least stress."""
    from bellows_design.cli.studies.indent import IndentOptions
    from bellows_design.cli.studies.indent import indent as search

    options = DesignOptions(name, tuple(settings or ()))
    how = IndentOptions(points, accuracy, not no_cache)
    answer(lambda: search(options, how, output, plot), as_json, quiet)
