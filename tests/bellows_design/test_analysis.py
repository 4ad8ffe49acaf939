"""What is solved: the half body's mesh, its supports and its load."""

from __future__ import annotations

from functools import cache
from itertools import pairwise

import numpy as np
import pytest

from bellows_design.analysis import LADDER, half_problem, half_solid, mesh_of
from bellows_design.design import Design, load_design
from bellows_design.paper import TABLE_4, Result
from bellows_design.parameters import BellowsParameters, Indent
from solver import Mesh
from solver.curving import jacobian_ratios
from solver.elements import triangle_rule

BELLOWS = BellowsParameters.model_validate(
    {**load_design("prototype_1").bellows.model_dump(), "length": 18, "number_of_bubbles": 1}
)
DESIGN = Design(name="short", bellows=BELLOWS, indent=Indent(depth=0.4, width=2.4))


@cache
def meshes() -> tuple[Mesh, ...]:
    solid = half_solid(DESIGN)
    return tuple(mesh_of(solid, DESIGN, level) for level in LADDER)


def area_vectors(mesh: Mesh, *names: str) -> tuple[np.ndarray, np.ndarray]:
    """Points and weighted outward normals (k, q, 3) of curved triangles."""
    rule = triangle_rule()
    corners = mesh.nodes[mesh.triangles(*names)]
    points = np.einsum("qa,kai->kqi", rule.quadratic, corners)
    tangents = np.einsum("qad,kai->dkqi", rule.gradients, corners)
    return points, np.cross(tangents[0], tangents[1]) * rule.weights[:, None]


def volume(mesh: Mesh, *names: str) -> float:
    points, normals = area_vectors(mesh, *names)
    return float(np.einsum("kqi,kqi->", points, normals) / 3)


def test_the_mesh_has_the_surfaces_of_the_half_body() -> None:
    solid = half_solid(DESIGN)
    for mesh in meshes():
        assert set(mesh.surfaces) == {"cavity", "outside", "root", "tip", "symmetry"}
        _, normals = area_vectors(mesh, *mesh.surfaces)
        assert normals.sum(axis=(0, 1)) == pytest.approx(np.zeros(3), abs=1e-8)  # closed
        for name in ("root", "tip"):
            flat = np.linalg.norm(area_vectors(mesh, name)[1], axis=2).sum()
            assert flat == pytest.approx(solid.area(name), rel=1e-9)


def test_the_mesh_stands_on_the_planes_it_is_held_at() -> None:
    for mesh in meshes():
        nodes = mesh.nodes
        assert np.abs(nodes[mesh.surface_nodes("root")][:, 0]).max() < 1e-9
        assert np.abs(nodes[mesh.surface_nodes("symmetry")][:, 1]).max() < 1e-9
        assert np.abs(nodes[mesh.surface_nodes("tip")][:, 0] - 18).max() < 1e-9
        assert nodes[:, 1].min() > -1e-9


def test_every_step_of_the_ladder_is_finer_and_nearer_to_the_solid() -> None:
    exact = half_solid(DESIGN).solid.Volume()
    counts = [len(mesh.tets) for mesh in meshes()]
    assert all(finer > 1.2 * coarser for coarser, finer in pairwise(counts))
    errors = [abs(volume(mesh, *mesh.surfaces) / exact - 1) for mesh in meshes()]
    assert errors[0] < 0.02 and errors[-1] < 2e-4
    assert errors[-1] < errors[0] / 10


def test_no_step_of_the_ladder_has_a_folded_element() -> None:
    for mesh in meshes():
        assert jacobian_ratios(mesh.nodes, mesh.tets).min() >= 0.1


def test_the_cavity_encloses_the_air_of_the_bellows() -> None:
    """Its normals point into the air, so cavity and its section at y = 0 bound it inside out."""
    mesh = meshes()[-1]
    chamber = 2.0 * (17.0 / 2) * 17.0  # half of it
    channel = (BELLOWS.bubble_middles[-1] - 1.5 - 1.0) * (9.0 / 2) * 2.0
    points, normals = area_vectors(mesh, "cavity")
    # The plane y = 0 closes the air and adds nothing to the integral of y n_y.
    air = -np.einsum("kq,kq->", points[..., 1], normals[..., 1])
    assert air == pytest.approx(chamber + channel, rel=0.04)  # less the fillets


def test_root_is_clamped_the_half_symmetric_and_the_whole_cavity_loaded() -> None:
    problem = half_problem(DESIGN, meshes()[0])
    assert problem.supports.clamped == ("root",)
    assert dict(problem.supports.symmetry) == {"symmetry": 1}
    assert problem.pressurised == ("cavity",)
    assert (problem.material.mu, problem.material.alpha) == ((0.19825, 3.2778), (3.05, -0.0054))
    assert problem.material.bulk_modulus == np.inf


@pytest.mark.parametrize("result", TABLE_4, ids=lambda result: result.label)
def test_stations_ascend_from_root_to_tip_through_every_bubble(result: Result) -> None:
    design = result.build()
    axis = half_problem(design, meshes()[0]).axis
    assert axis is not None
    assert (axis.stations[0], axis.stations[-1]) == (0, design.bellows.length)
    assert len(axis.stations) == 2 * design.bellows.bubble_count + 1
    assert set(design.bellows.bubble_middles) <= set(axis.stations)
    assert all(after > before for before, after in pairwise(axis.stations))


def test_equal_designs_give_equal_meshes() -> None:
    again = mesh_of(half_solid(DESIGN), DESIGN, LADDER[0])
    assert np.array_equal(again.nodes, meshes()[0].nodes)
    assert np.array_equal(again.tets, meshes()[0].tets)
