"""Mirror images that share nodes with what they are images of."""

from __future__ import annotations

import cadquery as cq
import numpy as np
import pytest
from closed_surfaces import volume_of_cells

from bellows_design.deformed.joined.copies import Assembled, Placed
from bellows_design.deformed.joined.motion import Motion
from bellows_design.deformed.joined.single import mirrored_copies
from bellows_design.geometry.named_solids import named
from solver import Mesh
from solver.meshing import MeshOptions

PLANES = {"x": 0, "y": 1, "z": 2}


@pytest.fixture(scope="module")
def octant() -> Mesh:
    """An eighth of a box of 4 × 6 × 8 mm about the origin."""
    solid = named(cq.Solid.makeBox(2, 3, 4), "outside").renamed(_plane_or_outside)
    return solid.meshed(MeshOptions(size=2.0), 60.0)


def _plane_or_outside(face: cq.Face, own: str) -> str:
    centre, normal = face.Center().toTuple(), face.normalAt().toTuple()
    axis = int(np.abs(normal).argmax())
    return "xyz"[axis] if abs(centre[axis]) < 1e-9 else own


def test_eight_images_make_the_whole_box(octant: Mesh) -> None:
    whole = Assembled.of([octant], mirrored_copies(PLANES, {"outside": "outside"}))
    nodes = whole.positions(Placed((octant.nodes,), (Motion(),)))
    mesh = Mesh(nodes, whole.tets, whole.surfaces)
    assert len(np.unique(nodes.round(9), axis=0)) == len(nodes)  # none is there twice
    assert volume_of_cells(mesh, nodes) == pytest.approx(4 * 6 * 8)
    assert mesh.boundary_surfaces == {"outside"}
    assert len(mesh.outer_faces) == len(mesh.surfaces["outside"])


def test_values_are_the_same_on_all_images(octant: Mesh) -> None:
    whole = Assembled.of([octant], mirrored_copies(PLANES, {"outside": "outside"}))
    nodes = whole.positions(Placed((octant.nodes,), (Motion(),)))
    distances = np.linalg.norm(octant.nodes, axis=1)
    assert whole.values((distances,)) == pytest.approx(np.linalg.norm(nodes, axis=1))
