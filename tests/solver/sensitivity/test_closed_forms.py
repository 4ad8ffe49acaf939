"""Derivatives against closed forms, and against what scaling and rigid motions demand."""

from __future__ import annotations

import numpy as np
import pytest
from meshes import bellows_cell_mesh, box_mesh, sphere_mesh
from numpy.typing import NDArray
from resolved import TIGHT
from scipy.integrate import quad
from scipy.optimize import brentq

from solver import (
    Ogden,
    Problem,
    Sensitivities,
    Solution,
    Supports,
    Traction,
    constant_changes,
    sensitivities,
    solve,
)
from solver.material.law import Hyperelastic
from solver.material.mooney_rivlin import MooneyRivlin

Array = NDArray[np.float64]
RUBBER = Ogden((0.19825, 3.2778), (3.05, -0.0054))


def sphere_volume(inner: float, outer: float, pressure: float) -> float:
    """Volume inside an octant of a thick incompressible sphere, mm^3.

    p = integral of W'(l) / (l^3 - 1) over the hoop stretches l from outside to inside.
    """

    def slope(stretch: float) -> float:
        hoop = float(np.log(stretch))
        stress = RUBBER.principal_stresses([hoop, hoop, -2 * hoop])
        return 2 * float(stress[0] - stress[2]) / stretch

    def excess(stretch: float) -> float:
        outside = np.cbrt(1 + (inner / outer) ** 3 * (stretch**3 - 1))
        return quad(lambda s: slope(s) / (s**3 - 1), outside, stretch)[0] - pressure

    return float(np.pi / 6 * (inner * brentq(excess, 1.01, 1.3, xtol=1e-13)) ** 3)


def test_a_thick_sphere_grows_with_radii_and_pressure_as_its_closed_form() -> None:
    """The mesh errs by less than 1 % in the derivatives, which are steeper than the volume."""
    inner, outer, pressure = 10.0, 12.0, 0.2
    mesh = sphere_mesh(inner, outer, 2, 5)
    supports = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2})
    solution = solve(Problem(mesh, RUBBER, supports, ("inside",)), pressure, TIGHT)
    radius = np.linalg.norm(mesh.nodes, axis=1, keepdims=True)
    share = (radius - inner) / (outer - inner)
    velocities = {"inner": (1 - share) * mesh.nodes / radius, "outer": share * mesh.nodes / radius}
    found = sensitivities(solution, velocities, responses=("volume",)).derivatives["volume"]
    at = np.array([inner, outer, pressure])
    for place, name in enumerate(("inner", "outer", "pressure")):
        step = 1e-4 * at[place] * np.eye(3)[place]
        exact = (sphere_volume(*(at + step)) - sphere_volume(*(at - step))) / (2 * step[place])
        assert found[name] == pytest.approx(exact, rel=1e-2), name


def pulled_bar(modulus: float, stress: float) -> Solution:
    mesh = box_mesh((2, 1, 1), (2.0, 1.0, 1.0))
    supports = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2})
    loads = (Traction("x1", (stress, 0.0, 0.0)),)
    return solve(Problem(mesh, Ogden.neo_hooke(modulus), supports, loads=loads), 0.0, TIGHT)


def test_stress_of_a_pulled_bar_changes_with_modulus_and_not_with_size() -> None:
    """Dead traction t = mu (l - 1 / l^2), Cauchy stress t l, the same at all N nodes."""
    modulus, stress = 0.8, 0.6
    solution = pulled_bar(modulus, stress)
    stretch = brentq(lambda x: modulus * (x - x**-2) - stress, 1, 3)
    nodes = solution.problem.mesh.nodes
    velocities = {"length": nodes * [1, 0, 0], "width": nodes * [0, 1, 0]}
    changes = {"modulus": constant_changes(solution.problem.material)["mu_1"]}
    found = sensitivities(solution, velocities, changes)
    factor = len(nodes) ** (1 / found.smooth_peak.sharpness)
    assert found.smooth_peak.peak == pytest.approx(stress * stretch, rel=1e-9)
    assert found.smooth_peak.ratio == pytest.approx(factor, rel=1e-9)
    slope = -stress * stress / (modulus**2 * (1 + 2 / stretch**3))
    derivatives = found.derivatives["peak_stress"]
    assert derivatives["modulus"] == pytest.approx(factor * slope, rel=1e-7)
    assert abs(derivatives["length"]) < 1e-9 and abs(derivatives["width"]) < 1e-9


def cell(material: Hyperelastic) -> Solution:
    supports = Supports(symmetry={"x0": 0, "y0": 1})
    mesh = bellows_cell_mesh()
    problem = Problem(mesh, material, supports, ("cavity",), moving_plane="x1")
    return solve(problem, 0.1, TIGHT)


@pytest.fixture(scope="module")
def bent() -> Sensitivities:
    solution = cell(RUBBER)
    nodes = solution.problem.mesh.nodes
    velocities = {"size": nodes, "height": 0 * nodes + [0, 0, 1], "place": 0 * nodes + [1, 0, 0]}
    return sensitivities(solution, velocities, constant_changes(RUBBER))


def test_a_body_of_another_size_bends_alike(bent: Sensitivities) -> None:
    """No length but the body's own: rotation and stress stay, the volume goes with its cube."""
    sizes = {name: row["size"] for name, row in bent.derivatives.items()}
    assert sizes["volume"] == pytest.approx(3 * bent.responses["volume"], rel=1e-9)
    assert abs(sizes["rotation"]) < 1e-9 * bent.responses["rotation"]
    assert abs(sizes["peak_stress"]) < 1e-8 * bent.responses["peak_stress"]


@pytest.mark.parametrize("motion", ["height", "place"])
def test_where_a_body_lies_does_not_matter(bent: Sensitivities, motion: str) -> None:
    for name, row in bent.derivatives.items():
        assert abs(row[motion]) < 1e-9 * bent.responses[name], name


def test_stiffer_rubber_under_as_much_more_pressure_bends_alike(bent: Sensitivities) -> None:
    """Only the ratio of moduli and pressure bends; the stress goes with both."""
    moduli = dict(zip(("mu_1", "mu_2"), RUBBER.mu, strict=True)) | {"pressure": 0.1}
    for name, row in bent.derivatives.items():
        total = sum(value * row[parameter] for parameter, value in moduli.items())
        expected = bent.responses[name] if name == "peak_stress" else 0.0
        assert total == pytest.approx(expected, abs=1e-7 * bent.responses[name]), name


def test_one_constant_of_two_laws_has_one_derivative() -> None:
    """Mooney's and Rivlin's law with c10 and c01, as a polynomial and as two Ogden terms."""
    polynomial, terms = MooneyRivlin(0.9, 0.2), Ogden.mooney_rivlin(0.9, 0.2)
    one, two = (
        sensitivities(cell(law), materials=constant_changes(law)).derivatives
        for law in (polynomial, terms)
    )
    for response, row in one.items():
        by_terms = two[response]
        assert row["c10"] == pytest.approx(2 * by_terms["mu_1"], rel=1e-7)
        assert row["c01"] == pytest.approx(2 * by_terms["mu_2"], rel=1e-7)
