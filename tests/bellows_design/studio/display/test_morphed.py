"""Shapes without CAD lie on the CAD solid's surface, for any number of bubbles."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
import trimesh

from bellows_design.analysis.mesh_sequence import begun, next_plan
from bellows_design.analysis.models import UNIT_CELL
from bellows_design.budget import DEFAULT
from bellows_design.design.design import Design
from bellows_design.design.shipped import load_design
from bellows_design.geometry.actuator import printed_part
from bellows_design.geometry.tessellation import tessellate
from bellows_design.studio.choices.changed import changed
from bellows_design.studio.display.chained import Shape
from bellows_design.studio.display.morphed import Cells, MovedCell
from solver import Mesh

BASE = load_design("prototype_2")
CLOSE = 0.02
"""mm. Points lie on the solid, whose triangles are within 0.02 mm of it."""


@cache
def cell_mesh() -> Mesh:
    return next_plan(begun(BASE, UNIT_CELL, "")).made(DEFAULT)


@cache
def cell() -> MovedCell:
    return MovedCell.of(BASE, cell_mesh())


def solid(design: Design) -> trimesh.Trimesh:
    part = printed_part(design.bellows, design.indent, design.port, design.mount, design.fingertip)
    mesh = tessellate(part.solid)
    return trimesh.Trimesh(mesh.vertices, mesh.triangles, process=False)


def of_two_bubbles(design: Design, shape: Shape) -> np.ndarray:
    """All points between the middles of the first two bubbles: the ends are boxes."""
    x, middles = shape.points[:, 0], design.bellows.bubble_middles
    return shape.points[(x > middles[0] + 0.01) & (x < middles[1] - 0.01)]


@pytest.mark.parametrize(
    "values",
    [
        {},
        {"bubble_width": 22.0, "tendon_height": 6.4},
        {"bubble_height": 24.0, "bubble_distance": 1.0},
        {"length": 71.0},
        {"number_of_bubbles": 4, "chamber_length": 1.5},
    ],
)
@pytest.mark.thorough
def test_points_of_the_shape_lie_on_the_cad_solid(values: dict[str, float]) -> None:
    """With four bubbles also the mid-nodes that the mesh holds back from its sharp fillets."""
    design = changed(BASE, values)
    assert cell().fits(design)
    points = of_two_bubbles(design, cell().shape_of(design))
    _, distance, _ = trimesh.proximity.closest_point(solid(design), points)
    assert len(points) > 1000 and distance.max() < CLOSE


def test_there_are_as_many_bubbles_as_the_design_has() -> None:
    counts = {}
    for length in (50.0, 80.0):
        design = changed(BASE, {"length": length})
        top = cell().shape_of(design).points
        high = np.sort(top[top[:, 2] > design.bellows.bubble_height - 0.01, 0])
        counts[design.bellows.bubble_count] = 1 + int((np.diff(high) > 1.0).sum())
    assert len(counts) == 2 and all(count == shown for count, shown in counts.items())


def test_many_bubbles_are_drawn_by_fewer_triangles_each() -> None:
    few, many = (
        cell().shape_of(changed(BASE, {"length": length, "number_of_bubbles": count}))
        for length, count in ((50.0, 4), (400.0, 60))
    )
    each = [len(shape.triangles) / count for shape, count in ((few, 4), (many, 60))]
    assert each[1] < each[0] / 3


def test_triangles_look_outward_everywhere() -> None:
    """So the mirrored copies do too: the whole encloses its material, the ends included."""
    shape = cell().shape_of(BASE)
    corners = shape.points[shape.triangles]
    volume = np.einsum("ij,ij->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6
    bubbles = BASE.bellows.bubble_count * 4 * cell_volume()
    assert volume == pytest.approx(bubbles + boxes_volume(), rel=0.05)


def cell_volume() -> float:
    corners = cell_mesh().nodes[cell_mesh().tets[:, :4]]
    sides = corners[:, 1:] - corners[:, :1]
    return float(np.abs(np.linalg.det(sides)).sum() / 6)


def boxes_volume() -> float:
    """Root and tip as solid boxes, and the socket."""
    bellows, port = BASE.bellows, BASE.port
    rest = bellows.length - bellows.bubble_count * bellows.pitch
    tendon = rest * bellows.tendon_width * bellows.tendon_height
    return tendon + port.depth * 2 * port.radius * port.height


def test_other_faces_have_no_shape_and_follow_from_a_cell_of_their_own() -> None:
    cells, full = Cells(), changed(BASE, {"inner_fillet": 0.0})
    assert cells.shape_of(BASE) is None
    cells.add(cell())
    assert cells.shape_of(BASE) is not None and cells.shape_of(full) is None


def test_a_second_cell_of_the_same_faces_takes_the_place_of_the_first() -> None:
    cells = Cells()
    for _ in range(10):
        cells.add(cell())
    assert len(cells._cells) == 1
