"""What the commands take from the command line: their options, and the groups several share."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from bellows_design.cli.completion.names import designs, exports, printers
from bellows_design.cli.completion.options import complete_model, complete_setting
from bellows_design.cli.layout import panels
from bellows_design.materials.laws import FIT_CHOICES

if TYPE_CHECKING:
    from bellows_design.budget import Budget
    from bellows_design.design.design import Design

DesignName = Annotated[
    str,
    typer.Argument(
        metavar="DESIGN",
        autocompletion=designs,
        help="A shipped design (see bellows list) or a TOML file.",
    ),
]
Settings = Annotated[
    list[str] | None,
    typer.Option(
        "--set",
        metavar="KEY=VALUE",
        autocompletion=complete_setting,
        help="Change one value: bubble_thickness=1.2, indent.depth=0.4. Repeatable.",
        rich_help_panel=panels.DESIGN,
    ),
]
ExportFolder = Annotated[
    Path,
    typer.Argument(
        metavar="FOLDER",
        autocompletion=exports,
        help="Folder of an export, such as exports/finger.",
    ),
]
Quick = Annotated[
    bool, typer.Option("--quick", help="Leave out evaluation and leak test, and say so.")
]
WithSettings = Annotated[
    bool,
    typer.Option(
        "--with-settings",
        help="A .3mf that carries the printer's settings as well.",
        rich_help_panel=panels.FILES,
    ),
]
Quiet = Annotated[
    bool,
    typer.Option(
        "--quiet",
        "-q",
        help="No progress and no notes on stderr, only errors.",
        rich_help_panel=panels.SPEECH,
    ),
]
AsJson = Annotated[
    bool,
    typer.Option(
        "--json", help="Print one JSON object instead of text.", rich_help_panel=panels.SPEECH
    ),
]
Printer = Annotated[
    str | None,
    typer.Option(
        metavar="NAME",
        autocompletion=printers,
        help="Printer profile, or a TOML file, instead of the design's.",
        rich_help_panel=panels.DESIGN,
    ),
]
Pressure = Annotated[
    str | None,
    typer.Option(
        metavar="MPA", help="Pressure instead of the design's, MPa; START:STOP:STEP for a curve."
    ),
]
Accuracy = Annotated[
    float | None,
    typer.Option(metavar="PERCENT", help="Refine until the estimated errors are this small."),
]
Vtu = Annotated[
    Path | None,
    typer.Option(
        metavar="FILE",
        help="Also write the deformed mesh, for ParaView (.vtu).",
        rich_help_panel=panels.FILES,
    ),
]
Memory = Annotated[
    float | None,
    typer.Option(
        metavar="GIB",
        help="Memory to take at most; larger meshes are refused. Without it three quarters of the "
        "machine's, at most 4.",
        rich_help_panel=panels.LIMITS,
    ),
]
MeshSeconds = Annotated[
    float | None,
    typer.Option(
        metavar="S",
        help="Time limit of each mesh, in seconds; without it 120.",
        rich_help_panel=panels.LIMITS,
    ),
]
TimeLimit = Annotated[
    float | None,
    typer.Option(
        "--seconds",
        metavar="S",
        help="Time limit of the evaluation, in seconds; without it 240. It then ends with the "
        "last good state, and says so.",
        rich_help_panel=panels.LIMITS,
    ),
]
Derivatives = Annotated[
    bool,
    typer.Option("--sensitivities", help="Also derivatives by every number of the design."),
]
NoCache = Annotated[
    bool,
    typer.Option(
        "--no-cache",
        help="Compute anew, and keep nothing: see bellows cache.",
        rich_help_panel=panels.LIMITS,
    ),
]
Meshes = Annotated[
    int | None,
    typer.Option(metavar="N", help="Meshes of each; without it one more than evaluate uses."),
]
FitData = Annotated[
    list[Path],
    typer.Argument(
        metavar="FILE",
        help="Nominal stress (force over initial area) over strain or stretch, of one specimen or "
        "several: CSV and the like, or .xlsx. Columns are known by their names.",
    ),
]
FitModelName = Annotated[
    str,
    typer.Option(
        metavar="LAW",
        autocompletion=complete_model,
        help=f"{', '.join(FIT_CHOICES[:-1])} or {FIT_CHOICES[-1]}.",
    ),
]
YieldStrength = Annotated[
    float | None,
    typer.Option(
        metavar="MPA", help="Yield strength of that material.", rich_help_panel=panels.MATERIAL
    ),
]
ElongationAtBreak = Annotated[
    float | None,
    typer.Option(
        metavar="PERCENT",
        help="Elongation at break of that material, per cent (400, not 4): strains beyond are "
        "refused.",
        rich_help_panel=panels.MATERIAL,
    ),
]
AcceptPoorFit = Annotated[
    bool,
    typer.Option(
        "--accept-poor-fit",
        help="Take a poor fit for a material, which keeps a warning.",
        rich_help_panel=panels.MATERIAL,
    ),
]
Columns = Annotated[
    str | None,
    typer.Option(
        metavar="NAMES",
        help="Names of the columns instead of the header's: strain_percent,stress_mpa, with - for "
        "one to leave out; or by number: strain=2,stress_mpa=4.",
        rich_help_panel=panels.READING,
    ),
]
Units = Annotated[
    str | None,
    typer.Option(
        metavar="UNITS",
        help="Units instead of the header's: stress=kPa (MPa, N/mm², psi, kgf/cm² …), strain=% "
        "(1 for fractions), force=N, extension=mm.",
        rich_help_panel=panels.READING,
    ),
]
Skip = Annotated[
    str | None,
    typer.Option(
        metavar="LINES",
        help="Lines to leave out: 4 the first four, 3-5, 70- to the end.",
        rich_help_panel=panels.READING,
    ),
]
Decimal = Annotated[
    str | None,
    typer.Option(
        metavar="SIGN", help="Decimal sign: point or comma.", rich_help_panel=panels.READING
    ),
]
Branch = Annotated[
    str | None,
    typer.Option(
        metavar="BRANCH",
        help="Of a test that goes to and fro: first (loading for the first time) or last; all for "
        "all points; specimens where each return is a new specimen.",
        rich_help_panel=panels.READING,
    ),
]
Keep = Annotated[
    list[str] | None,
    typer.Option(
        metavar="WHAT",
        help="zero: take strains as they are, without looking for preload and slack; break: take "
        "points after break as well. Repeatable.",
        rich_help_panel=panels.READING,
    ),
]
TrueStress = Annotated[
    bool,
    typer.Option(
        "--true-stress",
        help="The stress is over present, not initial, area.",
        rich_help_panel=panels.READING,
    ),
]
TrueStrain = Annotated[
    bool,
    typer.Option(
        "--true-strain",
        help="The strain is logarithmic, not nominal.",
        rich_help_panel=panels.READING,
    ),
]
Area = Annotated[
    float | None,
    typer.Option(
        metavar="MM2",
        help="Initial area that a force is divided by, mm².",
        rich_help_panel=panels.READING,
    ),
]
GaugeLength = Annotated[
    float | None,
    typer.Option(
        metavar="MM",
        help="Initial length that an extension is divided by, mm.",
        rich_help_panel=panels.READING,
    ),
]


@dataclass(frozen=True)
class DesignOptions:
    """A design as it is named, the changes to it, each ``key=value``, and another printer."""

    name: str
    settings: tuple[str, ...] = ()
    printer: str | None = None

    def load(self, pressure: float | None = None, rename: bool = False) -> Design:
        """The design as named and changed. Raises ``DesignError``.

        ``pressure`` (MPa) replaces the design's; ``rename`` gives a changed design a name of its
        own.
        """
        from bellows_design.design.overrides import renamed_if_changed, with_overrides
        from bellows_design.design.shipped import load_design

        original = load_design(self.name)
        load = [] if pressure is None else [f"load.pressure={pressure!r}"]
        printer = [] if self.printer is None else [f"printer={self.printer}"]
        changed = with_overrides(original, [*self.settings, *load, *printer])
        return renamed_if_changed(changed, original) if rename else changed


@dataclass(frozen=True)
class BudgetOptions:
    """Memory (GiB), seconds for each mesh and for all, as far as they are given."""

    memory: float | None = None
    mesh_seconds: float | None = None
    seconds: float | None = None

    def budget(self) -> Budget:
        """The limits given, and the usual ones of those that are not. Raises ``DesignError``."""
        from bellows_design.budget import DEFAULT, Budget

        return Budget(
            DEFAULT.memory if self.memory is None else self.memory,
            DEFAULT.mesh_seconds if self.mesh_seconds is None else self.mesh_seconds,
            DEFAULT.seconds if self.seconds is None else self.seconds,
        )
