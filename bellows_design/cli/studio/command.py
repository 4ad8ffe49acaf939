"""The command ``bellows studio`` and its options."""

from __future__ import annotations

import signal
from pathlib import Path
from typing import Annotated

import typer

from bellows_design.cli.answer import Answer, answer
from bellows_design.cli.interruption import Interrupted
from bellows_design.cli.options import DesignName, DesignOptions, Settings

Port = Annotated[
    int, typer.Option(metavar="N", help="Port of this machine; 0 for any that is free.")
]
NoBrowser = Annotated[
    bool, typer.Option("--no-browser", help="Print the address only; open no browser.")
]
Output = Annotated[Path, typer.Option(help="Folder of the approved models.")]


def studio(
    name: DesignName = "prototype_1",
    port: Port = 0,
    no_browser: NoBrowser = False,
    output: Output = Path("exports"),
    settings: Settings = None,
) -> None:
    """Open a page on this machine: move sliders, see shape, angle and stress."""
    options = DesignOptions(name, tuple(settings or ()))
    answer(lambda: served(options, port, not no_browser, output), as_json=False)


def served(options: DesignOptions, port: int, browser: bool, output: Path) -> Answer:
    """Serve the page until it is ended, by Ctrl-C or by the page."""
    from bellows_design.cli.surroundings.environment import require_working_folder
    from bellows_design.cli.surroundings.memory import EVALUATION, require_address_space

    require_working_folder()
    require_address_space(EVALUATION)
    design = options.load()
    design.profile()
    from bellows_design.studio.serving.running import Options, serve

    try:
        serve(Options(design, port, browser=browser, output=output), _tell)
    except Interrupted as interruption:
        if interruption.number != signal.SIGINT:  # Ctrl-C is how it is meant to end
            raise
    return Answer({}, ["The studio has ended."])


def _tell(address: str) -> None:
    typer.echo(f"bellows studio: {address}", err=True)
    typer.echo("Only this machine can open it. Ctrl-C ends it.", err=True)
