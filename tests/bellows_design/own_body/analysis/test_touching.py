"""Walls of an own body that touch under a vacuum, where nothing keeps them apart."""

from __future__ import annotations

import numpy as np
import pytest
from own_body.bodies import bar, box, part

from bellows_design.own_body.analysis.evaluate import evaluate
from bellows_design.own_body.analysis.touching import IMAGES, WALLS, touching
from solver.mesh.mesh import Mesh


@pytest.mark.thorough
def test_the_path_ends_where_a_slit_closes() -> None:
    """The walls above and below are plates over a slit of 0.2 mm."""
    slit = box(20, 5, 4).cut(box(14, 4, 0.2, at=(3, 0, 1.9))).Solids()[0]
    body = bar(parts=[part(slit)], load={"pressure": -0.0003}, mesh={"size": 3.0})
    found = evaluate(body, meshes=1)
    assert not found.converged and found.touch_pressure_mpa == found.pressure_mpa
    assert -0.0003 < found.pressure_mpa < 0
    assert 0 < (found.end.cavity_volume_mm3 or 0) < 14 * 8 * 0.2 / 2  # it closes in its middle
    assert found.contact.min_gap_mm == pytest.approx(0, abs=0.1)
    assert f"{WALLS} touch" in found.message
    assert not found.error_estimate.bending_angle_percent


def test_a_wall_that_passes_a_plane_of_symmetry_touches_its_image() -> None:
    body = bar()
    nodes = np.array([[0, 0, 0], [4, 0, 0], [0, 4, 0], [0, 0, 4.0]])
    corners = np.vstack([nodes, [(nodes[a] + nodes[b]) / 2 for a, b in EDGES]])
    faces = {name: np.array([face], np.int32) for name, face in FACES.items()}
    mesh = Mesh(corners, np.arange(10, dtype=np.int32)[None], faces)
    still = np.zeros(corners.shape)
    assert touching(body, mesh, still) == ()
    pulled = still.copy()
    pulled[2, 1] = -4.5  # the corner that is off the plane
    assert IMAGES in touching(body, mesh, pulled)


EDGES = ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))

FACES = {
    "middle": (0, 1, 3, 4, 8, 7),
    "outside": (1, 2, 3, 5, 9, 8),
}
