"""The commands ``bellows study``: many evaluations that answer one question.

What a command does is in the module of its name in ``bellows_design.cli.studies``.
"""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from bellows_design.cli.answer import answer
from bellows_design.cli.options import AsJson, DesignName, DesignOptions, NoCache, Settings

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
    as_json: AsJson = False,
) -> None:
    """How angle, stress and volume depend on every number, and within tolerances."""
    from bellows_design.cli.studies.sensitivity import sensitivity as examine

    options = DesignOptions(name, tuple(settings or ()))
    asked = (percent, samples, wall, modulus, seed, not no_sobol, output, plot, not no_cache)
    answer(lambda: examine(options, *asked), as_json)
