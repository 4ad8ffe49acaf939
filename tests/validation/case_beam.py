"""Silicone beam under its weight and a load on the edge of its tip."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import partial
from itertools import pairwise
from typing import Any

import numpy as np
from beam_report import (
    AUTHORS,
    CELLS,
    DATA,
    INCOMPRESSIBLE,
    MARKERS,
    NEARLY,
    SEVERAL,
    draw,
    on_cells,
    report,
)
from meshes import cell_mesh
from record import Case, Computed
from rigid_patch import RigidMotion, motion_of

from solver import BodyForce, Mesh, Ogden, PointForce, Problem, Solution, Supports, solve
from solver.arrays import Reals

LENGTH, WIDTH, HEIGHT = (DATA[f"{name}_mm"] for name in ("length", "width", "height"))
WEIGHT = DATA["density_kg_m3"] * DATA["gravity_m_s2"] * 1e-9  # N/mm^3
LOADS = DATA["loads_n"]
FOOT = 6.0  # mm; half the side of the square of surface that moves a marker
SURFACES = {"top": "z1", "left": "y1", "right": "y1"}


def half_beam(cell: float) -> Mesh:
    """The half y > 0 of the beam along x, held at x0; lines of the mesh bound the markers' feet."""
    pieces = ((0, LENGTH - FOOT, LENGTH), (0, FOOT, WIDTH / 2), (0, 12, 18, HEIGHT))
    lines = [_lines(at, cell) for at in pieces]
    return cell_mesh(np.ones([len(line) - 1 for line in lines], int), lines)


def _lines(ends: Sequence[float], cell: float) -> Reals:
    """Lines of cells of at most that size, mm, in each piece between the ends."""
    parts = [
        np.linspace(start, end, 1 + math.ceil((end - start) / cell - 1e-9))[1:]
        for start, end in pairwise(ends)
    ]
    return np.concatenate([[ends[0]], *parts]).astype(float)


def silicone(young_modulus: float, poisson_ratio: float) -> Ogden:
    """Neo-Hooke with these moduli at small strains, MPa; incompressible for a ratio of 1/2."""
    mu = young_modulus / 2 / (1 + poisson_ratio)
    if poisson_ratio == 0.5:
        return Ogden((mu,), (2.0,))
    return Ogden((mu,), (2.0,), young_modulus / 3 / (1 - 2 * poisson_ratio))


def sagging(mesh: Mesh, material: Ogden) -> Solution:
    """The beam under its weight."""
    supports = Supports(clamped=("x0",), symmetry={"y0": 1})
    return _found(solve(Problem(mesh, material, supports, loads=(BodyForce((0, 0, -WEIGHT)),))))


def loaded(sagged: Solution) -> tuple[Solution, ...]:
    """Then under each of the loads on the upper edge of the tip."""
    problem = sagged.problem
    loads = (*problem.loads, *edge_load(problem.mesh, LOADS[-1] / 2))
    heavier = Problem(problem.mesh, problem.material, problem.supports, loads=loads)
    stops = [load / LOADS[-1] for load in LOADS[1:-1]]
    last = _found(solve(heavier, stops=stops, after=sagged))
    return (sagged, *last.at_stops, last)


def edge_load(mesh: Mesh, force: float) -> tuple[PointForce, ...]:
    """A force down, N, spread evenly along the edge x = LENGTH, z = HEIGHT of quadratic elements.

    A quadratic edge of length l carries l/6 of the load per length at its ends, 2 l/3 between.
    """
    edge = np.flatnonzero((mesh.nodes[:, [0, 2]] == [LENGTH, HEIGHT]).all(axis=1))
    edge = edge[np.argsort(mesh.nodes[edge, 1])]
    at = mesh.nodes[edge, 1]
    shares = np.zeros(len(edge))
    for first in range(0, len(edge) - 1, 2):
        shares[first : first + 3] += (at[first + 2] - at[first]) * np.array([1, 4, 1]) / 6
    down = -force * shares / shares.sum()
    return tuple(
        PointForce(tuple(mesh.nodes[node]), (0.0, 0.0, float(f)))
        for node, f in zip(edge, down, strict=True)
    )


def foot(solution: Solution, name: str) -> RigidMotion:
    """The motion of a marker's foot: the surface within 6 mm of it along each axis."""
    mesh, base = solution.problem.mesh, np.array([LENGTH, *MARKERS[name][0]])
    corners = mesh.nodes[mesh.triangles(SURFACES[name])[:, :3]]
    near = (abs(corners - base) < FOOT + 1e-6).all(axis=(1, 2))
    return motion_of(solution, SURFACES[name], near)


def markers(solution: Solution) -> dict[str, list[float]]:
    """Displacements (x, z) of the markers, mm, which stand off the surface."""
    found = {}
    for name, (base, normal) in MARKERS.items():
        place = np.array([LENGTH, *base]) + DATA["marker_distance_mm"] * np.array([0, *normal])
        found[name] = foot(solution, name).displacement(place)[[0, 2]].tolist()
    return found


def surface(solution: Solution) -> dict[str, float]:
    """Displacement down of the nodes below the markers, mm."""
    nodes = solution.problem.mesh.nodes
    bases = {name: np.array([LENGTH, *base]) for name, (base, _) in MARKERS.items()}
    at = {name: np.linalg.norm(nodes - base, axis=1).argmin() for name, base in bases.items()}
    return {name: -float(solution.displacement[node, 2]) for name, node in at.items()}


def tilt(found: dict[str, list[float]]) -> float:
    """Rotation of the line from the right to the top marker in the x-z plane, degrees."""
    away = DATA["marker_distance_mm"]
    (x, z), (x_right, z_right) = found["top"], found["right"]
    rise = MARKERS["top"][0][1] + away - MARKERS["right"][0][1] + z - z_right
    return math.degrees(math.atan2(x - x_right, rise))


def misfit(solution: Solution, run: Sequence[float]) -> float:
    """Mean of the markers' deflections over that of a run of the experiment."""
    ours = -np.mean([z for _, z in markers(solution).values()])
    return float(ours / np.mean(run))


def identified(
    mesh: Mesh, poisson_ratio: float, runs: Sequence[int]
) -> tuple[Solution, dict[str, float]]:
    """The sagging beam whose mean deflection is that of some runs, its modulus, and the misfit.

    The deflection goes nearly as a power of the modulus, which the last two trials give.
    """
    measured = np.array(DATA["deflections_mm"]["0"])[list(runs)].mean(axis=0)
    moduli, ratios, exponent = [DATA["authors_young_modulus_mpa"]], [], -1.0
    for _ in range(3):
        solution = sagging(mesh, silicone(moduli[-1], poisson_ratio))
        ratios.append(misfit(solution, measured))
        if abs(ratios[-1] - 1) < 1e-6:
            break
        if len(ratios) > 1:
            exponent = float(np.diff(np.log(ratios[-2:]))[0] / np.diff(np.log(moduli[-2:]))[0])
        moduli.append(moduli[-1] * ratios[-1] ** (-1 / exponent))
    return solution, {"young_modulus_mpa": moduli[len(ratios) - 1], "misfit": ratios[-1] - 1}


def predicted(cell: float, poisson_ratio: float, runs: Sequence[int] = (0, 1)) -> Computed:
    """Modulus from the weight in these runs, then the markers under all loads."""
    mesh = half_beam(cell)
    sagged, found = identified(mesh, poisson_ratio, runs)
    return _computed(mesh, loaded(sagged), found)


def as_the_authors(cell: float) -> Computed:
    """With the authors' modulus, for the comparison with their COMSOL."""
    mesh = half_beam(cell)
    material = silicone(DATA["authors_young_modulus_mpa"], DATA["poisson_ratio"])
    return _computed(mesh, loaded(sagging(mesh, material)), {})


def _computed(mesh: Mesh, states: Sequence[Solution], first: dict[str, Any]) -> Computed:
    found = [markers(state) for state in states]
    readings = first | {
        "markers_xz_mm": found,
        "surface_down_mm": [surface(state) for state in states],
        "tilt_deg": [tilt(each) for each in found],
        "newton_iterations": [state.newton_iterations for state in states[::2]],
    }
    return Computed(readings, len(mesh.tets), mesh.nodes.size + len(mesh.vertices))


def _found(solution: Solution) -> Solution:
    assert solution.converged, solution.message
    return solution


RATIO = DATA["poisson_ratio"]

CASE = Case(
    "B. A silicone beam under its weight and a load at its tip",
    {
        **{on_cells(NEARLY, cell): partial(predicted, cell, RATIO) for cell in CELLS},
        **{
            on_cells(f"run {run + 1} alone", SEVERAL): partial(predicted, SEVERAL, RATIO, (run,))
            for run in (0, 1)
        },
        on_cells(INCOMPRESSIBLE, SEVERAL): partial(predicted, SEVERAL, 0.5),
        on_cells(AUTHORS, CELLS[2]): partial(as_the_authors, CELLS[2]),
    },
    report,
    sample=on_cells(NEARLY, CELLS[0]),
    draw=draw,
)
