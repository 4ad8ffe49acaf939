"""The commands ``bellows mesh`` and ``bellows plate``, and their options."""

from __future__ import annotations

from enum import StrEnum
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
    Printer,
    Settings,
)


class Body(StrEnum):
    """A body that can be meshed."""

    HALF = "half"
    FULL = "full"
    UNIT_CELL = "unit-cell"


Output = Annotated[
    Path,
    typer.Option(
        "-o",
        "--output",
        help="File to write: .inp (Abaqus, CalculiX), .vtk (SOFA), .msh, .vtu or .xdmf.",
    ),
]
BodyName = Annotated[
    Body | None, typer.Option(help="Body to mesh; without it half, for SOFA the full one.")
]
ProgramName = Annotated[
    str | None,
    typer.Option("--for", metavar="PROGRAM", help="abaqus (without it), calculix or sofa."),
]
Size = Annotated[
    float | None,
    typer.Option(metavar="MM", help="Largest edge, mm; without it the coarsest that bears."),
]


def mesh(
    name: DesignName,
    output: Output,
    model: BodyName = None,
    program: ProgramName = None,
    size: Size = None,
    settings: Settings = None,
    memory: Memory = None,
    mesh_seconds: MeshSeconds = None,
    as_json: AsJson = False,
) -> None:
    """Write the mesh, or a deck, for Abaqus, CalculiX, SOFA and others."""
    from bellows_design.cli.exchange.mesh import mesh as write

    options = DesignOptions(name, tuple(settings or ()))
    body, limits = None if model is None else model.value, BudgetOptions(memory, mesh_seconds)
    answer(lambda: write(options, output, body, program, size, limits), as_json)


def plate(
    designs: Annotated[
        list[str],
        typer.Argument(metavar="DESIGN...", help="Designs; finger:3 for three of one."),
    ],
    output: Annotated[
        Path, typer.Option("-o", "--output", help="File to write: .3mf, .step or .stl.")
    ],
    spacing: Annotated[
        float, typer.Option(metavar="MM", help="Least distance between two parts, mm.")
    ] = 5.0,
    printer: Printer = None,
    as_json: AsJson = False,
) -> None:
    """Put several actuators on one printer's bed, in one file."""
    from bellows_design.cli.exchange.plate import plate as arrange

    answer(lambda: arrange(designs, output, spacing, printer), as_json)
