"""Membranes: derivatives of their energy, invariance, closed forms of homogeneous stretch."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.sparse import csr_array
from scipy.spatial.transform import Rotation

from solver import Membrane, Mesh, Ogden, Problem, Supports
from solver.assembly.assembly import Assembly, unbalanced_forces
from solver.assembly.membranes.membranes import Membranes
from solver.assembly.state import State

Array = NDArray[np.float64]
Meshes = Callable[..., Mesh]
FILM = Membrane("z1", 100.0, 0.3, 0.1, wrinkles=False)


def curved(box: Meshes) -> Mesh:
    """A small block with curved faces and crooked triangles."""
    mesh = box((2, 2, 1), (2.0, 2.0, 1.0))
    x = mesh.nodes
    return mesh.moved(x + 0.05 * np.sin(2 * x[:, [1, 2, 0]] + x))


def with_film(mesh: Mesh, *films: Membrane) -> Problem:
    return Problem(mesh, Ogden.neo_hooke(1.0, 10.0), Supports(("x0",)), membranes=films or (FILM,))


@pytest.mark.parametrize("wrinkles", [True, False])
def test_forces_and_tangent_are_derivatives_of_the_energy(box: Meshes, wrinkles: bool) -> None:
    """To 1e-8: of a curved surface, part of which is clamped, in a state of large strain."""
    problem = with_film(curved(box), replace(FILM, wrinkles=wrinkles))
    having, bare = (Assembly(each) for each in (problem, replace(problem, membranes=())))
    random, size = np.random.default_rng(1), bare.numbering.size
    place = random.uniform(-0.05, 0.05, size)

    def state(vector: Array) -> State:
        return State(*bare.numbering.expand(vector))

    def energy(vector: Array) -> float:
        return having.energy(state(vector)) - bare.energy(state(vector))

    def forces(vector: Array) -> Array:
        pair = [each.evaluate(state(vector), 0.0, False).residual for each in (having, bare)]
        return pair[0] - pair[1]

    one, other = (each.evaluate(state(place), 0.0) for each in (having, bare))
    assert np.array_equal(one.pattern.indices, other.pattern.indices)
    values = (one.tangent - other.tangent, one.pattern.indices, one.pattern.indptr)
    upper = csr_array(values, shape=(size, size))
    for _ in range(3):
        along = random.normal(size=size)
        step = 1e-5 * along
        ahead, behind = (energy(place + s * step) for s in (1, -1))
        assert forces(place) @ along == pytest.approx((ahead - behind) / 2e-5, rel=1e-6)
        numerical = (forces(place + step) - forces(place - step)) / 2e-5
        action = upper @ along + upper.T @ along - upper.diagonal() * along
        assert action == pytest.approx(numerical, abs=1e-6 * abs(numerical).max())


def test_a_rigid_motion_strains_no_membrane(box: Meshes) -> None:
    mesh = curved(box)
    turn = Rotation.from_rotvec((1.0, 2.0, -0.5)).as_matrix()
    moved = mesh.nodes @ turn.T + [100.0, 20.0, 3.0] - mesh.nodes
    forces = Membranes.of(with_film(mesh)).forces(moved)
    assert abs(forces).max() < 1e-10 * FILM.stiffness


def test_forces_turn_with_the_body(box: Meshes) -> None:
    mesh = curved(box)
    films = Membranes.of(with_film(mesh))
    turn = Rotation.from_rotvec((-0.4, 1.2, 0.8)).as_matrix()
    strained = 0.1 * np.sin(mesh.nodes[:, [2, 0, 1]])
    turned = (mesh.nodes + strained) @ turn.T - mesh.nodes
    assert films.energy(turned) == pytest.approx(films.energy(strained), rel=1e-12)
    expected = films.forces(strained) @ turn.T
    assert films.forces(turned) == pytest.approx(expected, abs=1e-12 * abs(expected).max())


@pytest.mark.parametrize("poisson_ratio", [-0.3, 0.0, 0.5])
@pytest.mark.parametrize(("crookedness", "accuracy"), [(0.0, 1e-12), (0.1, 1e-5)])
def test_the_energy_of_a_homogeneous_strain_is_that_of_plane_stress(
    box: Meshes, poisson_ratio: float, crookedness: float, accuracy: float
) -> None:
    """Y t / (2 (1 - nu^2)) (nu (tr E)^2 + (1 - nu) E : E) per area.

    Exact on straight triangles; crooked ones have no constant tensors between their edges.
    """
    mesh = box((2, 2, 1), (2.0, 2.0, 1.0))
    x, y, _ = mesh.nodes.T
    bent = mesh.nodes.copy()
    bent[:, 0] += crookedness * np.sin(np.pi * y / 2) * x * (2 - x)
    mesh = mesh.moved(bent)
    gradient = np.array([[1.1, 0.2, 0.0], [0.0, 0.95, 0.0], [0.3, 0.0, 1.0]])
    strain = (gradient.T @ gradient - np.eye(3))[:2, :2] / 2
    film = replace(FILM, poisson_ratio=poisson_ratio)
    invariants = poisson_ratio * np.trace(strain) ** 2 + (1 - poisson_ratio) * (strain**2).sum()
    expected = 4 * film.stiffness / (2 * (1 - poisson_ratio**2)) * invariants
    moved = mesh.nodes @ (gradient - np.eye(3)).T
    energy = Membranes.of(with_film(mesh, film)).energy(moved)
    assert energy == pytest.approx(expected, rel=accuracy)


def test_a_membrane_may_lie_within_the_body_and_on_others(box: Meshes) -> None:
    """Two films on one surface are one of twice the thickness, whichever way triangles face."""
    mesh = box((2, 2, 2), (2.0, 2.0, 2.0))
    flat = (mesh.nodes[mesh.tets[:, :, None], 2] == 1.0).squeeze()
    faces = np.array(
        [(0, 2, 1, 6, 5, 4), (0, 1, 3, 4, 9, 7), (1, 2, 3, 5, 8, 9), (0, 3, 2, 7, 8, 6)]
    )
    inside = np.concatenate([mesh.tets[flat[:, face].all(axis=1)][:, face] for face in faces])
    _, once = np.unique(np.sort(inside, axis=1), axis=0, return_index=True)
    flipped = inside[once][:, [0, 2, 1, 5, 4, 3]]
    mesh = mesh.with_surfaces({"within": inside[once], "flipped": flipped})
    moved = 0.1 * np.sin(mesh.nodes[:, [2, 0, 1]])
    within, turned = (replace(FILM, surface=name) for name in ("within", "flipped"))
    single = Membranes.of(with_film(mesh, within)).forces(moved)
    double = Membranes.of(with_film(mesh, within, turned)).forces(moved)
    assert abs(single).max() > 0.1
    assert double == pytest.approx(2 * single, abs=1e-12 * abs(single).max())


def test_unbalanced_forces_have_those_of_membranes(box: Meshes) -> None:
    problem = with_film(curved(box))
    moved = 0.05 * np.sin(problem.mesh.nodes[:, [2, 0, 1]])
    state = State(moved, np.zeros(len(problem.mesh.vertices)))
    having, bare = (
        unbalanced_forces(each, state, 0.0, 0.0)
        for each in (problem, replace(problem, membranes=()))
    )
    expected = Membranes.of(problem).forces(moved)
    assert having - bare == pytest.approx(expected, abs=1e-12 * abs(having).max())
