"""The command ``bellows optimize`` and its options."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from bellows_design.cli.answer import answer
from bellows_design.cli.options import AsJson, DesignName, DesignOptions, Quiet, Settings
from bellows_design.cli.studies.options import Scheduler, Workers


class Sought(StrEnum):
    """What is made as large or as small as possible; ``goal.Quantity`` of the study."""

    ANGLE = "angle"
    STRESS = "stress"
    VOLUME = "volume"
    MATERIAL = "material"


def optimize(
    name: DesignName,
    quantity: Annotated[
        Sought,
        typer.Option(
            "--goal",
            help="The largest angle; or, at an --angle, the least stress, volume of air or "
            "material.",
        ),
    ] = Sought.ANGLE,
    angle: Annotated[
        float | None, typer.Option(metavar="DEGREES", help="Least bending angle.")
    ] = None,
    stress: Annotated[
        float | None,
        typer.Option(
            metavar="MPA",
            help="Highest stress including its error; without it the design's own limit.",
        ),
    ] = None,
    strain: Annotated[
        float | None,
        typer.Option(metavar="PERCENT", help="Largest principal strain, for fatigue."),
    ] = None,
    least_force: Annotated[
        float | None,
        typer.Option(
            metavar="N",
            help="Least blocked force at the design pressure, less its error; known to the "
            "verification alone.",
        ),
    ] = None,
    touching: Annotated[
        bool, typer.Option("--touching", help="Neighbouring bubbles may touch under pressure.")
    ] = False,
    lines: Annotated[
        str | None,
        typer.Option(metavar="COUNTS", help="Lines of the walls, such as 3,4 or 3-5."),
    ] = None,
    bubbles: Annotated[
        str | None, typer.Option(metavar="COUNTS", help="Numbers of bubbles, such as 8-10.")
    ] = None,
    indents: Annotated[
        bool, typer.Option("--indents/--no-indents", help="Try a groove under every chamber.")
    ] = True,
    gap: Annotated[
        float | None,
        typer.Option(metavar="MM", help="Least bubble distance; without it the printer's."),
    ] = None,
    passage: Annotated[
        float | None,
        typer.Option(
            metavar="MM", help="Least width and height of the air channel; without it two lines."
        ),
    ] = None,
    output: Annotated[
        Path, typer.Option("-o", "--output", help="Folder of results and designs.")
    ] = Path("optimum"),
    minutes: Annotated[float, typer.Option(help="Time for all of it.")] = 15.0,
    seed: Annotated[int, typer.Option(help="Of the global stage.")] = 0,
    verify: Annotated[
        bool, typer.Option("--verify/--no-verify", help="Verify the best on finer meshes.")
    ] = True,
    half: Annotated[
        bool, typer.Option("--half/--no-half", help="Also by the half actuator.")
    ] = True,
    workers: Workers = None,
    scheduler: Scheduler = None,
    plot: Annotated[
        Path | None, typer.Option(help="Also draw the front (.png); needs matplotlib.")
    ] = None,
    settings: Settings = None,
    quiet: Quiet = False,
    as_json: AsJson = False,
) -> None:
    """Find the best design: whole lines, printable, within its limits.

    An interrupted run goes on from what it has, with the same command.
    """
    from bellows_design.cli.studies.optimize import CountOptions, GoalOptions, OptimumFiles
    from bellows_design.cli.studies.optimize import optimize as search

    options = DesignOptions(name, tuple(settings or ()))
    sought = GoalOptions(quantity.value, angle, stress, strain, touching, least_force)
    counted = CountOptions(lines, bubbles, indents, gap, passage)
    files = OptimumFiles(output, plot)
    answer(
        lambda: search(
            options, sought, counted, files, minutes, seed, verify, half, workers, scheduler
        ),
        as_json,
        quiet,
    )
