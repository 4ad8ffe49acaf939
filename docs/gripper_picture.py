"""Draw the picture of mount, fingertip and gripper.

    python docs/gripper_picture.py docs/gripper.png

Needs the extra ``pictures`` (PyVista).
"""

from __future__ import annotations

import runpy
import sys
from pathlib import Path
from typing import Any

import cadquery as cq
import numpy as np
import pyvista as pv

from bellows_design import load_design
from bellows_design.design import Design, with_overrides
from bellows_design.geometry.tessellation import tessellate
from bellows_design.pipeline import build_part

EXAMPLES = Path(__file__).parents[1] / "examples"
FINGER, PLATE = "#e8a33d", "#8a97a3"


def surface(solid: cq.Shape) -> pv.PolyData:
    """Of a solid, mm."""
    mesh = tessellate(solid)
    return pv.PolyData.from_regular_faces(mesh.vertices, mesh.triangles)


def show(plotter: pv.Plotter, solid: cq.Shape, colour: str) -> None:
    """Add a solid with its sharp edges."""
    plotter.add_mesh(
        surface(solid), color=colour, smooth_shading=True, split_sharp_edges=True, feature_angle=30
    )


def look(plotter: pv.Plotter, column: int, place: tuple[float, float, float]) -> None:
    """From a place, in the directions of the part, at all that column shows."""
    plotter.subplot(0, column)
    centre = np.array(plotter.renderer.center)
    plotter.camera_position = [centre + place, centre, (0, 0, 1)]
    plotter.reset_camera()
    plotter.camera.zoom(1.05)


def draw(target: str) -> None:
    """Flange and pad from above and below, a foot, and three fingers on their plate."""
    example: dict[str, Any] = runpy.run_path(str(EXAMPLES / "gripper.py"))
    design = load_design(EXAMPLES / "finger_gripping.toml")
    foot = with_overrides(design, ["mount.kind=foot"])
    plotter = pv.Plotter(off_screen=True, shape=(1, 4), window_size=(1600, 400), border=False)
    views = ((design, (-60, -80, 60)), (design, (70, -60, -80)), (foot, (-60, -80, 60)))
    for column, (each, place) in enumerate(views):
        plotter.subplot(0, column)
        show(plotter, solid_of(each), FINGER)
        look(plotter, column, place)
    gripper = example["Gripper"](design)
    plotter.subplot(0, 3)
    show(plotter, gripper.plate(), PLATE)
    for place in gripper.places:
        show(plotter, solid_of(design).moved(cq.Location(place)), FINGER)
    look(plotter, 3, (80, -130, 70))
    plotter.set_background("white", all_renderers=True)
    plotter.screenshot(target)


def solid_of(design: Design) -> cq.Solid:
    """The printed part."""
    return build_part(design).solid


if __name__ == "__main__":
    draw(sys.argv[1])
