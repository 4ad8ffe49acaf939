"""Curved elements: how folding is measured, and how it is undone."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray

from solver import Mesh
from solver.mesh.elements import TETRAHEDRON_EDGES, quadratic_gradients
from solver.mesh.mid_nodes import SMALLEST_RATIO, jacobian_ratios, relaxed

Array = NDArray[np.float64]
ONE = np.arange(10, dtype=np.int32)[None]


def straight_tetrahedron(corners: Array) -> Array:
    middles = [corners[list(edge)].mean(axis=0) for edge in TETRAHEDRON_EDGES]
    return np.vstack([corners, middles])


def unit_tetrahedron() -> Array:
    return straight_tetrahedron(np.vstack([np.zeros(3), np.eye(3)]))


def folded_pair() -> tuple[Array, NDArray[np.int32]]:
    """Two tetrahedra on a common face, a mid-node of the first pushed through it; a third apart."""
    points = np.vstack([np.zeros(3), np.eye(3), np.ones(3)])
    nodes = np.vstack([unit_tetrahedron(), points[4], (points[1:4] + points[4]) / 2])
    second = [1, 2, 3, 10, 5, 8, 9, 11, 13, 12]
    nodes = np.vstack([nodes, unit_tetrahedron() + np.array([5, 0, 0])])
    nodes[4] += [0.0, 0.35, 0.35]  # the middle of the first one's edge from node 0 to node 1
    nodes[18] += [0.0, 0.02, 0.0]  # slightly curved: a good element
    return nodes, np.array([range(10), second, range(14, 24)], dtype=np.int32)


def test_straight_elements_have_the_ratio_one(box: Callable[..., Mesh]) -> None:
    mesh = box((2, 3, 2), size=(1.0, 4.0, 2.5), distortion=0.2)
    assert jacobian_ratios(mesh.nodes, mesh.tets) == pytest.approx(1.0, abs=1e-12)


def test_an_element_inside_out_has_a_negative_ratio() -> None:
    nodes = unit_tetrahedron() * [1, 1, -1]
    assert jacobian_ratios(nodes, ONE) == pytest.approx(-1.0)


def test_the_ratio_sees_shape_only() -> None:
    random = np.random.default_rng(3)
    nodes = unit_tetrahedron() + random.normal(scale=0.03, size=(10, 3))
    rotation, _ = np.linalg.qr(random.normal(size=(3, 3)))
    rotation *= np.sign(np.linalg.det(rotation))
    moved = 7.5 * nodes @ rotation.T + [1, 2, 3]
    assert jacobian_ratios(moved, ONE) == pytest.approx(jacobian_ratios(nodes, ONE), rel=1e-10)


def test_a_middle_node_at_a_quarter_of_its_edge_makes_the_jacobian_vanish() -> None:
    """On an edge with its middle node at the share s, dx/dr at the near end is 4 s - 1."""
    nodes = unit_tetrahedron()
    nodes[4] = [0.25, 0, 0]
    assert jacobian_ratios(nodes, ONE) == pytest.approx(0.0, abs=1e-12)


def test_no_point_of_an_accepted_element_is_folded() -> None:
    """Twenty-six samples of a cubic stand for all of it."""
    random = np.random.default_rng(11)
    elements = unit_tetrahedron() + random.normal(scale=0.06, size=(300, 10, 3))
    nodes, tets = elements.reshape(-1, 3), np.arange(3000, dtype=np.int32).reshape(300, 10)
    accepted = elements[jacobian_ratios(nodes, tets) >= SMALLEST_RATIO]
    assert 50 < len(accepted) < 300
    inner = random.dirichlet(np.full(4, 0.5), size=2000)
    gradients = quadratic_gradients(inner, TETRAHEDRON_EDGES)
    jacobians = np.einsum("eni,qnj->eqij", accepted, gradients, optimize=True)
    assert np.linalg.det(jacobians).min() > 0


def test_relaxing_repairs_a_folded_element_and_touches_only_its_middle_nodes() -> None:
    nodes, tets = folded_pair()
    ratios = jacobian_ratios(nodes, tets)
    assert ratios[0] < 0 and ratios[1:].min() > SMALLEST_RATIO
    repaired = relaxed(nodes, tets)
    assert jacobian_ratios(repaired, tets).min() >= SMALLEST_RATIO
    unmoved = np.setdiff1d(np.arange(len(nodes)), tets[0, 4:])
    assert np.array_equal(repaired[unmoved], nodes[unmoved])
    assert not np.array_equal(repaired[4], nodes[4])
    share = repaired[4] - [0.5, 0, 0]  # still curved towards the same side
    assert share[1] > 0 and share[1] == pytest.approx(share[2])


def test_good_elements_are_left_bit_for_bit_as_they_are(sphere: Callable[..., Mesh]) -> None:
    mesh = sphere(1.0, 2.0, layers=1, divisions=2)
    assert 0.1 < jacobian_ratios(mesh.nodes, mesh.tets).min() < 0.99
    assert np.array_equal(relaxed(mesh.nodes, mesh.tets), mesh.nodes)


def test_an_element_whose_corners_are_inside_out_cannot_be_relaxed() -> None:
    nodes = unit_tetrahedron() * [1, 1, -1]
    assert jacobian_ratios(relaxed(nodes, ONE), ONE) < 0
