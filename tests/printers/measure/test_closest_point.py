"""The nearest point of a triangle, well shaped or not."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from printers.measure.closest_point import closest_on_triangles


@settings(max_examples=50, deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_no_point_of_a_triangle_is_nearer_than_the_closest(seed: int) -> None:
    random = np.random.default_rng(seed)
    corners, point = random.normal(size=(1, 3, 3)), 2 * random.normal(size=(1, 3))
    closest = closest_on_triangles(corners, point)[0]
    weights = random.dirichlet([0.5] * 3, size=4000)
    others = weights @ corners[0]
    distance = np.linalg.norm(closest - point[0])
    assert distance <= np.linalg.norm(others - point[0], axis=1).min() + 1e-12
    assert np.linalg.norm(others - closest, axis=1).min() < 0.3


@pytest.mark.parametrize("height", [0.0, 1e-15, 1e-12, 1e-9, 1e-5])
def test_a_needle_is_as_near_as_the_segment_it_nearly_is(height: float) -> None:
    random = np.random.default_rng(5)
    turn = np.linalg.qr(random.normal(size=(3, 3)))[0]
    along, beside = random.uniform(-10, 30, 500), random.uniform(0.1, 5, 500)
    needle = np.array([[0.0, 0, 0], [20, 0, 0], [random.uniform(0, 20), height, 0]])
    corners = np.repeat((needle @ turn)[None], 500, axis=0)
    points = np.stack([along, -beside, np.zeros(500)], axis=1)  # across from the third corner
    found = closest_on_triangles(corners, points @ turn)
    expected = np.stack([along.clip(0, 20), np.zeros(500), np.zeros(500)], axis=1)
    assert np.allclose(found, expected @ turn, rtol=0, atol=1e-13)


@pytest.mark.parametrize("same", [(0, 1), (0, 2), (1, 2), (0, 1, 2)])
def test_corners_that_coincide_leave_a_segment_or_a_point(same: tuple[int, ...]) -> None:
    random = np.random.default_rng(6)
    corners = random.normal(size=(200, 3, 3))
    corners[:, same] = corners[:, same[:1]]
    points = 2 * random.normal(size=(200, 3))
    start, end = corners[:, same[0]], corners[:, 3 - sum(same[:2])]
    fraction = ((points - start) * (end - start)).sum(axis=1)
    fraction /= np.maximum(((end - start) ** 2).sum(axis=1), 1e-300)
    expected = start + fraction.clip(0, 1)[:, None] * (end - start)
    assert np.allclose(closest_on_triangles(corners, points), expected, rtol=0, atol=1e-13)
