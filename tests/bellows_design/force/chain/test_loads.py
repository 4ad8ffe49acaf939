"""Holds, weights, energies, invariances and the tangent of a chain."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from linear_chains import BENDING, LENGTH, beam, hinged_rod
from scipy.optimize import root
from scipy.special import ellipk

from bellows_design.design.shipped import load_design
from bellows_design.errors import BellowsError
from bellows_design.force.chain.balance import Balance, Unknowns
from bellows_design.force.chain.contact.obstacles import Disc, Plane, RoundedBox
from bellows_design.force.chain.finger.chain import Chain
from bellows_design.force.chain.finger.weight import Weight, Weights
from bellows_design.force.chain.loaded_chain import LoadedChain
from bellows_design.force.chain.path import Path, follow, follow_loads, rest
from bellows_design.force.chain.readings import unknowns_of
from bellows_design.force.chain.surroundings import DeadForce, Hold, LoadPoint, Surroundings

CURL = 0.4
"""Curvature by pressure, 1/mm per MPa: at 0.1 MPa a beam turns by 2 rad."""
DISC = Disc((30.0, -22.0), 14.0)


def weighed(chain: Chain) -> Chain:
    pieces = tuple(replace(piece, weight=Weight(0.01, 6.0)) for piece in chain.pieces)
    return replace(chain, pieces=pieces)


def enthalpy(chain: Chain, path: Path) -> float:
    """Σ s·d - G: stored energy less pressure times volume."""
    last = path.last
    energy = chain.response(last.pressure, last.loads).energy
    return float((last.loads * last.motions).sum() - energy.sum())


def test_small_weights_bend_a_beam_as_in_textbooks() -> None:
    """w L⁴ / 8 EI at the tip of a cantilever under its own weight w per length."""
    weight = 1e-3
    chain = beam(40)
    light = Weight(weight / 40, 0.0)
    chain = replace(chain, pieces=tuple(replace(each, weight=light) for each in chain.pieces))
    state = follow(chain, Surroundings(gravity=(0.0, -1.0)), [0.0]).last
    expected = weight * LENGTH**3 / 8 / BENDING
    assert -state.tip[1] == pytest.approx(expected, rel=3e-3)


def test_weights_of_a_design_are_those_of_its_boxes() -> None:
    design = load_design("prototype_1")
    bellows, weights = design.bellows, Weights.of(design, 1.2)
    bubble = 5 * 20 * 20 - 2 * 17 * 17 - 1.5 * 2 * 9 * 2
    tendon = 12 * 5 - 9 * 2
    assert weights.piece.newtons == pytest.approx(
        (bubble / 2 + 0.75 * tendon) * 1.2e-6 * 9.80665, rel=1e-12
    )
    assert tendon * 1.2e-6 * 9.80665 * 2 < weights.piece.newtons
    assert 2.5 < weights.piece.height < 10
    chain = Chain.of(bellows, beam(1).pieces[0].law, weights=weights)
    assert len(chain.pieces) == 2 * bellows.bubble_count


def test_a_load_cell_under_a_small_curl_carries_what_a_propped_cantilever_does() -> None:
    """A prop at the tip of a cantilever of rest curvature κ: 3 EI κ / 2 L."""
    curvature = 1e-5
    state = follow(beam(64, 1.0), Surroundings(hold=Hold.load_cell()), [curvature]).last
    expected = 1.5 * BENDING * curvature / LENGTH
    assert state.held_force[1] == pytest.approx(expected, rel=1e-3)
    assert state.held_force[0] == state.held_force[2] == 0
    assert state.tip_stiffness == pytest.approx(3 * BENDING / LENGTH**3, rel=1e-3)


def test_a_finger_leaves_a_load_cell_that_only_pushes() -> None:
    around = Surroundings(dead_forces=(DeadForce(LENGTH, (0.0, 0.1)),), hold=Hold.load_cell())
    up = follow(beam(8), around, [0.0]).last
    assert up.tip[1] > 1 and up.held_force == (0.0, 0.0, 0.0)
    path = follow(beam(8, CURL), around, [0.0, 0.1])
    assert path.ending is None
    assert path.last.tip[1] == pytest.approx(0.0, abs=1e-12) and path.last.held_force[1] > 0.1


def test_a_load_cell_that_pulls_is_a_hold() -> None:
    around = Surroundings(dead_forces=(DeadForce(LENGTH, (0.0, 0.1)),), hold=Hold(z=0.0))
    state = follow(beam(8), around, [0.0]).last
    assert state.tip[1] == pytest.approx(0, abs=1e-12)
    assert state.held_force[1] == pytest.approx(-0.1)


def test_a_fully_held_tip_of_a_straight_beam_carries_the_moment_of_its_curl() -> None:
    state = follow(beam(8, 1.0, 1e-3), Surroundings(hold=Hold(LENGTH, 0.0, 0.0)), [0.005]).last
    assert state.held_force == pytest.approx((0.0, 0.0, -BENDING * 0.005), abs=1e-9)


def test_the_reaction_of_a_load_cell_is_the_derivative_of_the_energy() -> None:
    chain, step = beam(10, CURL), 1e-3
    dead = (DeadForce(30.0, (0.05, -0.1), 2.0),)

    def at(height: float) -> tuple[float, float]:
        around = Surroundings(dead_forces=dead, hold=Hold.load_cell(height))
        path = follow(chain, around, [0.1])
        loaded = LoadedChain.of(chain, around)
        points = loaded.carriers.positions(path.last.frames[1:-1])[0]
        work = float(np.dot((0.05, -0.1), points))
        return enthalpy(chain, path) - work, path.last.held_force[1]

    slope = (at(-4 + step)[0] - at(-4 - step)[0]) / (2 * step)
    assert slope == pytest.approx(at(-4.0)[1], rel=1e-6)


def test_the_stiffness_of_the_tip_is_the_slope_of_the_load_cells_force() -> None:
    chain, step = beam(10, CURL), 1e-3
    loaded = LoadedChain.of(chain, Surroundings(hold=Hold.load_cell(-6.0)))
    state = follow(chain, loaded.surroundings, [0.1]).last
    moved = [
        follow_loads(loaded, state, [replace(state.load, hold_shift=(0.0, shift, 0.0))]).last
        for shift in (-step, step)
    ]
    slope = (moved[1].held_force[1] - moved[0].held_force[1]) / (2 * step)
    assert state.tip_stiffness == pytest.approx(slope, rel=1e-6)


@pytest.mark.parametrize("obstacle", [DISC, Plane((0.0, -9.0), (0.1, 1.0))])
def test_work_of_pressure_and_loads_is_stored(obstacle: Disc | Plane) -> None:
    chain = weighed(beam(14, CURL))
    around = Surroundings(
        objects=(obstacle,), dead_forces=(DeadForce(LENGTH, (0.05, 0.02)),), gravity=(0.0, -1.0)
    )
    path = follow(chain, around, np.linspace(0, 0.12, 121))
    assert path.ending is None and path.last.contacts
    start, end = path.states[0], path.last
    assert all(state.pressure == 0 for state in path.steps if state.load.forces < 1)
    work = path.work_of_pressure
    loaded = LoadedChain.of(chain, around)
    forces = loaded.dead_forces(LoadPoint())
    way = loaded.carriers.positions(end.frames[1:-1]) - loaded.carriers.positions(
        start.frames[1:-1]
    )
    work += float((forces * way).sum())
    stored = end.stored_energy - start.stored_energy + end.contact_energy - start.contact_energy
    assert stored == pytest.approx(work, rel=1e-4)


def turned_by(angle: float, vector: tuple[float, float]) -> tuple[float, float]:
    cos, sin = np.cos(angle), np.sin(angle)
    return float(cos * vector[0] + sin * vector[1]), float(cos * vector[1] - sin * vector[0])


@pytest.mark.parametrize("friction", [0.0, 0.4])
def test_a_turned_scene_has_the_same_forces(friction: float) -> None:
    chain, angle = weighed(beam(8, CURL)), 0.7

    def seen(turn: float) -> Path:
        around = Surroundings(
            objects=(
                Disc(turned_by(turn, DISC.centre), DISC.radius),
                RoundedBox(turned_by(turn, (42, -36)), (8, 4), 2, 0.3 + turn),
                Plane(turned_by(turn, (0, -60)), turned_by(turn, (0, 1))),
            ),
            friction=friction,
            dead_forces=(DeadForce(LENGTH, turned_by(turn, (0.02, -0.05)), 1.0),),
            gravity=turned_by(turn, (0.0, -1.0)),
        )
        return follow(replace(chain, root_frame=(0.0, 0.0, turn)), around, [0.05, 0.1])

    here, there = seen(0.0), seen(angle)
    assert here.ending is None and len(here.last.contacts) > 0
    assert there.last.motions == pytest.approx(here.last.motions, abs=1e-8)
    assert there.last.loads == pytest.approx(here.last.loads, abs=1e-6)
    turned = turned_by(angle, here.last.contact_force)
    assert there.last.contact_force == pytest.approx(turned, abs=1e-7)


@pytest.mark.parametrize("friction", [0.0, 0.4])
def test_the_tangent_is_the_derivative_of_the_forces(friction: float) -> None:
    """At an equilibrium with a contact; it is symmetric without friction."""
    around = Surroundings(
        objects=(DISC,), friction=friction, gravity=(0.0, -1.0), hold=Hold.load_cell(-20.0)
    )
    chain = weighed(beam(6, CURL))
    path = follow(chain, around, [0.06, 0.1])
    before, state = path.steps[-2], path.last
    loaded, at = LoadedChain.of(chain, around), unknowns_of(state)
    assert state.contacts

    def force(motions: np.ndarray) -> Balance:
        moved = Unknowns(motions, at.loads, at.held, at.pressing)
        return Balance.of(loaded, state.load, moved, before.history)

    tangent, step = force(at.motions).stiffness, 1e-7
    for number in range(at.motions.size):
        aside = np.zeros(at.motions.size)
        aside[number] = step
        ahead = force(at.motions + aside.reshape(-1, 3)).force
        back = force(at.motions - aside.reshape(-1, 3)).force
        slope = -(ahead - back) / (2 * step)
        assert tangent[:, number] == pytest.approx(slope, rel=1e-4, abs=2e-5 * np.abs(slope).max())
    symmetric = np.abs(tangent - tangent.T).max() < 1e-9 * np.abs(tangent).max()
    assert symmetric == (friction == 0)


def test_a_hinged_rod_falls_until_its_spring_holds() -> None:
    """c M = a, with M = W cos(a) L / 2."""
    chain = hinged_rod(0.0, 0.02)
    heavy = replace(chain.pieces[1], weight=Weight(1.5, 0.0))
    chain = replace(chain, pieces=(chain.pieces[0], heavy))
    angle = follow(chain, Surroundings(gravity=(0.0, -1.0)), [0.0]).last.tip[2]
    assert angle == pytest.approx(0.02 * 1.5 * LENGTH / 2 * np.cos(angle), rel=1e-12)


def test_an_upright_rod_is_stable_below_its_critical_weight_only() -> None:
    """Weight on the rod's end: W L c = 1."""
    chain = replace(hinged_rod(0.0, 0.02), root_frame=(0.0, 0.0, -np.pi / 2))
    critical = 1 / 0.02 / LENGTH
    light = Surroundings(dead_forces=(DeadForce(LENGTH, (0.0, -0.99 * critical)),))
    state = follow(chain, light, [0.0]).last
    assert state.stable and state.margin == pytest.approx(0.01, rel=1e-6)
    heavy = Surroundings(dead_forces=(DeadForce(LENGTH, (0.0, -1.2 * critical)),))
    ending = follow(chain, heavy, [0.0]).ending
    assert ending is not None and ending.cause == "instability"
    assert ending.load.forces == pytest.approx(1 / 1.2, rel=1e-3)


def test_a_leaning_rod_that_is_pushed_over_snaps_at_the_fold() -> None:
    """Balance (φ - φ0) / c = W L sin(φ) / 2 + F L cos(φ) with the lean φ, and its derivative."""
    lean, compliance, weight = -0.1, 0.02, 2.2
    rod = replace(hinged_rod(0.0, compliance), root_frame=(0.0, 0.0, lean - np.pi / 2))
    heavy = replace(rod.pieces[1], weight=Weight(weight, 0.0))
    rod = replace(rod, pieces=(rod.pieces[0], heavy))

    def fold(at: np.ndarray) -> list[float]:
        sin, cos = LENGTH * np.sin(at[0]), LENGTH * np.cos(at[0])
        balance = (at[0] - lean) / compliance - weight * sin / 2 - at[1] * cos
        return [balance, 1 / compliance - weight * cos / 2 + at[1] * sin]

    angle, force = root(fold, [-0.5, 0.1], tol=1e-12).x
    push = 1.5 * force
    around = Surroundings(dead_forces=(DeadForce(LENGTH, (push, 0.0)),), gravity=(0.0, -1.0))
    loaded = LoadedChain.of(rod, around)
    leant = follow_loads(loaded, rest(loaded), [LoadPoint(forces=0.0)])
    assert leant.ending is None
    path = follow_loads(loaded, leant.last, [LoadPoint()])
    assert path.ending is not None and path.ending.cause in ("limit point", "jump")
    assert path.last.load.forces * push == pytest.approx(force, rel=2e-3)
    assert path.last.load.forces * push < force
    assert path.last.tip[2] + np.pi / 2 == pytest.approx(angle, abs=0.05)
    assert path.last.stable
    over = path.ending.beyond
    assert over is not None and over.stable and over.tip[0] > 0
    lent, pushed = over.tip[2] + np.pi / 2, over.load.forces * push
    assert fold(np.array([lent, pushed]))[0] == pytest.approx(0.0, abs=1e-7)
    told = follow_loads(loaded, leant.last, [LoadPoint()], jumps=True)
    assert told.ending is None and len(told.jumps) == 1 and told.last.load.forces == 1


def test_a_buckled_column_is_followed_if_asked_and_carries_what_the_elastica_does() -> None:
    """Just past Euler's load P the angle of the tip is 2 sin⁻¹ k, P'/P = (2 K(k) / π)²."""
    force = 1.1 * np.pi**2 * BENDING / (4 * LENGTH**2)
    around = Surroundings(dead_forces=(DeadForce(LENGTH, (-force, 0.0)),))
    path = follow(beam(32), around, [0.0], jumps=True)
    assert path.ending is None and [jump.cause for jump in path.jumps] == ["instability"]
    modulus = np.sin(abs(path.last.tip[2]) / 2)
    assert (2 * ellipk(modulus**2) / np.pi) ** 2 == pytest.approx(1.1, rel=3e-3)


def test_a_place_beside_the_finger_and_negative_friction_are_refused() -> None:
    with pytest.raises(BellowsError, match="place = 51 mm is not on the finger"):
        follow(beam(4), Surroundings(dead_forces=(DeadForce(51.0, (0, 0)),)), [0.0])
    with pytest.raises(BellowsError, match=r"friction = -0.1 must not be negative"):
        Surroundings(friction=-0.1)
