"""What a viewer shows: surfaces and lines that may move, with values at their points."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from bellows_design.errors import BellowsError
from bellows_design.web.colours import require_colour

Reals: TypeAlias = NDArray[np.floating[Any]]
Integers: TypeAlias = NDArray[np.integer[Any]]


class SceneError(BellowsError):
    """Surfaces, fields or options that a viewer cannot show."""


@dataclass(frozen=True, eq=False)
class Field:
    """Values at the points of a surface, shown as colours.

    Attributes:
        name: Title of the legend.
        unit: Beside it; empty for a plain number.
        values: At every point, in every frame or the same in all; NaN where there is no value.
            *Shape:* `(k, n)` or `(n,)`
        low, high: Ends of the colour scale; None for the least and the greatest value.
        limit: Marked on the legend; None for no mark.
        reverse: Whether small values are the ones that stand out, as with a wall's thickness.
    """

    name: str
    unit: str
    values: Reals
    low: float | None = None
    high: float | None = None
    limit: float | None = None
    reverse: bool = False


@dataclass(frozen=True, eq=False)
class Surface:
    """Triangles that are seen from outside, counter-clockwise; `k` frames of `n` points.

    Attributes:
        name: By which it is switched on and off.
        triangles: Numbers of points.
            *Shape:* `(m, 3)`
        positions: Of the points, mm; one frame if it does not move.
            *Shape:* `(k, n, 3)`, or `(n, 3)` for one frame
        fields: Values at the points.
        frame_labels: What each frame is, such as its pressure; empty or `k` texts.
        colour: `#rrggbb`; empty for the page's own.
        opacity: From 0 to 1.
        visible: Whether it is shown at first.
    """

    name: str
    triangles: Integers
    positions: Reals
    fields: tuple[Field, ...] = ()
    frame_labels: tuple[str, ...] = ()
    colour: str = ""
    opacity: float = 1.0
    visible: bool = True


@dataclass(frozen=True, eq=False)
class Lines:
    """Straight lines, drawn one pixel wide.

    Attributes:
        name: By which it is switched on and off.
        segments: Numbers of the points at both ends.
            *Shape:* `(m, 2)`
        positions: Of the points, mm; one frame if it does not move.
            *Shape:* `(k, n, 3)`, or `(n, 3)` for one frame
        colour: `#rrggbb`; empty for the page's own.
        visible: Whether they are shown at first.
    """

    name: str
    segments: Integers
    positions: Reals
    colour: str = ""
    visible: bool = True


Shown: TypeAlias = Surface | Lines


def frames_of(shown: Shown) -> Reals:
    """Positions in all frames, mm. *Shape:* `(k, n, 3)`."""
    positions = np.asarray(shown.positions)
    return positions[None] if positions.ndim == 2 else positions


def cells_of(shown: Shown) -> Integers:
    """Triangles `(m, 3)` or segments `(m, 2)`."""
    return np.asarray(shown.triangles if isinstance(shown, Surface) else shown.segments)


def require_scene(surfaces: Sequence[Shown]) -> None:
    """Raise `SceneError`, a sentence that names the surface, if a viewer cannot show these."""
    names = [shown.name for shown in surfaces]
    if not names:
        raise SceneError("there is nothing to show: the scene has no surface.")
    for first, second in pairwise(sorted(names)):
        if first == second:
            raise SceneError(f"two surfaces have the same name, “{first}”.")
    for shown in surfaces:
        _require_geometry(shown)
        if isinstance(shown, Surface):
            _require_labels(shown)
            for field in shown.fields:
                _require_field(shown, field)


def _require_geometry(shown: Shown) -> None:
    positions, cells = frames_of(shown), cells_of(shown)
    corners = 3 if isinstance(shown, Surface) else 2
    if positions.ndim != 3 or positions.shape[2] != 3 or not positions.size:
        raise _error(shown, f"its positions have the shape {positions.shape}, not (k, n, 3)")
    if cells.ndim != 2 or cells.shape[1] != corners or not len(cells):
        raise _error(shown, f"its cells have the shape {cells.shape}, not (m, {corners})")
    if not np.issubdtype(cells.dtype, np.integer):
        raise _error(shown, f"its cells are of type {cells.dtype}, not whole numbers")
    if cells.min() < 0 or cells.max() >= positions.shape[1]:
        worst = int(cells.min() if cells.min() < 0 else cells.max())
        raise _error(shown, f"a cell names point {worst}, of {positions.shape[1]}")
    if not np.isfinite(positions).all():
        raise _error(shown, "a coordinate is not a finite number")
    require_colour(shown.colour)


def _require_labels(surface: Surface) -> None:
    count = len(frames_of(surface))
    if surface.frame_labels and len(surface.frame_labels) != count:
        raise _error(surface, f"it has {len(surface.frame_labels)} labels for {count} frames")
    if not 0 <= surface.opacity <= 1:
        raise _error(surface, f"its opacity is {surface.opacity}, not between 0 and 1")


def _require_field(surface: Surface, field: Field) -> None:
    frames, points, _ = frames_of(surface).shape
    values = np.asarray(field.values)
    if values.shape not in ((points,), (1, points), (frames, points)):
        raise _error(
            surface,
            f"its field “{field.name}” has the shape {values.shape}, neither ({points},) nor "
            f"({frames}, {points})",
        )
    if np.isinf(values).any():
        raise _error(surface, f"its field “{field.name}” has an infinite value")
    for name in ("low", "high", "limit"):
        bound = getattr(field, name)
        if bound is not None and not np.isfinite(bound):
            raise _error(surface, f"“{name}” of its field “{field.name}” is {bound}")
    if [one.name for one in surface.fields].count(field.name) > 1:
        raise _error(surface, f"two of its fields are named “{field.name}”")


def _error(shown: Shown, what: str) -> SceneError:
    return SceneError(f"“{shown.name}” cannot be shown: {what}.")
