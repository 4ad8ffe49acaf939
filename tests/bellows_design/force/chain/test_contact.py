"""Objects in the way of a chain: distances, pressing, friction."""

from __future__ import annotations

import numpy as np
import pytest
from linear_chains import LENGTH, beam

from bellows_design.errors import BellowsError
from bellows_design.force.chain.contact.model import ContactModel
from bellows_design.force.chain.contact.obstacles import Disc, Obstacle, Plane, RoundedBox
from bellows_design.force.chain.finger.chain import Chain
from bellows_design.force.chain.loaded_chain import LoadedChain
from bellows_design.force.chain.path import follow, follow_loads, rest
from bellows_design.force.chain.state import ChainState
from bellows_design.force.chain.surroundings import DeadForce, Hold, LoadPoint, Surroundings

CURL = 0.4
"""Curvature by pressure, 1/mm per MPa: at 0.1 MPa a beam turns by 2 rad."""
OBSTACLES: tuple[Obstacle, ...] = (
    Plane((1.0, -2.0), (0.3, 2.0)),
    Disc((3.0, -4.0), 5.0),
    RoundedBox((2.0, -1.0), (4.0, 3.0), 1.5, 0.4),
)


@pytest.mark.parametrize("obstacle", OBSTACLES)
def test_derivatives_of_distances_agree_with_finite_differences(obstacle: Obstacle) -> None:
    points = np.random.default_rng(3).uniform(-12, 12, (200, 2))
    at, step = obstacle.distance(points), 1e-5
    assert obstacle.gap(points) == pytest.approx(at.value, abs=1e-12)
    for axis in (0, 1):
        ahead = obstacle.distance(points + step * np.eye(2)[axis])
        back = obstacle.distance(points - step * np.eye(2)[axis])
        slope = (ahead.value - back.value) / (2 * step)
        assert at.gradient[:, axis] == pytest.approx(slope, abs=1e-7)
        bend = (ahead.gradient - back.gradient) / (2 * step)
        assert at.hessian[:, :, axis] == pytest.approx(bend, abs=1e-6)
    assert np.hypot(*at.gradient.T) == pytest.approx(np.ones(200), abs=1e-12)


def test_a_box_is_as_far_as_its_faces_and_corners() -> None:
    box = RoundedBox((0.0, 0.0), (4.0, 3.0), 1.0)
    corner = np.array([3.0, 2.0]) + 2.5 * np.array([0.6, 0.8])
    distance = box.distance(np.array([[6.0, 1.0], [0.0, -3.5], corner, [0.0, 2.9]])).value
    assert distance == pytest.approx([2.0, 0.5, 1.5, -0.1], abs=1e-12)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Disc((0, 0), 0.0), "radius = 0 mm of a disc must be positive"),
        (lambda: Plane((0, 0), (0, 0)), "gives no direction"),
        (lambda: RoundedBox((0, 0), (2, 1), 1.5), "corner_radius = 1.5 mm .* at most .* 1 mm"),
    ],
)
def test_impossible_objects_are_refused(make: object, message: str) -> None:
    with pytest.raises(BellowsError, match=message):
        make()  # type: ignore[operator]


def test_an_object_inside_the_finger_is_refused() -> None:
    with pytest.raises(BellowsError, match="object 2 reaches 1 mm into the undeformed finger"):
        around = Surroundings(objects=(Disc((20, -8), 6.0), Disc((20, -4), 5.0)))
        follow(beam(4), around, [0.0])
    above = Surroundings(objects=(Disc((20, 0.5), 0.2),))
    with pytest.raises(BellowsError, match="object 1 reaches"):
        follow(beam(4), above, [0.0])


def test_a_wall_below_the_tip_does_what_a_load_cell_does() -> None:
    """As long as only the tip's edge touches; apart from the depth it is pressed in."""
    chain = beam(10, CURL)
    wall = Surroundings(objects=(Plane((0, -6.0), (0, 1)),))
    cell = Surroundings(hold=Hold.load_cell(-6.0))
    pressed, held = (follow(chain, around, [0.05, 0.1]).last for around in (wall, cell))
    assert [point.place for point in pressed.contacts] == pytest.approx([LENGTH])
    assert pressed.contact_force == pytest.approx((0.0, held.held_force[1]), rel=2e-3)
    assert pressed.tip == pytest.approx(held.tip, abs=0.05)
    assert pressed.contact_energy < 5e-3 * pressed.stored_energy


def test_objects_out_of_reach_leave_the_finger_alone() -> None:
    far = Surroundings(objects=(Disc((20.0, -300.0), 20.0),), friction=0.5)
    free, beside = (follow(beam(8, CURL), around, [0.1]).last for around in (Surroundings(), far))
    assert beside.contacts == ()
    assert beside.motions == pytest.approx(free.motions, abs=1e-12)


def pressed_on(model: ContactModel, obstacle: Obstacle, friction: float) -> ChainState:
    around = Surroundings(objects=(obstacle,), friction=friction, contact=model)
    path = follow(beam(14, CURL), around, np.linspace(0.01, 0.1, 10))
    assert path.ending is None
    return path.last


@pytest.mark.parametrize(
    "obstacle", [Disc((30.0, -22.0), 14.0), RoundedBox((30.0, -22.0), (10.0, 14.0), 3.0)]
)
@pytest.mark.parametrize(("friction", "bound"), [(0.0, 5e-3), (0.4, 1e-2)])
def test_neither_stiffness_nor_number_of_points_decides(
    obstacle: Obstacle, friction: float, bound: float
) -> None:
    usual = pressed_on(ContactModel(), obstacle, friction)
    scale = np.hypot(*usual.contact_force)
    for model in (ContactModel(stiffness=1000.0), ContactModel(spacing=0.04)):
        other = pressed_on(model, obstacle, friction)
        change = np.subtract(other.contact_force, usual.contact_force)
        assert np.hypot(*change) < bound * scale


GAP = 3.0
"""Of the tip above the floor, mm: so that the edge alone touches."""


def dragged_on(ways: tuple[float, ...], along: float = 0.0) -> list[ChainState]:
    """A beam, soft in length, whose tip is pressed on a floor of friction 0.4 that moves.

    A force pulls the tip ``along`` the floor.
    """
    around = Surroundings(
        objects=(Plane((0, -GAP), (0, 1)),),
        friction=0.4,
        dead_forces=(DeadForce(LENGTH, (along, -0.5)),),
        contact=ContactModel(stiffness=1000.0),
    )
    loaded = LoadedChain.of(beam(4, stretch=1.0), around)
    start = follow_loads(loaded, rest(loaded), [LoadPoint(forces=0.5), LoadPoint()]).last
    path = follow_loads(loaded, start, [LoadPoint(object_shift=(way, 0.0)) for way in ways])
    assert start.load.forces == 1 and path.ending is None
    assert all(len(state.contacts) == 1 for state in path.states)
    return [start, *path.states]


def test_a_block_sticks_up_to_the_coefficient_times_what_presses_it() -> None:
    """What the floor does not hold stretches the beam: 1 mm per mm and N, over 50 mm."""
    (held,), (slid,) = dragged_on((), 0.15), dragged_on((), 0.3)
    assert held.contacts[0].sticks and not slid.contacts[0].sticks
    assert abs(held.contact_force[0]) < 0.4 * held.contact_force[1]
    assert slid.contact_force[0] == pytest.approx(-0.4 * slid.contact_force[1], rel=1e-12)
    further = LENGTH * (0.3 + slid.contact_force[0] - 0.15 - held.contact_force[0])
    assert slid.tip[0] - held.tip[0] == pytest.approx(further, rel=0.02)


def test_a_floor_drags_a_beam_until_it_slips_and_back_at_once() -> None:
    start, dragged, slipped, still, back, fro = dragged_on((4.0, 12.0, 14.0, 10.0, -15.0))
    assert dragged.tip[0] - start.tip[0] == pytest.approx(4.0, abs=0.02)
    assert dragged.contacts[0].sticks and not slipped.contacts[0].sticks
    assert slipped.contact_force[0] == pytest.approx(0.4 * slipped.contact_force[1], rel=1e-12)
    assert still.tip == pytest.approx(slipped.tip, abs=1e-6)
    assert back.contacts[0].sticks
    assert back.tip[0] - still.tip[0] == pytest.approx(-4.0, abs=0.02)
    assert fro.contact_force[0] == pytest.approx(-0.4 * fro.contact_force[1], rel=1e-12)


@pytest.mark.parametrize("obstacle", [Disc((30.0, -22.0), 14.0), Disc((38.0, -12.0), 3.0)])
def test_a_finger_does_not_pass_through_an_object_in_one_step(obstacle: Disc) -> None:
    """Beyond it there is an equilibrium too, as if it were not there."""
    around = Surroundings(objects=(obstacle,))
    at_once = follow(beam(14, 3 * CURL), around, [0.1])
    slowly = follow(beam(14, 3 * CURL), around, np.linspace(0.005, 0.1, 20))
    assert at_once.ending is None and slowly.ending is None
    assert at_once.last.contacts
    assert at_once.last.tip == pytest.approx(slowly.last.tip, abs=1e-3)


def test_friction_never_exceeds_its_coefficient() -> None:
    state = pressed_on(ContactModel(), Disc((30.0, -22.0), 14.0), 0.3)
    for point in state.contacts:
        across = np.hypot(*point.force) ** 2 - point.normal_force**2
        assert across <= (0.3 * point.normal_force) ** 2 * (1 + 1e-9)
        assert point.normal_force > 0


def test_a_chain_without_pieces_of_its_own_length_still_has_a_tip() -> None:
    chain = Chain(beam(2, CURL).pieces, root_length=2.0, tip_length=3.0)
    around = Surroundings(objects=(Plane((0, -1.0), (0, 1)),))
    state = follow(chain, around, [0.02]).last
    assert state.contacts[-1].place == pytest.approx(LENGTH + 5.0)
