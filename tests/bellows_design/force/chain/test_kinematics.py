"""Geometry of a chain: uniform ones, derivatives against finite differences."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from bellows_design.analysis.cell_chain import _places
from bellows_design.design.shipped import load_design
from bellows_design.errors import BellowsError
from bellows_design.force.chain.finger.chain import Chain, Piece
from bellows_design.force.chain.finger.kinematics import Configuration
from bellows_design.force.chain.finger.points import Points
from bellows_design.force.section_law import LinearLaw

SEED = 17


def uneven_chain() -> Chain:
    """Forward and backward pieces, hinges and stubs, at an angle."""
    long = LinearLaw(3.0, np.eye(3), np.zeros(3))
    short = LinearLaw(2.0, np.eye(3), np.zeros(3))
    hinge = LinearLaw(0.0, np.eye(3), np.zeros(3))
    pieces = (Piece(hinge), Piece(long, True), Piece(long), Piece(short, True), Piece(hinge))
    return Chain(pieces, 4.0, 3.0, 5.0, 9.0, root_frame=(1.0, -2.0, 0.4))


def some_motions(count: int) -> np.ndarray:
    return np.random.default_rng(SEED).normal(size=(count, 3)) * [0.4, 0.3, 0.3]


@pytest.mark.parametrize("name", ["prototype_1", "finger"])
def test_a_uniform_chain_lies_where_copies_of_its_cell_do(name: str) -> None:
    bellows = load_design(name).bellows
    tilt, shift = 0.21, 0.13
    chain = Chain.of(bellows, LinearLaw(bellows.pitch / 2, np.eye(3), np.zeros(3)))
    motions = np.tile([tilt, shift, 0.0], (len(chain.pieces), 1))
    frames = Configuration.of(chain, motions).frames
    places = _places(bellows, SimpleNamespace(plane=(tilt, shift)))  # type: ignore[arg-type]
    middles = np.array([[*origin, angle] for _, side, origin, angle in places if side > 0])
    assert frames[1::2] == pytest.approx(middles, abs=1e-12)
    assert chain.length == pytest.approx(bellows.length, abs=1e-12)


def test_slip_and_extension_of_mirrored_pieces_are_mirror_images() -> None:
    """From a gap over a bubble to the next gap: seen from the bubble both halves are the same."""
    law = LinearLaw(3.0, np.eye(3), np.zeros(3))
    chain = Chain((Piece(law, True), Piece(law)))
    frames = Configuration.of(chain, np.tile([0.3, 0.2, 0.5], (2, 1))).frames
    middle, back, front = frames[1], frames[0], frames[2]
    cos, sin = np.cos(middle[2]), np.sin(middle[2])
    axes = np.array([[cos, -sin], [-sin, -cos]])
    behind, ahead = axes @ (back - middle)[:2], axes @ (front - middle)[:2]
    assert behind == pytest.approx(ahead * [-1, 1], abs=1e-12)
    assert front[2] - middle[2] == pytest.approx(middle[2] - back[2], abs=1e-12)


def test_undeformed_points_are_where_their_place_says() -> None:
    chain = uneven_chain()
    places = np.linspace(0, chain.length, 41)
    frames = Configuration.of(chain, np.zeros((len(chain.pieces), 3))).frames
    at = Points.of(chain, places, 2.0).positions(frames)
    ahead, up = np.array([np.cos(0.4), -np.sin(0.4)]), np.array([np.sin(0.4), np.cos(0.4)])
    assert at == pytest.approx(np.array([1.0, -2.0]) + places[:, None] * ahead + 2 * up, abs=1e-12)


def test_a_place_past_the_tip_is_refused() -> None:
    with pytest.raises(BellowsError, match="place = 99 mm is not on the finger, which is 15 mm"):
        Points.of(uneven_chain(), np.array([3.0, 99.0]))


def test_derivatives_of_points_agree_with_finite_differences() -> None:
    chain = uneven_chain()
    motions, size = some_motions(len(chain.pieces)), 3 * len(chain.pieces)
    points = Points.of(chain, np.linspace(0, chain.length, 23), 1.7)
    forces = np.random.default_rng(SEED).normal(size=(23, 2))

    def at(flat: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        configuration = Configuration.of(chain, flat.reshape(-1, 3))
        frames = configuration.frames
        by_motions = configuration.jacobian.reshape(len(frames), 3, size)
        return (
            points.positions(frames),
            points.jacobian(frames, by_motions),
            points.curvature(chain, configuration, by_motions, forces),
        )

    _, jacobian, curvature = at(motions.ravel())
    step = 1e-5
    for number in range(size):
        aside = np.zeros(size)
        aside[number] = step
        after, before = at(motions.ravel() + aside), at(motions.ravel() - aside)
        first = (after[0] - before[0]) / (2 * step)
        assert jacobian[:, :, number] == pytest.approx(first, abs=1e-8)
        second = np.einsum("mcj,mc->j", after[1] - before[1], forces) / (2 * step)
        assert curvature[:, number] == pytest.approx(second, abs=1e-7)
    assert curvature == pytest.approx(curvature.T, abs=1e-11)
