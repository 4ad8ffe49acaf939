"""Segments against triangles, compared with asking every pair."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from printers.measure.box_tree import build_tree, crossings, first_hits


def brute_force(corners: np.ndarray, start: np.ndarray, end: np.ndarray) -> set[tuple[int, int]]:
    """Pairs (segment, triangle) that cross, by solving for the crossing point of every pair."""
    found = set()
    for s, (a, b) in enumerate(zip(start, end, strict=True)):
        for t, (p, q, r) in enumerate(corners):
            matrix = np.column_stack([q - p, r - p, a - b])
            u, v, fraction = np.linalg.solve(matrix, a - p)
            if min(u, v, 1 - u - v, fraction, 1 - fraction) > 0:
                found.add((s, t))
    return found


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 2**32 - 1), st.integers(1, 40), st.integers(1, 15))
def test_the_tree_misses_and_invents_no_crossing(seed: int, triangles: int, segments: int) -> None:
    random = np.random.default_rng(seed)
    corners = random.normal(size=(triangles, 3, 3))
    start, end = random.normal(size=(2, segments, 3)) * 2
    found = crossings(build_tree(corners), start, end)
    assert set(zip(found.segment, found.triangle, strict=True)) == brute_force(corners, start, end)


def test_a_ray_through_a_stack_of_planes_stops_at_the_first_that_is_not_its_own() -> None:
    square = np.array([[[0, 0, 0], [3, 0, 0], [0, 3, 0]]], dtype=float)
    corners = np.concatenate([square + np.array([0, 0, z]) for z in (0.0, 1.0, 2.5)])
    start, end = np.array([[0.5, 0.5, 0.0]] * 2), np.array([[0.5, 0.5, 5.0]] * 2)
    distance, triangle = first_hits(build_tree(corners), start, end, np.array([0, -1]))
    assert distance.tolist() == [1.0, 0.0]
    assert triangle.tolist() == [1, 0]


def test_a_ray_past_everything_goes_on_for_ever() -> None:
    corners = np.array([[[0, 0, 0], [1, 0, 0], [0, 1, 0]]], dtype=float)
    distance, triangle = first_hits(
        build_tree(corners), np.array([[2.0, 2, -1]]), np.array([[2.0, 2, 1]]), np.array([-1])
    )
    assert np.isinf(distance[0])
    assert triangle[0] == -1
