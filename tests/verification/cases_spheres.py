"""Spheres: inflation past the limit point."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial

import numpy as np
from case import Case, Order, Outcome, Row
from measures import observed_order
from meshes import sphere_mesh
from references import NEO_HOOKE, NINJAFLEX, TRELOAR, closed_form

from solver import (
    Ogden,
    PathPoint,
    Problem,
    SolverOptions,
    Supports,
    cavity_volume,
    inflate,
    trace,
)

OPTIONS = SolverOptions(tolerance=1e-8, maximum_iterations=15)


@dataclass(frozen=True)
class Shell:
    """A thick sphere: key of its reference, material, radii (mm) and the mesh of its octant.

    ``spherical``: it stays a sphere to this stretch of its cavity. ``order_at``: where the order of
    convergence is measured, if at all.
    """

    key: str
    title: str
    material: Ogden
    inner: float
    outer: float
    layers: int
    spherical: float = 5.0
    order_at: str = ""
    divisions: int = 4

    def problem(self, layers: int, divisions: int) -> Problem:
        """Pressure in an octant between planes of symmetry."""
        mesh = sphere_mesh(self.inner, self.outer, layers, divisions)
        supports = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2})
        return Problem(mesh, self.material, supports, ("inside",))

    @property
    def reference(self) -> dict:
        """Pressures over stretches, and limit points."""
        return closed_form("S1")["reference"][self.key]


def at_rest(problem: Problem) -> float:
    """Cavity of the undeformed octant, mm^3."""
    return cavity_volume(problem.mesh, np.zeros_like(problem.mesh.nodes), ("inside",))


def stretch_of(problem: Problem, point: PathPoint) -> float:
    """Growth of the cavity's radius at a point of a path."""
    return float(np.cbrt(point.volume / at_rest(problem)))


SHELLS = (
    Shell("NinjaFlex_A10_B12", "NinjaFlex, 10 to 12 mm", NINJAFLEX, 10.0, 12.0, 1, 1.5, "1.25"),
    Shell("NinjaFlex_A10_B11", "NinjaFlex, 10 to 11 mm", NINJAFLEX, 10.0, 11.0, 1, 1.5),
    Shell("NeoHooke_mu1_A1_B2", "neo-Hooke, 1 to 2 mm", NEO_HOOKE, 1.0, 2.0, 3),
    Shell("NeoHooke_mu1_A10_B11", "neo-Hooke, 10 to 11 mm", NEO_HOOKE, 10.0, 11.0, 2),
    Shell("Treloar_A10_B11", "Treloar's rubber, 10 to 11 mm", TRELOAR, 10.0, 11.0, 1),
)


def pressures(problem: Problem, stretches: list[str]) -> list[float]:
    """Pressures (MPa) that hold the cavity at ascending stretches of its radius."""
    volumes = [at_rest(problem) * float(stretch) ** 3 for stretch in stretches]
    solution = inflate(problem, volumes[-1], OPTIONS, stops=volumes)
    assert solution.converged, solution.message
    reached = np.array([point.volume for point in solution.path])
    return [solution.path[int(abs(reached - volume).argmin())].pressure for volume in volumes]


def inflated(shell: Shell) -> Outcome:
    """Pressures by volume control, limit points by arc length, and the order of the pressure."""
    problem = shell.problem(shell.layers, shell.divisions)
    rows = under_volume_control(shell, problem) + limit_points(shell, problem)
    mesh = f"octant of {len(problem.mesh.tets)} tetrahedra"
    if not shell.order_at:
        return Outcome(rows, mesh=mesh)
    order = Order(f"pressure at {shell.order_at}", pressure_order(shell), 3.5, "4")
    return Outcome(rows, (order,), f"{mesh}; order on {len(REFINEMENTS)} meshes")


def under_volume_control(shell: Shell, problem: Problem) -> tuple[Row, ...]:
    """Pressures at the listed stretches."""
    expected = shell.reference["P_of_lambda_a"]
    stretches = [stretch for stretch in expected if float(stretch) <= shell.spherical]
    return tuple(
        Row(f"pressure at {stretch} times the radius", expected[stretch], ours, 5e-3, "MPa")
        for stretch, ours in zip(stretches, pressures(problem, stretches), strict=True)
    )


REFINEMENTS = (1, 2, 4)


def pressure_order(shell: Shell) -> float:
    """Order of the pressure at one stretch, in thickness and along the surface at once."""
    reference = shell.reference["P_of_lambda_a"][shell.order_at]
    errors = []
    for n in REFINEMENTS:
        (found,) = pressures(shell.problem(n, 2 * n), [shell.order_at])
        errors.append(abs(found / reference - 1))
    return observed_order(REFINEMENTS, errors)


def limit_points(shell: Shell, problem: Problem) -> tuple[Row, ...]:
    """The limit points met by arc length."""
    expected = shell.reference["limit_points"]
    beyond = 1.15 * expected[-1]["lambda_a"]
    walked = trace(problem, 1.0, OPTIONS, until=lambda at: stretch_of(problem, at) > beyond)
    kinds = [limit.kind for limit in walked.limits]
    assert kinds == [{"max": "maximum", "min": "minimum"}[e["type"]] for e in expected], kinds
    rows: list[Row] = []
    for limit, entry in zip(walked.limits, expected, strict=True):
        pressure, stretch = limit.point.pressure, stretch_of(problem, limit.point)
        rows += [
            Row(f"pressure at the {limit.kind}", entry["P"], pressure, 5e-3, "MPa"),
            Row(f"stretch at the {limit.kind}", entry["lambda_a"], stretch, 1e-2, digits=3),
        ]
    return tuple(rows)


BRANCHES = (
    " Near twice the radius other shapes branch off from the sphere, on every mesh. The closed "
    "form beyond is no stable state even at a held volume, so it is left out."
)
CASES = tuple(
    Case(
        f"S1 Thick sphere of {shell.title}",
        "The pressure that holds the cavity at given volumes, past the maximum that a pressure "
        "alone cannot pass, and the limit points met by arc length. Stretches are those of the "
        "cavity's radius." + (BRANCHES if shell.spherical < 2 else ""),
        closed_form("S1")["source"] + ".",
        partial(inflated, shell),
    )
    for shell in SHELLS
)
