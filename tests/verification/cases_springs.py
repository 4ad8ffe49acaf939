"""Linear springs: a bar against one, a column with one at its head."""

from __future__ import annotations

import numpy as np
from case import Case, Outcome, Row
from meshes import box_mesh
from scipy.optimize import brentq

from solver import (
    FoundationSpring,
    NodeSpring,
    Ogden,
    Problem,
    SolverOptions,
    Supports,
    Traction,
    potential,
    solve,
)
from solver.assembly.assembly import Assembly
from solver.assembly.state import State
from solver.nonlinear.linear_system import LinearSystem

RUBBER = Ogden.neo_hooke(1.0)
LENGTH = 20.0
"""Of the column, mm; its section is 1 mm by 1 mm."""


def bar() -> Outcome:
    """Stretch and energies of a bar that pulls a foundation at its end."""
    mesh, stiffness, stress = box_mesh((3, 1, 1), (3.0, 1.0, 1.0)), 0.2, 1.5
    problem = Problem(
        mesh,
        RUBBER,
        Supports(symmetry={"x0": 0, "y0": 1, "z0": 2}),
        loads=(Traction("x1", (stress, 0, 0)),),
        springs=(FoundationSpring("x1", (stiffness, 0, 0)),),
    )
    solution = solve(problem, options=SolverOptions(tolerance=1e-10))
    exact = brentq(lambda s: s - s**-2 + 3 * stiffness * (s - 1) - stress, 1.0, 3.0)
    ours, energy = 1 + solution.displacement[:, 0].max() / 3, potential(solution)
    moved = 3 * (exact - 1)
    rows = (
        Row("stretch", exact, float(ours), 1e-8),
        Row("energy of the bar", 1.5 * (exact**2 + 2 / exact - 3), energy.strain, 1e-8, "N mm"),
        Row("energy of the spring", stiffness * moved**2 / 2, energy.springs, 1e-8, "N mm"),
        Row("potential of the load", -stress * moved, energy.loads, 1e-8, "N mm"),
    )
    return Outcome(rows, mesh=f"{len(mesh.tets)} tetrahedra")


def euler(stiffness: float) -> float:
    """Load of a column with a spring (N/mm) at its head: tan u = u - u^3 E I / (k L^3), N."""
    rigidity, support = 3.0 / 12, stiffness * LENGTH**3

    def balance(u: float) -> float:
        return support * (np.sin(u) - u * np.cos(u)) + rigidity * u**3 * np.cos(u)

    return float(brentq(balance, 0.5, 4.4934094579) ** 2 * rigidity / LENGTH**2)


def buckling(stiffness: float) -> float:
    """The same by the first load (N) at which the tangent of the straight column is unstable."""
    mesh = box_mesh((20, 1, 1), (LENGTH, 1.0, 1.0))
    springs = (NodeSpring((0, 0, 0), (0, 0, 1.0)), FoundationSpring("x1", (0, 0, stiffness)))
    supports = Supports(symmetry={"x0": 0, "y0": 1})
    assembly = Assembly(Problem(mesh, RUBBER, supports, springs=springs))
    system = LinearSystem(assembly, "auto")

    def unstable(load: float) -> bool:
        stretch = float(brentq(lambda s: s**-2 - s - load, 0.5, 1.0))
        sides = stretch**-0.5
        displacement = mesh.nodes * (np.array([stretch, sides, sides]) - 1)
        pressure = np.full(len(mesh.vertices), (1 / stretch - stretch**2) / 3)
        system.factorize(assembly.evaluate(State(displacement, pressure), 0.0))
        return system.unstable_modes == 1

    low, high = 0.5 * euler(stiffness), 1.2 * euler(stiffness)
    assert unstable(high) and not unstable(low)
    while high - low > 1e-4 * high:
        middle = (low + high) / 2
        low, high = (low, middle) if unstable(middle) else (middle, high)
    return (low + high) / 2


def column() -> Outcome:
    """Without a spring, with two that hold a little, and with one that holds."""
    rows = (
        Row(f"k = {k:g} N/mm: load", euler(k), buckling(k), 0.02, "N", digits=3)
        for k in (0.0, 1e-3, 4e-3, 1.0)
    )
    return Outcome(tuple(rows), mesh="120 tetrahedra")


CASES = (
    Case(
        "K1 Bar against a spring",
        "A bar of 3 mm under a dead traction of 1.5 MPa pulls a foundation of 0.2 N/mm³ at its "
        "end: μ (λ − 1/λ²) + k (λ − 1) L = t.",
        "Equilibrium of a homogeneous bar. Status: closed form.",
        bar,
    ),
    Case(
        "K2 Column with a spring at its head",
        "The straight column 20 : 1 becomes unstable at Euler's load, from free to held at its "
        "head; one foot stands on a spring that holds no moment.",
        "Euler's column with an elastic support, E = 3 μ. Status: closed form.",
        column,
    ),
)
