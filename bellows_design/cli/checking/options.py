"""What ``bellows check`` takes from the command line."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from bellows_design.cli.completion.names import designs_and_parts, filaments
from bellows_design.cli.layout import panels
from bellows_design.cli.options import DesignOptions
from bellows_design.errors import DesignError
from bellows_design.validation.quoting import near, quoted

if TYPE_CHECKING:
    from printers import PrinterProfile
    from printers.orientation.turning import Turning

DEFAULT_PRINTER = "prusa_i3"
PARTS = (".stl", ".3mf", ".step", ".stp")
GCODE = (".gcode", ".gco", ".g")
AUTO = "auto"

Checked = Annotated[
    str,
    typer.Argument(
        metavar="DESIGN|FILE",
        autocompletion=designs_and_parts,
        help="A shipped design, a TOML file, or a part of any program: .stl, .3mf, .step, .gcode.",
    ),
]
FilamentName = Annotated[
    str | None,
    typer.Option(
        "--filament",
        metavar="NAME",
        autocompletion=filaments,
        help="Filament, or a TOML file, instead of the printer's.",
        rich_help_panel=panels.DESIGN,
    ),
]
Openings = Annotated[
    list[str] | None,
    typer.Option(
        "--opening",
        metavar="X,Y,Z[,D]",
        help="Mouth of the cavity near this point of the file, of diameter D, mm; repeatable. "
        "auto, as without it: the one that is found.",
    ),
]
Up = Annotated[
    str | None,
    typer.Option(
        metavar="AXIS", help="Direction of the file that points up: Z, -Z, X …, or X,Y,Z."
    ),
]
OrientationChoice = Annotated[
    str | None,
    typer.Option("--orientation", metavar="auto", help="Compare how the part can stand."),
]
Slice = Annotated[
    bool, typer.Option("--slice", help="Also slice it, and look for leaks in the G-code.")
]
RequireSlicer = Annotated[
    bool, typer.Option("--require-slicer", help="With --slice: without a slicer the check fails.")
]
Picture = Annotated[
    Path | None,
    typer.Option(
        metavar="FILE",
        help="Also draw the layer with the leak or the thinnest seal (.png).",
        rich_help_panel=panels.FILES,
    ),
]
KeepGcode = Annotated[
    Path | None,
    typer.Option(
        "--keep-gcode",
        metavar="FILE",
        help="Also write the G-code (.gcode).",
        rich_help_panel=panels.FILES,
    ),
]


@dataclass(frozen=True)
class CheckOptions:
    """What is checked, and how: the options as they were given."""

    name: str
    settings: tuple[str, ...] = ()
    printer: str | None = None
    filament: str | None = None
    openings: tuple[str, ...] = ()
    up: str | None = None
    orientation: str | None = None
    slice: bool = False
    require_slicer: bool = False
    picture: Path | None = None
    keep_gcode: Path | None = None

    @property
    def suffix(self) -> str:
        """Of the file that is checked, in small letters; empty for a design's name."""
        return Path(self.name).suffix.lower()

    @property
    def is_part(self) -> bool:
        """Whether a part of another program is checked."""
        return self.suffix in PARTS

    @property
    def is_gcode(self) -> bool:
        """Whether G-code is checked."""
        return self.suffix in GCODE

    @property
    def is_design(self) -> bool:
        """Whether a design is checked."""
        return not (self.is_part or self.is_gcode)

    @property
    def design(self) -> DesignOptions:
        """The design that is checked."""
        return DesignOptions(self.name, self.settings, self.printer)

    def profile(self) -> PrinterProfile:
        """The printer for a file. Raises ``PrintersError``."""
        from printers import load_profile

        printer = DEFAULT_PRINTER if self.printer is None else self.printer
        return self.with_filament(load_profile(printer))

    def turning(self) -> Turning:
        """How the part stands on the bed: as its file has it, or as was asked for.

        Raises ``DesignError``.
        """
        from printers.errors import PrintersError
        from printers.orientation.turning import AS_IN_FILE, AXES, parse_up

        try:
            return AS_IN_FILE if self.up is None else parse_up(self.up)
        except PrintersError:
            raise DesignError(
                f"--up is {quoted(self.up)}; it must be {', '.join(AXES)} or a vector such as "
                "0,0.5,1."
            ) from None

    def with_filament(self, profile: PrinterProfile) -> PrinterProfile:
        """The printer with the filament that was asked for. Raises ``PrintersError``."""
        from printers.profile_files import with_filament

        return profile if self.filament is None else with_filament(profile, self.filament)

    def require_consistent(self) -> None:
        """Raise ``DesignError`` for options that mean nothing here."""
        self._require_known_file()
        only_parts = "only a part in a file can be turned"
        for option, given, holds, reason in (
            ("--set", self.settings, self.is_design, "a file has no parameters"),
            ("--opening", self.openings, not self.is_design, "a design declares its port"),
            ("--up", self.up, self.is_part, only_parts),
            ("--orientation", self.orientation, self.is_part, only_parts),
            ("--slice", self.slice, not self.is_gcode, "G-code is sliced already"),
            ("--keep-gcode", self.keep_gcode, self.slice, "it needs --slice"),
            ("--require-slicer", self.require_slicer, self.slice, "it needs --slice"),
            ("--picture", self.picture, self.slice or self.is_gcode, "it needs --slice"),
        ):
            if given not in (None, False, ()) and not holds:
                raise DesignError(f"{option} means nothing for {quoted(self.name)}: {reason}.")
        if self.orientation not in (None, AUTO):
            hint = near(str(self.orientation), [AUTO])
            raise DesignError(
                f"--orientation is {quoted(str(self.orientation))}; it can be auto{hint or '.'}"
            )
        if self.orientation is not None and self.up is not None:
            raise DesignError("--orientation auto chooses what --up says: give one of them.")

    def _require_known_file(self) -> None:
        known = (".toml", *PARTS, *GCODE)
        hint = near(self.suffix, known)
        if self.is_design and self.suffix not in ("", ".toml"):
            raise DesignError(
                f"{quoted(self.name)} is no design and no part: its name must end in "
                f"{', '.join(known)}{hint or '.'}"
            )
