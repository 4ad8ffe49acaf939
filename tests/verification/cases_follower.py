"""Follower pressure on surfaces with a free rim: loads without a potential."""

from __future__ import annotations

import numpy as np
from case import Case, Outcome, Row
from meshes import box_mesh, tube_mesh
from scipy.integrate import quad
from scipy.optimize import fsolve
from structures import along

from solver import Ogden, Problem, SolverOptions, Supports

NEO_HOOKE = Ogden((1.0,), (2.0,))
PLANES = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2})
STRAINS = (0.2, 0.5, 1.0, 2.0)
TIGHT = SolverOptions(tolerance=1e-9)


def pulled_bar() -> Outcome:
    """Mean stretch of two slender bars at the pressures that stretch them so."""
    rows = []
    for size, divisions in (((4.0, 1.0, 1.0), (4, 1, 1)), ((10.0, 2.0, 2.0), (10, 2, 2))):
        mesh = box_mesh(divisions, size)
        problem = Problem(mesh, NEO_HOOKE, PLANES, ("x1",))
        pressures = [1 / (1 + strain) - (1 + strain) ** 2 for strain in STRAINS]
        end = mesh.surface_nodes("x1")
        for strain, state in zip(STRAINS, along(problem, pressures, TIGHT), strict=True):
            name = f"{size[0]:g} × {size[1]:g} × {size[2]:g} mm, stretch"
            rows.append(Row(name, 1 + strain, 1 + state[end, 0].mean() / size[0], 1e-8))
    return Outcome(tuple(rows), mesh="1 and 2 cells across, of 6 tetrahedra each")


INNER, OUTER = 5.0, 6.0
PRESSURES = (0.1, 0.13)


def open_tube() -> Outcome:
    """Bore in the middle of a long tube that is open at both ends, on two meshes."""
    rows = []
    meshes = ((1, 2, 4), (2, 4, 8))
    expected = [_bore(pressure) for pressure in PRESSURES]
    for divisions in meshes:
        mesh = tube_mesh(INNER, OUTER, 24.0, divisions, np.pi / 2)
        supports = Supports(symmetry={"start": 1, "end": 0, "z0": 2})
        problem = Problem(mesh, NEO_HOOKE, supports, ("inside",))
        middle = int(np.linalg.norm(mesh.nodes - (INNER, 0.0, 0.0), axis=1).argmin())
        found = [INNER + state[middle, 0] for state in along(problem, PRESSURES, TIGHT)]
        name = f"{divisions[0]} × {divisions[1]} × {divisions[2]} cells, bore at"
        rows += [
            Row(f"{name} {pressure:g} MPa", bore, ours, tolerance(divisions[0]), "mm")
            for pressure, bore, ours in zip(PRESSURES, expected, found, strict=True)
        ]
    return Outcome(tuple(rows), mesh="a quarter of the tube and half its length")


def tolerance(layers: int) -> float:
    """By the number of elements through the wall."""
    return {1: 1e-3, 2: 5e-4}[layers]


def _bore(pressure: float) -> float:
    """Inner radius of a long tube without axial force, mm: plane sections, no axial traction."""

    def imbalances(unknowns: np.ndarray) -> tuple[float, float]:
        bore, stretch = unknowns
        rim = np.sqrt(bore**2 + (OUTER**2 - INNER**2) / stretch)

        def around(r: float) -> float:
            return r / np.sqrt(INNER**2 + stretch * (r**2 - bore**2))

        def hoop_minus_radial(r: float) -> float:
            return around(r) ** 2 - 1 / (around(r) * stretch) ** 2

        def radial(r: float) -> float:
            return -quad(lambda s: hoop_minus_radial(s) / s, r, rim)[0]

        def axial(r: float) -> float:
            return radial(r) + stretch**2 - 1 / (around(r) * stretch) ** 2

        force = quad(lambda r: axial(r) * r, bore, rim)[0]
        return float(radial(bore) + pressure), float(force)

    bore, _ = fsolve(imbalances, (INNER * (1 + 2 * pressure), 1.0), xtol=1e-12)
    return float(bore)


def membrane() -> Outcome:
    """Height of two strips, each held at its ends and free along its sides."""
    rows = []
    for thickness in (0.2, 0.1):
        mesh = box_mesh((40, 1, 1), (SPAN / 2, WIDTH, thickness))
        supports = Supports(clamped=("x1",), symmetry={"x0": 0, "y0": 1})
        problem = Problem(mesh, NEO_HOOKE, supports, ("z0",))
        pressures = [_pressure(angle, thickness) for angle in ANGLES]
        middle = mesh.surface_nodes("x0")
        for angle, state in zip(ANGLES, along(problem, pressures, TIGHT), strict=True):
            height = SPAN / 2 * np.tan(angle / 2)
            name = f"{thickness:g} mm thick, height at an angle of {angle:g}"
            rows.append(Row(name, height, state[middle, 2].mean(), 0.1 * thickness, "mm"))
    return Outcome(tuple(rows), mesh="40 × 1 × 1 cells of half the span and half the width")


SPAN, WIDTH = 20.0, 0.5
ANGLES = (0.6, 1.0)
"""Half the angle of the arc, rad."""


def _pressure(angle: float, thickness: float) -> float:
    """That bends a strip without bending stiffness to an arc, under uniaxial tension, MPa."""
    stretch = angle / np.sin(angle)
    force = (stretch - stretch**-2) * thickness  # per width of the undeformed strip
    radius = SPAN / 2 / np.sin(angle)
    return float(force * np.sqrt(stretch) / radius)


CASES = (
    Case(
        "Bar pulled by a follower pressure",
        "A bar between three planes of symmetry, pulled by a negative pressure on its end, whose "
        "free rim leaves the load without a potential, stretches uniformly: λ² − 1/λ = |p|/μ.",
        "closed form. Status: exact",
        pulled_bar,
    ),
    Case(
        "Tube open at both ends",
        "A long tube of neo-Hookean rubber with a pressure in its bore and nothing on its ends.",
        "plane sections of a thick tube without axial force, integrated numerically. Status: exact "
        "far from the ends",
        open_tube,
    ),
    Case(
        "Inflated strip with free sides",
        "A narrow strip of 20 mm between its held ends, blown up to an arc: thin, it is a membrane "
        "in uniaxial tension. Its bending stiffness, most of all at the ends, is of the order of "
        "its thickness.",
        "arc of a membrane in uniaxial tension, closed form. Status: limit of a thin strip",
        membrane,
    ),
)
