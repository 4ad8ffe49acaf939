"""Layers and heights of beads: which stand on which."""

from __future__ import annotations

import numpy as np

from printers.arrays import Flags, Floats, Ints
from printers.errors import PrintersError

DIGITS = 4
"""Of a height in mm: slicers write three, and sums of relative moves are off in the last bit."""


def layers(
    lower: Floats, upper: Floats, length: Floats, of_part: Flags, lines: Ints
) -> tuple[Floats, Ints]:
    """(n,) the height at which each bead's layer is printed, and (n,) the layer's number.

    `lower` and `upper` are the nozzle's heights at the lower and upper end of each bead, mm. Level
    beads make the layers. A bead that rises on its way up to its layer, as in a seam that
    OrcaSlicer ramps, is put at the height of the layer; so is what is not of the part.

    Raises:
        PrintersError: Beads of the part rise above all layers or through one, or most of a layer
            rises, as in a spiral vase.
    """
    lower, upper = np.round(lower, DIGITS), np.round(upper, DIGITS)
    level = (lower == upper) | ~of_part
    tops = np.unique(upper[level])
    layer = np.searchsorted(tops, upper)
    below = np.concatenate(([-np.inf], tops))[layer]
    rising = np.bincount(layer, length * ~level) > np.bincount(layer, length * of_part) / 2
    astray = ~level & ((layer == len(tops)) | (lower < below) | rising[layer])
    if astray.any():
        raise PrintersError(
            f"the nozzle rises while it prints (line {lines[astray][0]} of the G-code); a spiral "
            f"vase or a print that is not in level layers cannot be judged"
        )
    return tops[layer], layer


def heights(stated: Floats, tops: Floats, layer: Ints, of_part: Flags) -> Floats:
    """(n,) mm: as stated, or else down to the next layer of the part below.

    Layers of supports alone lie between those of the part and do not count for it.
    """
    missing = np.isnan(stated)
    levels = np.unique(tops[of_part]) if of_part.any() else np.unique(tops)
    below = np.concatenate(([0.0], levels))[np.searchsorted(levels, tops)]
    return np.where(missing, np.round(tops - below, DIGITS), stated)
