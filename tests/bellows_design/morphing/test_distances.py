"""Distances from rounded boxes, and points moved onto them."""

from __future__ import annotations

import numpy as np
import pytest
from bodies_to_morph import DESIGNS

from bellows_design.morphing.classification import classified
from bellows_design.morphing.distances import distances_and_normals, signed_distances
from bellows_design.morphing.primitives import Boxes, boxes_of
from bellows_design.morphing.projection import projected
from solver.arrays import Reals

CELL = boxes_of(DESIGNS["finger"], "unit-cell")


def scattered(count: int) -> Reals:
    """Random points in and around the cell."""
    return np.random.default_rng(2).uniform((-4, -11, -2), (4, 11, 22), (count, 3))


@pytest.mark.parametrize("box", range(len(CELL.radius)))
def test_normals_are_the_gradients_of_distances(box: int) -> None:
    points = scattered(400)
    chosen = np.full(len(points), box)
    _, normals = distances_and_normals(CELL, chosen, points)
    assert np.linalg.norm(normals, axis=1) == pytest.approx(1, abs=1e-12)
    step = 1e-6 * np.eye(3)
    for axis in range(3):
        ahead, behind = (
            signed_distances(CELL, chosen, points + sign * step[axis]) for sign in (1, -1)
        )
        assert (ahead - behind) / 2e-6 == pytest.approx(normals[:, axis], abs=1e-4)


def test_distances_from_a_ball_and_from_a_box_are_the_known_ones() -> None:
    core = np.array([[[0.0, 0, 0], [0, 0, 0]], [[-1, -2, -3], [1, 2, 3]]])
    boxes = Boxes(core, np.array([1.5, 0.0]), np.array([1, 1]), level_floors=False)
    points = np.array([[3.0, 4, 0], [0, 0, 0.5], [4, 6, 3], [0.7, 0, 0]])
    found = signed_distances(boxes, np.array([0, 0, 1, 1]), points)
    assert found == pytest.approx([3.5, -1.0, 5.0, -0.3])


def test_points_near_a_curve_are_moved_onto_both_surfaces() -> None:
    """Where the channel, along x, meets the round end of the chamber."""
    channel, chamber = 1, 3
    corner = np.array([[0.9, 1.2, 2.0], [1.0, 1.4, 2.9], [0.97, 1.36, 2.4]])
    chosen = np.array([[[chamber, -1], [channel, -1], [-1, -1]]] * 3)
    places = classified(CELL, corner)
    places = type(places)(np.full((3, 3), -1), places.on, chosen, np.full(3, 2))
    moved, missed = projected(CELL, places, np.arange(3), corner)
    assert missed.max() < 1e-12
    for box in (channel, chamber):
        assert np.abs(signed_distances(CELL, np.full(3, box), moved)).max() < 1e-12
    assert np.linalg.norm(moved - corner, axis=1).max() < 0.3
