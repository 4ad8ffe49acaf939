"""Principal strains at the quadrature points: closed forms, rotation, small strains, edges."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from solver import Mesh, Ogden, Problem, Solution, Supports, solve
from solver.results.strains import principal_logs, reached_logs

Meshes = Callable[..., Mesh]
ROTATION = np.linalg.qr(np.random.default_rng(8).normal(size=(3, 3)))[0]


def test_a_homogeneous_state_has_its_stretches_at_every_point_in_any_orientation(
    box: Meshes,
) -> None:
    mesh = box((2, 2, 1), distortion=0.2)
    stretches = np.array([0.4, 1.1, 2.3])
    gradient = ROTATION @ np.diag(stretches) @ ROTATION.T @ ROTATION
    logs = principal_logs(mesh, mesh.nodes @ (gradient - np.eye(3)).T)
    assert logs.shape == (len(mesh.tets), 4, 3)
    assert logs == pytest.approx(np.broadcast_to(np.log(stretches), logs.shape), abs=1e-14)


def test_small_strains_keep_their_digits(box: Meshes) -> None:
    mesh, size = box((1, 1, 1)), 1e-11
    strain = np.array([[1.0, 0.4, 0.0], [0.4, -0.3, 0.2], [0.0, 0.2, -0.7]])
    logs = principal_logs(mesh, size * mesh.nodes @ strain)
    assert logs[0, 0] / size == pytest.approx(np.linalg.eigvalsh(strain), rel=1e-9)


def test_bending_strains_vary_through_the_thickness_as_they_should(box: Meshes) -> None:
    """Small pure bending of curvature k: strains k z along x and -k z / 2 across."""
    mesh, curvature = box((2, 2, 2), distortion=0.2), 1e-7
    x, y, z = (mesh.nodes - 0.5).T
    u = curvature * np.stack([x * z, -y * z / 2, -(x**2) / 2 + y**2 / 4 - z**2 / 4], axis=1)
    logs = principal_logs(mesh, u) / curvature
    assert logs.sum(axis=-1) == pytest.approx(0.0, abs=1e-5)
    size = abs(logs[..., ::2]).max(axis=-1)
    assert 0.3 < size.max() <= 0.5
    assert size.min() < 0.1


def test_elements_at_sharp_edges_do_not_count(box: Meshes, ninjaflex: Ogden) -> None:
    mesh = box((4, 2, 2), (4.0, 1.0, 1.0))
    problem = Problem(mesh, ninjaflex, Supports(clamped=("x0",)), ("x1",))
    sheared = np.exp(-4 * mesh.nodes[:, :1]) * [0.0, 0.05, 0.0]  # most of it next to the clamp
    solution = replace(solve(problem, 0.01), displacement=sheared)
    everything = reached_logs(solution)
    assert len(everything) == 4 * len(mesh.tets)
    rounded = with_radius(solution, 0.3)
    assert len(rounded) < len(everything)
    assert rounded[:, 2].max() < everything[:, 2].max()
    assert np.array_equal(with_radius(solution, 100.0), everything)  # better all than none


def with_radius(solution: Solution, radius: float) -> np.ndarray:
    problem = replace(solution.problem, sharp_edge_radius=radius)
    return reached_logs(replace(solution, problem=problem))
