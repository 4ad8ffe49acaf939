"""The section between two cells under a couple, an axial force and pressure, and their work."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from meshes import bellows_cell_mesh, box_mesh
from resolved import TIGHT

from solver import (
    AxialForce,
    Contact,
    Couple,
    Mesh,
    Ogden,
    Problem,
    SectionDerivatives,
    Solution,
    Supports,
    contact_forces,
    neighbouring,
    potential,
    reaction,
    section_response,
    solve,
    work,
)
from solver.errors import SolverError

MIDDLES = Supports(symmetry={"x0": 0, "y0": 1})
SOFT = Ogden.yeoh(0.5, 0.03, bulk_modulus=20.0)
STEPS = np.array([1e-3, 1e-3, 1e-5])
"""Of couple (N mm), axial force (N) and pressure (MPa): a ten thousandth of those in the states."""


def cell(contacts: tuple[Contact, ...], loads: tuple[float, float, float]) -> Problem:
    couple, force, _ = loads
    return Problem(
        bellows_cell_mesh(), SOFT, MIDDLES, ("cavity",), loads=(Couple(couple), AxialForce(force)),
        moving_plane="x1", contacts=contacts,
    )  # fmt: skip


STATES = {
    "free": ((), (0.4, 0.4, 0.05)),
    "walls that touch": ((Contact("outside", 0.05),), (-1.5, 0.1, 0.08)),
}


@cache
def solved(name: str) -> Solution:
    contacts, loads = STATES[name]
    return solve(cell(contacts, loads), loads[2], TIGHT)


def beside(name: str, change: np.ndarray) -> SectionDerivatives:
    """The section at loads that differ by a change (3,)."""
    contacts, loads = STATES[name]
    there = tuple((np.array(loads) + change).tolist())
    found = neighbouring(cell(contacts, there), there[2], solved(name), options=TIGHT).solution
    assert found is not None
    return section_response(found)


def differences(name: str, value: Callable[[SectionDerivatives], np.ndarray]) -> np.ndarray:
    """Derivatives of a value by the loads, by central differences of fourth order."""
    columns = []
    for number, step in enumerate(STEPS):
        change = step * np.eye(3)[number]
        near, far = (
            value(beside(name, s * change)) - value(beside(name, -s * change)) for s in (1, 2)
        )
        columns.append((8 * near - far) / (12 * step))
    return np.array(columns).T


def motion(section: SectionDerivatives) -> np.ndarray:
    return np.array([section.tilt, section.shift, section.volume])


@pytest.mark.parametrize("name", STATES)
@pytest.mark.thorough
def test_derivatives_are_those_of_cells_solved_anew(name: str) -> None:
    found = section_response(solved(name)).derivatives
    assert differences(name, motion) == pytest.approx(found, rel=1e-6)


@pytest.mark.parametrize("name", STATES)
def test_what_one_load_does_to_another_s_motion_is_mutual(name: str) -> None:
    found = section_response(solved(name)).derivatives
    assert found == pytest.approx(found.T, rel=1e-9)
    assert (np.linalg.eigvalsh(found) > 0).all()  # the states are stable


@pytest.mark.parametrize("name", STATES)
@pytest.mark.thorough
def test_complementary_energy_changes_by_the_motions(name: str) -> None:
    slopes = differences(name, lambda section: np.array(section.complementary_energy))
    assert slopes == pytest.approx(motion(section_response(solved(name))), rel=1e-7)


def test_walls_touch_in_the_state_where_they_may() -> None:
    assert contact_forces(solved("walls that touch"))[0].area > 1.0


def test_the_factorization_of_a_neighbour_is_enough() -> None:
    contacts, loads = STATES["free"]
    there = (loads[0] + 0.01, *loads[1:])
    beside = neighbouring(cell(contacts, there), loads[2], solved("free"))
    assert beside.solution is not None
    at_hand = section_response(beside.solution, beside.newton)
    anew = section_response(beside.solution)
    assert (at_hand.factorizations, anew.factorizations) == (0, 1)
    assert at_hand.derivatives == pytest.approx(anew.derivatives, rel=1e-7)


def test_an_axial_force_stretches_a_block_as_in_uniaxial_tension() -> None:
    """An incompressible neo-Hookean block: f = A mu (s - 1 / s^2), in its middle.

    Its force acts half of the height at rest below that, so that a couple has to keep it straight.
    """
    mesh = box_mesh((2, 1, 1), (2.0, 1.0, 1.0))
    stretch = 1.3
    force = stretch - stretch**-2
    loads = (AxialForce(force), Couple(force * 0.5))
    supports = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2})
    problem = Problem(mesh, Ogden.neo_hooke(1.0), supports, loads=loads, moving_plane="x1")
    found = solve(problem, options=TIGHT)
    assert found.plane == pytest.approx((0.0, 2.0 * (stretch - 1)), abs=1e-8)
    assert reaction(found, "x0").force[0] == pytest.approx(-force, rel=1e-9)
    section = section_response(found)
    assert section.volume == section.derivatives[2, 2] == 0.0


def test_an_axial_force_does_on_the_way_what_is_stored(cell: Mesh) -> None:
    """With a couple on the plane that turns, and the pressure on the opening."""
    loads = (Couple(1.0), AxialForce(0.2), AxialForce(0.3))
    problem = Problem(cell, SOFT, MIDDLES, ("cavity",), loads=loads, moving_plane="x1")
    errors = []
    for steps in (4, 8):
        stops = 0.04 * np.arange(1, steps) / steps
        last = solve(problem, 0.04, TIGHT, stops=stops)
        stored = potential(last).stored
        errors.append(work((*last.at_stops, last)).total - stored)
    assert abs(errors[1]) < 0.01 * stored
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.15)  # the trapezoidal rule


def test_a_section_needs_a_moving_plane_and_an_equilibrium() -> None:
    bar = Problem(box_mesh((1, 1, 1), (1.0, 1.0, 1.0)), SOFT, Supports(("x0",)))
    with pytest.raises(SolverError, match="section_response: the problem has no moving plane"):
        section_response(solve(bar))
    with pytest.raises(SolverError, match="section_response: the solution did not"):
        section_response(replace(solved("free"), converged=False, message="stopped."))
