"""Own bodies with their mirror images."""

from __future__ import annotations

import numpy as np
import pytest
from closed_surfaces import volume_of_cells

from bellows_design.deformed import DeformedActuator, deformed_body
from bellows_design.own_body import OwnBody
from bellows_design.own_body.analysis.evaluate import evaluate

RUBBER = {"name": "rubber", "model": "neo-hooke", "c10": 0.015, "yield_strength": 1.0}


@pytest.fixture(scope="module")
def column() -> DeformedActuator:
    """A quarter of a column about x = 5, y = 7 mm, which hangs from its upper end."""
    import cadquery as cq

    solid = cq.Solid.makeBox(2, 3, 20, cq.Vector(5, 7, 0))
    part = {"name": "body", "solid": solid, "material": RUBBER, "density_kg_m3": 1000.0}
    surfaces = {"top": ">Z", "tip": "<Z", "x": "<X", "y": "<Y", "sides": [">X", ">Y"]}
    body = OwnBody.of(
        {"name": "column", "parts": [part], "surfaces": surfaces, "gravity": {},
         "supports": {"clamped": ["top"], "symmetry": {"x": "x", "y": "y"}},
         "mesh": {"size": 4.0}}
    )  # fmt: skip
    return deformed_body(evaluate(body, meshes=1))


def test_a_quarter_is_shown_whole(column: DeformedActuator) -> None:
    mesh = column.mesh
    assert volume_of_cells(mesh, mesh.nodes) == pytest.approx(4 * 2 * 3 * 20)
    assert mesh.nodes.min(axis=0) == pytest.approx([3, 4, 0])
    assert mesh.nodes.max(axis=0) == pytest.approx([7, 10, 20])
    assert set(mesh.surfaces) == {"top", "tip", "sides"} == mesh.boundary_surfaces
    assert len(mesh.outer_faces) == sum(map(len, mesh.surfaces.values()))


def test_its_images_move_alike(column: DeformedActuator) -> None:
    rows = np.column_stack([column.mesh.nodes - [5, 7, 0], column.displacement]).round(9)
    for signs in ([-1, 1, 1], [1, -1, 1]):
        images = rows * [*signs, *signs] + 0.0
        ordered, others = (each[np.lexsort(each.T[:3])] for each in (rows + 0.0, images))
        assert others == pytest.approx(ordered, abs=1e-8)
    assert column.displacement[:, 2].min() < 0
