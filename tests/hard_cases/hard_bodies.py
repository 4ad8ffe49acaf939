"""Bodies, supports, motions and materials that several hard cases share."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from meshes import FACES, bellows_mesh
from numpy.typing import NDArray

from solver import Mesh, Ogden, Problem, SlenderAxis, Solution, SolverOptions, Supports, solve
from solver.mesh.elements import TETRAHEDRON_EDGES

Points = NDArray[np.float64]
Motion = Callable[[Points, float], Points]

NINJAFLEX = Ogden((0.19825, 3.2778), (3.05, -0.0054))
"""Curkovic & Jambresic 2020, table 3."""
NEO_HOOKE = Ogden((1.0,), (2.0,))
THREE_PLANES = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2})
CLAMPED = Supports(clamped=("x0",))
TIGHT = SolverOptions(tolerance=1e-9, maximum_iterations=30)


def cantilever(mesh: Mesh, material: Ogden = NINJAFLEX) -> Problem:
    """A bar clamped at x0 with pressure from below."""
    return Problem(mesh, material, CLAMPED, ("z0",))


def actuator(bubbles: int, material: Ogden = NINJAFLEX) -> Problem:
    """Half of a small bellows that bends under pressure inside."""
    mesh = bellows_mesh(bubbles)
    middles = 2.0 + 1.4 * np.arange(2 * bubbles - 1)
    axis = SlenderAxis((0.0, *middles, float(mesh.nodes[:, 0].max())))
    supports = Supports(clamped=("root",), symmetry={"symmetry": 1})
    return Problem(mesh, material, supports, ("cavity",), axis=axis)


def stretched(to: float, axis: int = 0, clamped: bool = False) -> Motion:
    """Moves a face along an axis to a stretch; it may slide in its plane unless ``clamped``."""

    def motion(positions: Points, load: float) -> Points:
        displacement = np.full(positions.shape, 0.0 if clamped else np.nan)
        displacement[:, axis] = load * (to - 1) * positions[:, axis]
        return displacement

    return motion


def rolled(turns: float, length: float, middle: float) -> Motion:
    """Leads a section around a circle: a bar of ``length`` bent by so many turns towards -z.

    The fibre at the height ``middle`` keeps its length.
    """

    def motion(positions: Points, load: float) -> Points:
        if load == 0:
            return np.zeros_like(positions)
        angle = 2 * np.pi * turns * load
        out = length / angle + positions[:, 2] - middle
        x, z = out * np.sin(angle), out * np.cos(angle) - length / angle + middle
        return np.stack([x, positions[:, 1], z], axis=1) - positions

    return motion


def single_tetrahedron() -> Mesh:
    """One element: the corner of a unit cube, with surfaces x0, y0, z0 and far."""
    corners = np.concatenate([np.zeros((1, 3)), np.eye(3)])
    middles = [corners[list(edge)].mean(axis=0) for edge in TETRAHEDRON_EDGES]
    names = zip(("z0", "y0", "far", "x0"), FACES, strict=True)
    surfaces = {name: np.array([face], np.int32) for name, face in names}
    tets = np.arange(10, dtype=np.int32)[None]
    return Mesh(np.concatenate([corners, middles]), tets, surfaces)


def moved(mesh: Mesh, matrix: Points, shift: Points | float = 0.0) -> Mesh:
    """The mesh after X -> matrix X + shift; a mirrored one is numbered the other way round."""
    tets, surfaces = mesh.tets, dict(mesh.surfaces)
    if np.linalg.det(matrix) < 0:
        tets = tets[:, [1, 0, 2, 3, 4, 6, 5, 9, 8, 7]]
        surfaces = {name: faces[:, [0, 2, 1, 5, 4, 3]] for name, faces in surfaces.items()}
    return Mesh(mesh.nodes @ matrix.T + shift, tets, surfaces)


def with_surfaces(mesh: Mesh, **surfaces: NDArray[np.int32]) -> Mesh:
    """The mesh with more surfaces, or others of the same name."""
    return Mesh(mesh.nodes, mesh.tets, {**mesh.surfaces, **surfaces})


def reached(solution: Solution) -> Solution:
    """The solution, if the load was reached."""
    assert solution.converged, solution.message
    return solution


def solved(problem: Problem, pressure: float = 0.0, options: SolverOptions = TIGHT) -> Solution:
    """The whole load, walked with care."""
    return reached(solve(problem, pressure, options))


def distance(one: Points, other: Points) -> float:
    """Largest difference over the largest value of ``other``."""
    return float(np.abs(one - other).max() / np.abs(other).max())
