"""What a finger exerts: closed forms of small pressures, balances of energy, and what cannot be."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import pytest
from linear_finger import BEND, DESIGN, TURN, arms, linear_law

from bellows_design.design import load_design, with_overrides
from bellows_design.design.scenes.blocked import Blocked
from bellows_design.design.scenes.free import Free
from bellows_design.design.scenes.grip import Grip
from bellows_design.design.scenes.payload import Payload
from bellows_design.errors import DesignError
from bellows_design.force.curve import force_curve
from bellows_design.force.finger_law import Uncertainty
from bellows_design.force.result import ForceCurve
from bellows_design.force.scene.solved import Solved
from bellows_design.force.scene.surroundings import weights_of
from bellows_design.force.section_law import LinearLaw, SectionResponse
from solver.arrays import Reals

SMALL = 1e-4
"""MPa: rotations of some 0.01 rad in all, so that squares of them are below 1e-3."""

GRIP = Grip(size=30.0, mass_g=50.0, distance=18.0, place=44.0)
DRAWING = Grip(size=30.0, mass_g=50.0, distance=18.0, place=38.0)
"""Nearer to the root, so that the finger closes beyond the object's middle."""


def curve(scene: object, *pressures: float, **facts: object) -> ForceCurve:
    """Of the linear finger."""
    return force_curve(DESIGN, scene, pressures, linear_law(**facts))  # type: ignore[arg-type]


def replace_mass(scene: Grip, mass_g: float) -> Grip:
    """The same grip of another mass."""
    return Grip.model_validate(scene.model_dump() | {"mass_g": mass_g})


def test_a_blocked_tip_exerts_what_bends_all_pieces_back() -> None:
    reach = arms()
    expected = TURN * SMALL * reach.sum() / (BEND * (reach**2).sum())
    found = curve(Blocked(), SMALL).last
    assert found.force_n == pytest.approx(expected, rel=1e-3)
    assert found.components_n == pytest.approx((0, -expected), rel=1e-3)
    assert found.tip_position_mm[1] == pytest.approx(0, abs=1e-9)


def test_its_force_falls_with_the_tips_stiffness_until_the_free_tip_is_reached() -> None:
    stiffness = 1 / (BEND * (arms() ** 2).sum())
    found = curve(Blocked(), SMALL)
    free = curve(Free(), SMALL).last
    assert found.tip_stiffness_n_per_mm == pytest.approx(stiffness, rel=1e-3)
    last = found.by_distance[-1]
    assert last.force_n == 0
    assert last.distance_mm == pytest.approx(-free.tip_position_mm[1], rel=1e-9)
    for each in found.by_distance:
        assert each.distance_mm is not None
        expected = found.last.force_n - stiffness * each.distance_mm
        assert each.force_n == pytest.approx(expected, abs=2e-3 * found.last.force_n)
    triangle = found.last.force_n**2 / stiffness / 2
    # Ten intervals and one less than half of one beyond: the sum of trapezia is as good.
    assert found.tip_work_mj == pytest.approx(triangle, rel=2e-2)


def test_a_tip_that_is_held_bears_the_couple_that_turns_all_pieces_back() -> None:
    found = curve(Blocked(support="held"), SMALL).last
    assert found.moment_n_mm == pytest.approx(-TURN * SMALL / BEND, rel=1e-6)
    assert found.tip_angle_deg == pytest.approx(0, abs=1e-9)


def test_a_wall_at_the_rest_height_bears_what_a_load_cell_bears() -> None:
    wall, cell = (
        force_curve(DESIGN, each, (0.1,), linear_law(), by_distance=False).last
        for each in (Blocked(support="wall"), Blocked())
    )
    # The wall gives way by a penalty of some micrometres.
    assert wall.force_n == pytest.approx(cell.force_n, rel=1e-3)
    assert wall.moment_n_mm == pytest.approx(0, abs=0.05)


@pytest.mark.parametrize("scene", [Free(), Blocked(), Blocked(support="held")])
def test_the_work_of_the_pressure_is_the_energy_stored(scene: Free | Blocked) -> None:
    solved = Solved.of(DESIGN, scene, (0.1,), linear_law())
    stored = solved.path.last.stored_energy - solved.path.steps[0].stored_energy
    assert curve(scene, 0.1).pneumatic_work_mj == pytest.approx(stored, rel=1e-3)


def test_a_payload_bends_the_finger_by_its_moments() -> None:
    """The finger's own weight, with its centre above the lower side, makes it somewhat softer."""
    found = curve(Payload(mass_g=1e-3), SMALL)
    free = curve(Free(gravity=(0.0, -1.0)), SMALL)
    more = free.last.tip_position_mm[1] - found.last.tip_position_mm[1]
    assert more == pytest.approx(1e-6 * 9.80665 * BEND * (arms() ** 2).sum(), rel=5e-2)
    assert found.last.force_n == 0 and found.last.error is None


def test_the_error_of_a_force_is_that_of_the_rotation_that_makes_it() -> None:
    unknown = Uncertainty(interpolation=1e-3 * TURN * SMALL, mesh=2e-3 * TURN * SMALL)
    error = curve(Blocked(), SMALL, rotations=unknown).last.error
    assert error is not None
    assert error.interpolation == pytest.approx(0.1, rel=1e-2)
    assert error.mesh == pytest.approx(0.2, rel=1e-2)
    assert error.total == pytest.approx(0.3, rel=1e-2)
    assert error.ends == error.shear == error.neighbours == 0


def test_ends_count_by_their_arms() -> None:
    reach = arms()
    unknown = Uncertainty(root=1e-5)
    found = curve(Blocked(), SMALL, rotations=unknown).last
    expected = 1e-5 * reach[0] / (BEND * (reach**2).sum())
    assert found.error is not None
    assert found.error.ends * found.force_n / 100 == pytest.approx(expected, rel=1e-2)


def test_a_grip_holds_as_much_as_its_fingers_bear_and_no_more() -> None:
    found = curve(GRIP, 0.1).last
    assert found.largest_payload_g is not None and found.holds
    heavier = replace_mass(GRIP, 1.01 * found.largest_payload_g)
    lighter = replace_mass(GRIP, 0.99 * found.largest_payload_g)
    assert curve(heavier, 0.1).last.holds is False
    assert curve(lighter, 0.1).last.holds is True


@pytest.mark.parametrize(
    "grip",
    [
        GRIP,
        replace_mass(DRAWING, 150.0),
        Grip(object="box", size=20, mass_g=20, distance=14, place=44),
    ],
)
def test_a_grip_that_holds_is_in_equilibrium_with_its_share_of_the_weight(grip: Grip) -> None:
    found = curve(grip, 0.1).last
    assert found.holds
    assert found.components_n[0] == pytest.approx(-grip.mass_g * 9.80665e-3 / 2, rel=2e-3)


def test_an_object_that_is_drawn_in_without_end_is_not_said_to_be_held() -> None:
    found = curve(DRAWING, 0.1)
    assert found.last.holds is None
    assert found.last.largest_payload_g is not None and found.last.largest_payload_g > 50
    assert any("draw the object towards their roots" in each for each in found.warnings)


def test_an_object_that_slips_is_said_to_be_kept_in_its_place() -> None:
    found = curve(replace_mass(GRIP, 5000.0), 0.1)
    assert found.last.holds is False
    assert any("slips out of the grip" in each for each in found.warnings)


@pytest.mark.parametrize(("friction", "most"), [(0.0, 1.01), (0.5, 3.0)])
def test_the_payload_is_as_uncertain_as_the_law_that_it_is_found_by(
    friction: float, most: float
) -> None:
    """With friction a finger that closes further slides further, which the estimate does not know:
    it is then too large."""
    part, light = 1e-3, Grip(size=30, mass_g=5, distance=18, place=38, friction=friction)
    known = linear_law(rotations=Uncertainty(mesh=part * TURN * 0.1))
    more = (1 + part) * np.array([TURN, 0.0, 0.0])
    other = replace(known, piece=replace(known.piece, motion_by_pressure=more))  # type: ignore[type-var]
    found, again = (force_curve(DESIGN, light, (0.1,), law).last for law in (known, other))
    assert found.largest_payload_g is not None and again.largest_payload_g is not None
    assert found.largest_payload_error_percent is not None
    changed = 100 * abs(again.largest_payload_g / found.largest_payload_g - 1)
    assert 0.99 * changed < found.largest_payload_error_percent < most * changed


def test_an_object_that_is_drawn_in_keeps_its_place_and_that_is_said() -> None:
    """The curled tip presses it towards the root by more than it weighs, or it sinks a little."""
    light, heavy = curve(replace_mass(DRAWING, 1.0), 0.1), curve(replace_mass(DRAWING, 150.0), 0.02)
    (said,) = light.warnings
    more = -light.last.components_n[0] - 1e-6 * 9.80665 * 1e3 / 2
    assert f"each by {more:.3g} N more than its weight" in said
    assert not any("more than its weight" in each for each in heavy.warnings)


@pytest.mark.parametrize(("mass", "place"), [(50.0, 44.0), (150.0, 44.0), (150.0, 38.0)])
def test_the_error_of_a_grip_lets_the_object_move_until_it_hangs_again(
    mass: float, place: float
) -> None:
    part, scene = 1e-2, Grip(size=30, mass_g=mass, distance=18, place=place)
    known = linear_law(rotations=Uncertainty(mesh=part * TURN * 0.1))
    more = (1 + part) * np.array([TURN, 0.0, 0.0])
    other = replace(known, piece=replace(known.piece, motion_by_pressure=more))  # type: ignore[type-var]
    found, again = (force_curve(DESIGN, scene, (0.1,), law).last for law in (known, other))
    assert found.holds and found.error is not None
    # Points that slide on the object do so by another way than in the estimate.
    changed = 100 * abs(again.force_n / found.force_n - 1)
    assert found.error.mesh == pytest.approx(changed, rel=0.15)


@pytest.mark.parametrize(
    ("scene", "pressure"), [(Blocked(support="wall", distance=8.0), 0.05), (DRAWING, 0.1)]
)
def test_the_error_by_shear_is_to_first_order_on_stiff_objects_too(
    scene: Blocked | Grip, pressure: float
) -> None:
    """A stiff object must not turn the curvature of the chain's motion into a force."""
    soft = linear_law(rotations=Uncertainty(shear=1.0))
    piece = replace(soft.piece, compliance=np.diag([BEND, 0.01, 0.02]))
    found = force_curve(DESIGN, scene, (pressure,), replace(soft, piece=piece)).last
    stiffer = replace(piece, compliance=np.diag([BEND, 0.01, 0.018]))
    other = force_curve(DESIGN, scene, (pressure,), replace(soft, piece=stiffer)).last
    # A tenth of the compliance less; the force is smooth in it, but for points that slide.
    measured = 10 * abs(other.force_n / found.force_n - 1) * 100
    assert found.error is not None and measured > 0.1
    assert found.error.shear == pytest.approx(measured, rel=0.3)


def test_a_finger_that_snaps_off_its_load_cell_ends_with_its_last_state_on_it() -> None:
    found = curve(Blocked(), 0.05, 0.3)
    assert not found.converged and "snaps off the load cell and curls past it" in found.message
    assert 0.05 < found.last.pressure_mpa < 0.3 and found.last.tip_angle_deg < 180
    assert found.last.stable and found.by_distance == ()


def test_force_against_distance_ends_where_the_tip_snaps_off() -> None:
    found = curve(Blocked(), 0.12)
    (said,) = (each for each in found.warnings if "snaps off" in each)
    assert "as its support moves away, at a distance of" in said
    assert all(each.tip_angle_deg < 180 for each in found.by_distance)
    places = [each.distance_mm for each in found.by_distance]
    assert places == sorted(places)  # type: ignore[type-var]


def test_a_finger_that_touches_its_neighbours_says_so() -> None:
    assert not curve(Blocked(), 0.02).last.contact
    assert curve(Blocked(), 0.1).last.contact


@pytest.mark.parametrize(
    ("scene", "pressure", "sentence"),
    [
        (
            Blocked(support="wall", distance=60.0),
            0.02,
            r"the wall at distance = 60 mm is not reached at 0\.02 MPa: the free finger reaches "
            r"16\.\d mm below",
        ),
        (Blocked(distance=60.0), 0.02, r"the load cell .* the free tip reaches 16\.\d mm below"),
        (Blocked(), -0.02, r"not reached at -0\.02 MPa"),
        (
            Grip(size=10.0, mass_g=5.0, distance=90.0, place=38.0),
            0.02,
            r"the cylinder of size = 10 mm at place = 38 mm is not touched at 0\.02 MPa: the "
            r"finger comes within 68\.\d mm",
        ),
    ],
)
def test_what_the_finger_does_not_reach_is_refused(
    scene: Blocked | Grip, pressure: float, sentence: str
) -> None:
    with pytest.raises(DesignError, match=sentence):
        curve(scene, pressure)


@dataclass(frozen=True)
class ShortLaw(LinearLaw):
    """A law that ends at 0.03 MPa."""

    def response(self, pressure: float, loads: Reals) -> SectionResponse:
        """As a linear law's."""
        if pressure > 0.03:
            raise DesignError("the law ends here.")
        return super().response(pressure, loads)


@dataclass(frozen=True)
class StiffLaw(LinearLaw):
    """A law that ends where a tip has been let go by half."""

    def response(self, pressure: float, loads: Reals) -> SectionResponse:
        """As a linear law's."""
        if pressure == 0.05 and loads[:, 0].min() > -20:
            raise DesignError("the piece bears no less.")
        return super().response(pressure, loads)


def test_a_finger_without_equilibrium_says_so_and_keeps_the_last_good_state() -> None:
    whole = linear_law()
    short = replace(whole, piece=ShortLaw(**vars(whole.piece)))
    found = force_curve(DESIGN, Blocked(), (0.02, 0.04), short)
    assert not found.converged and found.message == "the law ends here."
    assert found.curve[0].pressure_mpa == 0.02 and len(found.curve) == 2
    assert found.last.pressure_mpa == pytest.approx(0.03, abs=1e-4)
    assert found.last.stable and found.by_distance == ()


def test_the_pressures_asked_for_are_the_readings() -> None:
    pressures = (0.013, 0.02, 0.0731)
    found = curve(Blocked(), *pressures)
    assert [each.pressure_mpa for each in found.curve] == pytest.approx(pressures, rel=1e-12)
    alone = curve(Blocked(), 0.0731)
    assert alone.last.force_n == pytest.approx(found.last.force_n, rel=1e-9)


def test_pressures_near_each_other_are_readings_of_their_own() -> None:
    found = curve(Blocked(), 0.05, 0.05 + 1e-10, 0.05 + 2e-10)
    assert len(found.curve) == 3
    assert len(curve(Free(), 1e-9).curve) == 1


@pytest.mark.parametrize(
    "pressures", [(), (0.0,), (np.nan,), (np.inf,), (0.1, 0.05), (0.05, 0.05), (-0.05, 0.05)]
)
def test_pressures_that_do_not_go_away_from_zero_are_refused(pressures: tuple[float, ...]) -> None:
    with pytest.raises(DesignError, match="must go away from 0 MPa"):
        curve(Free(), *pressures)


@pytest.mark.parametrize("flow", [0.0, -1.0, np.nan, np.inf])
def test_a_valve_without_flow_is_refused(flow: float) -> None:
    with pytest.raises(DesignError, match=r"flow = .* L/min must be positive and finite"):
        force_curve(DESIGN, Free(), (0.05,), linear_law(), flow=flow)


def test_a_tip_that_bears_a_couple_alone_has_no_force_and_no_error_of_it() -> None:
    found = curve(Blocked(support="held"), 0.05, rotations=Uncertainty(mesh=0.01)).last
    assert found.force_n < 1e-9 and abs(found.moment_n_mm) > 1
    assert found.error is not None and found.error.total == 0


def test_a_law_that_ends_while_the_support_moves_away_is_not_called_a_jump() -> None:
    whole = linear_law()
    short = replace(whole, piece=StiffLaw(**vars(whole.piece)))
    found = force_curve(DESIGN, Blocked(), (0.05,), short)
    assert found.converged
    (warning,) = found.warnings
    assert "the curve ends: the piece bears no less" in warning and "snaps" not in warning


@pytest.mark.thorough
def test_the_error_of_shear_is_what_shear_changes() -> None:
    """On a wall, which other points come to touch where the change is a large one."""
    law = linear_law(rotations=Uncertainty(shear=0.01))
    soft, softer = (
        replace(law, piece=replace(law.piece, compliance=np.diag([BEND, 0.01, shear])))  # type: ignore[type-var]
        for shear in (0.05, 0.05 * 0.99)
    )
    wall = Blocked(support="wall", distance=3.0)
    found, again = (force_curve(DESIGN, wall, (0.1,), each).last for each in (soft, softer))
    assert found.error is not None
    changed = 100 * abs(again.force_n / found.force_n - 1)
    assert found.error.shear == pytest.approx(changed, rel=0.1) and changed > 1e-3
    assert found.error.total == found.error.shear


@pytest.mark.parametrize(
    "settings", [("length=48.6",), ("bubble_distance=4", "offset=1.6", "length=70")]
)
@pytest.mark.parametrize("scene", [Free(gravity=(0.0, -1.0)), Blocked()])
def test_a_finger_may_end_with_a_bubble_or_begin_within_half_a_gap(
    settings: tuple[str, ...], scene: Free | Blocked
) -> None:
    """A stub that is shorter than nothing weighs nothing."""
    design = with_overrides(load_design("finger"), settings)
    weights = weights_of(design)
    assert min(weights.root.newtons, weights.tip.newtons) >= 0
    assert force_curve(design, scene, (0.02,), linear_law()).converged


def test_a_summary_has_no_times_and_no_curves() -> None:
    found = curve(Blocked(), 0.05)
    assert {"seconds", "curve", "versions"}.isdisjoint(found.summary())
    assert found.to_dict()["curve"][-1]["force_n"] == found.summary()["force_n"]
    assert np.isfinite(found.air.seconds) and found == curve(Blocked(), 0.05)
