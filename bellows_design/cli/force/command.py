"""The command ``bellows force`` and its options."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from bellows_design.cli.answer import answer
from bellows_design.cli.completion.options import complete_scene
from bellows_design.cli.layout import panels
from bellows_design.cli.options import (
    AsJson,
    BudgetOptions,
    DesignName,
    DesignOptions,
    Memory,
    MeshSeconds,
    NoCache,
    Pressure,
    Quiet,
    Settings,
    TimeLimit,
)

SceneName = Annotated[
    str,
    typer.Option(
        "--scene",
        metavar="SCENE",
        autocompletion=complete_scene,
        help="A scene of the design, free, blocked, or a TOML file that holds one.",
    ),
]
ByDistance = Annotated[
    bool,
    typer.Option(
        "--by-distance",
        help="Also print the force while the support moves away.",
    ),
]
Flow = Annotated[
    float | None,
    typer.Option(
        metavar="LITRES",
        help="Constant flow of free air through the valve, a minute; without it 10.",
    ),
]
Picture = Annotated[
    Path | None,
    typer.Option(
        metavar="FILE",
        help="Also draw the finger's shapes (.png); needs matplotlib.",
        rich_help_panel=panels.FILES,
    ),
]
Plot = Annotated[
    Path | None,
    typer.Option(
        metavar="FILE",
        help="Also draw force over pressure and distance (.png); needs matplotlib.",
        rich_help_panel=panels.FILES,
    ),
]


def force(
    name: DesignName,
    scene: SceneName = "blocked",
    pressure: Pressure = None,
    by_distance: ByDistance = False,
    flow: Flow = None,
    picture: Picture = None,
    plot: Plot = None,
    settings: Settings = None,
    memory: Memory = None,
    mesh_seconds: MeshSeconds = None,
    seconds: TimeLimit = None,
    no_cache: NoCache = False,
    quiet: Quiet = False,
    as_json: AsJson = False,
) -> None:
    """Compute what the actuator exerts in a scene: blocked, carrying, gripping."""
    from bellows_design.cli.force.force import ForceOptions, force_answer

    options = ForceOptions(
        DesignOptions(name, tuple(settings or ())), scene, pressure, by_distance, flow, picture,
        plot, BudgetOptions(memory, mesh_seconds, seconds), not no_cache,
    )  # fmt: skip
    answer(lambda: force_answer(options), as_json, quiet)
