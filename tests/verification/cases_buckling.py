"""Buckling: loads at which straight bodies lose their stability."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from case import Case, Outcome, Row
from measures import Points
from meshes import box_mesh, doubled_mesh
from scipy.optimize import brentq

from solver import Mesh, Ogden, Problem, SolverOptions, Supports, Traction, solve, trace

MATERIAL = Ogden.neo_hooke(1.0)
LENGTH, WIDTH, HEIGHT = 20.0, 1.5, 1.0
EULER = np.pi**2 * 3.0 * WIDTH * HEIGHT**3 / 12 / (4 * LENGTH**2)
"""Critical dead load of the free end of a clamped column, E = 3 mu, N."""


def on_mirrored_mesh(loads: float) -> Problem:
    """The column along z on a mesh and its mirror image, under so many Euler loads."""
    mesh = doubled_mesh(box_mesh((1, 2, 20), (HEIGHT / 2, WIDTH, LENGTH)))
    load = Traction("z1", (0.0, 0.0, -loads * EULER / (WIDTH * HEIGHT)))
    return Problem(mesh, MATERIAL, Supports(("z0",)), loads=(load,))


def on_lopsided_mesh(loads: float) -> Problem:
    """The column along x on a mesh without mirror symmetry."""
    mesh = box_mesh((20, 2, 2), (LENGTH, WIDTH, HEIGHT))
    load = Traction("x1", (-loads * EULER / (WIDTH * HEIGHT), 0.0, 0.0))
    return Problem(mesh, MATERIAL, Supports(("x0",)), loads=(load,))


def traced(problem: Problem, first_step: float) -> float:
    """Middle of the bracket of the first bifurcation, as a fraction of the load."""
    options = SolverOptions(first_step=first_step)
    path = trace(problem, options=options, until=lambda point: point.stable is False)
    assert path.limits[0].kind == "bifurcation", path.message
    before, behind = path.limits[0].between
    return (before.load + behind.load) / 2


def walked(problem: Problem) -> float:
    """The limit that a walk by load names, as a fraction of the load."""
    limit = solve(problem).limit
    assert limit is not None
    return limit


def column() -> Outcome:
    """Euler's load by several walks that step over it in different ways."""
    walks: dict[str, tuple[Callable[[float], Problem], float, float]] = {
        "mirrored mesh, steps from 6 % of it": (on_mirrored_mesh, 2.0, 0.03),
        "mirrored mesh, from 30 %": (on_mirrored_mesh, 3.0, 0.1),
        "mirrored mesh, from 240 %": (on_mirrored_mesh, 8.0, 0.3),
        "mesh without symmetry, from 50 %": (on_lopsided_mesh, 5.0, 0.1),
    }
    rows = [
        Row(f"P / P_Euler, {label}", 1.0, loads * traced(pose(loads), first), 0.03, digits=2)
        for label, (pose, loads, first) in walks.items()
    ]
    found = 2.0 * walked(on_mirrored_mesh(2.0))
    rows.append(Row("P / P_Euler, mirrored mesh, walked by load", 1.0, found, 0.03, digits=2))
    return Outcome(tuple(rows), mesh="480 tetrahedra each")


SLENDERNESS = (10, 5)
"""Lengths over thickness of the slab."""


def critical_stretch(slenderness: float) -> float:
    """Stretch at which a slab in plane strain between frictionless plates first bends.

    Half a wave over the length: (1 + s^2)^2 tanh(q) = 4 s tanh(s q), s = lambda^2,
    q = pi / (2 s L / H).
    """

    def excess(stretch: float) -> float:
        s = stretch**2
        q = np.pi / (2 * s * slenderness)
        return float((1 + s * s) ** 2 * np.tanh(q) - 4 * s * np.tanh(s * q))

    euler = np.pi**2 / 12 / slenderness**2
    return float(brentq(excess, 1 - 2 * euler, 1 - euler / 2))


def slab(mesh: Mesh, length: float, shortening: float) -> Problem:
    """Ends along x slide on their planes; one is led; the middle of the other is held."""
    middle = mesh.nodes[:, 2].max() / 2

    def ends(positions: Points, load: float) -> Points:
        motion = np.full(positions.shape, np.nan)
        far = positions[:, 0] > length / 2
        motion[:, 0] = np.where(far, -load * shortening * length, 0.0)
        motion[~far & np.isclose(positions[:, 2], middle), 2] = 0.0
        return motion

    supports = Supports((), {"y0": 1, "y1": 1}, {"x0": ends, "x1": ends})
    return Problem(mesh, MATERIAL, supports)


def sliding() -> Outcome:
    """Biot's slab, mirrored meshes and not, led to twice the critical shortening."""
    rows = []
    for slenderness in SLENDERNESS:
        expected = 1 - critical_stretch(slenderness)
        for label, mesh in slabs(slenderness).items():
            found = 2 * expected * traced(slab(mesh, float(slenderness), 2 * expected), 0.1)
            rows.append(
                Row(f"L / H = {slenderness}, {label}: shortening", expected, found, 0.01, digits=2)
            )
    return Outcome(tuple(rows), mesh="4 cells over the thickness")


def slabs(slenderness: int) -> dict[str, Mesh]:
    """Meshes of a slab of thickness 1, x along it and z across."""
    whole = box_mesh((2 * slenderness, 1, 4), (float(slenderness), 0.5, 1.0))
    half = box_mesh((2, 1, 2 * slenderness), (0.5, 0.5, float(slenderness)))
    return {"mesh without symmetry": whole, "mirrored mesh": upright(doubled_mesh(half))}


def upright(mesh: Mesh) -> Mesh:
    """The mesh with x and z exchanged: mirrored, and so numbered the other way round."""
    names = {"x0": "z0", "x1": "z1", "z0": "x0", "z1": "x1"}
    return Mesh(
        mesh.nodes[:, ::-1],
        mesh.tets[:, [1, 0, 2, 3, 4, 6, 5, 9, 8, 7]],
        {names.get(n, n): t[:, [0, 2, 1, 5, 4, 3]] for n, t in mesh.surfaces.items()},
    )


CASES = (
    Case(
        "Euler's column under a dead load",
        "A slender column (20 × 1.5 × 1) clamped at one end loses its stability at the same load, "
        "however far the steps reach beyond it, and on meshes with mirror symmetry and without, "
        "where the branches are parted. The clamp, which holds the section, makes it 1 % stiffer.",
        "P = π² E I / (4 L²), E = 3 μ. Status: thin-beam limit.",
        column,
        slow=True,
    ),
    Case(
        "A slab between frictionless plates bends",
        "A thick slab in plane strain, shortened by ends that slide on rigid plates, loses its "
        "straight shape at the shortening of the exact incremental solution. The ends are led: "
        "there is no other load.",
        "Biot, Mechanics of Incremental Deformations, 1965: (1 + s²)² tanh q = 4 s tanh(s q), "
        "s = λ², q = π H / (2 λ² L), neo-Hooke. Status: closed form.",
        sliding,
    ),
)
