"""The solver on a body of your own: how far does a soft bar bend under a force at its tip?

    python examples/own_body.py

Builds half of a bar in CadQuery, names its faces, clamps one end, pulls the other one down by a
force that keeps its direction, and compares tip and clamp with the elastica: the theory of a thin
beam that bends without being stretched or sheared. On fine meshes they differ by half a per cent,
and by less the more slender the bar is. Units: mm, N, MPa.
"""

from __future__ import annotations

from dataclasses import dataclass
from io import BytesIO

import cadquery as cq
import numpy as np
from scipy.integrate import solve_bvp

from solver import Ogden, Problem, Solution, Supports, Traction, reaction, solve
from solver.meshing import MeshOptions, mesh_solid

LENGTH, WIDTH, THICKNESS = 40.0, 2.0, 2.0  # along x, y, z
FORCE = 0.02  # N, on the whole bar
RUBBER = Ogden.neo_hooke(mu=3.476)  # as stiff as NinjaFlex at small strains; Young's modulus 3 mu


def half_a_bar() -> cq.Solid:
    """The other half, y < 0, is its mirror image."""
    return cq.Solid.makeBox(LENGTH, WIDTH / 2, THICKNESS)


def face_name(face: cq.Face) -> str:
    """Supports and loads refer to faces by name; several faces may share one."""
    x, y, _ = face.Center().toTuple()
    if np.isclose(x, 0):
        return "clamp"
    if np.isclose(x, LENGTH):
        return "tip"
    return "middle" if np.isclose(y, 0) else "outside"


def bent_bar(size: float) -> Solution:
    """The equilibrium on a mesh with edges of at most ``size`` mm."""
    solid, brep = half_a_bar(), BytesIO()
    solid.exportBrep(brep)
    names = [face_name(face) for face in solid.Faces()]  # in the order of the faces
    mesh = mesh_solid(brep.getvalue(), names, MeshOptions(size=size))
    supports = Supports(clamped=("clamp",), symmetry={"middle": 1})  # 1: no displacement along y
    load = Traction("tip", (0.0, 0.0, -FORCE / (WIDTH * THICKNESS)))
    return solve(Problem(mesh, RUBBER, supports, loads=(load,)))


@dataclass(frozen=True)
class Shape:
    """Where the tip is, mm from the clamp, and the moment at the clamp, N mm."""

    x: float
    z: float
    moment: float


def shape_of(solution: Solution) -> Shape:
    """The mean position of the tip's nodes, and what the clamp exerts on both halves."""
    mesh = solution.problem.mesh
    tip = mesh.surface_nodes("tip")
    x, _, z = (mesh.nodes[tip] + solution.displacement[tip]).mean(axis=0)
    held = reaction(solution, "clamp", about=(0.0, 0.0, THICKNESS / 2))
    return Shape(float(x), float(z - THICKNESS / 2), abs(2 * float(held.moment[1])))


def elastica() -> Shape:
    """E I t'' = F cos t for the inclination t(s), with t = 0 at the clamp and t' = 0 at the tip."""
    stiffness = 3 * RUBBER.shear_modulus * WIDTH * THICKNESS**3 / 12

    def along(_: np.ndarray, state: np.ndarray) -> np.ndarray:
        angle, slope, _, _ = state
        return np.stack([slope, FORCE / stiffness * np.cos(angle), np.cos(angle), np.sin(angle)])

    def at_ends(clamp: np.ndarray, tip: np.ndarray) -> np.ndarray:
        return np.array([clamp[0], clamp[2], clamp[3], tip[1]])

    places = np.linspace(0, LENGTH, 50)
    found = solve_bvp(along, at_ends, places, np.zeros((4, places.size)), tol=1e-8)
    return Shape(found.y[2, -1], found.y[3, -1], stiffness * abs(found.y[1, 0]))


def row(name: object, shape: Shape) -> str:
    """One line of the table."""
    return f"{name:>10} {shape.x:9.3f} {shape.z:9.3f} {shape.moment:12.4f}"


def main() -> None:
    """Print the bar on finer and finer meshes, and the elastica."""
    print("tetrahedra     tip x     tip z       moment")
    for size in (2.0, 1.0, 0.5):
        solution = bent_bar(size)
        print(row(len(solution.problem.mesh.tets), shape_of(solution)))
    print(row("elastica", elastica()))


if __name__ == "__main__":
    main()
