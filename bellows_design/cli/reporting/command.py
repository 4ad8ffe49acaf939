"""The command ``bellows report`` and its options."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from bellows_design.cli.answer import answer
from bellows_design.cli.options import (
    AsJson,
    BudgetOptions,
    DesignName,
    DesignOptions,
    Memory,
    MeshSeconds,
    NoCache,
    Printer,
    Settings,
    TimeLimit,
)

Output = Annotated[
    Path | None,
    typer.Option("-o", "--output", help="File to write: .html; without it NAME_report.html."),
]
Png = Annotated[
    Path | None,
    typer.Option(help="Also one picture of it all (.png); needs the extra pictures."),
]
Pdf = Annotated[
    Path | None,
    typer.Option(help="Also the same as pages (.pdf); needs the extra pictures."),
]
SceneNames = Annotated[
    list[str] | None,
    typer.Option(
        "--scene",
        metavar="SCENE",
        help="Also the force in a scene of the design, free, blocked, or of a TOML file. "
        "Repeatable.",
    ),
]
NoSensitivities = Annotated[
    bool, typer.Option("--no-sensitivities", help="Leave out what a change of each number does.")
]


def report(
    name: DesignName,
    output: Output = None,
    png: Png = None,
    pdf: Pdf = None,
    scene: SceneNames = None,
    no_sensitivities: NoSensitivities = False,
    printer: Printer = None,
    settings: Settings = None,
    memory: Memory = None,
    mesh_seconds: MeshSeconds = None,
    seconds: TimeLimit = None,
    no_cache: NoCache = False,
    as_json: AsJson = False,
) -> None:
    """Show all that is found out about a design as one HTML page."""
    from bellows_design.cli.reporting.report import ReportOptions, report_answer

    options = ReportOptions(
        DesignOptions(name, tuple(settings or ()), printer), output, png, pdf,
        tuple(scene or ()), not no_sensitivities, BudgetOptions(memory, mesh_seconds, seconds),
        not no_cache,
    )  # fmt: skip
    answer(lambda: report_answer(options), as_json)
