"""An order in which neighbours follow each other."""

from __future__ import annotations

import numpy as np
import pytest

from bellows_design.study.sweep.order import length, ordered


@pytest.mark.parametrize(("number", "axes"), [(300, 2), (300, 4), (2, 3), (1, 1)])
def test_every_point_comes_once(number, axes):
    points = np.random.default_rng(0).random((number, axes))
    assert sorted(ordered(points, [0] * number)) == list(range(number))


@pytest.mark.parametrize(("axes", "share"), [(2, 0.12), (3, 0.2), (5, 0.4)])
def test_the_way_is_well_below_that_of_points_as_they_come(axes, share):
    """500 random points; a way within 30 % of the shortest was found to have these shares."""
    points = np.random.default_rng(1).random((500, axes))
    assert length(points[ordered(points, [0] * 500)]) < share * length(points)


def test_a_grid_is_passed_nearly_step_by_step():
    line = np.linspace(0, 1, 8)
    points = np.stack(np.meshgrid(line, line, line, indexing="ij"), axis=-1).reshape(-1, 3)
    way = ordered(points, [0] * len(points))
    assert length(points[way]) < 1.15 * (len(points) - 1) / 7  # of a way with no step too long


def test_turning_pieces_round_shortens_the_way():
    from bellows_design.study.sweep.order import _nearest_next

    points = np.random.default_rng(2).random((400, 2))
    plain = _nearest_next(points, points.min(axis=0))
    assert length(points[ordered(points, [0] * 400)]) < 0.97 * length(points[plain])


def test_groups_stay_whole():
    points = np.random.default_rng(3).random((120, 2))
    groups = [int(x > 0.5) for x, _ in points]
    passed = [groups[place] for place in ordered(points, groups)]
    assert np.count_nonzero(np.diff(passed)) == 1


def test_no_points_no_way():
    assert ordered(np.empty((0, 2)), []).size == 0
