"""Volume control: limits, loads that act first, pressure from outside."""

from __future__ import annotations

import numpy as np
from case import Case, Outcome, Row
from measures import Points
from meshes import mapped_box, sphere_mesh, tube_mesh
from references import NEO_HOOKE, NINJAFLEX
from thick_walls import (
    closed_tube_at,
    highest_in_closed_tube,
    sphere_outside,
    sphere_pressure,
    tube_state,
)

from solver import (
    Problem,
    Solution,
    SolverOptions,
    Supports,
    Traction,
    cavity_volume,
    inflate,
    reaction,
)

OPTIONS = SolverOptions(tolerance=1e-8, maximum_iterations=15)
INNER, OUTER = 5.0, 6.0
"""Radii of the tube, mm."""

SOURCE = (
    "equilibrium along the radius of an incompressible wall, integrated by Gauss quadrature "
    "(`tests/support/thick_walls.py`)."
)


def at_rest(problem: Problem) -> float:
    """Volume inside the pressurised surfaces of the undeformed mesh, mm^3."""
    mesh = problem.mesh
    return cavity_volume(mesh, np.zeros_like(mesh.nodes), problem.pressurised)


def through(problem: Problem, factors: list[float]) -> tuple[Solution, ...]:
    """Equilibria at so many times the volume at rest."""
    volumes = [factor * at_rest(problem) for factor in factors]
    found = inflate(problem, volumes[-1], OPTIONS, stops=volumes)
    assert found.converged, found.message
    return (*found.at_stops, found)


def closed_tube() -> Problem:
    """Half of a slice of a tube; the section x1 carries the pressure on the closed end."""

    def place(cube: Points) -> Points:
        radius, angle = INNER + (OUTER - INNER) * cube[:, 1], np.pi * cube[:, 2]
        return np.stack([2 * cube[:, 0], radius * np.sin(angle), -radius * np.cos(angle)], 1)

    supports = Supports(symmetry={"x0": 0, "z0": 1, "z1": 1})
    mesh = mapped_box((1, 2, 3), place)
    return Problem(mesh, NINJAFLEX, supports, ("y0",), moving_plane="x1")


def past_the_limit() -> Outcome:
    """Pressures of a closed tube on both sides of its limit, and the limit."""
    problem = closed_tube()
    factors = [2.0, 5.0, 10.2]
    states = through(problem, factors)
    rows = [
        Row(
            f"pressure at {factor:g} times the volume",
            closed_tube_at(NINJAFLEX, INNER, OUTER, factor),
            state.pressure,
            1e-3,
            "MPa",
        )
        for factor, state in zip(factors, states, strict=True)
    ]
    limit = highest_in_closed_tube(NINJAFLEX, INNER, OUTER)
    rows.append(Row("pressure at the maximum", limit, states[-1].limit or 0.0, 1e-3, "MPa"))
    return Outcome(tuple(rows), mesh=f"half of {len(problem.mesh.tets)} tetrahedra")


def stretched_along(to: float, positions: Points, load: float) -> Points:
    """Leads an end along z to a stretch of the length; it may slide in its plane."""
    displacement = np.full(positions.shape, np.nan)
    displacement[:, 2] = load * (to - 1) * positions[:, 2]
    return displacement


def led_tube(along: float) -> Problem:
    """A quarter of a tube whose end is led along its axis."""
    supports = Supports(
        symmetry={"start": 1, "end": 0, "z0": 2},
        prescribed={"z1": lambda at, load: stretched_along(along, at, load)},
    )
    mesh = tube_mesh(INNER, OUTER, 1.0, (2, 3, 1), np.pi / 2)
    return Problem(mesh, NINJAFLEX, supports, ("inside",))


def length_first() -> Outcome:
    """Pressure and axial force at two volumes of tubes of two lengths."""
    rows: list[Row] = []
    for along in (1.5, 0.8):
        problem = led_tube(along)
        stretches = [1.2 / np.sqrt(along), 2.0 / np.sqrt(along)]
        states = through(problem, [stretch**2 * along for stretch in stretches])
        for stretch, state in zip(stretches, states, strict=True):
            pressure, force = tube_state(NINJAFLEX, INNER, OUTER, stretch, along)
            axial = (force + pressure * np.pi * (INNER * stretch) ** 2) / 4
            label = f"length {along:g}, radius {stretch:.3g} times: "
            ours = float(reaction(state, "z1").force[2])
            rows += [
                Row(f"{label}pressure", pressure, state.pressure, 1e-3, "MPa"),
                Row(f"{label}force along a quarter", axial, ours, 1e-3, "N"),
            ]
    return Outcome(tuple(rows), mesh=f"quarter of {len(problem.mesh.tets)} tetrahedra")


STRESS = 0.05
"""Of the dead tractions on the sphere, MPa."""


def outwards(positions: Points) -> Points:
    """Dead tractions along the radius."""
    return STRESS * positions / np.linalg.norm(positions, axis=1, keepdims=True)


def drawn_first() -> Outcome:
    """Pressures inside a sphere that dead tractions draw outwards."""
    mesh = sphere_mesh(10.0, 12.0, 2, 6)
    supports = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2})
    loads = (Traction("outside", outwards),)
    problem = Problem(mesh, NEO_HOOKE, supports, ("inside",), loads)
    stretches = [1.2, 1.5]
    states = through(problem, [stretch**3 for stretch in stretches])
    rows = []
    for stretch, state in zip(stretches, states, strict=True):
        outside = STRESS * (12 / sphere_outside(10.0, 12.0, stretch)) ** 2
        pressure = sphere_pressure(NEO_HOOKE, 10.0, 12.0, stretch) - outside
        quantity = f"pressure at {stretch:g} times the radius"
        rows.append(Row(quantity, pressure, state.pressure, 2e-3, "MPa", digits=3))
    return Outcome(tuple(rows), mesh=f"octant of {len(mesh.tets)} tetrahedra")


def pressed_from_outside() -> Outcome:
    """Pressures on a hollow sphere at given volumes within its outside."""
    mesh = sphere_mesh(5.0, 10.0, 4, 6)
    supports = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2})
    problem = Problem(mesh, NEO_HOOKE, supports, ("outside",))
    stretches = [0.95, 0.9, 0.8]
    states = through(problem, [(sphere_outside(5.0, 10.0, s) / 10) ** 3 for s in stretches])
    rows = tuple(
        Row(
            f"pressure at {stretch:g} times the inner radius",
            -sphere_pressure(NEO_HOOKE, 5.0, 10.0, stretch),
            state.pressure,
            5e-3,
            "MPa",
            digits=3,
        )
        for stretch, state in zip(stretches, states, strict=True)
    )
    return Outcome(rows, mesh=f"octant of {len(mesh.tets)} tetrahedra")


CASES = (
    Case(
        "V1 Tube inflated past its limit",
        "A long tube of NinjaFlex, 5 to 6 mm, with closed ends that are free to move: the pressure "
        "at given volumes, to three times the radius, and its maximum, which volume control finds "
        "between two of its steps.",
        SOURCE,
        past_the_limit,
    ),
    Case(
        "V2 Tube led to a length, then inflated",
        "The same tube is stretched or shortened first, at no pressure, and held so; then its "
        "volume is given.",
        SOURCE,
        length_first,
    ),
    Case(
        "V3 Sphere drawn outwards, then inflated",
        f"Dead tractions of {STRESS} MPa draw a neo-Hookean sphere of 10 to 12 mm outwards first; "
        "then its volume is given.",
        SOURCE,
        drawn_first,
    ),
    Case(
        "V4 Hollow sphere pressed from outside",
        "The volume within the outside of a neo-Hookean hollow sphere of 5 to 10 mm is made "
        "smaller.",
        SOURCE,
        pressed_from_outside,
    ),
)
