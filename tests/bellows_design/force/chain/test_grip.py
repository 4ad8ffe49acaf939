"""Grips of rigid fingers on elastic hinges, by hand, and of soft ones."""

from __future__ import annotations

import numpy as np
import pytest
from linear_chains import LENGTH, beam, hinged_rod

from bellows_design.force.chain.contact.obstacles import Disc
from bellows_design.force.chain.grip import Grip, Pull, grip
from bellows_design.force.chain.surroundings import Surroundings

MOMENT_BY_PRESSURE, COMPLIANCE = 200.0, 0.02
CENTRE, RADIUS, FRICTION = (25.0, -14.0), 10.0, 0.4


def rigid_grip(friction: float, moment: float = MOMENT_BY_PRESSURE) -> Grip:
    around = Surroundings(objects=(Disc(CENTRE, RADIUS),), friction=friction)
    return grip(hinged_rod(moment, COMPLIANCE), around, [0.05, 0.1], Pull(step=0.5, longest=15.0))


def force_by_hand(way: float, friction: float) -> float:
    """Of a rod, tangent to the disc at the reach r from its hinge, that slides along it.

    N r = M with the moment that is left of the hinge's; friction acts along the rod.
    """
    x, z = CENTRE[0] + way, -CENTRE[1]
    angle = np.arctan2(z, x) - np.arcsin(RADIUS / np.hypot(x, z))
    reach = np.sqrt(x**2 + z**2 - RADIUS**2)
    normal = (MOMENT_BY_PRESSURE * 0.1 - angle / COMPLIANCE) / reach
    return float(normal * (np.sin(angle) + friction * np.cos(angle)))


@pytest.mark.parametrize("friction", [0.0, FRICTION])
def test_a_rigid_finger_holds_a_cylinder_as_computed_by_hand(friction: float) -> None:
    result = rigid_grip(friction)
    curve = [point for point in result.curve if point[0] > 0.6]
    expected = [force_by_hand(way, friction) for way, _ in curve]
    assert len(curve) > 10
    assert [force for _, force in curve] == pytest.approx(expected, rel=1e-2)
    assert result.largest_force == pytest.approx(force_by_hand(0.0, friction), rel=2e-2)


def test_a_held_object_is_in_equilibrium_and_a_heavier_one_slips() -> None:
    result = rigid_grip(FRICTION)
    for part in (0.3, 0.9):
        force = part * result.largest_force
        state = result.under(force)
        assert state is not None and any(point.sticks for point in state.contacts)
        assert result.pull.force(state) == pytest.approx(force, rel=5e-3)
    assert result.under(1.01 * result.largest_force) is None


def test_a_finger_that_does_not_reach_holds_nothing() -> None:
    result = rigid_grip(FRICTION, moment=1.0)
    assert result.let_go and result.largest_force == 0
    assert result.strongest is not None and result.strongest.contacts == ()
    assert result.under(0.1) is None


def test_friction_makes_a_soft_finger_hold_more() -> None:
    def held(friction: float) -> float:
        around = Surroundings(objects=(Disc((25.0, -16.0), 12.0),), friction=friction)
        result = grip(beam(10, 0.5), around, [0.04, 0.08], Pull(step=1.0))
        assert result.closing.ending is None
        return result.largest_force

    forces = [held(friction) for friction in (0.0, 0.5)]
    assert 0 < 1.5 * forces[0] < forces[1]


def test_the_length_of_the_rod_is_more_than_its_reach() -> None:
    """What is computed by hand holds while the disc is beside the rod."""
    assert np.hypot(CENTRE[0] + 15.0, CENTRE[1]) < LENGTH


def test_the_largest_force_depends_little_on_the_steps_of_the_pull() -> None:
    """It is looked for in eighths of them where it is largest: here a kink, as the rod slips."""
    around = Surroundings(objects=(Disc(CENTRE, RADIUS),), friction=0.7)
    rod = hinged_rod(MOMENT_BY_PRESSURE, COMPLIANCE)
    forces = [
        grip(rod, around, [0.05, 0.1], Pull(step=step, longest=6.0)).largest_force
        for step in (0.5, 0.125)
    ]
    assert forces[0] == pytest.approx(forces[1], rel=1e-2)
