"""G-code of any slicer, tested for leaks."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from bellows_design.cli.answer import DONE, REFUSED, Answer
from bellows_design.cli.checking.opening_options import parse_openings
from bellows_design.cli.checking.options import CheckOptions
from bellows_design.cli.checking.sliced import drawn
from bellows_design.cli.checking.subject import opening_dict
from bellows_design.errors import DesignError
from bellows_design.reports.check import report_table
from bellows_design.validation.quoting import quoted

if TYPE_CHECKING:
    from printers.gcode.beads import Beads
    from printers.model import Opening
    from printers.openings.near import Named


def check_gcode(options: CheckOptions) -> Answer:
    """The leak test on the beads of a file. Raises ``DesignError`` and ``PrintersError``."""
    from bellows_design.progress import on_stderr
    from printers.gcode.reading import read_gcode
    from printers.leak_test.run import leak_test
    from printers.report import PrintabilityReport

    named, profile = _named(options), options.profile()
    with on_stderr() as progress:
        progress.stage(f"read {Path(options.name).name}")
        gcode = read_gcode(options.name, profile.filament.diameter if options.filament else None)
        openings = tuple(
            opening_on(gcode.beads, each, f"opening {i}" if len(named) > 1 else "opening")
            for i, each in enumerate(named, 1)
        )
        progress.stage("leak test")
        found = leak_test(gcode.beads, openings, profile)
    report = PrintabilityReport(profile.name, found.rules)
    slicer = " ".join(each for each in (gcode.slicer, gcode.slicer_version) if each)
    notes = (
        f"G-code{f' of {slicer}' if slicer else ''}; places in its own coordinates, mm",
        *(_said(opening) for opening in openings),
        *gcode.notes,
        *found.notes,
        *drawn(found, options.picture),
    )
    content = {
        "file": options.name,
        "format": "G-code",
        "slicer": gcode.slicer,
        "slicer_version": gcode.slicer_version,
        "openings": [opening_dict(opening) for opening in openings],
        "notes": list(notes),
        **report.to_dict(),
        "leak_test": found.figures(),
    }
    status = DONE if report.verdict == "pass" else REFUSED
    return Answer(content, report_table(Path(options.name).name, report, notes), status)


def _named(options: CheckOptions) -> Sequence[Named]:
    named = parse_openings(options.openings)
    if not named or any(diameter is None for *_, diameter in named):
        raise DesignError(
            f"{quoted(options.name)} is G-code, which does not show what is meant to be open: give "
            "--opening X,Y,Z,DIAMETER, mm, in its coordinates."
        )
    return named


def opening_on(beads: Beads, named: Named, name: str) -> Opening:
    """The opening at a point, through the nearest side of the box around the part's beads."""
    import numpy as np

    from printers.model import Opening

    lower, upper = beads.part_box
    point = np.array(named[:3])
    distances = np.abs(np.concatenate([point - lower, upper - point]))
    side = int(distances.argmin())
    direction = [0.0, 0.0, 0.0]
    direction[side % 3] = -1.0 if side < 3 else 1.0
    assert named[3] is not None
    return Opening(name, named[:3], (direction[0], direction[1], direction[2]), named[3] / 2)


def _said(opening: Opening) -> str:
    from printers.report import place

    axis = max(range(3), key=lambda each: abs(opening.direction[each]))
    sign = "-" if opening.direction[axis] < 0 else "+"
    return (
        f"{opening.name} at {place(opening.centre)}, {2 * opening.radius:g} mm wide, opens towards "
        f"{sign}{'xyz'[axis]}, the nearest side of the part's box"
    )
