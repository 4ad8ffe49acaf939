"""The command ``bellows``: parse, call, print.

Exit status: 0 done or approved; 1 refused, or a printability rule failed; 2 bad input; 3 the
solver could not reach the load; 4 an internal error; 130 interrupted, 143 terminated. Results go
to stdout, all else to stderr. Heavy imports wait until a command needs them.
"""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from bellows_design.cli.answer import Answer, answer

if TYPE_CHECKING:
    from bellows_design.analysis.budget import Budget
    from bellows_design.design.design import Design

app = typer.Typer(
    name="bellows",
    help="From the twelve numbers of a soft bellows actuator to an approved, printable STL.",
    add_completion=False,
    no_args_is_help=True,
    pretty_exceptions_enable=False,
)

DesignName = Annotated[
    str,
    typer.Argument(metavar="DESIGN", help="A shipped design (see bellows list) or a TOML file."),
]
Settings = Annotated[
    list[str] | None,
    typer.Option(
        "--set",
        metavar="KEY=VALUE",
        help="Change one value: bubble_thickness=1.2, indent.depth=0.4. Repeatable.",
    ),
]
AsJson = Annotated[bool, typer.Option("--json", help="Print one JSON object instead of text.")]
Pressure = Annotated[
    str | None,
    typer.Option(
        metavar="MPA", help="Pressure instead of the design's, MPa; START:STOP:STEP for a curve."
    ),
]
Memory = Annotated[
    float | None,
    typer.Option(
        metavar="GIB",
        help="Memory to take at most; larger meshes are refused. Without it three quarters of the "
        "machine's, at most 4.",
    ),
]
MeshSeconds = Annotated[
    float | None,
    typer.Option(metavar="S", help="Time limit of each mesh, in seconds; without it 120."),
]


class Model(StrEnum):
    """Models to evaluate with."""

    auto = "auto"
    unit_cell = "unit-cell"
    half = "half"
    full = "full"


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

    def work() -> Answer:
        from bellows_design.design.design import load_design, shipped_designs

        designs = {name: load_design(name).description for name in shipped_designs()}
        lines = [f"{name:22} {text}" for name, text in designs.items()]
        return Answer({"designs": designs}, lines)

    answer(work, as_json)


@app.command()
def design(
    name: DesignName,
    output: Annotated[
        Path, typer.Option("-o", "--output", help="File to write: .stl, .3mf or .step.")
    ],
    settings: Settings = None,
    as_json: AsJson = False,
) -> None:
    """Build the printed part and write it as STL, 3MF or STEP."""

    def work() -> Answer:
        from bellows_design.export.formats import write_part, writer_for
        from bellows_design.pipeline import build_part
        from bellows_design.progress import on_stderr

        chosen = _load(name, settings)
        writer_for(output)
        _require_folder(output)
        with on_stderr() as progress:
            progress.stage("geometry")
            part = build_part(chosen)
            progress.stage(f"write {output.name}")
            write_part(part, output)
        content = {
            "design": chosen.name,
            "digest": chosen.digest,
            "file": str(output),
            "triangles": len(part.mesh.triangles),
            "volume_mm3": part.mesh.volume,
        }
        text = f"{output}: {len(part.mesh.triangles)} triangles, {part.mesh.volume / 1000:.2f} cm³"
        return Answer(content, [text])

    answer(work, as_json)


@app.command()
def check(
    name: DesignName,
    printer: Annotated[
        str | None, typer.Option(help="Printer profile, or a TOML file, instead of the design's.")
    ] = None,
    settings: Settings = None,
    as_json: AsJson = False,
) -> None:
    """Check the part against the rules of a printer."""

    def work() -> Answer:
        from bellows_design import pipeline
        from bellows_design.progress import on_stderr
        from bellows_design.reports import tables
        from printers import load_profile

        chosen = _load(name, settings)
        load_profile(printer or chosen.printer)
        with on_stderr() as progress:
            progress.stage("geometry")
            part = pipeline.build_part(chosen)
            progress.stage("check")
            report = pipeline.check(chosen, part, printer)
        content = pipeline.check_dict(chosen, report)
        return Answer(content, tables.check_table(content), 0 if report.verdict == "pass" else 1)

    answer(work, as_json)


@app.command()
def evaluate(
    name: DesignName,
    model: Annotated[Model, typer.Option(help="auto: the smallest model that answers.")] = (
        Model.auto
    ),
    pressure: Pressure = None,
    accuracy: Annotated[
        float | None,
        typer.Option(metavar="PERCENT", help="Refine until the estimated errors are this small."),
    ] = None,
    vtu: Annotated[
        Path | None, typer.Option(help="Also write the deformed mesh, for ParaView (.vtu).")
    ] = None,
    settings: Settings = None,
    memory: Memory = None,
    mesh_seconds: MeshSeconds = None,
    as_json: AsJson = False,
) -> None:
    """Compute bending angle and stress under pressure."""

    def work() -> Answer:
        from bellows_design.cli.pressures import parse_pressures
        from bellows_design.progress import on_stderr
        from bellows_design.reports import tables

        pressures = () if pressure is None else parse_pressures(pressure)
        chosen = _load(name, settings, pressures[-1] if pressures else None)
        _require_file(vtu, ".vtu")
        budget = _budget(memory, mesh_seconds)
        from bellows_design.analysis import (
            evaluate as evaluation,  # heavy: not before the input is known to be good
        )

        with on_stderr() as progress:
            result = evaluation.evaluate(
                chosen, model.value, accuracy, pressures, progress, budget=budget
            )
            if vtu is not None:
                evaluation.write_vtu(result, vtu)
        content = result.to_dict()
        return Answer(content, tables.evaluation_table(content), 0 if result.converged else 3)

    answer(work, as_json)


@app.command()
def run(
    name: DesignName,
    output: Annotated[Path, typer.Option(help="Folder of the approved models.")] = Path("exports"),
    settings: Settings = None,
    memory: Memory = None,
    mesh_seconds: MeshSeconds = None,
    as_json: AsJson = False,
) -> None:
    """Design, check, evaluate, decide, and export what is approved."""

    def work() -> Answer:
        from bellows_design import pipeline
        from bellows_design.progress import on_stderr
        from bellows_design.reports import tables
        from printers import load_profile

        chosen = _load(name, settings, rename=True)
        load_profile(chosen.printer)
        budget = _budget(memory, mesh_seconds)
        with on_stderr() as progress:
            outcome = pipeline.run(chosen, output, progress, budget)
        content = outcome.to_dict()
        status = 0 if outcome.verdict.approved else 1 if outcome.evaluation.converged else 3
        return Answer(content, tables.outcome_table(content), status)

    answer(work, as_json)


@app.command()
def benchmark(
    name: DesignName = "prototype_1",
    model: Annotated[
        list[Model] | None,
        typer.Option(help="Model to measure; repeatable. Without it the unit cell and the half."),
    ] = None,
    meshes: Annotated[
        int | None,
        typer.Option(metavar="N", help="Meshes of each; without it one more than evaluate uses."),
    ] = None,
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

    def work() -> Answer:
        from bellows_design.export.approved import write_json
        from bellows_design.progress import on_stderr
        from bellows_design.reports import benchmark_plot as plots
        from bellows_design.reports import tables

        chosen = _load(name, settings)
        budget = _budget(memory, mesh_seconds)
        _require_file(output, ".json")
        _require_file(plot, ".png")
        if plot is not None:
            plots.require_matplotlib()
        from bellows_design.benchmark import (
            study as benchmark,  # heavy: not before the input is known to be good
        )

        names = [each.value for each in model or ()] or benchmark.DEFAULT_MODELS
        with on_stderr() as progress:
            study = benchmark.study(chosen, names, meshes, progress, budget=budget)
        content = study.to_dict()
        if output is not None:
            write_json(content, output)
        if plot is not None:
            plots.plot_benchmark(content, plot)
        return Answer(content, tables.benchmark_tables(content), 0 if study.converged else 3)

    answer(work, as_json)


@app.command()
def fit(
    data: Annotated[
        Path,
        typer.Argument(metavar="CSV", help="Columns mode, stretch or strain, and stress_mpa."),
    ],
    model: Annotated[
        str, typer.Option(help="best, neo-hooke, mooney-rivlin, ogden1, ogden2, ogden3 or yeoh.")
    ] = "best",
    output: Annotated[
        Path | None, typer.Option("-o", "--output", help="Also write a material as .toml.")
    ] = None,
    yield_strength: Annotated[
        float | None, typer.Option(metavar="MPA", help="Yield strength of that material.")
    ] = None,
    plot: Annotated[
        Path | None, typer.Option(help="Also draw the fit (.png); needs matplotlib.")
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Fit Ogden's rubber to measured stress over stretch."""

    def work() -> Answer:
        from bellows_design.cli import fit as fit_command

        return fit_command.fit(data, model, output, yield_strength, plot)

    answer(work, as_json)


def _load(
    name: str, settings: list[str] | None, pressure: float | None = None, rename: bool = False
) -> Design:
    """The design as named and changed; ``rename`` gives a changed one a name of its own."""
    from bellows_design.design.design import load_design
    from bellows_design.design.overrides import renamed_if_changed, with_overrides

    original = load_design(name)
    changes = [*(settings or []), *([] if pressure is None else [f"load.pressure={pressure!r}"])]
    changed = with_overrides(original, changes)
    return renamed_if_changed(changed, original) if rename else changed


def _budget(memory: float | None, mesh_seconds: float | None) -> Budget:
    """The limits given, and the usual ones of those that are not."""
    from bellows_design.analysis.budget import DEFAULT, Budget

    return Budget(
        DEFAULT.memory if memory is None else memory,
        DEFAULT.mesh_seconds if mesh_seconds is None else mesh_seconds,
    )


def _require_file(path: Path | None, suffix: str) -> None:
    """Refuse a file that cannot be written or whose name does not end in ``suffix``."""
    if path is not None:
        _require_suffix(path, suffix)
        _require_folder(path)


def _require_folder(path: Path) -> None:
    from bellows_design.errors import DesignError, quoted

    if not path.parent.is_dir():
        raise DesignError(f"there is no folder {quoted(str(path.parent))} to write to.")
    if path.is_dir():
        raise DesignError(f"{quoted(str(path))} is a folder, not a file to write.")


def _require_suffix(path: Path, suffix: str) -> None:
    from bellows_design.errors import DesignError, quoted

    if path.suffix.lower() != suffix:
        raise DesignError(f"{quoted(str(path))} must end in {suffix}.")


def main() -> None:
    """The command ``bellows``, as ``bellows_design.__main__`` runs it."""
    from bellows_design.__main__ import main

    main()


if __name__ == "__main__":
    main()
