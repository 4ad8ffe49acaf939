"""Neighbouring designs: the same nodes, moved, with the ends of the evaluation they start from."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from closed_surfaces import open_edges, volume_of_cells

from bellows_design.deformed import Assembly, deformed_surface
from bellows_design.design.overrides import with_overrides
from bellows_design.errors import DesignError
from bellows_design.evaluation import Evaluation, NeighbourEvaluation, evaluate
from bellows_design.geometry.actuator import full_body
from solver import Mesh, rotation

Evaluated = Callable[[str], Evaluation]
CHANGED = ["bubble_width=14.4", "bubble_distance=1.55", "offset=5.2", "load.pressure=0.102"]


@pytest.fixture(scope="module")
def neighbour(evaluated: Evaluated) -> NeighbourEvaluation:
    anchor = evaluated("three bubbles")
    found = evaluate(with_overrides(anchor.design, CHANGED), near=anchor)
    assert not found.fallback
    return found


@pytest.mark.thorough
def test_it_has_its_own_shape_at_rest(neighbour: NeighbourEvaluation) -> None:
    body = Assembly.of(neighbour.anchor).actuator(neighbour)
    solid = full_body(neighbour.design.bellows, None).solid
    assert volume_of_cells(body.mesh, body.mesh.nodes) == pytest.approx(solid.Volume(), rel=5e-3)
    box, nodes = solid.BoundingBox(), body.mesh.nodes
    assert nodes.max(axis=0) == pytest.approx([box.xmax, box.ymax, box.zmax], abs=0.01)


def test_its_tip_turns_by_its_own_angle(neighbour: NeighbourEvaluation) -> None:
    body = Assembly.of(neighbour.anchor).actuator(neighbour)
    tip = body.mesh.surfaces["tip"]
    half = tip[(body.mesh.nodes[tip, 1] >= 0).all(axis=1)]
    turned = rotation(Mesh(body.mesh.nodes, body.mesh.tets, {"tip": half}), body.displacement)
    assert neighbour.bending_angle_deg != neighbour.anchor.bending_angle_deg
    assert turned == pytest.approx(neighbour.bending_angle_deg, abs=1e-3)


def test_its_surface_has_the_triangles_of_the_evaluation(
    neighbour: NeighbourEvaluation, evaluated: Evaluated
) -> None:
    first, shown = deformed_surface(evaluated("three bubbles")), deformed_surface(neighbour)
    assert np.array_equal(first.triangles, shown.triangles)
    assert open_edges(shown.triangles) == 0
    assert shown.positions[0] != pytest.approx(first.positions[0], abs=0.1)


def test_one_assembly_serves_all(neighbour: NeighbourEvaluation, evaluated: Evaluated) -> None:
    assembly = Assembly.of(neighbour.anchor)
    for found in (neighbour, evaluated("three bubbles"), neighbour):
        alone, kept = deformed_surface(found), assembly.surface(found)
        assert np.array_equal(alone.positions, kept.positions)
        assert np.array_equal(alone.von_mises, kept.von_mises)


def test_an_assembly_refuses_what_has_other_meshes(evaluated: Evaluated) -> None:
    assembly = Assembly.of(evaluated("two bubbles"))
    with pytest.raises(DesignError, match="has other meshes: make an Assembly of that evaluation"):
        assembly.surface(evaluated("three bubbles"))
