"""Layers of a print as a slicer's G-code lays them down, packed for a browser that draws them.

The format is that of `packing`, with its own header: runs of beads that follow each other end to
end, their points in steps of 0.01 mm, so that a place is off by no more than 0.005 mm.
"""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from bellows_design.web.element import element
from bellows_design.web.packing import Arrays, deflated
from bellows_design.web.scene import Integers, Reals, SceneError

FORMAT = "bellows-layers"
VERSION = 1
STEP = 0.01
"""mm, of places and widths."""
LARGEST = 65535
"""Of 16 bit: so many steps may a print be long."""

Severity = Literal["fail", "warn", "info"]


@dataclass(frozen=True)
class LayerMark:
    """A place that is pointed at.

    Attributes:
        x, y: In the plane of the layers, mm.
        layer: Number from 0.
        text: What is there.
        severity: "fail" for a leak, "warn" for a seal that is too thin, "info" for others.
    """

    x: float
    y: float
    layer: int
    text: str
    severity: Severity


@dataclass(frozen=True, eq=False)
class AirMap:
    """Cells of air in a part of one layer.

    Attributes:
        layer: Number from 0.
        corners: Where the first cell's corner lies, the last one's of its row, and the first one's
            of the last row, mm.
            *Shape:* `(3, 2)`
        cells: Number in `names` of each.
            *Shape:* `(ny, nx)`
        names: What the numbers mean; the first is drawn as nothing.
    """

    layer: int
    corners: Reals
    cells: Integers
    names: tuple[str, ...]


@dataclass(frozen=True, eq=False)
class PrintLayers:
    """Straight beads in the order in which they are printed.

    Attributes:
        start, end: Of each bead's axis, mm, seen from above.
            *Shape:* `(n, 2)`
        width: Of each bead, mm.
            *Shape:* `(n,)`
        kind: Number in `kind_names`.
            *Shape:* `(n,)`
        layer: Number from 0, not falling.
            *Shape:* `(n,)`
        tops: Height of each layer's upper side above the bed, mm.
            *Shape:* `(k,)`
        kind_names: Such as "external perimeter".
        marks: Places that are pointed at.
        air: Cells of air that were looked at closely; None for none.
    """

    start: Reals
    end: Reals
    width: Reals
    kind: Integers
    layer: Integers
    tops: Reals
    kind_names: tuple[str, ...]
    marks: tuple[LayerMark, ...] = ()
    air: AirMap | None = None


def packed_layers(layers: PrintLayers) -> bytes:
    """The layers as the viewer's `Bellows.unpackLayers` takes them.

    Raises:
        SceneError: Arrays do not fit each other, or the print is longer than 655 mm.
    """
    _require_layers(layers)
    low = np.minimum(layers.start.min(axis=0), layers.end.min(axis=0))
    begins = _run_begins(layers)
    arrays = Arrays()
    header: dict[str, Any] = {
        "format": FORMAT,
        "version": VERSION,
        "step": STEP,
        "low": low.tolist(),
        "tops": np.round(layers.tops, 4).tolist(),
        "kind_names": list(layers.kind_names),
        "marks": [asdict(mark) for mark in layers.marks],
        "runs": len(begins),
        "beads": len(layers.start),
        "air": None if layers.air is None else _air(layers.air, arrays),
        "points": arrays.add(_points(layers, begins, low)),
        "widths": arrays.add(_steps(layers.width[:, None])),
        "lengths": arrays.add(_lengths(begins, len(layers.start))),
        "kinds": arrays.add(layers.kind[begins][:, None].astype("<u2")),
        "layers": arrays.add(layers.layer[begins][:, None].astype("<u2")),
    }
    return deflated(header, arrays)


def layers_element(
    layers: PrintLayers,
    *,
    height_px: int = 420,
    label: str = "Layers of the print",
    layer: int | None = None,
) -> str:
    """HTML of the layers with a slider over them; the page needs `viewer_script` once.

    Args:
        layers: What is shown.
        height_px: Of the picture, without the bar below it.
        label: What is shown, for those who do not see it.
        layer: Shown at first; None for that of the first mark, or the middle one.

    Raises:
        SceneError: The layers cannot be shown.
    """
    data = packed_layers(layers)
    if layer is None:
        layer = layers.marks[0].layer if layers.marks else len(layers.tops) // 2
    if not 0 <= layer < len(layers.tops):
        raise SceneError(f"there is no layer {layer}: the last one is {len(layers.tops) - 1}.")
    return element("layers", data, {"height": height_px, "label": label, "layer": layer})


def _require_layers(layers: PrintLayers) -> None:
    count = len(layers.start)
    if not count:
        raise SceneError("the print has no beads to show.")
    for name in ("end", "width", "kind", "layer"):
        if len(getattr(layers, name)) != count:
            raise SceneError(
                f"the print has {count} beads but {len(getattr(layers, name))} {name}s."
            )
    for name in ("start", "end", "width"):
        if not np.isfinite(getattr(layers, name)).all():
            raise SceneError(f"“{name}” of a bead is not a finite number.")
    if np.any(np.diff(layers.layer) < 0):
        raise SceneError("the beads are not in the order of their layers.")
    if layers.layer.max() >= len(layers.tops):
        raise SceneError(f"a bead is in layer {layers.layer.max()}, of {len(layers.tops)}.")
    everything = np.vstack([layers.start, layers.end])
    if np.ptp(everything, axis=0).max() > LARGEST * STEP:
        raise SceneError(f"the print is longer than {LARGEST * STEP:.0f} mm.")


def _run_begins(layers: PrintLayers) -> NDArray[np.int64]:
    """Numbers of the beads that do not go on from the one before."""
    apart = np.abs(layers.start[1:] - layers.end[:-1]).max(axis=1) > STEP / 4
    other = (np.diff(layers.kind) != 0) | (np.diff(layers.layer) != 0)
    return np.concatenate([[0], 1 + np.flatnonzero(apart | other)])


def _points(layers: PrintLayers, begins: NDArray[np.int64], low: Reals) -> NDArray[np.uint16]:
    """Of each run its start, then the end of each of its beads; `(runs + beads, 2)` steps."""
    return _steps(np.insert(layers.end, begins, layers.start[begins], axis=0) - low)


def _lengths(begins: NDArray[np.int64], count: int) -> NDArray[np.uint32]:
    """Beads of each run. *Shape:* `(runs, 1)`."""
    return np.diff(begins, append=count)[:, None].astype("<u4")


def _steps(lengths: Reals) -> NDArray[np.uint16]:
    return np.clip(np.rint(lengths / STEP), 0, LARGEST).astype("<u2")


def _air(air: AirMap, arrays: Arrays) -> dict[str, Any]:
    rows, columns = air.cells.shape
    return {
        "layer": air.layer,
        "corners": np.asarray(air.corners, float).tolist(),
        "rows": rows,
        "columns": columns,
        "names": list(air.names),
        "cells": arrays.add(air.cells.reshape(-1, 1).astype("<u2")),
    }
