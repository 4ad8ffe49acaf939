"""Beads from the moves that lay down plastic and what comments say of them."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from printers.arrays import Flags, Floats
from printers.errors import PrintersError, quoted
from printers.gcode.beads import OTHER, SKIRT, SUPPORT, Beads
from printers.gcode.comments import Comments
from printers.gcode.heights import heights, layers
from printers.gcode.machine import FLOW, LINE, PATH, TOOL, X0, X1, Y0, Y1, Z0, Z1

MOST_FLOWS = 5
"""That are told."""


def before_first_layer(moves: Floats, comments: Comments) -> Flags:
    """(n,) moves before the first layer that a comment begins, such as the purge of a nozzle."""
    first = comments.layer.lines[0] if comments.layer.lines else 0
    return np.asarray(moves[:, LINE] < first)


def laid_beads(moves: Floats, volume: Floats, comments: Comments) -> Beads:
    """The beads of the moves, whose plastic has the volumes (n,) mm³.

    Raises:
        PrintersError: The part is not printed in level layers above the bed.
    """
    lines = moves[:, LINE].astype(np.int64)
    kind = comments.kind.at(lines, OTHER).astype(np.int64)
    kind[before_first_layer(moves, comments)] = SKIRT
    of_part = (kind != SKIRT) & (kind != SUPPORT)
    lower, upper = np.minimum(moves[:, Z0], moves[:, Z1]), np.maximum(moves[:, Z0], moves[:, Z1])
    length = np.hypot(moves[:, X1] - moves[:, X0], moves[:, Y1] - moves[:, Y0])
    top, layer = layers(lower, upper, length, of_part, lines)
    height = heights(comments.height.at(lines, np.nan), top, layer, of_part)
    if (of_part & (height <= 0)).any():
        first = lines[of_part & (height <= 0)][0]
        raise PrintersError(f"line {first} of the G-code lays down plastic at or below the bed")
    height = np.where(height > 0, height, np.nan)  # purge below the bed, beside it
    beads = Beads(
        start=np.ascontiguousarray(moves[:, (X0, Y0)]),
        end=np.ascontiguousarray(moves[:, (X1, Y1)]),
        top=top,
        height=height,
        width=volume / (length * height),
        nominal_width=comments.width.at(lines, np.nan),
        kind=kind,
        path=moves[:, PATH].astype(np.int64),
        layer=layer,
    )
    return beads if (height > 0).all() else beads.chosen(height > 0)


def notes_on(moves: Floats, beads: Beads, comments: Comments) -> Iterator[str]:
    """Sentences on what was doubtful in the moves."""
    if not comments.kind.lines:
        yield "no comment states the kinds of beads: skirts and purge count as part of the part"
    if comments.unknown_features:
        names = ", ".join(quoted(name) for name in sorted(comments.unknown_features))
        yield f"features of unknown names count as part of the part: {names}"
    if not beads.of_part.any():
        yield "nothing is laid down that is of the part: all is skirt, purge or support"
    later = moves[~before_first_layer(moves, comments)]
    sloped = np.count_nonzero(np.abs(later[:, Z1] - later[:, Z0]) > 1e-4)
    if sloped:
        yield f"{sloped} beads rise on their way and are put at the height of their layer"
    for flow in np.unique(later[:, FLOW])[:MOST_FLOWS]:
        if flow != 1:
            count = np.count_nonzero(later[:, FLOW] == flow)
            yield f"{count} beads get {flow:.3g} times the plastic that they ask for (M221)"
    if len(np.unique(later[:, TOOL])) > 1:
        yield "several extruders print; all are taken to have the filament of the first"
