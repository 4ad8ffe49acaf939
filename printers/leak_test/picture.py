"""A picture of the layer with the leak, or with the thinnest seal: what it shows, and how."""

from __future__ import annotations

from io import BytesIO
from typing import Any

import numpy as np

from printers.arrays import Floats, Ints
from printers.errors import PrintersError
from printers.gcode.beads import KIND_NAMES, Beads
from printers.leak_test.field import Field
from printers.leak_test.flood import CAVITY, CLOSED, OUTSIDE
from printers.leak_test.frames import as_place, moved
from printers.leak_test.painting import AIR, Levels
from printers.leak_test.result import LayerView, LeakTest
from printers.leak_test.widest_path import WidestPath, narrowest
from printers.report import place

SIZE = 9.0  # inches
DOTS = 110
VIEWED = 8.0  # mm around the place
ROUND = 8  # straight pieces of a bead's round end

AIR_COLOURS = ("#e8e0d0", "#9ecae1", "#ffffff", "#bdbdbd", "#f4a3a3")
AIR_NAMES = ("beads", "air of the cavity", "air outside", "plug", "void between beads")
BEAD_COLOURS = {
    "external perimeter": "#d95f02",
    "perimeter": "#fdae6b",
    "solid infill": "#7fbc7f",
    "infill": "#b8dcb8",
    "bridge": "#8073ac",
    "gap fill": "#e7298a",
}


def leak_picture(test: LeakTest) -> bytes:
    """The picture as a PNG.

    Raises:
        PrintersError: Matplotlib is not installed, or the test has no layer to show.
    """
    if test.view is None:
        raise PrintersError("the leak test has no layer to draw: no path leads to the outside")
    try:
        from matplotlib.figure import Figure
    except ImportError:
        raise PrintersError(
            "pictures need Matplotlib: pip install 'bellows-design[pictures]'"
        ) from None
    figure = Figure(figsize=(SIZE, SIZE), dpi=DOTS, layout="constrained")
    axes = figure.add_subplot()
    _draw(axes, test.view)
    axes.set_title(_title(test, test.view), fontsize=11)
    axes.set_xlabel("x of the part, mm")
    axes.set_ylabel("y of the part, mm")
    made = BytesIO()
    figure.savefig(made, format="png", metadata={"Software": None})
    return made.getvalue()


def layer_view(
    field: Field,
    beads: Beads,
    path: tuple[WidestPath, Ints],
    way: Floats,
    to_part: Floats,
) -> LayerView | None:
    """The layer of the leak, or of the thinnest seal."""
    widest, cells = path
    points = field.place_of(cells) if len(cells) else way
    if not len(points):
        return None
    middle = field.place_of(np.array([narrowest(field, cells)]))[0] if len(cells) else None
    middle = points[len(points) // 2] if middle is None else middle
    layer = field.layer_at(middle[2])
    bottom, top = field.heights[layer], field.heights[layer + 1]
    height = (bottom + top) / 2
    there = (beads.top > height) & (beads.top - beads.height < height)
    near = np.minimum(beads.start, beads.end) <= middle[:2] + VIEWED
    near &= np.maximum(beads.start, beads.end) >= middle[:2] - VIEWED
    rows, columns = _window(field, middle)
    marks = widest.marks.reshape(field.levels.shape)[layer][rows, columns]
    levels = field.levels[layer][rows, columns]
    x, y = field.corner
    corner = x + columns.start * field.voxel, y + rows.start * field.voxel
    return LayerView(
        beads=beads.chosen(there & near.all(axis=1)),
        bottom=float(bottom),
        top=float(top),
        corner=corner,
        voxel=field.voxel,
        air=_kinds(marks, levels, widest.ratio, field),
        path=points,
        place=as_place(middle),
        to_part=to_part,
    )


def _kinds(marks: Levels, levels: Levels, ratio: float, field: Field) -> Ints:
    """The kinds of a `LayerView` in a layer.

    Air that is no wider than the leak bears no mark; along its walls it belongs to what is beside.
    """
    from scipy.ndimage import binary_dilation

    kinds = np.where(levels >= AIR, 4, 0).astype(np.int64)
    skin = int(np.ceil(max(ratio - 1, 0.0) * field.line_width / 2 / field.voxel)) + 1
    for kind, mark in ((1, CAVITY), (2, OUTSIDE)):
        wider = binary_dilation(marks == mark, iterations=skin, mask=kinds == 4)
        kinds[wider | (marks == mark)] = kind
    kinds[marks == CLOSED] = 3
    return kinds


def _window(field: Field, middle: Floats) -> tuple[slice, slice]:
    slices = []
    for axis, count in ((1, field.levels.shape[1]), (0, field.levels.shape[2])):
        place = (middle[axis] - field.corner[axis]) / field.voxel
        reach = VIEWED / field.voxel
        slices.append(slice(max(int(place - reach), 0), min(int(place + reach) + 1, count)))
    return slices[0], slices[1]


def _title(test: LeakTest, view: LayerView) -> str:
    where = moved(view.to_part, np.asarray(view.place)[None])[0]
    low = moved(view.to_part, np.array([[0, 0, view.bottom], [0, 0, view.top]]))[:, 2]
    layer = f"layer from z = {low[0]:.2f} to {low[1]:.2f} mm of the part"
    if test.leaks:
        what = f"{test.verdict}: {test.width:.2f} mm wide (r* {test.ratio:.2f}) at {place(where)}"
    else:
        what = f"{test.verdict} (r* {test.ratio:.2f}); thinnest seal {test.depth.lines:.2f} lines"
    return f"{what}\n{layer}"


def _draw(axes: Any, view: LayerView) -> None:
    from matplotlib.collections import PolyCollection
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    handles: list[Any] = _draw_air(axes, view)
    outlines, kinds = _outlines(view), np.array(KIND_NAMES)[view.beads.kind]
    for name in dict.fromkeys(kinds.tolist()):
        colour = BEAD_COLOURS.get(name, "#cccccc")
        chosen = [outline for outline, kind in zip(outlines, kinds, strict=True) if kind == name]
        shape: dict[str, Any] = {
            "facecolors": colour,
            "edgecolors": "#333333",
            "linewidths": 0.3,
            "alpha": 0.75,
        }
        axes.add_collection(PolyCollection(chosen, **shape))
        handles.append(Patch(color=colour, label=name))
    path = moved(view.to_part, view.path)
    axes.plot(path[:, 0], path[:, 1], color="#c00000", linewidth=2)
    (x, y, _) = moved(view.to_part, np.asarray(view.place)[None])[0]
    axes.plot([x], [y], "o", markersize=16, markeredgecolor="#c00000", markerfacecolor="none")
    handles.append(Line2D([], [], color="#c00000", label="path and its place"))
    axes.legend(handles=handles, loc="upper right", fontsize=8)
    reach = _reach(view)
    axes.set_xlim(x - reach, x + reach)
    axes.set_ylim(y - reach, y + reach)
    axes.set_aspect("equal")


def _reach(view: LayerView) -> float:
    """mm shown on each side of the place: what the path takes, and a few lines."""
    extent = float(np.ptp(view.path[:, :2], axis=0).max()) if len(view.path) else 0.0
    return min(max(3.0, 0.75 * extent), min(view.air.shape) * view.voxel / 2)


def _draw_air(axes: Any, view: LayerView) -> list[Any]:
    from matplotlib.colors import BoundaryNorm, ListedColormap
    from matplotlib.patches import Patch

    rows, columns = (np.arange(count + 1) - 0.5 for count in view.air.shape)
    x, y = np.meshgrid(view.corner[0] + columns * view.voxel, view.corner[1] + rows * view.voxel)
    flat = np.column_stack([x.ravel(), y.ravel(), np.full(x.size, view.bottom)])
    corners = moved(view.to_part, flat).reshape(*x.shape, 3)
    colours = ListedColormap(AIR_COLOURS)
    norm = BoundaryNorm(np.arange(len(AIR_COLOURS) + 1) - 0.5, len(AIR_COLOURS))
    axes.pcolormesh(
        corners[..., 0], corners[..., 1], view.air, cmap=colours, norm=norm, rasterized=True
    )
    shown = np.unique(view.air)
    return [
        Patch(facecolor=AIR_COLOURS[kind], edgecolor="#333333", label=AIR_NAMES[kind])
        for kind in shown.tolist()
    ]


def _outlines(view: LayerView) -> list[Floats]:
    """Outline (n, 2) of every bead in the part's coordinates: a rectangle with round ends."""
    outlines = _rounded(view.beads)
    height = np.full((*outlines.shape[:2], 1), view.bottom)
    points = np.concatenate([outlines, height], axis=2).reshape(-1, 3)
    return list(moved(view.to_part, points)[:, :2].reshape(outlines.shape))


def _rounded(beads: Beads) -> Floats:
    angle = np.arctan2(*(beads.end - beads.start).T[::-1])[:, None]
    turn = np.linspace(-np.pi / 2, np.pi / 2, ROUND + 1)
    half = beads.width[:, None, None] / 2
    ahead = np.stack([np.cos(angle + turn), np.sin(angle + turn)], axis=2) * half
    return np.concatenate([beads.end[:, None] + ahead, beads.start[:, None] - ahead], axis=1)
