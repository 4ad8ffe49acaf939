"""Solids: closed forms of large deformation."""

from __future__ import annotations

from functools import partial

import numpy as np
from case import Case, Order, Outcome, Row
from measures import Points, displacement_error, observed_order
from meshes import cylinder_mesh, mapped_box
from references import NEO_HOOKE, NINJAFLEX, closed_form

from solver import (
    Mesh,
    Ogden,
    Problem,
    Solution,
    SolverOptions,
    Supports,
    nodal_cauchy,
    reaction,
    solve,
)

TIGHT = SolverOptions(tolerance=1e-9, maximum_iterations=20)


def twisted(mesh: Mesh, material: Ogden, twist: float) -> Solution:
    """A cylinder along z, its end z1 turned by ``twist`` (rad/mm) times its height."""

    def motion(positions: Points, load: float) -> Points:
        return screw(positions, load * twist)

    supports = Supports(clamped=("z0",), prescribed={"z1": motion})
    return converged(solve(Problem(mesh, material, supports), 0.0, TIGHT))


def screw(positions: Points, twist: float) -> Points:
    """Displacements of pure torsion: each section turns by ``twist`` times z."""
    angle = twist * positions[:, 2]
    x, y = positions[:, 0], positions[:, 1]
    c, s = np.cos(angle) - 1, np.sin(angle)
    return np.stack([c * x - s * y, s * x + c * y, np.zeros(len(x))], axis=1)


def converged(solution: Solution) -> Solution:
    """The solution, if it is one."""
    assert solution.converged, solution.message
    return solution


def end_loads(solution: Solution, twist: str, moment: float, force: float) -> tuple[Row, Row]:
    """Moment and axial force on the turned end."""
    load = reaction(solution, "z1")
    return (
        Row(f"moment at {twist} rad/mm", moment, load.moment[2], 5e-3, "N mm"),
        Row(f"axial force at {twist} rad/mm", force, load.force[2], 5e-3, "N"),
    )


def torsion_of_ninjaflex(length: float, layers: int, twists: tuple[str, ...]) -> Outcome:
    """Several twists (rad/mm) on one mesh."""
    mesh = cylinder_mesh(5.0, length, 2, layers)
    reference = closed_form("S4")["reference"]["NinjaFlex"]
    rows: tuple[Row, ...] = ()
    for twist in twists:
        solution = twisted(mesh, NINJAFLEX, float(twist))
        rows += end_loads(solution, twist, reference[twist]["M_Nmm"], reference[twist]["N_axial"])
    return Outcome(rows, mesh=f"{length:g} mm of the cylinder, {len(mesh.tets)} tetrahedra")


def torsion_of_neo_hooke() -> Outcome:
    """One twist on several meshes; values of the finest."""
    loads = closed_form("S4")["reference"]["NeoHooke_mu1"]["psi0p1"]
    displacements, moments = [], []
    for n in PIECES:
        solution = twisted(cylinder_mesh(5.0, 5.0, n, n), NEO_HOOKE, 0.1)
        displacements.append(displacement_error(solution, lambda x: screw(x, 0.1)))
        moments.append(abs(reaction(solution, "z1").moment[2] / loads["M"] - 1))
    orders = (
        Order("displacement, L2", observed_order(PIECES, displacements), 2.8, "3"),
        Order("moment", observed_order(PIECES, moments), 3.5, "4"),
    )
    finest = len(solution.problem.mesh.tets)
    note = f"5 mm of the cylinder, {finest} tetrahedra; orders on {len(PIECES)} meshes"
    return Outcome(end_loads(solution, "0.1", loads["M"], loads["N"]), orders, note)


PIECES = (1, 2, 4)


def rolled(positions: Points, width: float, curvature: float) -> Points:
    """Displacements that roll a block of ``width`` along x into a sector of ``curvature``.

    Rivlin: r^2 = ri^2 + 2 x / w, angle w y, without load on the faces x = 0 and x = ``width`` if
    ri ro = 1 / w^2. The origin stays.
    """
    if curvature == 0:
        return np.zeros_like(positions)
    x, y = positions[:, 0], positions[:, 1]
    ratio = width / curvature
    inner = np.sqrt(np.hypot(ratio, curvature**-2) - ratio)
    radius = np.sqrt(inner**2 + 2 * x / curvature)
    placed = np.stack([radius * np.cos(curvature * y) - inner, radius * np.sin(curvature * y)])
    return np.column_stack([placed.T - positions[:, :2], np.zeros(len(x))])


def block(width: float, across: int, along: int) -> Mesh:
    """A block x in [0, width], y in [-10, 10], one element of 1 mm deep."""

    def place(cube: Points) -> Points:
        return (cube - [0, 0.5, 0]) * [width, 20.0, 1.0]

    return mapped_box((across, along, 1), place)


def bent(mesh: Mesh, material: Ogden, width: float, degrees: float) -> Solution:
    """The block in plane strain, its ends led along Rivlin's solution."""
    curvature = np.radians(degrees) / 20.0

    def motion(positions: Points, load: float) -> Points:
        return rolled(positions, width, load * curvature)

    supports = Supports(symmetry={"z0": 2, "z1": 2}, prescribed={"y0": motion, "y1": motion})
    return converged(solve(Problem(mesh, material, supports), 0.0, TIGHT))


def fibres(solution: Solution) -> tuple[float, float]:
    """Hoop stress in the middle of the block at the inner and the outer fibre, MPa."""
    nodes = solution.problem.mesh.nodes
    stress = nodal_cauchy(solution)[:, 1]
    middle = abs(nodes[:, 1]) < 1e-9
    inner, outer = (middle & (abs(nodes[:, 0] - x) < 1e-9) for x in (0.0, nodes[:, 0].max()))
    return float(stress[inner].mean()), float(stress[outer].mean())


def flexure(material: Ogden, name: str) -> Outcome:
    """All blocks of a material."""
    rows: list[Row] = []
    for entry in closed_form("S5")["reference"]:
        if entry["material"] != name:
            continue
        mesh = block(entry["h"], ACROSS, ALONG)
        solution = bent(mesh, material, entry["h"], entry["angle_deg"])
        moment = abs(reaction(solution, "y1").moment[2])
        inner, outer = fibres(solution)
        label = f"{entry['h']} mm to {entry['angle_deg']}°"
        rows += [
            Row(f"{label}: moment per depth", entry["moment_per_depth"], moment, 5e-3, "N"),
            Row(f"{label}: inner fibre", entry["sigma_theta_inner"], inner, 5e-2, "MPa"),
            Row(f"{label}: outer fibre", entry["sigma_theta_outer"], outer, 5e-2, "MPa"),
        ]
    errors = []
    for n in BLOCKS:
        solution = bent(block(5.0, n, 4 * n), material, 5.0, 180.0)
        errors.append(displacement_error(solution, lambda x: rolled(x, 5.0, np.pi / 20)))
    order = Order("position, L2", observed_order(BLOCKS, errors), 2.8, "3")
    note = f"{len(mesh.tets)} tetrahedra; order on {len(BLOCKS)} meshes of the 5 mm block to 180°"
    return Outcome(tuple(rows), (order,), note)


ACROSS, ALONG = 4, 16
BLOCKS = (1, 2, 4)

TWISTED = (
    "A cylinder with both ends led: the moment, and the axial force that grows with the twist "
    "squared (Poynting)."
)
CASES = (
    Case(
        "S4 Torsion of neo-Hooke",
        TWISTED,
        closed_form("S4")["source"] + ".",
        torsion_of_neo_hooke,
    ),
    Case(
        "S4 Torsion of NinjaFlex",
        TWISTED + " To 23° of twist per mm.",
        closed_form("S4")["source"] + ".",
        partial(torsion_of_ninjaflex, 5.0, 4, ("0.1", "0.2", "0.4")),
    ),
    Case(
        "S4 Torsion of a long cylinder of NinjaFlex",
        TWISTED + " Of 20 mm, which buckle before 0.4 rad/mm.",
        closed_form("S4")["source"] + ".",
        partial(torsion_of_ninjaflex, 20.0, 12, ("0.1", "0.2")),
        slow=True,
    ),
    *(
        Case(
            f"S5 Flexure of {title}",
            "A block rolled into a sector in plane strain, its ends led: the moment, and the hoop "
            "stress at both faces in the middle.",
            closed_form("S5")["source"] + ".",
            partial(flexure, material, name),
        )
        for title, material, name in (
            ("NinjaFlex", NINJAFLEX, "NinjaFlex"),
            ("neo-Hooke", NEO_HOOKE, "NeoHooke mu=1"),
        )
    ),
)
