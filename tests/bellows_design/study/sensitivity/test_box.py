"""Which designs a global study evaluates."""

from __future__ import annotations

import numpy as np
import pytest

from bellows_design.design.design import Design
from bellows_design.design.shipped import load_design
from bellows_design.design.variation import counted, geometric_parameters, parameters, same_topology
from bellows_design.errors import DesignError
from bellows_design.neighbours.carried import REACH
from bellows_design.neighbours.distance import distance
from bellows_design.study.sensitivity.box import Box, sampled, tour

FINGER = counted(load_design("finger"))
NAMES = ("bubble_width", "bubble_thickness", "chamber_length", "load.pressure")
BOX = Box(FINGER, NAMES, 10.0)


def test_the_corners_of_a_box_are_so_many_percent_away():
    corner = parameters(BOX.at(np.array([1.0, -1.0, 1.0, -1.0])))
    middle = parameters(FINGER)
    assert [corner[name] / middle[name] for name in NAMES] == pytest.approx([1.1, 0.9, 1.1, 0.9])
    assert parameters(BOX.at(np.zeros(4))) == pytest.approx(middle)


def test_samples_keep_faces_and_bubbles_and_fill_the_box():
    sample = sampled(BOX, 32, seed=3)
    assert len(sample.designs) == 32
    assert all(same_topology(FINGER, design) == "" for design in sample.designs)
    assert np.abs(sample.points).max() <= 1
    quarters = np.floor(2 * sample.points + 2).astype(int)
    assert all(len(set(column)) == 4 for column in quarters.T)  # each quarter of every side


def test_the_same_seed_gives_the_same_samples_and_another_one_others():
    first, again, other = (sampled(BOX, 16, seed).points for seed in (1, 1, 2))
    assert (first == again).all() and not (first == other).all()


def test_points_beyond_the_reach_of_neighbours_are_drawn_in_to_it():
    sample = sampled(Box(FINGER, tuple(geometric_parameters(FINGER)), 18.0, "unit-cell"), 20, 0)
    assert sample.drawn_in > 0
    assert max(distance(FINGER, design) for design in sample.designs) <= REACH


def refuse_beyond(percent: float, monkeypatch: pytest.MonkeyPatch) -> None:
    """As if faces changed where any of the numbers is farther off."""
    middle = parameters(FINGER)

    def same(_: Design, other: Design, model: str) -> str:
        off = [abs(value / middle[name] - 1) for name, value in parameters(other).items()]
        return "other faces" if max(off) > percent / 100 else ""

    monkeypatch.setattr("bellows_design.study.sensitivity.box.same_topology", same)


def test_designs_of_other_faces_are_drawn_anew(monkeypatch: pytest.MonkeyPatch):
    refuse_beyond(9.0, monkeypatch)  # 0.9⁴ = 0.66 of the box
    sample = sampled(BOX, 40, 0)
    assert sample.box.percent == 10
    assert np.abs(sample.points).max() <= 0.9
    assert 5 < sample.redrawn < 45


def test_a_box_in_which_few_designs_have_the_same_faces_is_narrowed(
    monkeypatch: pytest.MonkeyPatch,
):
    refuse_beyond(6.0, monkeypatch)  # 0.6⁴ = 0.13 of the box, 0.75⁴ = 0.32 of the next one
    assert sampled(BOX, 40, 0).box.percent == pytest.approx(8)
    refuse_beyond(0.01, monkeypatch)
    with pytest.raises(DesignError, match="hardly any design"):
        sampled(BOX, 40, 0)


def test_a_tour_visits_every_point_once_and_is_shorter_than_the_order_drawn():
    points = np.random.default_rng(0).uniform(-1, 1, (50, 3))
    order = tour(points)
    assert sorted(order) == list(range(50))

    def way(numbers: list[int]) -> float:
        return float(np.linalg.norm(np.diff(points[numbers], axis=0), axis=1).sum())

    assert way(order) < 0.7 * way(list(range(50)))
