"""Meshes that would give numbers but no sense are refused before anything is solved."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from solver import Mesh, Ogden, Problem, Supports, Traction, solve
from solver.mesh.connectivity import connected_parts

Meshes = Callable[..., Mesh]
CLAMPED = Supports(clamped=("x0",))


def with_surface(mesh: Mesh, triangles: np.ndarray) -> Mesh:
    return Mesh(mesh.nodes, mesh.tets, {**mesh.surfaces, "loaded": triangles})


def twins(mesh: Mesh) -> Mesh:
    """A mesh and a copy beside it, which shares no node with it."""
    nodes = np.concatenate([mesh.nodes, mesh.nodes + np.array([5.0, 0.0, 0.0])])
    return Mesh(nodes, np.concatenate([mesh.tets, mesh.tets + len(mesh.nodes)]), mesh.surfaces)


@pytest.mark.parametrize("loads", ["pressure", "traction"])
@pytest.mark.parametrize(
    ("triangles", "said"),
    [
        (lambda m: m.surfaces["x1"][:, [0, 2, 1, 5, 4, 3]], "faces into the body"),
        (lambda m: m.surfaces["x1"][:0], "has no triangles"),
        (lambda m: m.surfaces["x1"][:, [0, 1, 2, 4, 3, 5]], "other mid-nodes"),
        (lambda m: m.tets[:1][:, [0, 1, 3, 4, 9, 7]], "no outer face|faces into the body"),
    ],
)
def test_loads_act_on_outer_faces_seen_from_outside(
    box: Meshes,
    ninjaflex: Ogden,
    triangles: Callable[[Mesh], np.ndarray],
    said: str,
    loads: str,
) -> None:
    inner = box((3, 3, 3))
    order = np.argsort(np.linalg.norm(inner.nodes[inner.tets].mean(axis=1) - 0.5, axis=1))
    mesh = Mesh(inner.nodes, inner.tets[order], inner.surfaces)  # the first one is well inside
    named = with_surface(mesh, triangles(mesh))
    with pytest.raises(ValueError, match=said):
        if loads == "pressure":
            Problem(named, ninjaflex, CLAMPED, ("loaded",))
        else:
            Problem(named, ninjaflex, CLAMPED, loads=(Traction("loaded", (1.0, 0.0, 0.0)),))


def test_pressure_acts_on_a_triangle_once(box: Meshes, ninjaflex: Ogden) -> None:
    mesh = with_surface(box((1, 1, 1)), box((1, 1, 1)).surfaces["x1"][:1])
    with pytest.raises(ValueError, match="is pressurised twice"):
        Problem(mesh, ninjaflex, CLAMPED, ("x1", "loaded"))


def test_a_mesh_has_elements_and_each_of_them_once(box: Meshes, ninjaflex: Ogden) -> None:
    mesh = box((2, 1, 1))
    with pytest.raises(ValueError, match="no tetrahedra"):
        Problem(Mesh(mesh.nodes, mesh.tets[:0], {}), ninjaflex, Supports())
    twice = Mesh(mesh.nodes, np.concatenate([mesh.tets, mesh.tets[2:3]]), mesh.surfaces)
    with pytest.raises(ValueError, match="3 tetrahedra share a face at"):
        Problem(twice, ninjaflex, CLAMPED)


def test_every_part_of_a_body_must_be_held(box: Meshes, ninjaflex: Ogden) -> None:
    mesh = twins(box((2, 1, 1)))
    assert set(np.unique(connected_parts(mesh.tets, len(mesh.nodes)))) == {0, 1}
    with pytest.raises(ValueError, match=r"part of the body around \(5.5, 0.5, 0.5\) mm free .* 6"):
        Problem(mesh, ninjaflex, CLAMPED)


def test_nodes_of_no_element_hold_nothing(box: Meshes, ninjaflex: Ogden) -> None:
    mesh = box((2, 1, 1))
    nodes = np.concatenate([mesh.nodes, mesh.nodes[mesh.surface_nodes("x0")]])
    number = {old: len(mesh.nodes) + k for k, old in enumerate(mesh.surface_nodes("x0"))}
    loose = np.vectorize(number.get)(mesh.surfaces["x0"])
    apart = Mesh(nodes, mesh.tets, {**mesh.surfaces, "x0": loose})
    with pytest.raises(ValueError, match="free to move in 6 ways"):
        Problem(apart, ninjaflex, CLAMPED)


def test_lengths_beside_the_mesh_are_numbers(box: Meshes, ninjaflex: Ogden) -> None:
    problem = Problem(box((1, 1, 1)), ninjaflex, CLAMPED)
    for radius in (-1.0, float("nan"), float("inf")):
        with pytest.raises(ValueError, match="sharp_edge_radius"):
            replace(problem, sharp_edge_radius=radius)


@pytest.mark.parametrize(("length", "modulus"), [(1e-4, 1.0), (1e5, 1.0), (1.0, 1e-12), (1e4, 1e9)])
def test_the_units_are_the_users_own_affair(box: Meshes, length: float, modulus: float) -> None:
    def tip(length: float, modulus: float) -> np.ndarray:
        mesh = box((4, 1, 1), (4 * length, length, length))
        problem = Problem(mesh, Ogden((modulus,), (2.0,)), CLAMPED, ("z1",))
        solution = solve(problem, 0.02 * modulus)
        assert solution.converged, solution.message
        return solution.displacement[mesh.surface_nodes("x1")].mean(axis=0) / length

    assert tip(length, modulus) == pytest.approx(tip(1.0, 1.0), rel=1e-4, abs=1e-6)
