"""The layers of a sliced part, with the places that its leak test points at, for a page."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from bellows_design.web.layers import AirMap, LayerMark, PrintLayers, Severity
from printers.gcode.beads import KIND_NAMES

if TYPE_CHECKING:
    from printers.arrays import Floats
    from printers.leak_test.result import LayerView, LeakTest
    from printers.slicing.making import Sliced


def print_layers(sliced: Sliced, leaks: LeakTest) -> PrintLayers:
    """Beads of the part as they lie on the bed, the leaks and the thinnest seal.

    Args:
        sliced: The part, as its file has it, on the bed.
        leaks: Its leak test; places are in the part's own coordinates.
    """
    beads = sliced.gcode.beads
    beads = beads.chosen(np.flatnonzero(beads.of_part))
    beads = beads.chosen(np.argsort(beads.layer, kind="stable"))
    tops, layer = np.unique(beads.top, return_inverse=True)
    return PrintLayers(
        start=beads.start,
        end=beads.end,
        width=beads.width,
        kind=beads.kind,
        layer=layer,
        tops=tops,
        kind_names=KIND_NAMES,
        marks=tuple(_marks(sliced, leaks, tops)),
        air=None if leaks.view is None else _air(leaks.view, tops),
    )


def _marks(sliced: Sliced, leaks: LeakTest, tops: Floats) -> Iterator[LayerMark]:
    for leak in leaks.leaks:
        at_least = "at least " if leak.at_least else ""
        text = f"leak, {at_least}{leak.width:.2f} mm wide"
        if leak.width == 0:
            text = f"beads overlap by {(1 - leak.ratio) * leaks.line_width:.2f} mm only"
        yield _mark(sliced, leak.place, tops, text, "fail" if leak.width else "warn")
    depth = leaks.depth
    if depth.place is not None and not leaks.leaks:
        text = f"thinnest seal, {depth.lines:.2f} lines"
        yield _mark(sliced, depth.place, tops, text, _severity(leaks))


def _mark(
    sliced: Sliced,
    place: tuple[float, float, float],
    tops: Floats,
    text: str,
    severity: Severity,
) -> LayerMark:
    x, y, z = sliced.placement.to_gcode(np.array([place]))[0].tolist()
    return LayerMark(x, y, _layer_at(z, tops), text, severity)


def _severity(leaks: LeakTest) -> Severity:
    """Of the thinnest seal: what its rule says."""
    verdicts = {rule.verdict for rule in leaks.rules if rule.rule == "printed_depth"}
    if "fail" in verdicts:
        return "fail"
    return "warn" if "warn" in verdicts else "info"


def _air(view: LayerView, tops: Floats) -> AirMap:
    from printers.leak_test.picture import AIR_NAMES

    rows, columns = view.air.shape
    x, y = (each - view.voxel / 2 for each in view.corner)
    across, up = columns * view.voxel, rows * view.voxel
    corners = np.array([[x, y], [x + across, y], [x, y + up]])
    return AirMap(_layer_at((view.bottom + view.top) / 2, tops), corners, view.air, AIR_NAMES)


def _layer_at(height: float, tops: Floats) -> int:
    """Number of the layer that holds a height above the bed, mm."""
    return min(int(np.searchsorted(tops, height - 1e-6)), len(tops) - 1)
