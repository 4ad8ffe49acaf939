"""How a cell slips under a transverse force: beams with closed forms, and what may not matter."""

from __future__ import annotations

import numpy as np
import pytest
from meshes import bellows_cell_mesh, box_mesh
from resolved import TIGHT

from solver import (
    Contact,
    Couple,
    Mesh,
    Ogden,
    Problem,
    Solution,
    Supports,
    contact_forces,
    section_response,
    shear_compliance,
    solve,
)
from solver.errors import SolverError

MIDDLES = Supports(symmetry={"x0": 0, "y0": 1})
SOFT = Ogden.yeoh(0.5, 0.03, bulk_modulus=20.0)


def beam(length: float, elements: tuple[int, int, int]) -> Solution:
    """A slice of a wide plate, 1 mm thick and half as wide, incompressible with mu = 1 MPa."""
    supports = Supports(symmetry={"x0": 0, "y0": 1, "y1": 1})
    mesh = box_mesh(elements, (length, 0.5, 1.0))
    return solve(Problem(mesh, Ogden.neo_hooke(1.0), supports, moving_plane="x1"), options=TIGHT)


def cowper(length: float) -> float:
    """Slip of the beam: in plane strain nu = 1 and E = 4 mu, k = 10 (1 + nu) / (12 + 11 nu)."""
    area, inertia, modulus = 0.5, 0.5 / 12, 4.0
    return length / (20 / 23 * area) - 2 * length**3 / (3 * modulus * inertia)


@pytest.mark.parametrize("length", [0.5, 1.0, 2.0])
def test_a_beam_slips_as_cowper_s_shear_coefficient_says(length: float) -> None:
    found = shear_compliance(beam(length, (4, 1, 4)))
    assert found == pytest.approx(cowper(length), rel=2e-3)


def test_the_slip_of_a_beam_converges_with_its_mesh() -> None:
    coarse, fine = (abs(shear_compliance(beam(1.0, (n, 1, n))) - cowper(1.0)) for n in (2, 4))
    assert fine < coarse / 6


def test_a_section_that_stays_plane_is_stiffer() -> None:
    solution = beam(0.5, (4, 1, 4))
    assert shear_compliance(solution, warps=False) < 0.95 * shear_compliance(solution)


def pressed(
    couple: float, contacts: tuple[Contact, ...] = (), mesh: Mesh | None = None
) -> Solution:
    problem = Problem(
        bellows_cell_mesh() if mesh is None else mesh, SOFT, MIDDLES, ("cavity",),
        loads=(Couple(couple),), moving_plane="x1", contacts=contacts,
    )  # fmt: skip
    return solve(problem, 0.05, TIGHT)


def test_force_and_motion_do_not_depend_on_what_height_moments_refer_to() -> None:
    """What a force does in all, slip and the bending that is counted besides, stays the same."""
    mesh = bellows_cell_mesh()
    raised = mesh.moved(mesh.nodes + np.array([0.0, 0.0, 1.0]))
    motions, slips = [], []
    for solution in (pressed(0.4), pressed(0.4, mesh=raised)):
        section = section_response(solution)
        length = mesh.nodes[:, 0].max() + section.shift
        slips.append(shear_compliance(solution))
        motions.append(slips[-1] + section.derivatives[0, 0] * length**2)
    assert motions[1] == pytest.approx(motions[0], rel=1e-6)
    assert abs(slips[1] / slips[0] - 1) > 1e-3


def test_walls_that_touch_their_neighbour_s_keep_the_slip_finite() -> None:
    touching = pressed(-1.5, (Contact("outside", 0.05),))
    assert contact_forces(touching)[0].area > 0
    assert 0 < shear_compliance(touching) < 2 * shear_compliance(pressed(-1.5))


def test_walls_that_touch_at_the_middle_are_refused() -> None:
    problem = Problem(
        bellows_cell_mesh(), SOFT, MIDDLES, ("cavity",), moving_plane="x1",
        contacts=(Contact("cavity", 0.05, axis=0),),
    )  # fmt: skip
    sucked = solve(problem, -0.05, TIGHT)
    assert contact_forces(sucked)[0].area > 0
    with pytest.raises(SolverError, match="'cavity' touches its mirror image along x"):
        shear_compliance(sucked)


def test_a_body_without_a_moving_plane_is_refused() -> None:
    bar = Problem(box_mesh((1, 1, 1), (1.0, 1.0, 1.0)), SOFT, Supports(("x0",)))
    with pytest.raises(SolverError, match="needs a moving plane"):
        shear_compliance(solve(bar))
