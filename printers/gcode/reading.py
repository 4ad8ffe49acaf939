"""Reading a slicer's G-code, of any of the usual dialects."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType

import numpy as np

from printers.arrays import Flags, Floats
from printers.errors import PrintersError, quoted, shortened
from printers.gcode.arcs import straightened
from printers.gcode.beads import OTHER, SKIRT, SUPPORT, Beads
from printers.gcode.comments import Comments
from printers.gcode.heights import heights, layers
from printers.gcode.machine import (
    FED,
    LINE,
    PATH,
    TOOL,
    VOLUMETRIC,
    X0,
    X1,
    Y0,
    Y1,
    Z0,
    Z1,
    Machine,
)
from printers.gcode.words import LONGEST_LINE, read_lines

LARGEST_FILE = 300_000_000
"""Bytes; a print of a day has a tenth of it."""

MOST_BEADS = 10_000_000
"""They take 1 GB."""

PIECE = 1_000_000
"""Bytes read at a time."""

FILAMENT_DIAMETERS = (0.5, 5.0)
"""mm: the least and the largest that is believed."""

DISAGREEMENT = 0.05
"""Share by which the filament that is fed may differ from what the slicer states, which leaves out
purge and code of the printer's own; more means that something was misread."""


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

    Understood are the commands G0 to G3, G10, G11, G20, G21, G28, G90 to G92, M82, M83 and M200,
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
    machine, comments, moves = Machine(), Comments(), [np.empty((0, 14))]
    try:
        beads_left = MOST_BEADS
        first = 1
        for piece in _pieces(Path(path)):
            lines = read_lines(piece, first)
            comments.collect(piece, lines)
            moves.append(straightened(machine.follow(lines), beads_left))
            first, beads_left = first + lines.passed, beads_left - len(moves[-1])
            if beads_left < 0:
                raise PrintersError(f"it has more than {MOST_BEADS} beads")
        return _understood(np.concatenate(moves), machine, comments, filament_diameter)
    except OSError as error:
        reason = shortened(error.strerror or str(error))
        raise PrintersError(f"G-code {name} cannot be read: {reason}") from None
    except PrintersError as error:
        raise PrintersError(f"G-code {name}: {error}") from None


def _pieces(path: Path) -> Iterator[bytes]:
    """Whole lines of the file, about a megabyte at a time."""
    if path.exists() and not path.is_file():
        raise PrintersError("it is no file")  # reading from a pipe would wait for a writer
    with path.open("rb") as file:
        rest, total = b"", 0
        while block := file.read(PIECE):
            total += len(block)
            _refuse_other_files(block, first=total == len(block))
            if total > LARGEST_FILE:
                raise PrintersError(f"it is larger than {LARGEST_FILE // 1_000_000} MB")
            whole, newline, tail = (rest + block).rpartition(b"\n")
            rest = tail
            if len(rest) > LONGEST_LINE:
                raise PrintersError(f"it has a line longer than {LONGEST_LINE // 1000} kB")
            if newline:
                yield whole + newline
        if rest:
            yield rest


def _refuse_other_files(block: bytes, first: bool) -> None:
    if first and block.startswith(b"GCDE"):
        raise PrintersError(
            "it is binary G-code; convert it to text in the slicer, or slice again with binary "
            "G-code switched off"
        )
    if first and block.startswith(b"PK\x03\x04"):
        raise PrintersError("it is a zip archive; unpack it, the G-code is inside (Metadata/)")
    if b"\0" in block:
        raise PrintersError("it is no text, so no G-code")


def _understood(
    moves: Floats, machine: Machine, comments: Comments, argument: float | None
) -> GCode:
    if not len(moves):
        raise PrintersError("it lays down no plastic (no move with X or Y and a rising E)")
    facts = comments.facts
    volumetric = _volumetric(moves, comments)
    diameter, source = _filament_diameter(comments, argument, needed=not volumetric.all())
    area = np.pi * diameter**2 / 4
    beads, notes = _beads(moves, np.where(volumetric, 1.0, area) * moves[:, FED], comments)
    length = machine.length + machine.volume / area
    if facts.number("use_volumetric_e"):
        length = (machine.length + machine.volume) / area
    stated = facts.filament_length
    return GCode(
        beads=beads,
        slicer=facts.slicer,
        slicer_version=facts.version,
        estimated_time=facts.time,
        filament_diameter=diameter,
        filament_diameter_source=source,
        filament_length=length,
        stated_filament_length=stated,
        settings=MappingProxyType(dict(facts.settings)),
        notes=(*notes, *_disagreements(length, stated, comments, argument)),
    )


def _volumetric(moves: Floats, comments: Comments) -> Flags:
    """(n,) whether E is a volume: after M200, or as the settings say."""
    if comments.facts.number("use_volumetric_e"):
        return np.ones(len(moves), dtype=bool)
    return np.asarray(moves[:, VOLUMETRIC] == 1)


def _filament_diameter(
    comments: Comments, argument: float | None, needed: bool
) -> tuple[float, str]:
    stated = comments.facts.number("filament_diameter")
    if argument is None and stated is None:
        if not needed:
            return 1.75, "none needed"  # E is a volume; it only states the length
        raise PrintersError(
            "it states no filament_diameter; give it (1.75 mm, or 2.85 mm in some printers)"
        )
    diameter, source = (stated, "G-code") if argument is None else (argument, "argument")
    least, largest = FILAMENT_DIAMETERS
    assert diameter is not None
    if not least <= diameter <= largest:
        raise PrintersError(
            f"filament_diameter is {diameter:g} mm; it must lie from {least:g} to {largest:g} mm"
        )
    return diameter, source


def _beads(moves: Floats, volume: Floats, comments: Comments) -> tuple[Beads, tuple[str, ...]]:
    """Where the moves have a length in the plane of the layer, and sentences on them."""
    lines = moves[:, LINE].astype(np.int64)
    kind = comments.kind.at(lines, OTHER).astype(np.int64)
    if comments.layer.lines:
        kind[lines < comments.layer.lines[0]] = SKIRT
    of_part = (kind != SKIRT) & (kind != SUPPORT)
    lower, upper = np.minimum(moves[:, Z0], moves[:, Z1]), np.maximum(moves[:, Z0], moves[:, Z1])
    top, layer = layers(lower, upper, lines)
    height = heights(comments.height.at(lines, np.nan), top, layer, of_part)
    length = np.hypot(moves[:, X1] - moves[:, X0], moves[:, Y1] - moves[:, Y0])
    if (height <= 0).any():
        first = lines[height <= 0][0]
        raise PrintersError(f"line {first} lays down plastic at or below the bed, z = 0")
    beads = Beads(
        start=np.ascontiguousarray(moves[:, (X0, Y0)]),
        end=np.ascontiguousarray(moves[:, (X1, Y1)]),
        top=top,
        height=height,
        width=volume / (length * height),
        nominal_width=comments.width.at(lines, np.nan),
        kind=kind,
        path=moves[:, PATH].astype(np.int64),
        layer=layer.astype(np.int64),
    )
    return beads, tuple(_notes(beads, moves, comments, lower != upper))


def _notes(beads: Beads, moves: Floats, comments: Comments, sloped: Flags) -> Iterator[str]:
    if not comments.kind.lines:
        yield "no comment states the kinds of beads: skirts and purge count as part of the part"
    if comments.unknown_features:
        names = ", ".join(quoted(name) for name in sorted(comments.unknown_features))
        yield f"features of unknown names count as part of the part: {names}"
    if sloped.any():
        yield f"{sloped.sum()} beads rise on their way and are put at the height of their layer"
    if len(np.unique(moves[beads.of_part, TOOL])) > 1:
        yield "several extruders print the part; all are taken to have the first one's filament"


def _disagreements(
    length: float, stated: float | None, comments: Comments, argument: float | None
) -> Iterator[str]:
    if stated and abs(length / stated - 1) > DISAGREEMENT:
        yield (
            f"the G-code feeds {length:.0f} mm of filament, and its slicer states {stated:.0f} mm: "
            f"something may have been misread"
        )
    diameter = comments.facts.number("filament_diameter")
    if argument is not None and diameter is not None and abs(argument - diameter) > 1e-6:
        yield f"filament_diameter is {argument:g} mm as given; the G-code states {diameter:g} mm"
