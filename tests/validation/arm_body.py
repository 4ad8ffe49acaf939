"""Half of a silicone arm with four chambers, of which one is under pressure.

The arm lies along x, its base at x = 0. The pressurised chamber is the one at z > 0, whose middle
plane y = 0 is the arm's plane of symmetry then; the half y > 0 is built. The section is drawn with
CadQuery and cut into triangles by Gmsh, and swept along x, in layers, of which thin ones carry a
winding of thread.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from io import BytesIO
from pathlib import Path
from typing import Any

import cadquery as cq
import numpy as np
from meshes import prisms, quadratic_mesh

from solver import Mesh
from solver.arrays import Integers, Reals
from solver.meshing import MeshOptions, Part, mesh_solids

DATA: dict[str, Any] = json.loads(
    (Path(__file__).parent / "data" / "arm.json").read_text(encoding="utf-8")
)
LENGTH, RADIUS = DATA["length_mm"], DATA["outer_diameter_mm"] / 2
OUTER_WALL, INNER_WALL = DATA["outer_wall_mm"], DATA["inner_wall_mm"]
CAVITY = RADIUS - OUTER_WALL
CORE = DATA["core_mm"] / np.sqrt(2)  # half the side of the square in the middle
DEPTH = LENGTH - DATA["end_mm"]
SIDE = np.sqrt(2) * INNER_WALL  # of a wall at 45 degrees, along y
SLAB, FAR = 4.0, 2 * RADIUS
THREAD = 0.4  # mm, width of a winding


@dataclass(frozen=True)
class Section:
    """The section x = 0: corners (n, 2) as (y, z), triangles (k, 3), their parts (k,)."""

    corners: Reals
    triangles: Integers
    parts: Reals


def prism(points: list[tuple[float, float]]) -> cq.Workplane:
    """A slab over a polygon (y, z)."""
    return cq.Workplane("YZ").polyline(points).close().extrude(SLAB)


def chamber(turns: int) -> cq.Workplane:
    """The chamber at z > 0, turned about x by quarters.

    Its walls: the square around the core, the outer cylinder, and one on either side, which lies
    against that of the next chamber.
    """
    bottom = CORE + INNER_WALL
    at = [(SIDE - bottom, bottom), (bottom - SIDE, bottom), (FAR - SIDE, FAR), (SIDE - FAR, FAR)]
    inside = cq.Workplane("YZ").circle(CAVITY).extrude(SLAB)
    return prism(at).intersect(inside).rotate((0, 0, 0), (1, 0, 0), 90.0 * turns)


def parts_of_section() -> dict[str, cq.Solid]:
    """Walls, chambers and core of a slab of the half y > 0."""
    half = cq.Workplane().box(SLAB, FAR, 2 * FAR, centered=(False, False, True))
    square = [(CORE, CORE), (-CORE, CORE), (-CORE, -CORE), (CORE, -CORE)]
    rooms = {"pressed": chamber(0), "beside": chamber(3), "opposite": chamber(2)}
    rooms["core"] = prism(square)
    walls = cq.Workplane("YZ").circle(RADIUS).extrude(SLAB)
    for room in rooms.values():
        walls = walls.cut(room)
    parts = {"walls": walls, **rooms}
    return {name: part.intersect(half).val().Solids()[0] for name, part in parts.items()}


def section(size: float) -> Section:
    """Triangles with edges of at most ``size`` mm."""
    parts = [_part(name, solid) for name, solid in parts_of_section().items()]
    mesh = mesh_solids(parts, MeshOptions(size=size))
    names = [part.name for part in parts]
    cells = [mesh.triangles(f"{name} base")[:, :3] for name in names]
    nodes, triangles = np.unique(np.concatenate(cells), return_inverse=True)
    which = np.repeat(names, [len(each) for each in cells])
    return Section(mesh.nodes[nodes][:, 1:], triangles.reshape(-1, 3), which)


def _part(name: str, solid: cq.Solid) -> Part:
    brep = BytesIO()
    solid.exportBrep(brep)
    at_base = [bool(np.isclose(face.Center().x, 0)) for face in solid.Faces()]
    return Part(name, brep.getvalue(), [f"{name} base" if base else "side" for base in at_base])


def layers(windings: int) -> tuple[Reals, Reals]:
    """Positions along x, ascending, and of which layers between them are thread (bool)."""
    pitch = DEPTH / (windings + 1)
    middles = pitch * np.arange(1, windings + 1)
    edges = np.stack([middles - THREAD / 2, middles + THREAD / 2], axis=1).ravel()
    at = np.concatenate([[0.0], edges, [DEPTH, LENGTH]])
    thread = np.zeros(len(at) - 1, bool)
    thread[1 : 2 * windings : 2] = True
    return at, thread


def half_arm(size: float, windings: int) -> Mesh:
    """The half arm, its core solid.

    Surfaces base, tip, symmetry, skin, inside; the chambers by their names; and below the thread
    ``skin thread`` and ``pressed thread``, parts of skin and pressed chamber.
    """
    plan = section(size)
    at, thread = layers(windings)
    solid = np.isin(plan.parts, ["walls", "core"])
    tets, count = [], len(plan.corners)
    for layer in range(len(at) - 1):
        kept = plan.triangles if layer == len(at) - 2 else plan.triangles[solid]
        tets.append(prisms(kept, count, 1) + layer * count)
    points = np.concatenate([np.column_stack([np.full(count, x), plan.corners]) for x in at])
    used, numbers = np.unique(np.concatenate(tets), return_inverse=True)
    mesh = quadratic_mesh(points[used], numbers.reshape(-1, 4).astype(np.int32), labels, rounded)
    return mesh.with_surfaces(
        {f"{name} thread": wound(mesh, name, at, thread) for name in ("skin", "pressed")}
    )


def wound(mesh: Mesh, name: str, at: Reals, thread: Reals) -> Integers:
    """The triangles of a surface along x that lie below a winding."""
    triangles = mesh.triangles(name)
    layer = np.searchsorted(at, mesh.nodes[triangles[:, :3], 0].mean(axis=1)) - 1
    return triangles[thread[layer] & (layer < len(thread) - 1)]


def labels(faces: Reals) -> Reals:
    """Names of outer faces by their corners (k, 3, 3), outward in order."""
    middle = faces.mean(axis=1)
    normal = np.cross(faces[:, 1] - faces[:, 0], faces[:, 2] - faces[:, 0])
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    beyond = middle + 0.05 * normal
    y, z = abs(beyond[:, 1]), beyond[:, 2]
    names = np.full(len(faces), "inside").astype("<U12")
    names[(z > y) & (z > CORE + INNER_WALL)] = "pressed"
    names[(np.hypot(y, z) > RADIUS - 0.5 * OUTER_WALL) & (abs(normal[:, 0]) < 0.5)] = "skin"
    names[abs(middle[:, 1]) < 1e-9] = "symmetry"
    names[middle[:, 0] < 1e-9] = "base"
    names[middle[:, 0] > LENGTH - 1e-9] = "tip"
    return names


def rounded(points: Reals) -> Reals:
    """Mid-nodes of chords of both circles, on them."""
    found = points.copy()
    radius = np.hypot(points[:, 1], points[:, 2])
    for circle in (RADIUS, CAVITY):
        near = (radius < circle) & (radius > circle - SAGITTA)
        found[near, 1:] *= (circle / radius[near])[:, None]
    return found


SAGITTA = 0.25
"""mm: how deep a chord may lie below its circle; less than a quarter of the outer wall."""
