"""Draw the README's picture: a design as printed, cut open, and bent under its pressure.

    python docs/picture.py finger docs/picture.png

Needs the extra ``pictures`` (PyVista).
"""

from __future__ import annotations

import sys

import numpy as np
import pyvista as pv

from bellows_design import load_design
from bellows_design.evaluation import evaluate
from bellows_design.pipeline import build_part
from solver import nodal_von_mises


def part_surface(name: str) -> pv.PolyData:
    """The printed part as a surface, mm."""
    mesh = build_part(load_design(name)).mesh
    return pv.PolyData.from_regular_faces(mesh.vertices, mesh.triangles)


def bent_surface(name: str) -> pv.PolyData:
    """The whole actuator at its design pressure, coloured by von Mises stress, MPa."""
    solution = evaluate(load_design(name)).finest
    mesh = solution.problem.mesh
    cells = {pv.CellType.QUADRATIC_TETRA: mesh.tets[:, [0, 1, 2, 3, 4, 5, 6, 7, 9, 8]]}
    half = pv.UnstructuredGrid(cells, mesh.nodes + solution.displacement)
    half["von Mises stress, MPa"] = nodal_von_mises(solution)
    half = half.extract_surface(nonlinear_subdivision=2)
    return half.merge(half.reflect((0, 1, 0)))


def draw(name: str, target: str) -> None:
    """Three views side by side, written to ``target``."""
    part, bent = part_surface(name), bent_surface(name)
    plotter = pv.Plotter(off_screen=True, shape=(1, 3), window_size=(2100, 700), border=False)
    views = ((part, {"color": "#e8a33d"}), (part.clip("y", invert=False), {"color": "#e8a33d"}))
    for column, (surface, style) in enumerate(views):
        plotter.subplot(0, column)
        plotter.add_mesh(surface, smooth_shading=True, split_sharp_edges=True, **style)
        plotter.camera_position = [(-40, -110, 75), np.array(surface.center), (0, 0, 1)]
        plotter.camera.zoom(1.2)
    plotter.subplot(0, 2)
    plotter.add_mesh(bent, cmap="turbo", scalar_bar_args={"color": "black"})
    plotter.camera_position = [(-20, -130, 40), np.array(bent.center), (0, 0, 1)]
    plotter.set_background("white", all_renderers=True)
    plotter.screenshot(target)


if __name__ == "__main__":
    draw(*sys.argv[1:3])
