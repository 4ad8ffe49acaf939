"""Draw half of the silicone actuator of ``examples/pneunet.py`` at three volumes of its air.

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

STRESS = "von Mises stress, kPa"

SHOWN = (0, 3, 11)
"""Places on the curve."""

EXAMPLE = Path(__file__).parents[1] / "examples/pneunet.py"


def surface_of(solution: Solution) -> pv.PolyData:
    """The deformed half, cut open at y = 0, with its von Mises stress, kPa."""
    mesh = solution.problem.mesh
    cells = {pv.CellType.QUADRATIC_TETRA: mesh.tets[:, [0, 1, 2, 3, 4, 5, 6, 7, 9, 8]]}
    half = pv.UnstructuredGrid(cells, mesh.nodes + solution.displacement)
    half[STRESS] = 1e3 * nodal_von_mises(solution)
    return half.extract_surface(nonlinear_subdivision=2, algorithm=None)


def draw(target: str, size: float = 5.0) -> None:
    """Three views side by side, written to ``target``."""
    found = evaluate(runpy.run_path(str(EXAMPLE))["pneunet"](size), meshes=1)
    states = (*found.computation.finest.at_stops, found.computation.finest)
    plotter = pv.Plotter(off_screen=True, shape=(1, 3), window_size=(2100, 800), border=False)
    surfaces = [surface_of(states[place]) for place in SHOWN]
    highest = float(np.quantile(surfaces[-1][STRESS], 0.98))
    for column, (place, surface) in enumerate(zip(SHOWN, surfaces, strict=True)):
        read = found.curve[place]
        plotter.subplot(0, column)
        bar = {"color": "black", "fmt": "%.0f", "title_font_size": 24, "label_font_size": 22}
        plotter.add_mesh(
            surface,
            cmap="turbo",
            clim=(0, highest),
            ambient=0.4,
            show_scalar_bar=column == 1,
            scalar_bar_args=bar,
        )
        label = f"{1e3 * read.pressure_mpa:.0f} kPa, tip turned by {read.bending_angle_deg:.0f}°"
        plotter.add_text(label, position="upper_left", font_size=15, color="black")
        plotter.camera_position = [(2, -140, 38), (28, 5, -2), (0, 0, 1)]
    plotter.set_background("white", all_renderers=True)
    plotter.screenshot(target)


if __name__ == "__main__":
    draw(sys.argv[1])
