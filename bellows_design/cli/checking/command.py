"""The command ``bellows check``."""

from __future__ import annotations

from bellows_design.cli.answer import answer
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
from bellows_design.cli.options import AsJson, Printer, Quiet, Settings


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
    quiet: Quiet = False,
    as_json: AsJson = False,
) -> None:
    """Check a design, or a part of any program, against the rules of a printer."""
    from bellows_design.cli.checking.check import check as check_part

    options = CheckOptions(
        name, tuple(settings or ()), printer, filament, tuple(opening or ()), up, orientation,
        slice_it, require_slicer, picture, keep_gcode,
    )  # fmt: skip
    answer(lambda: check_part(options), as_json, quiet)
