"""Draw what stands for an actuator: its cell, what holds the cell, and the chain of cells.

    python docs/unit_cell_picture.py finger docs/unit-cell.png

Sections at y = 0, from the numbers of a design alone; nothing is solved. Needs Matplotlib.
"""

from __future__ import annotations

import sys

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Polygon, Rectangle
from numpy.typing import NDArray

from bellows_design import BellowsParameters, load_design

RUBBER, AIR, CELL = "#e8a33d", "#dceaf5", "#b5401f"
TURN = 22.0
"""Degrees that the section between two cells turns in the drawing of the chain."""

Points = NDArray[np.float64]


def half_outline(bellows: BellowsParameters) -> Points:
    """Rubber of half a bubble from its middle, x = 0, to the middle of the gap, (n, 2), mm."""
    end, floor = bellows.pitch / 2, bellows.tendon_thickness
    roof, top = bellows.tendon_height - floor, bellows.bubble_height
    chamber, wall = bellows.chamber_length / 2, bellows.bubble_length / 2
    upper = top - bellows.bubble_thickness
    return np.array(
        [
            *((0, 0), (end, 0), (end, floor), (0, floor), (0, upper), (chamber, upper)),
            *((chamber, roof), (end, roof), (end, bellows.tendon_height)),
            *((wall, bellows.tendon_height), (wall, top), (0, top)),
        ]
    )


def rubber(bellows: BellowsParameters) -> tuple[Points, Points]:
    """The cell's rubber as two polygons: the floor, and what lies above the channel, mm."""
    points = half_outline(bellows)
    return points[:4], points[4:]


def mirrored(points: Points) -> Points:
    """The other half of the bubble."""
    return points * (-1, 1)


def moved(points: Points, angle: float, place: Points) -> Points:
    """Turned by ``angle`` (degrees, towards -z) about the origin, then moved."""
    cos, sin = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    return points @ np.array([[cos, -sin], [sin, cos]]) + place


def draw_bubble(axes: Axes, bellows: BellowsParameters, angle: float, place: Points) -> None:
    """A bubble and half of the gap on either side."""
    for polygon in rubber(bellows):
        for half in (polygon, mirrored(polygon)):
            axes.add_patch(Polygon(moved(half, angle, place), facecolor=RUBBER, edgecolor="none"))


def whole(axes: Axes, bellows: BellowsParameters) -> None:
    """The actuator, with the cell that repeats in it."""
    for middle in bellows.bubble_middles:
        draw_bubble(axes, bellows, 0.0, np.array([middle, 0.0]))
    height = bellows.tendon_height
    ends = ((0.0, bellows.first_gap_middle), (bellows.bubble_middles[-1], bellows.length))
    for start, stop in ends:
        axes.add_patch(Rectangle((start, 0), stop - start, height, facecolor=RUBBER, zorder=-1))
    middle = bellows.bubble_middles[len(bellows.bubble_middles) // 2]
    size = bellows.pitch / 2, bellows.bubble_height + 2
    axes.add_patch(Rectangle((middle, -1), *size, fill=False, edgecolor=CELL, linewidth=2.5))
    axes.set_title("an actuator of bubbles that deform alike")
    axes.set_xlim(-2, bellows.length + 2)
    axes.set_ylim(-6, bellows.bubble_height + 8)


def cell(axes: Axes, bellows: BellowsParameters) -> None:
    """The cell, and what holds it."""
    end, top = bellows.pitch / 2, bellows.bubble_height
    axes.add_patch(Rectangle((0, 0), end, top, facecolor=AIR, zorder=-2))
    axes.add_patch(Rectangle((bellows.bubble_length / 2, bellows.tendon_height), end, top,
                             facecolor="white", zorder=-1))  # fmt: skip
    for polygon in rubber(bellows):
        axes.add_patch(Polygon(polygon, facecolor=RUBBER, edgecolor="#7a5210"))
    for x, text, side in (
        (0.0, "bubble_middle:\nno motion\nalong x", "right"),
        (end, "gap_middle:\nstays plane,\ntilts and shifts", "left"),
    ):
        axes.plot([x, x], [-1.5, top + 1.5], color=CELL, linewidth=2.5)
        offset = -0.3 if side == "right" else 0.3
        axes.text(x + offset, top / 2, text, ha=side, va="center")
    axes.text(end / 2, -3.5, "cavity: pressure; symmetry at y = 0", ha="center")
    axes.set_title("the cell: a quarter of a bubble")
    axes.set_xlim(-6, end + 6)
    axes.set_ylim(-6, top + 8)


def chain(axes: Axes, bellows: BellowsParameters, count: int = 4) -> None:
    """Cells one after the other, each turned by what the one before has turned."""
    place, angle, half = np.zeros(2), 0.0, np.array([bellows.pitch / 2, 0.0])
    for _ in range(count):
        angle += TURN / 2
        middle = moved(half, angle, place)
        draw_bubble(axes, bellows, angle, middle)
        place = moved(half, angle, middle)
        angle += TURN / 2
        line = np.array([[0.0, -2.0], [0.0, bellows.bubble_height + 2]])
        axes.plot(*moved(line, angle, place).T, color=CELL, linewidth=1.5)
    axes.set_title("the chain: every cell turns by the same angle")
    axes.set_xlim(-8, bellows.pitch * count + 14)
    axes.set_ylim(-22, bellows.bubble_height + 8)


def draw(name: str, target: str) -> None:
    """The three drawings side by side, written to ``target``."""
    bellows = load_design(name).bellows
    figure = Figure(figsize=(14, 4.4), dpi=110, layout="constrained")
    panels = figure.subplots(1, 3, width_ratios=(2.2, 1.5, 1.6))
    for axes, part in zip(panels, (whole, cell, chain), strict=True):
        part(axes, bellows)
        axes.set_aspect("equal")
        axes.axis("off")
    figure.savefig(target)


if __name__ == "__main__":
    draw(*sys.argv[1:3])
