"""The finger's shapes in a scene, with what stands around it."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from bellows_design.design.scenes.blocked import Blocked
from bellows_design.design.scenes.grip import Grip
from bellows_design.reports.plots import COLOURS, one_axes

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from bellows_design.design.design import Design
    from bellows_design.design.features.fingertip import Fingertip
    from bellows_design.force.result import ForceCurve, ForceReading

OBJECT = "0.75"
"""Grey of what stands around the finger."""


def draw_scene(found: ForceCurve, path: Path) -> None:
    """The lower side at every pressure, objects, and dots where they press, as PNG.

    Written completely or not at all. Raises ``DesignError`` without matplotlib.
    """
    with one_axes(f"{found.design.name}: {found.scene}", path) as axes:
        _surroundings(axes, found)
        count = len(found.curve)
        for number, reading in enumerate(found.curve):
            _shape(axes, reading, (number + 1) / count)
            _pad(axes, found.design.fingertip, reading, (number + 1) / count)
        axes.set_aspect("equal", adjustable="datalim")
        axes.set(xlabel="x, mm", ylabel="z, mm")
        axes.grid(True, linewidth=0.4, alpha=0.4)
        axes.legend(fontsize="small", loc="best")


def _shape(axes: Axes, reading: ForceReading, strength: float) -> None:
    """The lower side, darker the higher the pressure; dots where objects press."""
    line = tuple(zip(*reading.shape, strict=True))
    axes.plot(
        *line, "-", color=COLOURS[0], alpha=_alpha(strength), linewidth=1.8,
        label=f"{reading.pressure_mpa:.3g} MPa",
    )  # fmt: skip
    if reading.touched:
        axes.plot(*zip(*reading.touched, strict=True), ".", color=COLOURS[1], markersize=7)


def _alpha(strength: float) -> float:
    return 0.25 + 0.75 * strength


def _pad(axes: Axes, pad: Fingertip | None, reading: ForceReading, strength: float) -> None:
    """The fingertip's side, whose lower edge ends the lower side."""
    if pad is None:
        return
    from matplotlib.patches import Rectangle

    degrees = 180 - reading.tip_angle_deg
    axes.add_patch(
        Rectangle(
            reading.tip_position_mm, pad.length, -pad.thickness, angle=degrees,
            color=COLOURS[0], alpha=0.3 * _alpha(strength), linewidth=0,
        )
    )  # fmt: skip


def _mount(axes: Axes, design: Design) -> None:
    """The side of the plate that is screwed down."""
    mount, port = design.mount, design.port
    if mount is None:
        return
    from matplotlib.patches import Rectangle

    length = mount.length(port)
    plate = Rectangle((-length, 0), length, mount.height(port), color=COLOURS[0], alpha=0.3)
    axes.add_patch(plate)


def _surroundings(axes: Axes, found: ForceCurve) -> None:
    scene, length = found.content, found.design.finger_length
    axes.plot([0, length], [0, 0], "--", color="0.5", linewidth=1, label="at rest")
    _mount(axes, found.design)
    if isinstance(scene, Blocked) and scene.support != "held":
        axes.axhspan(-scene.distance - 0.02 * length, -scene.distance, color=OBJECT, zorder=0)
    if isinstance(scene, Grip):
        _object(axes, scene)


def _object(axes: Axes, scene: Grip) -> None:
    """What is gripped, and the gripper's axis."""
    from matplotlib.patches import Circle, Rectangle

    axes.axhline(-scene.distance, color="0.5", linestyle=":", linewidth=1)
    half, centre = scene.size / 2, (scene.place, -scene.distance)
    if scene.object == "box":
        height = scene.size if scene.height is None else scene.height
        corner = (centre[0] - height / 2, centre[1] - half)
        axes.add_patch(Rectangle(corner, height, scene.size, color=OBJECT, zorder=0))
    else:
        axes.add_patch(Circle(centre, half, color=OBJECT, zorder=0))
