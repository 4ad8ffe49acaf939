"""The solver on a body that is no bellows: up to which pressure does a rubber ball hold?

    python examples/balloon.py

Builds an eighth of a thick-walled sphere in CadQuery, names its faces, meshes it, follows its
equilibria through the limit point, and compares that with the closed form.
"""

from __future__ import annotations

from io import BytesIO

import cadquery as cq
import numpy as np
from scipy.integrate import quad
from scipy.optimize import minimize_scalar

from solver import Mesh, Ogden, Problem, Supports, Trace, trace
from solver.meshing.solid import MeshOptions, mesh_solid

INNER, OUTER = 10.0, 12.0  # mm
RUBBER = Ogden(mu=(0.19825, 3.2778), alpha=(3.05, -0.0054))  # NinjaFlex, MPa


def eighth_of_a_ball() -> cq.Solid:
    """x, y, z > 0 of the wall between both radii."""
    ball = cq.Workplane().sphere(OUTER).cut(cq.Workplane().sphere(INNER))
    corner = cq.Workplane().box(OUTER, OUTER, OUTER, centered=False)
    return ball.intersect(corner).val()


def face_name(face: cq.Face) -> str:
    """What a face is called: the planes of symmetry, ``cavity``, ``outside``."""
    if face.geomType() == "PLANE":
        return "xyz"[int(np.abs(face.normalAt().toTuple()).argmax())]
    return "cavity" if face.Center().Length < (INNER + OUTER) / 2 * 0.9 else "outside"


def mesh() -> Mesh:
    """Curved quadratic tetrahedra, one and a half through the wall."""
    solid = eighth_of_a_ball()
    brep = BytesIO()  # a file does as well: solid.exportBrep("ball.brep")
    solid.exportBrep(brep)
    names = [face_name(face) for face in solid.Faces()]
    return mesh_solid(brep.getvalue(), names, MeshOptions(size=2.5))


def path() -> Trace:
    """Equilibria until the radius has grown by two thirds; 2 MPa is more than it can bear."""
    supports = Supports(symmetry={"x": 0, "y": 1, "z": 2})
    problem = Problem(mesh(), RUBBER, supports, pressurised=("cavity",))
    return trace(problem, pressure=2.0, until=lambda point: stretch(point.volume) > 1.6)


def stretch(volume: float) -> float:
    """Of the inner radius, from the volume (mm^3) in the eighth."""
    return float(np.cbrt(6 * volume / np.pi)) / INNER


def closed_form(inner_stretch: float) -> float:
    """Pressure, MPa: the integral of dW/dl / (l^3 - 1) over the hoop stretches l in the wall."""
    volume = inner_stretch**3 - 1
    outer_stretch = float(np.cbrt(1 + volume * (INNER / OUTER) ** 3))

    def slope(hoop: float) -> float:
        stresses = RUBBER.principal_stresses(np.log([hoop, hoop, hoop**-2]))
        return 2 * (stresses[0] - stresses[2]) / hoop / (hoop**3 - 1)

    return float(quad(slope, outer_stretch, inner_stretch)[0])


def main() -> None:
    """Print the path next to the closed form."""
    found = path()
    print("stretch   pressure   closed form   stable")
    for point in found.points[1:]:
        there = stretch(point.volume)
        print(f"{there:7.4f} {point.pressure:10.4f} {closed_form(there):13.4f}   {point.stable}")
    best = minimize_scalar(lambda at: -closed_form(at), bounds=(1.1, 2.0), method="bounded")
    limit = found.limits[0].point.pressure
    print(f"limit at {limit:.4f} MPa; closed form {-best.fun:.4f} MPa")


if __name__ == "__main__":
    main()
