"""Meshes moved from one design to its neighbours."""

from __future__ import annotations

import cadquery as cq
import numpy as np
import pytest
from bodies_to_morph import DESIGNS, departures, design, morpher, solid
from OCP.BRepExtrema import BRepExtrema_DistShapeShape

from bellows_design.design.design import Design
from bellows_design.design.topology import same_topology
from bellows_design.design.variation import between, geometric_parameters, kinked, varied
from bellows_design.errors import DesignError
from bellows_design.morphing import ForeignMesh, Morpher, MorphFailed, NoNeighbour
from solver import Mesh
from solver.mesh.jacobians import least_jacobians
from solver.mesh.mid_nodes import SMALLEST_RATIO, jacobian_ratios

GROOVED = "prototype_2_indent"
QUICK = (
    ("prototype_1", "unit-cell"),
    (GROOVED, "unit-cell"),
    ("finger", "half"),
    ("fingertip", "half"),
)
ALL = [(name, "unit-cell") for name in DESIGNS] + [
    (name, "half") for name in ("prototype_1", GROOVED, "finger", "fingertip")
]


def beside(own: Design, parameter: str, factor: float) -> Design:
    return varied(own, {parameter: factor * geometric_parameters(own)[parameter]})


def neighbours(own: Design, model: str, share: float = 0.05) -> list[tuple[str, Design]]:
    """Every geometric parameter both ways, as far as that leaves the faces as they are."""
    found = []
    for parameter in geometric_parameters(own):
        for factor in (1 - share, 1 + share):
            try:
                other = beside(own, parameter, factor)
            except DesignError:
                continue
            if not same_topology(own, other, model):
                found.append((f"{parameter} * {factor:g}", other))
    return found


@pytest.mark.parametrize(("name", "model"), QUICK)
def test_the_own_design_has_the_same_nodes(name: str, model: str) -> None:
    tool = morpher(name, model)
    assert tool.mesh_of(design(name, model)) is tool.mesh
    assert np.abs(tool.nodes_of(design(name, model)) - tool.mesh.nodes).max() < 1e-12


@pytest.mark.parametrize(("name", "model"), QUICK)
def test_neighbours_of_all_parameters_share_the_tetrahedra_and_none_folds(
    name: str, model: str
) -> None:
    tool, own = morpher(name, model), design(name, model)
    others = neighbours(own, model)
    assert len(others) > 1.5 * len(geometric_parameters(own))
    for what, other in others:
        mesh = tool.mesh_of(other)
        assert np.shares_memory(mesh.tets, tool.mesh.tets), what
        assert mesh.surfaces.keys() == tool.mesh.surfaces.keys()
        assert jacobian_ratios(mesh.nodes, mesh.tets).min() >= SMALLEST_RATIO, what
        assert least_jacobians(mesh.nodes, mesh.tets).low.min() > 0, what


@pytest.mark.slow
@pytest.mark.parametrize(("name", "model"), ALL)
def test_a_morphed_mesh_is_as_near_to_the_solid_as_a_fresh_one(name: str, model: str) -> None:
    """Within 0.1 % of volume and areas of how near the mesh that it came from is to its own.

    The coarse meshes differ from their solids by up to 0.6 %, which changes with their numbers.
    """
    tool, own = morpher(name, model), design(name, model)
    before = departures(tool.mesh, solid(own, model))
    for what, other in neighbours(own, model):
        after = departures(tool.mesh_of(other), solid(other, model))
        assert np.abs(after - before).max() < 1e-3, what


@pytest.mark.parametrize(
    ("name", "parameter", "factor"),
    [
        ("prototype_1", "bubble_width", 0.9),
        ("prototype_1", "tendon_thickness", 1.05),  # the floors are level no longer
        ("prototype_1", "inner_fillet", 1.2),
        ("finger", "chamber_length", 1.1),
        ("finger", "indent.width", 0.8),
    ],
)
def test_nodes_of_the_surface_lie_on_the_faces_of_the_new_solid(
    name: str, parameter: str, factor: float
) -> None:
    tool = morpher(name)
    other = beside(tool.design, parameter, factor)
    shell = solid(other, "unit-cell").solid.Shells()[0].wrapped
    points = tool.boundary_of(other)[tool.skin.share == 1.0]
    for point in points[:: len(points) // 60]:
        vertex = cq.Vertex.makeVertex(*point).wrapped
        assert BRepExtrema_DistShapeShape(vertex, shell).Value() < 1e-6


@pytest.mark.parametrize(("name", "model"), QUICK)
def test_there_and_back_returns_the_nodes(name: str, model: str) -> None:
    tool = morpher(name, model)
    other = beside(tool.design, "bubble_height", 1.05)
    mesh = tool.mesh_of(other)
    back = Morpher.of(other, model, mesh).mesh_of(tool.design)
    moved = np.abs(mesh.nodes - tool.mesh.nodes).max()
    surface = tool.skin.nodes
    # The extensions back belong to the moved mesh, so that inside of faces and of the body the way
    # back differs by a share of second order in the change.
    assert np.abs(back.nodes - tool.mesh.nodes).max() < 0.1 * moved
    corners = surface[(tool.skin.places.level == 3) & (tool.skin.share == 1.0)]
    assert np.abs(back.nodes[corners] - tool.mesh.nodes[corners]).max() < 1e-9


@pytest.mark.parametrize(("name", "model"), QUICK)
def test_velocities_are_the_central_differences_of_nodes(name: str, model: str) -> None:
    tool = morpher(name, model)
    smooth = [name for name in geometric_parameters(tool.design) if name not in kinked(tool.design)]
    step = 3e-4
    for parameter in smooth:
        value = geometric_parameters(tool.design)[parameter]
        ahead, behind = (
            tool.nodes_of(varied(tool.design, {parameter: value + sign * step})) for sign in (1, -1)
        )
        velocity = tool.velocity(parameter)
        difference = (ahead - behind) / (2 * step)
        assert np.abs(velocity - difference).max() <= 1e-6 * np.abs(velocity).max(), parameter


def test_a_parameter_that_a_body_does_not_depend_on_moves_no_node() -> None:
    assert np.abs(morpher("prototype_1").velocity("offset")).max() < 1e-9


def test_a_velocity_at_a_neighbour_is_that_of_its_nodes() -> None:
    tool = morpher("finger")
    there = beside(tool.design, "bubble_width", 1.05)
    value, step = geometric_parameters(there)["tendon_height"], 3e-4
    ahead, behind = (
        tool.nodes_of(varied(there, {"tendon_height": value + sign * step})) for sign in (1, -1)
    )
    velocity = tool.velocity("tendon_height", there)
    assert np.abs(velocity - (ahead - behind) / (2 * step)).max() < 1e-6


@pytest.mark.parametrize(("name", "model"), QUICK)
def test_a_gradient_pulled_back_to_the_surface_gives_the_same_derivatives(
    name: str, model: str
) -> None:
    tool = morpher(name, model)
    gradient = np.random.default_rng(1).normal(size=tool.mesh.nodes.shape)
    pulled = tool.pulled_back(gradient)
    inside = np.setdiff1d(np.arange(len(gradient)), tool.skin.nodes)
    assert not pulled[inside].any()
    for parameter in ("bubble_thickness", "tendon_width", "chamber_length"):
        direct = (gradient * tool.velocity(parameter)).sum()
        assert (pulled * tool.boundary_velocity(parameter)).sum() == pytest.approx(direct, rel=1e-9)


@pytest.mark.parametrize(
    ("name", "changes", "reason"),
    [
        ("prototype_1", {"inner_fillet": 1.0}, "flat between the chamber's fillets along x"),
        ("prototype_1", {"bubble_thickness": 1.2}, "bubbles: 8 instead of 7"),
        ("finger", {"inner_fillet": 0.8}, "flat between the chamber's fillets along x"),
        ("finger", {"tendon_thickness": 1.1}, "the channel's floor above the chamber's"),
    ],
)
def test_another_topology_is_no_neighbour(
    name: str, changes: dict[str, float], reason: str
) -> None:
    tool = morpher(name)
    with pytest.raises(NoNeighbour, match=reason):
        tool.mesh_of(varied(tool.design, changes))


def test_too_far_a_way_says_how_far_it_can_be_gone() -> None:
    tool = morpher("prototype_1")
    far = varied(tool.design, {"bubble_width": 15.5})
    with pytest.raises(MorphFailed, match=r"near \(.*% of the way") as failure:
        tool.mesh_of(far)
    reached = failure.value.reached
    assert 0.2 < reached < 1
    tool.mesh_of(between(tool.design, far, reached))
    with pytest.raises(MorphFailed):
        tool.mesh_of(between(tool.design, far, reached + 0.02))


def test_a_design_that_is_too_far_for_one_way_is_reached_in_two() -> None:
    own = morpher("prototype_1")
    there = varied(own.design, {"bubble_width": 17.0})
    onwards = Morpher.of(there, "unit-cell", own.mesh_of(there))
    narrow = onwards.mesh_of(varied(own.design, {"bubble_width": 16.0}))
    assert narrow.nodes[:, 1].max() == pytest.approx(8.0, abs=1e-9)
    assert least_jacobians(narrow.nodes, narrow.tets).low.min() > 0


def test_the_mesh_of_another_body_is_refused() -> None:
    mesh = morpher("finger").mesh
    with pytest.raises(ForeignMesh, match="lie on no surface"):
        Morpher.of(design("prototype_1", "unit-cell"), "unit-cell", mesh)
    shifted = Mesh(mesh.nodes + 0.01, mesh.tets, mesh.surfaces)
    with pytest.raises(ForeignMesh, match="mm: it is a mesh of another body"):
        Morpher.of(design("finger", "unit-cell"), "unit-cell", shifted)


def test_a_parameter_that_cannot_be_moved_alone_has_no_velocity() -> None:
    with pytest.raises(DesignError, match="inner_fillet is no geometric parameter"):
        morpher("finger").velocity("inner_fillet")
