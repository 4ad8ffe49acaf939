"""The command ``bellows compare`` and its options."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from bellows_design.cli.answer import Answer, answer
from bellows_design.cli.completion.options import complete_scene
from bellows_design.cli.layout import panels
from bellows_design.cli.options import (
    AsJson,
    BudgetOptions,
    Decimal,
    DesignName,
    DesignOptions,
    Memory,
    MeshSeconds,
    NoCache,
    Quiet,
    Settings,
    Skip,
    TimeLimit,
)


class Angle(StrEnum):
    """How a bending angle is defined."""

    TANGENT = "tangent"
    CHORD = "chord"


class QuantityName(StrEnum):
    """What is compared where a file has several quantities."""

    ANGLE = "angle"
    DISPLACEMENT = "displacement"
    X = "displacement_x"
    Z = "displacement_z"
    FORCE = "force"


class BranchName(StrEnum):
    """Which way of a test that goes to and fro."""

    LOADING = "loading"
    UNLOADING = "unloading"
    ALL = "all"


Data = Annotated[
    Path,
    typer.Argument(
        metavar="FILE",
        help="Angle, displacement of the tip or force over pressure: CSV and the like, or .xlsx. "
        "Columns are known by their names.",
    ),
]
AngleOption = Annotated[
    Angle,
    typer.Option(help="tangent: rotation of the tip; chord: of the line from base to tip."),
]
ZeroAt = Annotated[
    float | None,
    typer.Option(metavar="MPA", help="Pressure from whose values both curves are counted."),
]
QuantityOption = Annotated[
    QuantityName | None, typer.Option("--quantity", help="Which column, where there are several.")
]
SceneName = Annotated[
    str | None,
    typer.Option(
        "--scene",
        metavar="SCENE",
        autocompletion=complete_scene,
        help="Of a force: a scene of the design, or a TOML file that holds one; without it the "
        "tip presses on a load cell at its rest height.",
    ),
]
PartName = Annotated[
    str | None,
    typer.Option(
        "--part",
        metavar="NAME",
        help="Of an own body: the part whose stiffness is in question; without it all.",
    ),
]
ColumnNames = Annotated[
    str | None,
    typer.Option(
        "--columns",
        metavar="NAMES",
        help="Names of the columns instead of the header's: pressure_kpa,angle_deg, with - for one "
        "to leave out; or by number: pressure_kpa=2,angle_deg=4.",
        rich_help_panel=panels.READING,
    ),
]
UnitNames = Annotated[
    str | None,
    typer.Option(
        "--units",
        metavar="UNITS",
        help="Units instead of the header's: pressure=kPa (MPa, bar, psi …), angle=deg (rad), "
        "displacement=mm, force=N.",
        rich_help_panel=panels.READING,
    ),
]
BranchOption = Annotated[
    BranchName,
    typer.Option(
        "--branch",
        help="Of a test that goes to and fro: loading, unloading or all.",
        rich_help_panel=panels.READING,
    ),
]
Fit = Annotated[
    bool, typer.Option("--fit/--no-fit", help="Whether a factor on the stiffness is fitted.")
]
FitOffset = Annotated[
    bool, typer.Option("--fit-offset", help="Also fit a constant that all values have in common.")
]
Uncertainty = Annotated[
    float | None,
    typer.Option(
        "--material-uncertainty",
        metavar="PERCENT",
        help="By how much the material's stiffness may be off, instead of what the material says.",
    ),
]
WriteMaterial = Annotated[
    Path | None,
    typer.Option(
        "--write-material",
        metavar="FILE",
        help="Also write the material with the factor (.toml).",
        rich_help_panel=panels.FILES,
    ),
]
Plot = Annotated[
    Path | None,
    typer.Option(
        metavar="FILE",
        help="Also draw both curves, bands and residuals (.png); needs matplotlib.",
        rich_help_panel=panels.FILES,
    ),
]


def compare(
    name: DesignName,
    data: Data,
    angle: AngleOption = Angle.TANGENT,
    zero_at: ZeroAt = None,
    quantity: QuantityOption = None,
    scene: SceneName = None,
    part: PartName = None,
    columns: ColumnNames = None,
    units: UnitNames = None,
    skip: Skip = None,
    decimal: Decimal = None,
    branch: BranchOption = BranchName.LOADING,
    fit: Fit = True,
    fit_offset: FitOffset = False,
    material_uncertainty: Uncertainty = None,
    write_material: WriteMaterial = None,
    plot: Plot = None,
    settings: Settings = None,
    memory: Memory = None,
    mesh_seconds: MeshSeconds = None,
    seconds: TimeLimit = None,
    no_cache: NoCache = False,
    quiet: Quiet = False,
    as_json: AsJson = False,
) -> None:
    """Hold a measurement against the model: how stiff is the print?"""

    def work() -> Answer:
        from bellows_design.cli.comparing.compare import ComparingOptions, compare_answer
        from bellows_design.materials.measurements.options import ReadingOptions
        from bellows_design.measured.comparison import CompareOptions
        from bellows_design.measured.reading.load import CurveOptions

        reading = CurveOptions(
            None if quantity is None else quantity.value,
            branch.value,
            ReadingOptions(columns, units, skip, decimal),
        )
        compared = CompareOptions(zero_at, fit, fit_offset, material_uncertainty)
        options = ComparingOptions(
            DesignOptions(name, tuple(settings or ())), data, reading, compared, angle.value, scene,
            part, write_material, plot, BudgetOptions(memory, mesh_seconds, seconds), not no_cache,
        )  # fmt: skip
        return compare_answer(options)

    answer(work, as_json, quiet)
