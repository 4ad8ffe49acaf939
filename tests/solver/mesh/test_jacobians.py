"""Bounds of the Jacobian over whole elements, and which meshes they refuse."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray

from solver import Mesh, Ogden, Problem, Supports, solve
from solver.mesh.checks import check_elements
from solver.mesh.elements import TETRAHEDRON_EDGES, quadratic_gradients, tetrahedron_rule
from solver.mesh.jacobians import folded, least_jacobians

Array = NDArray[np.float64]
ONE = np.arange(10, dtype=np.int32)[None]


def unit_tetrahedron() -> Array:
    corners = np.vstack([np.zeros(3), np.eye(3)])
    return np.vstack([corners, [corners[list(edge)].mean(axis=0) for edge in TETRAHEDRON_EDGES]])


def random_elements(count: int, scale: float) -> tuple[Array, NDArray[np.int32]]:
    random = np.random.default_rng(5)
    elements = unit_tetrahedron() + random.normal(scale=scale, size=(count, 10, 3))
    return elements.reshape(-1, 3), np.arange(10 * count, dtype=np.int32).reshape(count, 10)


def sampled(nodes: Array, tets: NDArray[np.int32], points: Array) -> Array:
    gradients = quadratic_gradients(points, TETRAHEDRON_EDGES)
    return np.linalg.det(np.einsum("qad,eai->eqdi", gradients, nodes[tets]))


def test_no_sample_lies_below_the_bound_and_the_sign_is_that_of_the_densest_sampling() -> None:
    nodes, tets = random_elements(400, 0.09)
    low, high, _ = least_jacobians(nodes, tets)
    points = np.random.default_rng(2).dirichlet(np.full(4, 0.5), size=4000)
    least = sampled(nodes, tets, np.concatenate([points, np.eye(4)])).min(axis=1)
    assert (least >= low - 1e-12).all()
    assert ((low >= 0) == (least >= 0)).mean() > 0.99  # what is left lies between two samples
    assert (np.sign(low) == np.sign(high)).all()
    assert 50 < (high < 0).sum() < 350


def test_a_straight_element_has_one_jacobian(box: Callable[..., Mesh]) -> None:
    mesh = box((2, 3, 2), size=(1.0, 4.0, 2.5), distortion=0.2)
    low, high, mean = least_jacobians(mesh.nodes, mesh.tets)
    assert low == pytest.approx(mean, rel=1e-12)
    assert high == pytest.approx(mean, rel=1e-12)
    assert mean.sum() / 6 == pytest.approx(10.0, rel=1e-12)


def test_an_element_folded_between_its_corners_only_is_found() -> None:
    """Mid-nodes of a face pulled together behind it: every corner and Gauss point is positive."""
    for seed in range(2000):
        nodes = unit_tetrahedron()
        nodes[4:] += np.random.default_rng(seed).normal(scale=0.12, size=(6, 3))
        watched = np.concatenate([np.eye(4), tetrahedron_rule().linear])
        if sampled(nodes, ONE, watched).min() > 0 > least_jacobians(nodes, ONE).high[0]:
            break
    else:
        pytest.fail("no such element among 2000")
    grid = np.random.default_rng(0).dirichlet(np.full(4, 0.3), size=200_000)
    assert sampled(nodes, ONE, grid).min() < 0
    assert folded(nodes, ONE).tolist() == [0]


@pytest.mark.parametrize("share", [0.25, 0.2499])
def test_a_mid_node_at_a_quarter_of_its_edge_is_the_limit(share: float) -> None:
    """On an edge with its middle node at the share s, dx/dr at the near end is 4 s - 1."""
    nodes = unit_tetrahedron()
    nodes[4] = [share, 0, 0]
    low, high, mean = least_jacobians(nodes, ONE)
    assert high[0] == pytest.approx(4 * share - 1, abs=1e-12)
    mesh = Mesh(nodes, ONE)
    if share == 0.25:
        assert low[0] == high[0] == 0.0 < mean[0]
        check_elements(mesh)
    else:
        with pytest.raises(ValueError, match=r"tetrahedron 0 is folded at \(.*falls to -0.0004 mm"):
            check_elements(mesh)


def test_a_mesh_with_a_negative_corner_is_refused_with_its_place(
    box: Callable[..., Mesh], ninjaflex: Ogden
) -> None:
    """Four Gauss points of this element are positive."""
    mesh = box((2, 2, 2))
    nodes = mesh.nodes.copy()
    tet = mesh.tets[7]
    skin = mesh.surface_nodes(*mesh.surfaces)
    place, edge = next(
        (4 + k, edge) for k, edge in enumerate(TETRAHEDRON_EDGES) if tet[4 + k] not in skin
    )
    near, far = nodes[tet[list(edge)]]
    nodes[tet[place]] = near + 0.2 * (far - near)
    bad = Mesh(nodes, mesh.tets, mesh.surfaces)
    gauss = sampled(nodes, bad.tets, tetrahedron_rule().linear)
    assert gauss.min() > 0
    problem = Problem(bad, ninjaflex, Supports(clamped=("x0",)), ("x1",))
    with pytest.raises(ValueError, match=r"tetrahedron \d+ is folded at \(0\.\d+, .*\) mm"):
        solve(problem, 0.01)


def test_neither_place_nor_size_nor_units_change_what_is_folded() -> None:
    nodes, tets = random_elements(200, 0.09)
    expected = folded(nodes, tets)
    random = np.random.default_rng(1)
    rotation, _ = np.linalg.qr(random.normal(size=(3, 3)))
    rotation *= np.sign(np.linalg.det(rotation))
    for scale in (1e-6, 1e6):
        assert np.array_equal(folded(scale * (nodes @ rotation.T + [1, 2, 3]), tets), expected)
