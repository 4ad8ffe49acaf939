"""Material: Ogden's stresses and energy."""

from __future__ import annotations

from collections.abc import Callable
from decimal import Decimal, localcontext
from functools import partial

import numpy as np
from case import Case, Outcome, Row
from meshes import box_mesh
from references import NINJAFLEX, TRELOAR, closed_form

from solver import Mesh, Ogden, Problem, Solution, SolverOptions, Supports, reaction, solve
from solver.assembly.assembly import solid
from solver.kernels.assembly import total_energy
from solver.kernels.hyperelastic import shear_stiffness
from solver.material import ogden

MODES = {"uniaxial": (1, -0.5, -0.5), "equibiaxial": (1, 1, -2), "planar": (1, 0, -1)}
"""Log stretches over that of the prescribed stretch; the last direction is free of stress."""

PATCH_STRETCHES = ("0.7", "0.9", "1.1", "1.5", "2", "3", "6.6")
TIGHT = SolverOptions(tolerance=1e-10, maximum_iterations=30)


def nominal_stress(material: Ogden, mode: str, stretch: float) -> float:
    """First Piola stress at a material point, MPa."""
    stress = material.principal_stresses(np.log(stretch) * np.array(MODES[mode]))
    return float(stress[0] - stress[2]) / stretch


def points(name: str, material: Ogden) -> Outcome:
    """All listed stretches of all modes at a material point."""
    rows = [
        Row(
            f"{mode}, stretch {stretch}",
            value,
            nominal_stress(material, mode, float(stretch)),
            1e-8,
            "MPa",
        )
        for stretch, values in closed_form(name)["reference"].items()
        for mode, value in values.items()
    ]
    return Outcome(tuple(rows))


def stretched(mesh: Mesh, material: Ogden, mode: str, stretch: float) -> Solution:
    """A cube between three planes of symmetry, pulled along x, along x and y, or with y held."""

    def pull(axis: int) -> Callable[[np.ndarray, float], np.ndarray]:
        def motion(positions: np.ndarray, load: float) -> np.ndarray:
            displacement = np.full(positions.shape, np.nan)
            displacement[:, axis] = (stretch**load - 1) * positions[:, axis]
            return displacement

        return motion

    led = {"x1": pull(0)} | ({"y1": pull(1)} if mode == "equibiaxial" else {})
    symmetry = {"x0": 0, "y0": 1, "z0": 2} | ({"y1": 1} if mode == "planar" else {})
    return solve(Problem(mesh, material, Supports(symmetry=symmetry, prescribed=led)), 0.0, TIGHT)


def patch(name: str, material: Ogden, necks: float) -> Outcome:
    """Distorted elements in homogeneous states: force over area, and the worst displacement.

    Equibiaxial stretches beyond ``necks`` are not stable.
    """
    mesh = box_mesh((2, 2, 2), distortion=0.25)
    reference = closed_form(name)["reference"]
    rows = []
    for stretch in PATCH_STRETCHES:
        for mode, exponents in MODES.items():
            if mode == "equibiaxial" and float(stretch) > necks:
                continue
            solution = stretched(mesh, material, mode, float(stretch))
            assert solution.converged, solution.message
            force = reaction(solution, "x1").force[0]
            label = f"{mode}, stretch {stretch}"
            rows.append(Row(label, reference[stretch][mode], force, 1e-6, "MPa"))
            exact = mesh.nodes * (float(stretch) ** np.array(exponents) - 1)
            worst = float(abs(solution.displacement - exact).max())
            rows.append(Row(f"{label}: largest stray", 0.0, worst, 1e-6, "mm", absolute=True))
    return Outcome(tuple(rows), mesh=f"unit cube, {len(mesh.tets)} distorted tetrahedra")


def near_equal_stretches() -> Outcome:
    """Divided differences of the stress where two stretches come together."""
    rows = []
    for entry in closed_form("M4")["reference"]:
        gap = np.log1p(float(entry["relgap"]))
        log = np.log(float(entry["base"]))
        logs, gaps = np.array([log + gap, log, 0.0]), np.array([gap, log, -log - gap])
        stress, quotients = np.empty(3), np.empty(3)
        ogden.response(logs, gaps, NINJAFLEX.values, stress, np.empty((3, 3)), quotients)
        divided = float(quotients[0])
        shear = shear_stiffness(divided, gap, stress[0] + stress[1])
        label = f"stretch {entry['base']}, gap {entry['relgap']}"
        rows.append(Row(f"T, {label}", float(entry["T"]), divided, 1e-12, "MPa"))
        rows.append(Row(f"C, {label}", float(entry["C"]), shear, 1e-12, "MPa"))
    return Outcome(tuple(rows))


def energies() -> Outcome:
    """Energy of isochoric states, at a point and of a stretched tetrahedral mesh."""
    rows = []
    for entry in closed_form("M5")["reference"]:
        reference = float(entry["W"])
        with localcontext() as context:
            context.prec = 40
            first, second = Decimal(entry["l1"]), Decimal(entry["l2"])
            stretches = (first, second, 1 / (first * second))
            logs = [float(stretch.ln()) for stretch in stretches]
            strains = [float(stretch - 1) for stretch in stretches]
        label = f"stretches {entry['l1']}, {entry['l2']}"
        at_point = NINJAFLEX.energy(logs)
        rows.append(Row(f"{label}: point", reference, at_point, 1e-12, "MPa", digits=6))
        rows.append(Row(f"{label}: mesh", reference, mesh_energy(strains), 1e-12, "MPa", digits=6))
    return Outcome(tuple(rows), mesh="for the mesh rows, unit cube of 6 tetrahedra")


def mesh_energy(strains: list[float]) -> float:
    """Energy of a unit cube stretched along its axes, N mm."""
    mesh = box_mesh((1, 1, 1))
    problem = Problem(mesh, NINJAFLEX, Supports(clamped=("x0",)))
    pressure = np.zeros(len(mesh.vertices))
    return float(total_energy(solid(problem), mesh.nodes * strains, pressure)[0])


CASES = (
    Case(
        "M1 NinjaFlex at a material point",
        "The nominal stress in uniaxial, equibiaxial and planar tension and compression, from 30 % "
        "to 760 % of the length.",
        closed_form("M1")["source"] + ".",
        partial(points, "M1", NINJAFLEX),
    ),
    Case(
        "M1 NinjaFlex in distorted elements",
        "A patch of distorted elements stretches homogeneously, under the force of the closed "
        "form. In equibiaxial tension it necks near twice its length, in compression its free "
        "faces crease, so only stable states are compared.",
        closed_form("M1")["source"] + ".",
        partial(patch, "M1", NINJAFLEX, 2.5),
    ),
    Case(
        "M2 Treloar's rubber at a material point",
        "The nominal stress of vulcanised rubber by Ogden's three terms.",
        closed_form("M2")["source"] + ".",
        partial(points, "M2", TRELOAR),
    ),
    Case(
        "M2 Treloar's rubber in distorted elements",
        "A patch of distorted elements stretches homogeneously, under the force of the closed "
        "form, where that is stable.",
        closed_form("M2")["source"] + ".",
        partial(patch, "M2", TRELOAR, np.inf),
    ),
    Case(
        "M4 Equal and nearly equal stretches",
        "T = (τi − τj) / (ln λi − ln λj) and C = (τi λj² − τj λi²) / (λi² − λj²) keep full "
        "precision however close two stretches come.",
        closed_form("M4")["source"] + ".",
        near_equal_stretches,
    ),
    Case(
        "M5 Energy",
        "The energy of volume-preserving states keeps full precision down to strains of 1e-6, at a "
        "point and through the elements.",
        closed_form("M5")["source"] + ".",
        energies,
    ),
)
