"""Numbering, sparsity and assembly against plain dense sums."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise

import numpy as np
import pytest

from solver import Mesh, Ogden, Problem, Supports
from solver.assembly.assembly import Assembly, solid
from solver.assembly.colouring import chunks
from solver.assembly.state import State
from solver.kernels.element import element_response

BoxMesh = Callable[..., Mesh]
THREE_PLANES = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2})


def random_state(mesh: Mesh, size: float) -> State:
    random = np.random.default_rng(9)
    return State(
        random.uniform(-size, size, mesh.nodes.shape),
        random.uniform(-1, 1, len(mesh.vertices)),
    )


def test_assembled_tangent_and_residual_equal_the_sum_over_elements(
    box: BoxMesh, ninjaflex: Ogden
) -> None:
    mesh = box((2, 2, 1), distortion=0.2)
    problem = Problem(mesh, ninjaflex, THREE_PLANES, ())
    assembly, state = Assembly(problem), random_state(mesh, 0.02)
    dofs, size = assembly.numbering.of_tets(mesh), assembly.numbering.size
    dense, residual = np.zeros((size + 1, size + 1)), np.zeros(size + 1)  # last: prescribed
    r, upper = np.empty(34), np.empty((34, 34))
    for tet, corners, places in zip(mesh.tets, mesh.tet_vertices, dofs, strict=True):
        q = state.hydrostatic_pressure[corners]
        body, x, u = solid(problem), mesh.nodes[tet], state.displacement[tet]
        element_response(body, 0, x, u, q, np.empty((0, 6)), True, r, upper)
        whole = np.triu(upper) + np.triu(upper, 1).T
        dense[np.ix_(places, places)] += whole
        residual[places] += r
    equilibrium = assembly.evaluate(state, 0.0)
    assert equilibrium.residual == pytest.approx(residual[:-1], abs=1e-14)
    rows = np.repeat(np.arange(size), np.diff(assembly.pattern.indptr))
    assert equilibrium.tangent == pytest.approx(dense[rows, assembly.pattern.indices], abs=1e-13)
    outside = np.triu(dense[:-1, :-1])
    outside[rows, assembly.pattern.indices] = 0.0
    assert not outside.any()


def test_residual_is_the_gradient_of_the_energy_of_the_whole_body(
    box: BoxMesh, ninjaflex: Ogden
) -> None:
    mesh = box((2, 2, 2), distortion=0.2)
    assembly, state = Assembly(Problem(mesh, ninjaflex, THREE_PLANES, ())), random_state(mesh, 0.02)
    residual = assembly.evaluate(state, 0.0, tangent=False).residual
    vector = np.random.default_rng(1).normal(size=len(residual))
    du, dq, _ = assembly.numbering.expand(vector)

    def energy(step: float) -> float:
        return assembly.energy(
            State(state.displacement + step * du, state.hydrostatic_pressure + step * dq)
        )

    h = 1e-4
    slope = (8 * (energy(h) - energy(-h)) - energy(2 * h) + energy(-2 * h)) / (12 * h)
    assert slope == pytest.approx(residual @ vector, rel=1e-8)


@pytest.mark.parametrize("divisions", [(2, 2, 2), (16, 3, 4)])
def test_chunks_of_one_colour_share_no_node(box: BoxMesh, divisions: tuple[int, int, int]) -> None:
    mesh = box(divisions, (4.0, 1.0, 1.0))
    order, starts, colours = chunks(mesh)
    assert np.array_equal(np.sort(order), np.arange(len(mesh.tets)))
    assert len(starts) - 1 == colours[-1] == max(len(mesh.tets) // 64, 1)
    for first, end in pairwise(colours):
        nodes = [np.unique(mesh.tets[order[starts[c] : starts[c + 1]]]) for c in range(first, end)]
        together = np.concatenate(nodes)
        assert len(np.unique(together)) == len(together) > 0


def test_assembly_does_not_depend_on_the_number_of_threads(box: BoxMesh, ninjaflex: Ogden) -> None:
    import numba

    mesh = box((16, 3, 4), (4.0, 1.0, 1.0))
    assembly, state = Assembly(Problem(mesh, ninjaflex, THREE_PLANES, ())), random_state(mesh, 0.01)
    threads = numba.get_num_threads()
    many = assembly.evaluate(state, 0.0)
    try:
        numba.set_num_threads(1)
        one = assembly.evaluate(state, 0.0)
    finally:
        numba.set_num_threads(threads)
    assert np.array_equal(many.tangent, one.tangent)
    assert np.array_equal(many.residual, one.residual)


@pytest.mark.parametrize("distortion", [0.0, 0.3])
def test_patch_of_distorted_elements_carries_a_homogeneous_state_exactly(
    box: BoxMesh, ninjaflex: Ogden, distortion: float
) -> None:
    mesh = box((3, 3, 3), distortion=distortion)
    assembly = Assembly(Problem(mesh, ninjaflex, THREE_PLANES, ()))
    gradient = np.array([[1.5, 0.4, 0.0], [0.1, 0.9, -0.2], [0.0, 0.3, 1.0]])
    gradient /= np.cbrt(np.linalg.det(gradient))
    u = mesh.nodes @ (gradient - np.eye(3)).T
    residual = assembly.evaluate(State(u, np.full(len(mesh.vertices), 0.7)), 0.0, False).residual
    inner = ((mesh.nodes > 1e-9) & (mesh.nodes < 1 - 1e-9)).all(axis=1)
    assert inner.any()
    assert residual[assembly.numbering.displacement[inner]] == pytest.approx(0.0, abs=1e-14)
    assert residual[assembly.numbering.pressure] == pytest.approx(0.0, abs=1e-15)
    if distortion:
        bad = State(u, np.linspace(0, 1, len(mesh.vertices)))  # not a homogeneous state
        residual = assembly.evaluate(bad, 0.0, False).residual
        assert abs(residual[assembly.numbering.displacement[inner]]).max() > 1e-4


def test_a_mesh_turned_inside_out_is_refused(box: BoxMesh, ninjaflex: Ogden) -> None:
    mesh = box((1, 1, 1))
    mirrored = Mesh(mesh.nodes * [1, 1, -1], mesh.tets, mesh.surfaces)
    with pytest.raises(ValueError, match=r"tetrahedron \d+ is turned inside out"):
        Assembly(Problem(mirrored, ninjaflex, THREE_PLANES, ()))
