"""The way into the leak test, and its order: field, widest path, depth, seams, rules."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from printers.arrays import Floats, Ints
from printers.errors import PrintersError
from printers.gcode.beads import Beads
from printers.leak_test.depth import CLOSED_VOID, thinnest_seal
from printers.leak_test.field import Field, grid_for, level_of, paint
from printers.leak_test.frames import Transform, as_place, matrix_of, moved
from printers.leak_test.painting import AIR
from printers.leak_test.picture import layer_view
from printers.leak_test.result import (
    SURELY_OPEN,
    SURELY_SEALED,
    Depth,
    Leak,
    LeakTest,
    Material,
    leak_verdict,
)
from printers.leak_test.rules import leak_rules, stretch_of_heights
from printers.leak_test.seams import seam_tolerance
from printers.leak_test.widest_path import WidestPath, air, crossing, narrowest, widest_path
from printers.model import Opening
from printers.profile import PrinterProfile

MOST_LEAKS = 5
WIDEST = 254


def leak_test(
    beads: Beads,
    openings: Sequence[Opening],
    profile: PrinterProfile,
    *,
    voxel: float | None = None,
    solid_volume: float | None = None,
    transform: Transform | None = None,
    seams: bool = True,
) -> LeakTest:
    """Look for paths of air from the cavity behind the openings to the outside.

    Args:
        beads: Of the sliced part; supports and skirts are left out.
        openings: Mouths of the cavity, in the frame of the G-code; they are plugged.
        profile: The printer that the part was sliced for.
        voxel: Side of the grid's cells, mm; an eighth of a line by default.
        solid_volume: Of the solid that was sliced, mm³.
        transform: From the frame of the G-code to the part's own: a (4, 4) matrix, a tuple of
            rotation and translation, or a function of (n, 3) points. Places are reported in the
            part's coordinates. By default they are the G-code's.
        seams: Whether to find out how much paths may lose at their ends, which takes half as much
            time again.

    Raises:
        PrintersError: One sentence: no openings or beads, an opening that is none of the printed
            part, a part too large for a grid that tells lines apart.
    """
    if not openings:
        raise PrintersError("no opening is given, so there is no cavity to test")
    to_part = matrix_of(transform)
    printed = beads.chosen(beads.of_part)
    side, notes = grid_for(printed, voxel, profile.line_width)
    field = paint(printed, side, profile.line_width)
    paths = _paths(field, openings)
    leaks = tuple(_leak(field, path, cells, to_part) for path, cells in paths if len(cells))
    depth, way = _depth(field, openings, paths[0][0], leaks, profile, to_part)
    hold = None
    if seams and not paths[0][0].is_open:
        hold = seam_tolerance(printed, openings, profile.line_width)
    material = _material(printed, solid_volume, profile)
    ratio = paths[0][0].ratio
    return LeakTest(
        verdict=leak_verdict(ratio),
        ratio=ratio,
        line_width=profile.line_width,
        leaks=leaks,
        depth=depth,
        seams=hold,
        material=material,
        voxel=side,
        notes=tuple(notes),
        rules=tuple(
            leak_rules(ratio, leaks, depth, hold, material, printed.layer_heights, profile)
        ),
        view=layer_view(field, printed, paths[0], way, to_part),
    )


def _paths(field: Field, openings: Sequence[Opening]) -> list[tuple[WidestPath, Ints]]:
    """The widest path and its cells; where it surely leaks also those beside it."""
    found: list[tuple[WidestPath, Ints]] = []
    blocked: list[Floats] = []
    while len(found) < MOST_LEAKS:
        path = widest_path(field, openings, blocked)
        if found and path.ratio <= SURELY_OPEN:
            break
        shown = path.ratio >= SURELY_SEALED
        cells = crossing(field, path) if shown else np.zeros(0, dtype=np.int64)
        found.append((path, cells))
        if path.ratio <= SURELY_OPEN or not len(cells):
            break
        blocked.append(field.place_of(np.array([narrowest(field, cells)]))[0])
    return found


def _leak(field: Field, path: WidestPath, cells: Ints, to_part: Floats) -> Leak:
    width = max(path.ratio - 1, 0.0) * field.line_width
    middle = field.place_of(np.array([narrowest(field, cells)]))
    return Leak(path.ratio, width, as_place(moved(to_part, middle)[0]), path.level >= WIDEST)


def _depth(
    field: Field,
    openings: Sequence[Opening],
    path: WidestPath,
    leaks: tuple[Leak, ...],
    profile: PrinterProfile,
    to_part: Floats,
) -> tuple[Depth, Floats]:
    """The thinnest seal and the way through it, in the frame of the G-code."""
    stretch, width = stretch_of_heights(profile), profile.line_width
    open_from = level_of(CLOSED_VOID)
    marks, leaking = air(field, openings, open_from)
    if leaking:
        return Depth(0.0, 0.0, 0.0, leaks[0].place), np.zeros((0, 3))
    seal = thinnest_seal(field, marks, open_from, stretch)
    beside = 0.0
    if not path.is_open:
        beside = thinnest_seal(field, path.marks, AIR, stretch).length / width
    middle = as_place(moved(to_part, seal.middle[None])[0]) if len(seal.points) else None
    if path.is_open and leaks:
        middle = leaks[0].place
    return Depth(seal.length / width, seal.millimetres, beside, middle), seal.points


def _material(beads: Beads, solid_volume: float | None, profile: PrinterProfile) -> Material:
    volume = float(beads.volume.sum())
    mass = volume * profile.filament.density / 1000
    return Material(volume, mass, solid_volume, profile.slicer.flow / 100)
