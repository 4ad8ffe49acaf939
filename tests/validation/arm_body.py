"""Half of a silicone arm with four chambers, of which one is under pressure.

The arm lies along x, its base at x = 0; the pressurised chamber is the one at z > 0, whose middle
plane y = 0 is the arm's plane of symmetry then. Only the half y > 0 is built.
"""

from __future__ import annotations

import json
from io import BytesIO
from pathlib import Path
from typing import Any

import cadquery as cq
import numpy as np

from solver import Mesh
from solver.meshing import MeshOptions, mesh_solid

DATA: dict[str, Any] = json.loads(
    (Path(__file__).parent / "data" / "arm.json").read_text(encoding="utf-8")
)
LENGTH, RADIUS = DATA["length_mm"], DATA["outer_diameter_mm"] / 2
OUTER_WALL, INNER_WALL = DATA["outer_wall_mm"], DATA["inner_wall_mm"]
CORE = DATA["core_mm"] / np.sqrt(2)  # half the side of the square hole in the middle
DEPTH = LENGTH - DATA["end_mm"]
FAR = 2 * RADIUS


def prism(points: list[tuple[float, float]], length: float) -> cq.Workplane:
    """Over a polygon (y, z), from x = 0."""
    return cq.Workplane("YZ").polyline(points).close().extrude(length)


def chamber(turns: int) -> cq.Workplane:
    """The chamber at z > 0, turned about x by quarters.

    Its walls: the square around the core, the outer cylinder, and one on either side, which lies
    against that of the next chamber.
    """
    bottom, side = CORE + INNER_WALL, np.sqrt(2) * INNER_WALL
    wedge = prism(
        [
            (-(bottom - side), bottom),
            (bottom - side, bottom),
            (FAR - side, FAR),
            (side - FAR, FAR),
        ],
        DEPTH,
    )
    inside = cq.Workplane("YZ").circle(RADIUS - OUTER_WALL).extrude(DEPTH)
    return wedge.intersect(inside).rotate((0, 0, 0), (1, 0, 0), 90.0 * turns)


def half_arm(solid_core: bool = False) -> cq.Solid:
    """The half y > 0."""
    half = cq.Workplane().box(LENGTH, FAR, 2 * FAR, centered=(False, False, True))
    body = cq.Workplane("YZ").circle(RADIUS).extrude(LENGTH)
    if not solid_core:
        square = [(CORE, CORE), (-CORE, CORE), (-CORE, -CORE), (CORE, -CORE)]
        body = body.cut(prism(square, DEPTH))
    for turns in range(4):
        body = body.cut(chamber(turns))
    found = body.intersect(half).val()
    (solid,) = found.Solids()
    return solid


def face_name(face: cq.Face) -> str:
    """``base``, ``tip``, ``symmetry``, ``chamber`` (the pressurised one), ``skin`` or ``inside``."""
    x, y, z = face.Center().toTuple()
    if np.isclose(x, 0) or np.isclose(x, LENGTH):
        return "base" if np.isclose(x, 0) else "tip"
    if face.geomType() == "PLANE" and np.isclose(y, 0) and abs(face.normalAt().y) > 0.99:
        return "symmetry"
    if face.geomType() == "CYLINDER" and np.isclose(face.BoundingBox().zmax, RADIUS):
        return "skin"
    return "chamber" if z > max(abs(y), CORE + INNER_WALL / 2) else "inside"


def meshed(solid: cq.Solid, size: float) -> Mesh:
    """Curved quadratic tetrahedra with edges of at most ``size`` mm."""
    brep = BytesIO()
    solid.exportBrep(brep)
    names = [face_name(face) for face in solid.Faces()]
    return mesh_solid(brep.getvalue(), names, MeshOptions(size=size), seconds=600)
