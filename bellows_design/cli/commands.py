"""The command ``bellows``: its subcommands and their options.

Exit status: 0 done or approved; 1 refused, or a printability rule failed, and nothing else; 2 bad
input, or a file or stream that cannot be read or written; 3 the load was not reached, no mesh was
made, or the memory did not suffice; 4 an internal error; 130 interrupted, 143 terminated. Results
go to stdout, all else to stderr.
"""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from bellows_design.analysis.model_names import ModelName
from bellows_design.cli import actions
from bellows_design.cli.answer import Answer, answer
from bellows_design.cli.checking.options import (
    Checked,
    CheckOptions,
    FilamentName,
    KeepGcode,
    Openings,
    OrientationChoice,
    Picture,
    RequireSlicer,
    Slice,
    Up,
)
from bellows_design.cli.comparing.command import compare
from bellows_design.cli.exchange.command import mesh, plate
from bellows_design.cli.force.command import force
from bellows_design.cli.options import (
    AcceptPoorFit,
    Accuracy,
    Area,
    AsJson,
    Branch,
    BudgetOptions,
    Columns,
    Decimal,
    Derivatives,
    DesignName,
    DesignOptions,
    ElongationAtBreak,
    ExportFolder,
    FitData,
    FitModelName,
    GaugeLength,
    Keep,
    Memory,
    Meshes,
    MeshSeconds,
    NoCache,
    Pressure,
    Printer,
    Quick,
    Settings,
    Skip,
    TimeLimit,
    TrueStrain,
    TrueStress,
    Units,
    Vtu,
    VtuModel,
    WithSettings,
    YieldStrength,
)
from bellows_design.cli.studies.optimize_command import optimize
from bellows_design.cli.study import study
from bellows_design.cli.templates import Kind
from bellows_design.materials.laws import BEST

app = typer.Typer(
    name="bellows",
    help="From the twelve numbers of a soft bellows actuator to an approved, printable STL.",
    add_completion=False,
    no_args_is_help=True,
    pretty_exceptions_enable=False,
)
app.add_typer(study, name="study")
app.command()(optimize)
app.command()(force)
app.command()(compare)
app.command()(mesh)
app.command()(plate)


@app.callback(invoke_without_command=True)
def _root(
    context: typer.Context,
    version: Annotated[bool, typer.Option("--version", help="Print the version.")] = False,
) -> None:
    if version:
        from bellows_design import __version__

        typer.echo(f"bellows-design {__version__}")
        raise typer.Exit
    if context.invoked_subcommand is None:
        typer.echo(context.get_help())
        raise typer.Exit(2)


@app.command("list")
def list_designs(as_json: AsJson = False) -> None:
    """Name the shipped designs."""
    answer(actions.list_designs, as_json)


@app.command()
def init(
    kind: Annotated[
        Kind, typer.Argument(metavar="KIND", help="design, printer, material or body.")
    ],
    file: Annotated[Path, typer.Argument(metavar="FILE", help="File to write: .toml.")],
    force: Annotated[
        bool, typer.Option("--force", help="Replace the file if it is there.")
    ] = False,
    as_json: AsJson = False,
) -> None:
    """Write a commented design, printer, material or own body to start from."""
    answer(lambda: actions.init(kind, file, force), as_json)


@app.command()
def design(
    name: DesignName,
    output: Annotated[
        Path, typer.Option("-o", "--output", help="File to write: .stl, .3mf or .step.")
    ],
    settings: Settings = None,
    with_settings: WithSettings = False,
    as_json: AsJson = False,
) -> None:
    """Build the printed part and write it as STL, 3MF or STEP."""
    options = DesignOptions(name, tuple(settings or ()))
    answer(lambda: actions.design(options, output, with_settings), as_json)


@app.command()
def check(
    name: Checked,
    printer: Printer = None,
    filament: FilamentName = None,
    opening: Openings = None,
    up: Up = None,
    orientation: OrientationChoice = None,
    slice_it: Slice = False,
    require_slicer: RequireSlicer = False,
    picture: Picture = None,
    keep_gcode: KeepGcode = None,
    settings: Settings = None,
    as_json: AsJson = False,
) -> None:
    """Check a design, or a part of any program, against the rules of a printer."""
    from bellows_design.cli.checking.check import check as check_part

    options = CheckOptions(
        name, tuple(settings or ()), printer, filament, tuple(opening or ()), up, orientation,
        slice_it, require_slicer, picture, keep_gcode,
    )  # fmt: skip
    answer(lambda: check_part(options), as_json)


@app.command()
def evaluate(
    name: DesignName,
    model: Annotated[ModelName, typer.Option(help="auto: the smallest model that answers.")] = (
        ModelName.AUTO
    ),
    pressure: Pressure = None,
    accuracy: Accuracy = None,
    vtu: Vtu = None,
    vtu_model: VtuModel = None,
    sensitivities: Derivatives = False,
    settings: Settings = None,
    memory: Memory = None,
    mesh_seconds: MeshSeconds = None,
    seconds: TimeLimit = None,
    no_cache: NoCache = False,
    as_json: AsJson = False,
) -> None:
    """Compute bending angle and stress under pressure."""
    options = DesignOptions(name, tuple(settings or ()))
    limits = BudgetOptions(memory, mesh_seconds, seconds)
    pictured = actions.Pictured(vtu, vtu_model)
    asked = (options, model.value, pressure, accuracy, pictured, limits)
    answer(lambda: actions.evaluate(*asked, not no_cache, sensitivities), as_json)


@app.command()
def run(
    name: DesignName,
    output: Annotated[Path, typer.Option(help="Folder of the approved models.")] = Path("exports"),
    printer: Printer = None,
    settings: Settings = None,
    memory: Memory = None,
    mesh_seconds: MeshSeconds = None,
    seconds: TimeLimit = None,
    no_cache: NoCache = False,
    as_json: AsJson = False,
) -> None:
    """Design, check, evaluate, decide, and export what is approved."""
    options = DesignOptions(name, tuple(settings or ()), printer)
    limits = BudgetOptions(memory, mesh_seconds, seconds)
    answer(lambda: actions.run(options, output, limits, not no_cache), as_json)


@app.command()
def verify(
    folder: ExportFolder,
    quick: Quick = False,
    memory: Memory = None,
    mesh_seconds: MeshSeconds = None,
    seconds: TimeLimit = None,
    no_cache: NoCache = False,
    as_json: AsJson = False,
) -> None:
    """Check every file of an export, and whether it would be approved again."""
    limits = BudgetOptions(memory, mesh_seconds, seconds)
    answer(lambda: actions.verify(folder, quick, limits, not no_cache), as_json)


@app.command()
def benchmark(
    name: DesignName = "prototype_1",
    model: Annotated[
        list[ModelName] | None,
        typer.Option(help="Model to measure; repeatable. Without it the unit cell and the half."),
    ] = None,
    meshes: Meshes = None,
    output: Annotated[Path | None, typer.Option(help="Also write everything as .json.")] = None,
    plot: Annotated[
        Path | None, typer.Option(help="Also draw error over seconds (.png); needs matplotlib.")
    ] = None,
    settings: Settings = None,
    memory: Memory = None,
    mesh_seconds: MeshSeconds = None,
    as_json: AsJson = False,
) -> None:
    """Measure speed against error: models by meshes, against converged values."""
    options = DesignOptions(name, tuple(settings or ()))
    models, limits = [each.value for each in model or ()], BudgetOptions(memory, mesh_seconds)
    answer(lambda: actions.benchmark(options, models, meshes, output, plot, limits), as_json)


@app.command()
def cache(
    clear: Annotated[bool, typer.Option("--clear", help="Remove all of it.")] = False,
    as_json: AsJson = False,
) -> None:
    """Say what is kept of earlier evaluations, and where."""
    answer(lambda: actions.cache(clear), as_json)


@app.command()
def fit(
    data: FitData,
    model: FitModelName = BEST,
    output: Annotated[
        Path | None, typer.Option("-o", "--output", help="Also write a material as .toml.")
    ] = None,
    yield_strength: YieldStrength = None,
    elongation_at_break: ElongationAtBreak = None,
    accept_poor_fit: AcceptPoorFit = False,
    plot: Annotated[
        Path | None,
        typer.Option(help="Also draw data, fit and residuals (.png); needs matplotlib."),
    ] = None,
    columns: Columns = None,
    units: Units = None,
    skip: Skip = None,
    decimal: Decimal = None,
    branch: Branch = None,
    keep: Keep = None,
    true_stress: TrueStress = False,
    true_strain: TrueStrain = False,
    area: Area = None,
    gauge_length: GaugeLength = None,
    as_json: AsJson = False,
) -> None:
    """Fit a rubber's constants to measured nominal stress over strain."""
    from bellows_design.cli.fit import MaterialOptions
    from bellows_design.cli.fit import fit as fit_measurements
    from bellows_design.materials.measurements.options import ReadingOptions

    def work() -> Answer:
        reading = ReadingOptions(
            columns, units, skip, decimal, branch, tuple(keep or ()),
            true_stress, true_strain, area, gauge_length,
        )  # fmt: skip
        material = MaterialOptions(output, yield_strength, elongation_at_break, accept_poor_fit)
        return fit_measurements(data, model, material, plot, reading)

    answer(work, as_json)
