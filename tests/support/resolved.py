"""Responses of problems that are solved anew, and their central differences."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from solver import Gradients, Problem, Solution, SolverOptions, solve
from solver.material.law import Hyperelastic
from solver.sensitivity.responses import available
from solver.sensitivity.smooth_peak import PeakRegion

Array = NDArray[np.float64]
TIGHT = SolverOptions(tolerance=1e-10, maximum_iterations=60)


def moved(problem: Problem, step: Array) -> Problem:
    """The problem on a mesh whose nodes are moved by ``step`` (n, 3)."""
    mesh = problem.mesh
    return replace(problem, mesh=mesh.moved(mesh.nodes + step))


def solved_near(problem: Problem, pressure: float, near: Solution) -> Solution:
    """The equilibrium of a neighbour of a solved problem."""
    start = (near.displacement, near.hydrostatic_pressure)
    solution = solve(problem, pressure, TIGHT, initial=start)
    assert solution.converged, solution.message
    return solution


def responses(solution: Solution, found: Gradients) -> dict[str, float]:
    """Of a solution, whole turns aside; the smooth peak over the same nodes as in ``found``."""
    problem, sharpness = solution.problem, found.region.sharpness
    counted = np.zeros(len(problem.mesh.nodes), bool)
    counted[problem.mesh.sides[found.region.sides]] = True
    region = PeakRegion.of(problem, solution.displacement, counted, sharpness)
    before = found.solution.rotation
    values = {
        "rotation": before + (solution.rotation - before + 180) % 360 - 180,
        "volume": solution.path[-1].volume,
        "peak_stress": region.peak(solution.displacement).value,
    }
    return {name: values[name] for name in available(problem)}


def difference(respond: Callable[[float], Mapping[str, float]], step: float) -> dict[str, float]:
    """Derivatives of responses at 0 by central differences of fourth order."""
    values = {k: respond(k * step) for k in (-2, -1, 1, 2)}
    return {
        name: (8 * (values[1][name] - values[-1][name]) - values[2][name] + values[-2][name])
        / (12 * step)
        for name in values[1]
    }


def by_velocity(
    solution: Solution, found: Gradients, velocity: Array, step: float
) -> dict[str, float]:
    """Derivatives along a velocity of the mesh, by solving on moved meshes."""
    problem, pressure = solution.problem, solution.pressure
    return difference(
        lambda s: responses(solved_near(moved(problem, s * velocity), pressure, solution), found),
        step,
    )


def by_pressure(solution: Solution, found: Gradients, step: float) -> dict[str, float]:
    """Derivatives by the pressure, by solving under others."""
    problem, pressure = solution.problem, solution.pressure
    return difference(
        lambda s: responses(solved_near(problem, pressure + s, solution), found), step
    )


def by_material(
    solution: Solution,
    found: Gradients,
    material: Callable[[float], Hyperelastic],
    step: float,
    region: str | None = None,
) -> dict[str, float]:
    """Derivatives by a parameter of the material, or of a region's, by solving with others."""
    problem, pressure = solution.problem, solution.pressure

    def changed(by: float) -> Problem:
        if region is None:
            return replace(problem, material=material(by))
        return replace(problem, materials={**problem.materials, region: material(by)})

    return difference(lambda s: responses(solved_near(changed(s), pressure, solution), found), step)
