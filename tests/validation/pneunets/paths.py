"""Equilibria of an actuator while its cavity fills, free or with its tip on a plate."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from pneunets.body import Actuator, mesh
from solver import (
    BodyForce,
    Membrane,
    Mesh,
    Ogden,
    Problem,
    RigidPlane,
    Solution,
    SolverOptions,
    Supports,
    cavity_volume,
    contact_forces,
    inflate,
)

DENSITY, GRAVITY = 1070.0, 9.81  # kg/m^3, m/s^2

OGDEN_MU = (0.0243610418, 6.67031797e-5, 4.5381009e-4)  # MPa, of Abaqus's form
OGDEN_ALPHA = (1.7137765693, 7.0678724376, -3.3658807088)
YEOH = (0.0132228954, -1.42340891e-4, 2.01153264e-5)  # MPa


def bulk_modulus(shear_modulus: float, poisson_ratio: float) -> float:
    """Of the undeformed material, MPa."""
    return 2 * shear_modulus * (1 + poisson_ratio) / (3 * (1 - 2 * poisson_ratio))


def ogden(poisson_ratio: float = 0.48, stiffness: float = 1.0) -> Ogden:
    """The published fit of three terms, times ``stiffness``."""
    mu = tuple(stiffness * each for each in OGDEN_MU)
    return Ogden(mu, OGDEN_ALPHA, bulk_modulus(sum(mu), poisson_ratio))


def yeoh(poisson_ratio: float = 0.48, stiffness: float = 1.0) -> Ogden:
    """The published fit of Yeoh's law, times ``stiffness``."""
    first, *higher = (stiffness * each for each in YEOH)
    return Ogden.yeoh(first, *higher, bulk_modulus=bulk_modulus(2 * first, poisson_ratio))


@dataclass(frozen=True)
class Film:
    """The silk film: MPa, mm; it is held where the body is."""

    young_modulus: float = 4100.0
    poisson_ratio: float = 0.49
    thickness: float = 0.5


@dataclass(frozen=True)
class Setup:
    """An actuator, what it is made of, and how finely it is meshed.

    Attributes:
        body: dimensions.
        material: of the silicone.
        film: on its bottom.
        near: edges at the chambers, mm.
        far: largest edges, mm.
        weight: direction of gravity; none by default.
        plate: whether a frictionless plate lies under the body.
        highest: pressure at which the path may end, kPa.
    """

    body: Actuator
    material: Ogden
    film: Film | None = Film()
    near: float = 2.0
    far: float = 4.0
    weight: tuple[float, float, float] = (0.0, 0.0, 0.0)
    plate: bool = False
    highest: float = 46.0

    def problem(self) -> Problem:
        """Half of it."""
        body, film = self.body, self.film
        films = () if film is None else (Membrane("film", film.young_modulus, film.poisson_ratio, film.thickness),)
        return Problem(
            self.mesh(),
            self.material,
            Supports(("clamp",), symmetry={"symmetry": 1}),
            pressurised=("cavity",),
            loads=self._loads(),
            contacts=self._contacts(),
            membranes=films,
        )

    def mesh(self) -> Mesh:
        """Of the half."""
        return mesh(self.body, self.near, self.far)

    def _loads(self) -> tuple[BodyForce, ...]:
        size = DENSITY * 1e-9 * GRAVITY
        force = tuple(size * each for each in self.weight)
        return (BodyForce(force),) if any(force) else ()

    def _contacts(self) -> tuple[RigidPlane, ...]:
        if not self.plate:
            return ()
        return (RigidPlane("film", PENETRATION, (0.0, 0.0, 1.0), (0.0, 0.0, -self.body.layer)),)


PENETRATION = 0.05
"""Of the plate at a pressure of the shear modulus, mm."""


def tip_node(body: Actuator, mesh: Mesh) -> int:
    """The bottom centre of the free end."""
    return int(np.linalg.norm(mesh.nodes - [body.length, 0.0, -body.layer], axis=1).argmin())


def readings(setup: Setup, solution: Solution) -> dict[str, float]:
    """Numbers of an equilibrium of the whole actuator."""
    body, problem = setup.body, solution.problem
    x, _, z = solution.displacement[tip_node(body, problem.mesh)]
    end = solution.path[-1]
    found = {
        "pressure_kpa": 1e3 * solution.pressure,
        "angle_deg": float(np.degrees(np.arctan2(-z, body.free_length + x))),
        "tip_x_mm": float(x),
        "tip_z_mm": float(z),
        "volume_mm3": 2 * end.volume,
        "stable": float(bool(end.stable)),
        "stable_at_volume": float(bool(end.stable_at_volume)),
    }
    if setup.plate:
        found["force_n"] = 2 * contact_forces(solution)[0].force[2]
    return found


STEPS = {"pressure_kpa": 3.0, "angle_deg": 6.0, "force_n": 0.1}
"""Wanted changes from one equilibrium to the next."""

FIRST_GROWTH, LARGEST_GROWTH = 1.03, 1.35
"""Of the volume, in the first step and in any."""


def path(setup: Setup, tell: Callable[[dict[str, float]], Any] = lambda _: None) -> list[dict[str, float]]:
    """Readings of equilibria of growing volume, until the pressure is above ``highest``."""
    found = []
    for solution in equilibria(setup):
        found.append(readings(setup, solution))
        tell(found[-1])
    return found


def equilibria(setup: Setup) -> Iterator[Solution]:
    """Equilibria of growing volume."""
    problem = setup.problem()
    mesh = problem.mesh
    volume = cavity_volume(mesh, np.zeros_like(mesh.nodes), problem.pressurised)
    start, growth, former, solution = volume, FIRST_GROWTH, None, None
    while volume < MOST * start:
        volume *= growth
        solution = inflate(problem, volume, SolverOptions(first_step=1.0), after=solution)
        if not solution.converged:
            return
        yield solution
        now = readings(setup, solution)
        if now["pressure_kpa"] > setup.highest:
            return
        growth = next_growth(growth, former, now)
        former = now


MOST = 60.0
"""Volume at which a path ends, in those of the undeformed cavity."""


def next_growth(growth: float, former: dict[str, float] | None, now: dict[str, float]) -> float:
    """Growth of the volume that changes the readings by about ``STEPS``."""
    if former is None:
        return growth
    change = max(abs(now[key] - former[key]) / step for key, step in STEPS.items() if key in now)
    return float(min(1 + (growth - 1) * min(1 / max(change, 0.25), 2.5), LARGEST_GROWTH))
