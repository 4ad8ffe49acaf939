"""Draw the silicone actuator of ``examples/pneunet.py`` at rest, before and behind its knee.

    python docs/pneunet_picture.py docs/pneunet.png

Needs the extra ``pictures`` (PyVista).
"""

from __future__ import annotations

import runpy
import sys
from pathlib import Path

import numpy as np
import pyvista as pv

from bellows_design.own_body.analysis.evaluate import evaluate
from solver import Solution, nodal_von_mises

EXAMPLE = Path(__file__).parents[1] / "examples/pneunet.py"


def surface_of(solution: Solution, displacement: np.ndarray) -> pv.PolyData:
    """Both halves after a displacement of the nodes, coloured by von Mises stress, MPa."""
    mesh = solution.problem.mesh
    cells = {pv.CellType.QUADRATIC_TETRA: mesh.tets[:, [0, 1, 2, 3, 4, 5, 6, 7, 9, 8]]}
    half = pv.UnstructuredGrid(cells, mesh.nodes + displacement)
    half["von Mises stress, kPa"] = 1e3 * nodal_von_mises(solution)
    half = half.extract_surface(nonlinear_subdivision=2, algorithm=None)
    return half.merge(half.reflect((0, 1, 0)))


def draw(target: str, size: float = 5.0) -> None:
    """Three views side by side, written to ``target``."""
    found = evaluate(runpy.run_path(str(EXAMPLE))["pneunet"](size), meshes=1)
    states = (*found.computation.finest.at_stops, found.computation.finest)
    chosen = (0, len(states) // 3, len(states) - 1)
    plotter = pv.Plotter(off_screen=True, shape=(1, 3), window_size=(2100, 760), border=False)
    for column, place in enumerate(chosen):
        state, read = states[place], found.curve[place]
        plotter.subplot(0, column)
        surface = surface_of(state, state.displacement)
        bar = {"color": "black", "fmt": "%.0f", "title_font_size": 22, "label_font_size": 20}
        limits = (0.0, float(np.quantile(surface["von Mises stress, kPa"], 0.99)))
        plotter.add_mesh(surface, cmap="turbo", clim=limits, scalar_bar_args=bar)
        label = f"{1e3 * read.pressure_mpa:.0f} kPa, {read.bending_angle_deg:.0f}° at the tip"
        plotter.add_text(label, "upper_left", font_size=14, color="black")
        plotter.camera_position = [(-30, -150, 60), (25, 0, 0), (0, 0, 1)]
    plotter.set_background("white", all_renderers=True)
    plotter.screenshot(target)


if __name__ == "__main__":
    draw(sys.argv[1])
