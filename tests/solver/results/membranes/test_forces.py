"""Forces in membranes against closed forms; the balance of energy; wrinkles."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from films import BentStrip
from meshes import tube_mesh
from numpy.typing import NDArray
from scipy.integrate import quad

from solver import (
    Membrane,
    Mesh,
    Ogden,
    Problem,
    SolverOptions,
    Supports,
    Traction,
    membrane_forces,
    potential,
    reaction,
    solve,
    work,
)

Array = NDArray[np.float64]
Meshes = Callable[..., Mesh]
EXACT = SolverOptions(tolerance=1e-10, loose_tolerance=1e-10, maximum_iterations=20)
THIRDS = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2})


def test_a_film_on_a_block_is_stretched_along_two_axes(box: Meshes) -> None:
    """By 1.2 and 0.95: its forces and energy are those of plane stress; the block bears the rest.

    Per undeformed width the film bears Y t l (E1 + nu E2) / (1 - nu^2), E = (l^2 - 1) / 2; the
    block's stress is mu (l1^2 - l3^2).
    """
    mesh, film = box((2, 1, 1), (2.0, 1.0, 0.5)), Membrane("z1", 2.0, 0.3, 0.1)
    one, two = 1.2, 0.95

    def led(axis: int, displacement: float) -> Callable[[Array, float], Array]:
        along = np.where(np.arange(3) == axis, displacement, np.nan)
        return lambda places, load: load * along + 0 * places

    motions = {"x1": led(0, 2.0 * (one - 1)), "y1": led(1, two - 1)}
    supports = Supports(symmetry=THIRDS.symmetry, prescribed=motions)
    problem = Problem(mesh, Ogden.neo_hooke(1.0), supports, membranes=(film,))
    solution = solve(problem, options=EXACT)
    longwise, crosswise = (one**2 - 1) / 2, (two**2 - 1) / 2
    plane = film.stiffness / (1 - 0.3**2)
    borne = plane * one * (longwise + 0.3 * crosswise)
    (forces,) = membrane_forces(solution)
    assert forces.principal[:, 0] == pytest.approx(borne / two, rel=1e-8)
    across = plane * two * (crosswise + 0.3 * longwise)
    assert forces.principal[:, 1] == pytest.approx(across / one, rel=1e-8)
    stored = plane * (longwise**2 + crosswise**2 + 0.6 * longwise * crosswise)  # over 2 mm^2
    assert potential(solution).membranes == pytest.approx(stored, rel=1e-8)
    rubber = (one**2 - (one * two) ** -2) / one * 0.5
    assert reaction(solution, "x1").force[0] == pytest.approx(rubber + borne, rel=1e-8)


def pressure_of_tube(film: Membrane, shear_modulus: float, swelling: float) -> tuple[float, float]:
    """Pressure (MPa) and hoop force of the film (N/mm) of a tube with r^2 = R^2 + ``swelling``.

    Inner and outer radius 1 and 1.5 mm, plane strain: p = integral of mu (l^2 - l^-2) dr / r plus
    what the film bears, its hoop force over its radius, with l = r / R.
    """

    def ring(reference: float) -> float:
        square = reference**2 + swelling
        stretch = square / reference**2
        return shear_modulus * (stretch - 1 / stretch) * reference / square

    radius = np.sqrt(1.5**2 + swelling)
    stretch = radius / 1.5
    hoop = film.stiffness / (1 - film.poisson_ratio**2) * (stretch**2 - 1) / 2 * stretch
    return quad(ring, 1.0, 1.5)[0] + hoop / radius, hoop


def test_a_film_around_a_tube_bears_the_pressure_of_its_hoop_force() -> None:
    mesh = tube_mesh(1.0, 1.5, 0.4, (2, 6, 1), np.pi / 2)
    symmetry = {"start": 1, "end": 0, "z0": 2, "z1": 2}
    film = Membrane("outside", 60.0, 0.3, 0.1)
    pressure, hoop = pressure_of_tube(film, 0.5, 0.2)
    assert hoop / np.sqrt(1.5**2 + 0.2) > 0.8 * pressure
    problem = Problem(
        mesh, Ogden.neo_hooke(0.5), Supports(symmetry=symmetry), ("inside",), membranes=(film,)
    )
    solution = solve(problem, pressure, EXACT)
    assert solution.converged and solution.stable is not False
    outer = mesh.surface_nodes("outside")
    moved = np.linalg.norm((mesh.nodes + solution.displacement)[outer, :2], axis=1)
    assert moved == pytest.approx(np.sqrt(1.5**2 + 0.2), rel=2e-4)
    (forces,) = membrane_forces(solution)
    assert forces.principal[:, 0] == pytest.approx(hoop, rel=5e-3)
    assert not forces.compressed.any() and forces.warning == ""
    assert forces.areas.sum() == pytest.approx(0.4 * np.pi / 2 * 1.5, rel=1e-3)


def test_work_is_stored_in_body_and_membranes(box: Meshes) -> None:
    """A block with films is pulled and bent; the error of the work falls with the steps' square."""
    mesh = box((3, 1, 1), (3.0, 1.0, 1.0))
    films = (Membrane("z1", 50.0, 0.3, 0.05), Membrane("y1", 20.0, 0.4, 0.05))
    load = Traction("x1", (0.3, 0.0, -0.1))
    problem = Problem(
        mesh, Ogden.neo_hooke(1.0, 20.0), Supports(("x0",)), loads=(load,), membranes=films
    )
    errors = []
    for steps in (2, 4):
        last = solve(problem, 0.0, EXACT, stops=np.arange(1, steps) / steps)
        stored = potential(last)
        assert stored.membranes > 0.05 * stored.stored
        errors.append(work((*last.at_stops, last)).total / stored.stored - 1)
    assert abs(errors[1]) < 0.02
    assert errors[0] / errors[1] == pytest.approx(4, rel=0.25)


def test_a_film_on_the_inner_side_of_a_bend_is_said_to_wrinkle(box: Meshes) -> None:
    film = Membrane("z0", 4100.0, 0.0, 0.5, wrinkles=False)
    body = BentStrip(0.025, 20.0, 2.5, 2.0, 0.01, film)
    solution = solve(body.problem(box((4, 1, 1), (20.0, 2.5, 2.0))), options=EXACT)
    (forces,) = membrane_forces(solution)
    borne = 0.1 * 0.01 * 2.0**2 / 2  # 4 mu k h^2 / 2, of an outer side that is stretched
    assert forces.principal[:, 1] == pytest.approx(-borne, rel=0.1)
    assert "the membrane 'z0' is compressed over 100 % of its area" in forces.warning
    assert "a real film wrinkles there" in forces.warning
    assert solution.warnings == (forces.warning,)


def test_what_a_solve_leaves_in_a_film_that_is_not_strained_is_no_compression(box: Meshes) -> None:
    """A block is led along with its film and turned: nothing is strained but by rounding."""

    def turned(places: Array, load: float) -> Array:
        c, s = np.cos(2 * load), np.sin(2 * load)
        return places @ np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]]) - places

    supports = Supports(prescribed={"x0": turned})
    film = Membrane("z1", 2e3, 0.3, 0.1, wrinkles=False)
    solution = solve(Problem(box(), Ogden.neo_hooke(1.0), supports, membranes=(film,)))
    (forces,) = membrane_forces(solution)
    assert abs(forces.lowest) < 1e-8 * film.stiffness
    assert not forces.compressed.any()
    assert solution.warnings == ()
