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
from bellows_design.cli.checking.command import check
from bellows_design.cli.comparing.command import compare
from bellows_design.cli.exchange.command import mesh, plate
from bellows_design.cli.force.command import force
from bellows_design.cli.layout import panels
from bellows_design.cli.layout.group import Commands
from bellows_design.cli.layout.panels import examples
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
    NoReport,
    Pressure,
    Printer,
    Quick,
    Quiet,
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
from bellows_design.cli.reporting.command import report
from bellows_design.cli.starting.command import init, list_known, schema
from bellows_design.cli.studies.optimize_command import optimize
from bellows_design.cli.studio.command import studio
from bellows_design.cli.study import study
from bellows_design.materials.laws import BEST

app = typer.Typer(
    name="bellows",
    cls=Commands,
    help="From the twelve numbers of a soft bellows actuator to an approved, printable STL.",
    epilog=examples(
        "bellows list",
        "bellows init design my_finger.toml",
        "bellows run my_finger.toml",
        "bellows evaluate finger --set bubble_thickness=1.2 --pressure 0.02:0.1:0.02",
    ),
    no_args_is_help=True,
    pretty_exceptions_enable=False,
)
app.command(
    "list",
    rich_help_panel=panels.START,
    epilog=examples("bellows list", "bellows list materials", "bellows list keys"),
)(list_known)
app.command(
    rich_help_panel=panels.START,
    epilog=examples(
        "bellows init design my_finger.toml",
        "bellows init design my_finger.toml --from prototype_2",
        "bellows init printer my_printer.toml --from prusa_mk4",
    ),
)(init)
app.command(
    rich_help_panel=panels.PRINT,
    epilog=examples(
        "bellows check my_finger.toml --printer bambu_a1",
        "bellows check gripper.step --orientation auto",
        "bellows check gripper.stl --opening 0,12.5,8 --slice --picture leak.png",
    ),
)(check)
app.command(
    rich_help_panel=panels.HOUSEKEEPING,
    epilog=examples("bellows schema", "bellows schema evaluate", "bellows schema study sweep"),
)(schema)
app.add_typer(study, name="study", rich_help_panel=panels.STUDY)
app.command(
    rich_help_panel=panels.STUDY,
    epilog=examples(
        "bellows optimize finger --minutes 30",
        "bellows optimize finger --goal stress --angle 200 --bubbles 8-10 -o soft_finger",
    ),
)(optimize)
app.command(
    rich_help_panel=panels.COMPUTE,
    epilog=examples(
        "bellows force finger",
        "bellows force finger --scene free --pressure 0.02:0.1:0.02",
        "bellows force finger --by-distance --plot force.png",
    ),
)(force)
app.command(
    rich_help_panel=panels.COMPUTE,
    epilog=examples(
        "bellows compare finger print.csv --plot print.png",
        "bellows compare finger print.csv --write-material my_print.toml",
    ),
)(compare)
app.command(
    rich_help_panel=panels.SHARE,
    epilog=examples(
        "bellows report finger",
        "bellows report finger --scene blocked --png finger.png",
    ),
)(report)
app.command(
    rich_help_panel=panels.SHARE,
    epilog=examples(
        "bellows studio finger",
        "bellows studio my_finger.toml --output models",
    ),
)(studio)
app.command(
    rich_help_panel=panels.TOOLS,
    epilog=examples(
        "bellows mesh finger -o finger.inp",
        "bellows mesh finger -o finger.vtk --for sofa",
    ),
)(mesh)
app.command(
    rich_help_panel=panels.PRINT,
    epilog=examples(
        "bellows plate finger:3 -o plate.3mf",
        "bellows plate finger my_finger.toml -o plate.step --spacing 8",
    ),
)(plate)


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


@app.command(
    rich_help_panel=panels.PRINT,
    epilog=examples(
        "bellows design finger -o finger.stl",
        "bellows design finger -o finger.3mf --with-settings",
        "bellows design my_finger.toml -o finger.step --set bubble_width=18",
    ),
)
def design(
    name: DesignName,
    output: Annotated[
        Path, typer.Option("-o", "--output", help="File to write: .stl, .3mf or .step.")
    ],
    settings: Settings = None,
    with_settings: WithSettings = False,
    quiet: Quiet = False,
    as_json: AsJson = False,
) -> None:
    """Build the printed part and write it as STL, 3MF or STEP."""
    options = DesignOptions(name, tuple(settings or ()))
    answer(lambda: actions.design(options, output, with_settings), as_json, quiet)


@app.command(
    rich_help_panel=panels.COMPUTE,
    epilog=examples(
        "bellows evaluate finger",
        "bellows evaluate finger --pressure 0.02:0.1:0.02 --vtu bent.vtu",
        "bellows evaluate finger --set bubble_thickness=1.2 --sensitivities",
    ),
)
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
    quiet: Quiet = False,
    as_json: AsJson = False,
) -> None:
    """Compute bending angle and stress under pressure."""
    options = DesignOptions(name, tuple(settings or ()))
    limits = BudgetOptions(memory, mesh_seconds, seconds)
    pictured = actions.Pictured(vtu, vtu_model)
    asked = (options, model.value, pressure, accuracy, pictured, limits)
    answer(lambda: actions.evaluate(*asked, not no_cache, sensitivities), as_json, quiet)


@app.command(
    rich_help_panel=panels.PRINT,
    epilog=examples(
        "bellows run finger",
        "bellows run my_finger.toml --printer my_printer.toml --output parts",
    ),
)
def run(
    name: DesignName,
    output: Annotated[Path, typer.Option(help="Folder of the approved models.")] = Path("exports"),
    printer: Printer = None,
    settings: Settings = None,
    memory: Memory = None,
    mesh_seconds: MeshSeconds = None,
    seconds: TimeLimit = None,
    no_report: NoReport = False,
    no_cache: NoCache = False,
    quiet: Quiet = False,
    as_json: AsJson = False,
) -> None:
    """Design, check, evaluate, decide, and export what is approved."""
    options = DesignOptions(name, tuple(settings or ()), printer)
    limits = BudgetOptions(memory, mesh_seconds, seconds)
    asked = (options, output, limits, not no_cache, not no_report)
    answer(lambda: actions.run(*asked), as_json, quiet)


@app.command(
    rich_help_panel=panels.PRINT,
    epilog=examples(
        "bellows verify exports/finger",
        "bellows verify exports/finger --quick",
    ),
)
def verify(
    folder: ExportFolder,
    quick: Quick = False,
    memory: Memory = None,
    mesh_seconds: MeshSeconds = None,
    seconds: TimeLimit = None,
    no_cache: NoCache = False,
    quiet: Quiet = False,
    as_json: AsJson = False,
) -> None:
    """Check every file of an export, and whether it would be approved again."""
    limits = BudgetOptions(memory, mesh_seconds, seconds)
    answer(lambda: actions.verify(folder, quick, limits, not no_cache), as_json, quiet)


@app.command(
    rich_help_panel=panels.STUDY,
    epilog=examples(
        "bellows benchmark prototype_1 --plot speed.png",
    ),
)
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
    quiet: Quiet = False,
    as_json: AsJson = False,
) -> None:
    """Measure speed against error: models by meshes, against converged values."""
    options = DesignOptions(name, tuple(settings or ()))
    models, limits = [each.value for each in model or ()], BudgetOptions(memory, mesh_seconds)
    answer(lambda: actions.benchmark(options, models, meshes, output, plot, limits), as_json, quiet)


@app.command(
    rich_help_panel=panels.HOUSEKEEPING, epilog=examples("bellows doctor", "bellows doctor --json")
)
def doctor(as_json: AsJson = False) -> None:
    """Say what is installed and works here, and how to mend what does not."""
    from bellows_design.cli.doctor.answer import doctor as examine

    answer(examine, as_json)


@app.command(
    rich_help_panel=panels.HOUSEKEEPING,
    epilog=examples(
        "bellows cache",
        "bellows cache --clear",
    ),
)
def cache(
    clear: Annotated[bool, typer.Option("--clear", help="Remove all of it.")] = False,
    as_json: AsJson = False,
) -> None:
    """Say what is kept of earlier evaluations, and where."""
    answer(lambda: actions.cache(clear), as_json)


@app.command(
    rich_help_panel=panels.COMPUTE,
    epilog=examples(
        "bellows fit tensile.csv --plot fit.png",
        "bellows fit a.csv b.csv -o my_rubber.toml --yield-strength 4",
    ),
)
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
