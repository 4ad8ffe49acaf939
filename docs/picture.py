"""Draw the README's picture: a design as printed, cut open, and bent under its pressure.

    python docs/picture.py finger docs/picture.png

Needs the extra ``pictures`` (PyVista).
"""

from __future__ import annotations

import sys

import cadquery as cq
import numpy as np
import pyvista as pv

from bellows_design import load_design
from bellows_design.analysis.evaluate import evaluate
from bellows_design.geometry.actuator import printed_part
from bellows_design.geometry.tessellation import tessellate
from solver import nodal_von_mises


def part_surfaces(name: str) -> tuple[pv.PolyData, pv.PolyData]:
    """The printed part, whole and cut open at its plane of symmetry, as surfaces, mm."""
    design = load_design(name)
    features = design.mount, design.fingertip
    whole = printed_part(design.bellows, design.indent, design.port, *features).solid
    front = cq.Solid.makeBox(1000, 1000, 1000, cq.Vector(-500, -1000, -500))
    opened = whole.cut(front).Solids()[0]
    meshes = (tessellate(whole), tessellate(opened))
    whole_surface, opened_surface = (
        pv.PolyData.from_regular_faces(mesh.vertices, mesh.triangles) for mesh in meshes
    )
    return whole_surface, opened_surface


def bent_surface(name: str) -> pv.PolyData:
    """The whole actuator at its design pressure, coloured by von Mises stress, MPa."""
    solution = evaluate(load_design(name), "half").computation.finest
    mesh = solution.problem.mesh
    cells = {pv.CellType.QUADRATIC_TETRA: mesh.tets[:, [0, 1, 2, 3, 4, 5, 6, 7, 9, 8]]}
    half = pv.UnstructuredGrid(cells, mesh.nodes + solution.displacement)
    half["von Mises stress, MPa"] = nodal_von_mises(solution)
    half = half.extract_surface(nonlinear_subdivision=2, algorithm=None)
    return half.merge(half.reflect((0, 1, 0)))


def draw(name: str, target: str) -> None:
    """Three views side by side, written to ``target``."""
    plotter = pv.Plotter(off_screen=True, shape=(1, 3), window_size=(2100, 620), border=False)
    for column, surface in enumerate(part_surfaces(name)):
        plotter.subplot(0, column)
        plotter.add_mesh(surface, color="#e8a33d", smooth_shading=True, split_sharp_edges=True)
        plotter.camera_position = [(-45, -110, 75), np.array(surface.center), (0, 0, 1)]
        plotter.camera.zoom(1.35)
    plotter.subplot(0, 2)
    bent = bent_surface(name)
    bar = {"color": "black", "fmt": "%.1f", "title_font_size": 22, "label_font_size": 20}
    plotter.add_mesh(bent, cmap="turbo", scalar_bar_args=bar)
    plotter.camera_position = [(-20, -130, 40), np.array(bent.center), (0, 0, 1)]
    plotter.camera.zoom(1.1)
    plotter.set_background("white", all_renderers=True)
    plotter.screenshot(target)


if __name__ == "__main__":
    draw(*sys.argv[1:3])
