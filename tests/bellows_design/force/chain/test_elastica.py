"""Chains with a linear law against closed forms and the elastica."""

from __future__ import annotations

import numpy as np
import pytest
from linear_chains import BENDING, LENGTH, beam, law_of
from scipy.integrate import solve_ivp
from scipy.optimize import brentq, root

from bellows_design.force.chain.finger.chain import Chain, Piece
from bellows_design.force.chain.path import follow
from bellows_design.force.chain.surroundings import DeadForce, Surroundings


def elastica_tip(force: tuple[float, float], rest_curvature: float = 0.0) -> np.ndarray:
    """x, z and angle of the tip of a clamped elastica of rest curvature under a dead tip force.

    EI (θ' - κ)' = Fx sin θ + Fz cos θ, θ(0) = 0, θ'(L) = κ: shooting for the root's moment.
    """

    def shot(moment: float) -> np.ndarray:
        def slope(_: float, y: np.ndarray) -> list[float]:
            x, z = np.cos(y[2]), -np.sin(y[2])
            turn = rest_curvature + y[3] / BENDING
            return [x, z, turn, force[0] * np.sin(y[2]) + force[1] * np.cos(y[2])]

        way = solve_ivp(slope, (0, LENGTH), [0, 0, 0, moment], "DOP853", rtol=1e-12, atol=1e-12)
        return way.y[:, -1]

    reach = 1.2 * LENGTH * np.hypot(*force)
    end = brentq(lambda moment: shot(moment)[3], -reach, reach, xtol=1e-13, rtol=1e-14)
    return shot(end)[:3]


def tip_of(chain: Chain, around: Surroundings, pressure: float = 0.0) -> np.ndarray:
    path = follow(chain, around, [pressure])
    assert path.ending is None
    return np.array(path.last.tip)


@pytest.mark.parametrize(
    ("load", "sideways", "down", "angle"),
    [(1, 0.05643, 0.30172, 0.46135), (2, 0.16064, 0.49346, 0.78175), (10, 0.555, 0.81061, 1.43029)],
)
def test_the_reference_is_mattiassons(
    load: float, sideways: float, down: float, angle: float
) -> None:
    """K. Mattiasson, Int. J. Numer. Meth. Engng. 17 (1981) 145, from elliptic integrals."""
    x, z, turn = elastica_tip((0.0, -load * BENDING / LENGTH**2))
    assert [1 - x / LENGTH, -z / LENGTH, turn] == pytest.approx([sideways, down, angle], abs=6e-6)


@pytest.mark.parametrize("rest_curvature", [0.0, 0.03])
@pytest.mark.parametrize("force", [(0.0, -0.6), (-0.2, 0.5)])
def test_a_chain_converges_to_the_elastica_with_the_square_of_the_cells(
    force: tuple[float, float], rest_curvature: float
) -> None:
    around = Surroundings(dead_forces=(DeadForce(LENGTH, force),))
    exact = elastica_tip(force, rest_curvature)
    errors = [
        np.abs(tip_of(beam(count, rest_curvature), around, 1.0) - exact) / [LENGTH, LENGTH, 1]
        for count in (8, 16, 32)
    ]
    sizes = [error.max() for error in errors]
    assert sizes[0] / sizes[1] == pytest.approx(4, rel=0.15)
    assert sizes[1] / sizes[2] == pytest.approx(4, rel=0.05)
    assert sizes[2] < 3e-3


def test_pieces_under_a_tip_moment_lie_on_a_regular_polygon() -> None:
    chain, moment = beam(14), 30.0
    state = follow(chain, Surroundings(tip_moment=moment), [0.0]).last
    turn = moment * LENGTH / 14 / BENDING
    chords = np.arange(7) * 4 * turn / 2 + turn
    corners = 2 * LENGTH / 14 * np.cumsum([np.cos(chords), -np.sin(chords)], axis=1)
    assert state.loads[:, 0] == pytest.approx(np.full(14, moment), rel=1e-12)
    assert state.tip[2] == pytest.approx(14 * turn, abs=1e-12)
    # Two pieces from gap to gap: turned by one piece's rotation, straight, and turned again.
    assert pytest.approx(corners, abs=1e-10) == state.frames[3::2, :2][:7].T


def test_a_chain_solves_the_equations_of_linked_rods() -> None:
    """Links of two pieces between springs of two: balance of moments, solved by SciPy."""
    count, force, rest = 6, np.array([-0.3, -0.45]), 0.04
    chain, size = beam(2 * count, rest), LENGTH / count
    compliance, free = size / 2 / BENDING, rest * size / 2

    def imbalance(angles: np.ndarray) -> np.ndarray:
        """Link by link, with one spring before the first one, and two between links."""
        springs = np.concatenate([[angles[0] - free], (np.diff(angles) - 2 * free) / 2])
        moments = np.append(springs / compliance, 0.0)
        arms = size * (-np.sin(angles) * force[0] - np.cos(angles) * force[1])
        return moments[1:] - moments[:-1] + arms

    found = root(imbalance, np.full(count, 0.3), tol=1e-14)
    state = follow(chain, Surroundings(dead_forces=(DeadForce(LENGTH, tuple(force)),)), [1.0]).last
    links = state.frames[2:-2:2, 2]
    assert np.abs(imbalance(found.x)).max() < 1e-11
    assert links == pytest.approx(found.x, abs=1e-10)


def euler_load(count: int) -> float:
    """Compression at which the straight chain of ``count`` pieces is found to lose stability."""
    force = 1.1 * np.pi**2 * BENDING / (4 * LENGTH**2)
    path = follow(beam(count), Surroundings(dead_forces=(DeadForce(LENGTH, (-force, 0.0)),)), [0.0])
    assert path.ending is not None and path.ending.cause == "instability"
    assert path.last.stable and 0 < path.last.margin < 2e-3
    assert path.last.load.forces < path.ending.load.forces
    return force * path.ending.load.forces


def test_a_straight_chain_buckles_at_eulers_load() -> None:
    """Discretely: 2 (1 - cos(π / 4 m)) / c with m links between springs of compliance c.

    m links with half a spring at the clamp make a quarter of a wave, like 4 m links of a whole one.
    """
    euler = np.pi**2 * BENDING / (4 * LENGTH**2)
    errors = []
    for count in (8, 16):
        links = count // 2
        size = LENGTH / links
        discrete = BENDING / size**2 * 2 * (1 - np.cos(np.pi / (2 * links)))
        assert euler_load(count) == pytest.approx(discrete, rel=1e-3)
        errors.append(abs(discrete - euler))
    assert errors[0] / errors[1] == pytest.approx(4, rel=0.05)


def test_the_last_piece_carries_the_moment_of_a_force_on_the_stub_beyond() -> None:
    law = law_of(5.0)
    chain = Chain(tuple(Piece(law, number % 2 == 0) for number in range(6)), 3.0, 8.0, 2.0)
    around = Surroundings(dead_forces=(DeadForce(41.0, (0.1, -0.4)),))
    state = follow(chain, around, [0.0]).last
    end, tip = state.frames[-2], state.frames[-1]
    along = np.array([np.cos(tip[2]), -np.sin(tip[2])])
    assert tip[:2] - end[:2] == pytest.approx(8 * along)
    arm = tip[:2] - end[:2]
    assert state.loads[-1, 0] == pytest.approx(0.1 * arm[1] + 0.4 * arm[0], rel=1e-10)
    assert state.loads[-1, 1] == pytest.approx(np.dot([0.1, -0.4], _normal(state.frames[-3, 2])))


def _normal(angle: float) -> np.ndarray:
    return np.array([np.cos(angle), -np.sin(angle)])
