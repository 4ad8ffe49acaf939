"""Reading a slicer's G-code, of any of the usual dialects."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from types import MappingProxyType

import numpy as np

from printers.arrays import Floats
from printers.errors import PrintersError, quoted, shortened
from printers.gcode.arcs import straightened
from printers.gcode.beads import Beads
from printers.gcode.comments import Comments
from printers.gcode.facts import Facts
from printers.gcode.laying import before_first_layer, laid_beads, notes_on
from printers.gcode.machine import COLUMNS, FED, FLOW, VOLUMETRIC, Machine
from printers.gcode.overlooked import Overlooked
from printers.gcode.pieces import pieces
from printers.gcode.words import read_lines

MOST_BEADS = 2_000_000
"""To read them takes 0.7 GB; the shipped finger has 149 000."""

FILAMENT_DIAMETERS = (1.0, 4.0)
"""mm: the least and the largest that is believed, as in a profile."""

DISAGREEMENT = 0.05
"""Share by which the filament that is laid down may differ from what the slicer states, which has
blobs and purge between; more means that something was misread."""


@dataclass(frozen=True, eq=False)
class GCode:
    """What a G-code file lays down, and what it says about itself.

    Attributes:
        beads: In the order in which they are printed, skirts and supports too.
        slicer: Name of the slicer, if stated.
        slicer_version: As stated.
        estimated_time: Of the print, s, as the slicer states it.
        filament_diameter: mm.
        filament_diameter_source: `"G-code"` or `"argument"`.
        filament_length: Filament that leaves the nozzle, mm, skirts, purge and blobs too.
        stated_filament_length: The same by the slicer's own account, mm.
        settings: The slicer's settings as the file states them.
        notes: Sentences on what was doubtful or left out.
    """

    beads: Beads
    slicer: str | None
    slicer_version: str | None
    estimated_time: float | None
    filament_diameter: float
    filament_diameter_source: str
    filament_length: float
    stated_filament_length: float | None
    settings: Mapping[str, str]
    notes: tuple[str, ...]


def read_gcode(path: str | os.PathLike[str], filament_diameter: float | None = None) -> GCode:
    """The beads of a G-code file, read as a stream.

    Understood are the commands G0 to G3, G10, G11, G20, G21, G28, G90 to G92, G90.1, G91.1, M82,
    M83, M200 and M221 (for all extruders), a note names others that change places or plastic,
    and comments of PrusaSlicer, SuperSlicer, OrcaSlicer, Bambu Studio and Cura; G-code without
    comments too, whose beads are all of the part, of the kind `OTHER`. Plastic before the first
    layer and at features such as `Custom` is no part of the part: its kind is `SKIRT`.

    Args:
        path: The file.
        filament_diameter: mm; by default what the file states.

    Raises:
        PrintersError: One sentence on a file that cannot be read, is no G-code, too large, states
            no filament diameter, or lays down no plastic.
    """
    name = quoted(os.fspath(path))
    machine, comments, overlooked = Machine(), Comments(), Overlooked()
    try:
        moves = _moves(Path(path), machine, comments, overlooked)
        code = _understood(moves, machine, comments, filament_diameter)
        return replace(code, notes=(*code.notes, *overlooked.notes()))
    except PrintersError as error:
        raise PrintersError(f"G-code {name}: {error}") from None
    except (OSError, ValueError) as error:  # ValueError: no name that a file may have
        reason = shortened(getattr(error, "strerror", None) or str(error))
        raise PrintersError(f"G-code {name} cannot be read: {reason}") from None


def _moves(path: Path, machine: Machine, comments: Comments, overlooked: Overlooked) -> Floats:
    """(n, 15) all moves that lay down plastic; the others take in the file."""
    parts, line, count = [np.empty((0, COLUMNS))], 1, 0
    for piece in pieces(path):
        lines = read_lines(piece, line)
        comments.collect(piece, lines)
        overlooked.collect(piece)
        parts.append(straightened(machine.follow(lines), MOST_BEADS))
        line, count = line + lines.passed, count + len(parts[-1])
        if count > MOST_BEADS:
            raise PrintersError(f"it has more than {MOST_BEADS} beads")
    return np.concatenate(parts)


def _understood(
    moves: Floats, machine: Machine, comments: Comments, argument: float | None
) -> GCode:
    if not len(moves):
        raise PrintersError("it lays down no plastic (no move with X or Y and a rising E)")
    facts = comments.facts
    diameter, source = _filament_diameter(facts, argument)
    area = np.pi * diameter**2 / 4
    # E is a length, or a volume after M200, or where the settings say so.
    section = 1.0 if facts.number("use_volumetric_e") else area
    asked = np.where(moves[:, VOLUMETRIC] == 1, 1.0, section) * moves[:, FED]
    beads = laid_beads(moves, asked * moves[:, FLOW], comments)
    printed = asked[~before_first_layer(moves, comments)].sum() / area  # slicers know no M221
    return GCode(
        beads=beads,
        slicer=facts.slicer,
        slicer_version=facts.version,
        estimated_time=facts.time,
        filament_diameter=diameter,
        filament_diameter_source=source,
        filament_length=(machine.length * section + machine.volume) / area,
        stated_filament_length=facts.filament_length,
        settings=MappingProxyType(dict(facts.settings)),
        notes=(*notes_on(moves, beads, comments), *_disagreements(printed, facts, argument)),
    )


def _filament_diameter(facts: Facts, argument: float | None) -> tuple[float, str]:
    stated = facts.number("filament_diameter")
    diameter, source = (stated, "G-code") if argument is None else (argument, "argument")
    if diameter is None:
        raise PrintersError(
            "it states no filament_diameter; give it (1.75 mm, or 2.85 mm in some printers)"
        )
    least, largest = FILAMENT_DIAMETERS
    if not least <= diameter <= largest:
        raise PrintersError(
            f"filament_diameter is {diameter:g} mm; it must lie from {least:g} to {largest:g} mm"
        )
    return diameter, source


def _disagreements(printed: float, facts: Facts, argument: float | None) -> Iterator[str]:
    """`printed` is the filament in mm without what comes before the first layer."""
    stated, diameter = facts.filament_length, facts.number("filament_diameter")
    if stated and abs(printed / stated - 1) > DISAGREEMENT:
        yield (
            f"the G-code lays down {printed:.0f} mm of filament, and its slicer states "
            f"{stated:.0f} mm: something may have been misread"
        )
    if argument is not None and diameter is not None and abs(argument - diameter) > 1e-6:
        yield f"filament_diameter is {argument:g} mm as given; the G-code states {diameter:g} mm"
