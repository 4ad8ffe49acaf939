"""Chains whose pieces do not answer in proportion, differ, or end."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import pytest
from linear_chains import BENDING, LENGTH, beam, law_of

from bellows_design.errors import BellowsError
from bellows_design.force.chain.contact.obstacles import Disc, Plane
from bellows_design.force.chain.finger.chain import Chain, Piece
from bellows_design.force.chain.path import follow
from bellows_design.force.chain.surroundings import Hold, Surroundings
from bellows_design.force.section_law import SectionResponse

CURL = 0.4
"""Curvature by pressure, 1/mm per MPa."""


@dataclass(frozen=True)
class StiffeningLaw:
    """Stiffer in bending below the moment ``onset``, where bubbles touch: by default ten times.

    The compliance changes within a tenth of it. Energies are left those of the softer law.
    """

    length: float
    onset: float = -10.0
    highest: float = 1.0
    lost: float = 0.9

    def response(self, pressure: float, loads: np.ndarray) -> SectionResponse:
        if pressure > self.highest:
            raise BellowsError(f"pressure = {pressure:g} MPa lies outside the law")
        soft, width = self.length / BENDING, -self.onset / 10
        linear = law_of(self.length, CURL).response(pressure, loads)
        past = (self.onset - loads[:, 0]) / width
        ramp = np.logaddexp(0.0, past)
        share = 1 / (1 + np.exp(-past))
        motion, compliance = linear.motion.copy(), linear.compliance.copy()
        motion[:, 0] += self.lost * soft * width * ramp
        compliance[:, 0, 0] -= self.lost * soft * share
        return replace(linear, motion=motion, compliance=compliance)


def stiffening(count: int, **options: float) -> Chain:
    law = StiffeningLaw(LENGTH / count, **options)
    return Chain(tuple(Piece(law, number % 2 == 0) for number in range(count)))


def test_bubbles_that_touch_make_a_blocked_finger_push_harder() -> None:
    """Nothing changes before they touch."""
    around = Surroundings(hold=Hold.load_cell())
    pressures = np.linspace(0.01, 0.12, 12)
    soft = follow(beam(14, CURL), around, pressures)
    stiff = follow(stiffening(14), around, pressures)
    assert soft.ending is None and stiff.ending is None
    forces = [[s.held_force[1] for s in path.states] for path in (soft, stiff)]
    assert forces[1][0] == pytest.approx(forces[0][0], rel=1e-3)
    assert forces[1][-1] > 1.1 * forces[0][-1]
    assert max(state.iterations for state in stiff.steps) <= 12


@pytest.mark.parametrize("friction", [0.0, 0.5])
def test_a_stiffening_finger_is_followed_around_objects(friction: float) -> None:
    around = Surroundings(
        objects=(Disc((24.0, -15.0), 13.0), Plane((0.0, -26.0), (0.0, 1.0))), friction=friction
    )
    path = follow(stiffening(14), around, np.linspace(0.02, 0.14, 7))
    assert path.ending is None and path.last.contacts
    loads = path.last.loads
    response = stiffening(14).response(path.last.pressure, loads)
    assert path.last.motions == pytest.approx(response.motion, abs=1e-8)


def test_a_law_that_ends_ends_the_path_with_the_last_good_state() -> None:
    path = follow(stiffening(8, highest=0.05), Surroundings(), [0.02, 0.04, 0.08])
    assert path.ending is not None and path.ending.cause == "law"
    assert "lies outside the law" in path.ending.sentence
    assert len(path.states) == 2 and path.last.pressure == pytest.approx(0.05, abs=1e-4)


def test_a_piece_that_is_unstable_by_itself_ends_the_path() -> None:
    """Its bending compliance is minus twice what it was, which no error of a table is."""
    law = StiffeningLaw(LENGTH / 8, lost=3.0)
    chain = Chain(tuple(Piece(law, number % 2 == 0) for number in range(8)))
    path = follow(chain, Surroundings(tip_moment=-20.0), [0.0])
    assert path.ending is not None and path.ending.cause == "law"
    assert path.ending.beyond is None and path.last.stable
    assert "unstable by itself" in path.ending.sentence


def test_a_small_negative_compliance_of_a_table_does_not_end_the_path() -> None:
    """As interpolation leaves where pieces are nearly rigid."""
    law = StiffeningLaw(LENGTH / 8, lost=1.01)
    chain = Chain(tuple(Piece(law, number % 2 == 0) for number in range(8)))
    path = follow(chain, Surroundings(tip_moment=-20.0), [0.0])
    assert path.ending is None and path.last.stable


def test_softer_ends_bend_like_longer_pieces() -> None:
    """A hinge at either end with the compliance of a piece adds its rotation and no length."""
    piece = law_of(5.0, CURL)
    middle = tuple(Piece(piece, number % 2 == 0) for number in range(6))
    hinge = replace(piece, length=0.0)
    chain = Chain((Piece(hinge), *middle, Piece(hinge)), 2.0, 3.0)
    state = follow(chain, Surroundings(tip_moment=8.0), [0.05]).last
    turn = CURL * 0.05 * 5.0 + 8.0 * 5.0 / BENDING
    assert np.diff(state.frames[1:-1, 2]) == pytest.approx(np.full(8, turn), rel=1e-10)
    assert state.frames[2, :2] == pytest.approx(state.frames[1, :2], abs=1e-12)
    assert state.volume == pytest.approx(
        8 * piece.response(0.05, np.array([[8.0, 0.0, 0.0]])).volume[0]
    )


def test_a_rigid_finger_that_is_held_has_no_single_answer() -> None:
    rigid = Chain((Piece(replace(law_of(50.0), compliance=np.zeros((3, 3)))),))
    with pytest.raises(BellowsError, match="the tangent is singular"):
        follow(rigid, Surroundings(hold=Hold(50.0, 0.0, 0.0)), [0.1])
