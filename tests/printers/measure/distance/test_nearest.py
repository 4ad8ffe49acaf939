"""The distance of points to a triangle surface."""

from __future__ import annotations

import numpy as np

from printers.measure.closest_point import closest_on_triangles
from printers.measure.distance.nearest import nearest_distances
from printers.measure.surface import Surface


def test_the_distance_is_the_least_to_any_triangle() -> None:
    chance = np.random.default_rng(4)
    corners = chance.normal(size=(60, 3, 3))
    corners[:5, 2] = corners[:5, 1]  # without an area
    corners[5:10, 2] = corners[5:10].mean(axis=1) + 1e-9  # needles
    surface = Surface(corners.reshape(-1, 3), np.arange(180).reshape(-1, 3))
    points = 2 * chance.normal(size=(200, 3))
    expected = [
        np.linalg.norm(closest_on_triangles(corners, np.tile(p, (60, 1))) - p, axis=1).min()
        for p in points
    ]
    assert np.allclose(nearest_distances(surface.tree, points), expected, atol=1e-9)
