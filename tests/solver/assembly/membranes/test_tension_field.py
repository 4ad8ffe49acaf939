"""Films that wrinkle: derivatives and convexity of their energy, and closed forms."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from meshes import cell_mesh
from numpy.typing import NDArray

from solver import (
    Membrane,
    Mesh,
    Ogden,
    Problem,
    Solution,
    SolverOptions,
    Supports,
    membrane_forces,
    potential,
    reaction,
    solve,
)
from solver.assembly.membranes import tension_field

Array = NDArray[np.float64]
Meshes = Callable[..., Mesh]
FILM = Membrane("z1", 100.0, 0.3, 0.1)
LAWS = [replace(FILM, poisson_ratio=nu) for nu in (-0.4, 0.3, 0.5)]
EXACT = SolverOptions(tolerance=1e-10, loose_tolerance=1e-10)


def strains(first: float, second: float, count: int = 50) -> Array:
    """Components (count, 3) of strains of these principal values, along random directions."""
    angle = np.random.default_rng(3).uniform(0, np.pi, count)
    mean, half = (first + second) / 2, (first - second) / 2
    parts = [mean + half * np.cos(2 * angle), mean - half * np.cos(2 * angle)]
    return np.stack([*parts, np.sqrt(2) * half * np.sin(2 * angle)], axis=1)


REGIMES = {"taut": (0.2, 0.1), "wrinkled": (0.2, -0.3), "slack": (-0.1, -0.2)}


@pytest.mark.parametrize("film", LAWS)
@pytest.mark.parametrize("regime", REGIMES)
def test_stress_and_stiffness_are_derivatives(film: Membrane, regime: str) -> None:
    """The stiffness with the turning of the direction of tension."""
    at, step = strains(*REGIMES[regime]), 1e-6
    stress, stiffness = tension_field.stress(film, at), tension_field.stiffness(film, at)
    for along in np.eye(3):
        ahead, behind = at + step * along, at - step * along
        change = tension_field.energy(film, ahead) - tension_field.energy(film, behind)
        assert stress @ along == pytest.approx(change / (2 * step), abs=1e-8 * film.stiffness)
        turned = tension_field.stress(film, ahead) - tension_field.stress(film, behind)
        assert stiffness @ along == pytest.approx(turned / (2 * step), abs=1e-8 * film.stiffness)


@pytest.mark.parametrize("film", LAWS)
def test_energy_and_stress_are_continuous_where_regimes_meet(film: Membrane) -> None:
    """Taut to wrinkled where E2 = -nu E1, wrinkled to slack where E1 = 0; the stiffness jumps."""
    taut = strains(0.2, -film.poisson_ratio * 0.2)
    slack = strains(0.0, -0.2)
    for border, inward in ((taut, strains(0.0, 1e-9)), (slack, strains(1e-9, 0.0))):
        here, there = border - inward, border + inward
        for law in (tension_field.energy, tension_field.stress):
            assert law(film, here) == pytest.approx(law(film, there), abs=1e-8 * film.stiffness)
        jump = tension_field.stiffness(film, there) - tension_field.stiffness(film, here)
        assert np.linalg.norm(jump, axis=(1, 2)).min() > 0.5 * film.stiffness


@pytest.mark.parametrize("film", LAWS)
def test_the_energy_is_convex_and_below_that_of_a_film_that_bears_compression(
    film: Membrane,
) -> None:
    one, other = np.random.default_rng(4).normal(size=(2, 1000, 3))
    apart = tension_field.stress(film, one) - tension_field.stress(film, other)
    assert (apart * (one - other)).sum(axis=1).min() >= -1e-12 * film.stiffness
    bearing = tension_field.energy(replace(film, wrinkles=False), one)
    assert (tension_field.energy(film, one) <= bearing * (1 + 1e-12)).all()


def led(*rows: tuple[float, float, float]) -> Callable[[Array, float], Array]:
    """The displacement gradient of these rows, in proportion to the load; NaN rows are free."""
    gradient = np.array(rows)
    return lambda places, load: load * places @ gradient.T


def stretched(mesh: Mesh, film: Membrane, *rows: tuple[float, float, float]) -> Solution:
    """A soft block whose four sides are led by a displacement gradient in the plane of its film."""
    free = (np.nan, np.nan, np.nan)
    motions = dict.fromkeys(("x0", "x1", "y0", "y1"), led(*rows, free))
    supports = Supports(symmetry={"z0": 2}, prescribed=motions)
    problem = Problem(mesh, Ogden.neo_hooke(1e-2), supports, membranes=(film,))
    return solve(problem, options=EXACT)


def test_a_sheared_film_bears_tension_along_its_diagonal_only(box: Meshes) -> None:
    """E1 = g / 4 (g + sqrt(g^2 + 4)) for the shear g: energy Y t E1^2 / 2 per area.

    At small shear the tension at 45 degrees is Y t g / 2, and the energy that of a shear modulus
    Y / 4: for whatever Poisson's ratio.
    """
    shear = 0.1
    solution = stretched(box((2, 2, 1)), FILM, (0.0, shear, 0.0), (0.0, 0.0, 0.0))
    first = shear / 4 * (shear + np.hypot(shear, 2))
    assert potential(solution).membranes == pytest.approx(FILM.stiffness / 2 * first**2, rel=1e-8)
    (forces,) = membrane_forces(solution)
    tension = FILM.stiffness * first * (1 + 2 * first)  # on a width that shrinks by 1 / l1
    assert forces.principal[:, 0] == pytest.approx(tension, rel=1e-8)
    assert forces.principal[:, 1] == pytest.approx(0, abs=1e-12 * tension)


def test_a_film_that_is_pressed_together_bears_nothing(box: Meshes) -> None:
    solution = stretched(box((2, 2, 1)), FILM, (-0.1, 0.0, 0.0), (0.0, -0.05, 0.0))
    assert potential(solution).membranes == 0
    assert not membrane_forces(solution)[0].principal.any()


def test_a_stretched_film_that_is_bent_is_as_stiff_as_theory_says() -> None:
    """M. Stein, J. M. Hedgepeth, Analysis of partly wrinkled membranes, NASA TN D-813, 1961.

    Of the height h a band is slack, the rest c has the tension Y t k y' of the curvature k: so
    T = Y t k c^2 / 2 and M = T (h / 2 - c / 3). A film that bears compression takes M = Y t k h^3
    / 12, 2.1 times as much here. In terms of both, k = 2 T / (Y t (3 h / 2 - 3 M / T)^2).
    """
    height, taut, curvature = 2.0, 1.2, 2e-4
    lines = [np.array([0.0, 1.0]), np.linspace(-1, 1, 9), np.array([0.0, 0.1])]
    mesh = cell_mesh(np.ones((1, 8, 1), int), lines)

    def ends(places: Array, load: float) -> Array:
        along = load * curvature * (places[:, 1] + taut - height / 2)
        return np.stack([along, *np.full((2, len(along)), np.nan)], axis=1)

    supports = Supports(
        symmetry={"x0": 0, "z0": 2}, nodes={(0.0, -1.0, 0.0): 1}, prescribed={"x1": ends}
    )
    soft = Ogden.neo_hooke(1e-3 * FILM.stiffness)  # with 0.06 % of the film's stiffness
    solution = solve(Problem(mesh, soft, supports, membranes=(FILM,)), options=EXACT)
    assert solution.converged, solution.message
    support = reaction(solution, "x1")
    tension, moment = support.force[0], -support.moment[2]
    assert tension == pytest.approx(FILM.stiffness * curvature * taut**2 / 2, rel=0.01)
    assert moment == pytest.approx(tension * (height / 2 - taut / 3), rel=0.01)
    assert tension * height / 6 < moment  # wrinkled
