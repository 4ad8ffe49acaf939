"""Closest points of six-node triangles, and derivatives of the distance from them."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from solver.kernels.closest_points import (
    CORNER,
    EDGE,
    INTERIOR,
    Feet,
    Surface,
    find_feet,
    shapes_at,
)
from solver.kernels.surface_contact import (
    gap_derivatives,
)

Array = NDArray[np.float64]
FLAT = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0.5, 0, 0], [0.5, 0.5, 0], [0, 0.5, 0]])
OWN = np.array([-0.1, 0.05, 0.15, 0.3, 0.35, 0.25])
"""Shape functions of a point in its own triangle."""


def curved(seed: int = 1, size: float = 0.1) -> Array:
    return FLAT + np.random.default_rng(seed).uniform(-size, size, (6, 3))


def feet(points: Array, x: Array, reach: float = 10.0, rim: bool = False) -> Feet:
    """Of points (p, 3) on one triangle, whose edges are a ``rim``, or stand for kinks."""
    candidates = np.zeros((len(points), 1), np.int64)
    neighbours = np.full((1, 3), -1 if rim else 0)
    alone = Surface(np.arange(6, dtype=np.int32)[None], neighbours, np.full((1, 3), rim))
    return find_feet(points, candidates, x, alone, reach)


def place(x: Array, r: float, s: float) -> tuple[Array, Array]:
    """A point of a triangle, and the unit normal there."""
    shapes, slopes = np.empty(6), np.empty((6, 2))
    shapes_at(r, s, shapes, slopes)
    normal = np.cross(slopes[:, 0] @ x, slopes[:, 1] @ x)
    return shapes @ x, normal / np.linalg.norm(normal)


@pytest.mark.parametrize("gap", [-0.2, -1e-6, 0.05])
@pytest.mark.parametrize(("r", "s"), [(0.2, 0.3), (0.7, 0.1), (0.05, 0.02), (0.45, 0.5)])
def test_a_point_over_a_curved_triangle_finds_where_it_was_raised_from(
    gap: float, r: float, s: float
) -> None:
    x = curved()
    foot, normal = place(x, r, s)
    found = feet((foot + gap * normal)[None], x)
    assert found.kinds[0] == INTERIOR
    assert found.parameters[0] == pytest.approx([r, s], abs=1e-9)
    assert found.gaps[0] == pytest.approx(gap, abs=1e-12)
    assert found.normals[0] == pytest.approx(normal, abs=1e-9)


def test_points_beyond_the_rim_or_too_deep_touch_nothing() -> None:
    """Beyond an edge or a corner; beyond a kink points count that are behind it, not beside."""
    points = np.array(
        [[0.3, 0.3, -0.2], [0.3, 0.3, -0.4], [-0.05, 0.3, -0.2], [-0.05, -0.05, -0.2],
         [-0.5, 0.3, -0.1]]
    )  # fmt: skip
    alone, joined = (feet(points, FLAT.copy(), reach=0.3, rim=rim) for rim in (True, False))
    assert list(alone.triangles) == [0, -1, -1, -1, -1]
    assert list(joined.triangles) == [0, -1, 0, 0, -1]
    deep = [0.2, np.inf, np.hypot(0.05, 0.2), np.sqrt(0.2**2 + 2 * 0.05**2), np.inf]
    assert abs(joined.gaps) == pytest.approx(np.array(deep))
    assert (alone.gaps[1:] == np.inf).all() and alone.gaps[0] == joined.gaps[0]


BEHIND = {
    INTERIOR: (0.3, 0.25, -0.15),
    EDGE: (0.4, -0.15, -0.2),
    CORNER: (-0.14, -0.16, -0.3),
}


@pytest.mark.parametrize("kind", BEHIND)
@pytest.mark.parametrize("seed", [1, 2, 3])
def test_derivatives_of_the_gap_are_those_of_the_distance(kind: int, seed: int) -> None:
    """By the positions of all nodes of both triangles, by central differences."""
    x = curved(seed, 0.03 if kind == CORNER else 0.1)
    own = np.outer(np.ones(6), BEHIND[kind]) + np.random.default_rng(9).uniform(-0.1, 0.1, (6, 3))
    own += (np.array(BEHIND[kind]) - OWN @ own) / OWN.sum()
    at = np.concatenate([own, x]).ravel()

    def found(nodes: Array) -> Feet:
        both = nodes.reshape(12, 3)
        return feet((OWN @ both[:6])[None], np.ascontiguousarray(both[6:]))

    def derivatives(nodes: Array) -> tuple[Array, Array]:
        here, first, second = found(nodes), np.empty(36), np.empty((36, 36))
        gap_derivatives(
            OWN, nodes.reshape(12, 3)[6:], *here.parameters[0], here.kinds[0], here.edges[0],
            here.gaps[0], here.normals[0], first, second,
        )  # fmt: skip
        return first, second

    assert found(at).kinds[0] == kind and found(at).gaps[0] < 0
    first, second = derivatives(at)
    step, unit = 1e-5, np.eye(36)
    gaps = [
        (found(at + step * e).gaps[0] - found(at - step * e).gaps[0]) / (2 * step) for e in unit
    ]
    assert first == pytest.approx(np.array(gaps), abs=1e-8)
    slopes = [
        (derivatives(at + step * e)[0] - derivatives(at - step * e)[0]) / (2 * step) for e in unit
    ]
    assert abs(second).max() > 0.1
    assert second == pytest.approx(np.array(slopes), abs=1e-7 * abs(second).max())
    assert second == pytest.approx(second.T, abs=1e-13 * abs(second).max())
