"""Equilibria of an actuator while its cavity fills, free or with its tip on a plate."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np

from pneunets.body import CHAMBER_LENGTH, Actuator, mesh
from solver import (
    BodyForce,
    Membrane,
    Mesh,
    Ogden,
    Problem,
    RigidPlane,
    SlenderAxis,
    Solution,
    SolverOptions,
    Supports,
    cavity_volume,
    contact_forces,
    inflate,
    reaction,
)
from solver.nonlinear.events import Listener

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
    """The film, a membrane on the bottom; MPa, mm."""

    young_modulus: float = 4100.0
    poisson_ratio: float = 0.49
    thickness: float = 0.5
    wrinkles: bool = False


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
        plate: whether a frictionless plate lies under the end of the body.
        gap: angle by which the plate leans away from the body, about the clamp, degrees.
        highest: pressure at which the path may end, kPa.
    """

    body: Actuator
    material: Ogden
    film: Film = Film()
    near: float = 2.0
    far: float = 4.0
    weight: tuple[float, float, float] = (0.0, 0.0, 0.0)
    plate: bool = False
    gap: float = 0.0
    highest: float = 46.0

    def problem(self) -> Problem:
        """Half of it."""
        body = self.body
        stations = (0.0, *self._middles(), body.length)
        return Problem(
            self.mesh(),
            self.material,
            Supports(("clamp",), symmetry={"symmetry": 1}),
            pressurised=("cavity",),
            loads=self._loads(),
            contacts=self._contacts(),
            axis=None if self.plate else SlenderAxis(stations),
            **self._film(),
        )

    def _film(self) -> dict[str, Any]:
        """The film as a membrane, or as the material of its part."""
        film = self.film
        if self.body.film:
            mu = film.young_modulus / 2 / (1 + film.poisson_ratio)
            return {
                "materials": {"film": Ogden.neo_hooke(mu, bulk_modulus(mu, film.poisson_ratio))}
            }
        constants = (film.young_modulus, film.poisson_ratio, film.thickness)
        return {"membranes": (Membrane("bottom", *constants, wrinkles=film.wrinkles),)}

    def _middles(self) -> list[float]:
        """x of the middles of chambers and of the walls between them, mm."""
        half, starts = CHAMBER_LENGTH / 2, self.body.chamber_starts
        walls = [start + CHAMBER_LENGTH + self.body.wall / 2 for start in starts[:-1]]
        return sorted([*(start + half for start in starts), *walls])

    def mesh(self) -> Mesh:
        """Of the half; its surface ``pad`` is the part of the bottom that the plate may touch."""
        found = mesh(self.body, self.near, self.far)
        bottom = found.triangles("bottom")
        ends = found.nodes[bottom, 0].min(axis=1)
        pad = bottom[ends > self.body.length - PAD - 1e-6]
        return found.with_surfaces({"pad": pad})

    def _loads(self) -> tuple[BodyForce, ...]:
        size = DENSITY * 1e-9 * GRAVITY
        force = tuple(size * each for each in self.weight)
        return (BodyForce(force),) if any(force) else ()

    def _contacts(self) -> tuple[RigidPlane, ...]:
        if not self.plate:
            return ()
        sine, cosine = np.sin(np.radians(self.gap)), np.cos(np.radians(self.gap))
        edge = (self.body.clamp, 0.0, self.body.bottom)
        return (RigidPlane("pad", PENETRATION, (float(sine), 0.0, float(cosine)), edge),)


PAD = 5.0
"""Length of the end of the body that the plate may touch, mm."""

PENETRATION = 5.0
"""Of the plate at a pressure of the film's shear modulus, mm: 0.02 mm at 0.05 MPa."""


def tip_node(body: Actuator, mesh: Mesh) -> int:
    """The bottom centre of the free end."""
    return int(np.linalg.norm(mesh.nodes - [body.length, 0.0, body.bottom], axis=1).argmin())


Readings: TypeAlias = dict[str, float]


def readings(setup: Setup, solution: Solution) -> Readings:
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
        held = reaction(solution, "clamp").force
        found["force_n"] = 2 * float(np.linalg.norm(contact_forces(solution)[0].force))
        found["clamp_force_n"] = 2 * float(np.hypot(held[0], held[2]))
    return found


FILLED = (1.1, 1.2, 1.3, 1.45, 1.6, 1.8, 2.0, 2.3, 2.6, 3.0, 3.5, 4.0, 4.6, 5.3, 6.0, 7.0, 8.0, 9.0)
FILLED = (*FILLED, *(10.0 * 1.15**k for k in range(20)))
"""Volumes of the cavity at which a path is read, in those of the undeformed one."""

AT_ONCE = 4
"""Of these volumes in one call of ``inflate``."""


def path(
    setup: Setup, tell: Callable[[Readings], Any] = lambda _: None, listener: Listener | None = None
) -> list[Readings]:
    """Readings of equilibria of growing volume, until the pressure is above ``highest``."""
    found = []
    for solution in equilibria(setup, listener):
        found.append(readings(setup, solution))
        tell(found[-1])
    return found


def equilibria(setup: Setup, listener: Listener | None = None) -> Iterator[Solution]:
    """Equilibria of growing volume, as far as they are found."""
    problem = setup.problem()
    mesh = problem.mesh
    start = cavity_volume(mesh, np.zeros_like(mesh.nodes), problem.pressurised)
    options = SolverOptions(first_step=0.3, smallest_step=0.02)
    last = None
    for first in range(0, len(FILLED), AT_ONCE):
        *stops, end = (start * each for each in FILLED[first : first + AT_ONCE])
        last = inflate(problem, end, options, listener, stops, last)
        yield from last.at_stops
        if not last.converged:
            return
        yield last
        if 1e3 * last.pressure > setup.highest:
            return
