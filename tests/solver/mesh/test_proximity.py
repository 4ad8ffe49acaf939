"""Gaps of a surface to itself: two plates of which the distance is known."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray

from solver import Mesh
from solver.mesh.proximity import facing_gaps

Array = NDArray[np.float64]
GAP = 0.5
LOWER, UPPER = 1.0, 1.0 + GAP  # top of the lower plate, bottom of the upper one


@pytest.fixture(scope="module")
def plates(box: Callable[..., Mesh]) -> Mesh:
    """Two plates 4 x 4 x 1 mm, one above the other, with one surface all around them."""
    plate = box((2, 2, 1), size=(4.0, 4.0, 1.0))
    skin = plate.triangles(*plate.surfaces)
    count = len(plate.nodes)
    return Mesh(
        np.concatenate([plate.nodes, plate.nodes + np.array([0, 0, UPPER])]),
        np.concatenate([plate.tets, plate.tets + count]),
        {"outside": np.concatenate([skin, skin + count])},
    )


def lifting(mesh: Mesh, height: float) -> Array:
    """The upper plate moved by ``height`` along z."""
    displacement = np.zeros_like(mesh.nodes)
    displacement[mesh.nodes[:, 2] > LOWER + GAP / 2, 2] = height
    return displacement


def test_parallel_plates_are_as_far_apart_as_they_were_built(plates: Mesh) -> None:
    gaps = facing_gaps(plates, np.zeros_like(plates.nodes), "outside")
    assert gaps.distances == pytest.approx(GAP, abs=1e-9)
    facets = 2 * 8 * 4  # on each of the two facing sides eight triangles of four facets
    assert len(gaps.distances) == len(gaps.starts) == len(gaps.ends) == facets


@pytest.mark.parametrize("height", [-0.4, -0.49, 0.25, 3.0])
def test_the_distance_follows_the_displacement(plates: Mesh, height: float) -> None:
    gaps = facing_gaps(plates, lifting(plates, height), "outside")
    assert gaps.distances == pytest.approx(GAP + height, abs=1e-9)


def test_places_are_those_of_the_undeformed_body(plates: Mesh) -> None:
    gaps = facing_gaps(plates, lifting(plates, 2.0), "outside")
    pairs = np.sort(np.column_stack([gaps.starts[:, 2], gaps.ends[:, 2]]), axis=1)
    assert pairs == pytest.approx(np.broadcast_to([LOWER, UPPER], pairs.shape), abs=1e-9)
    assert gaps.starts[:, :2] == pytest.approx(gaps.ends[:, :2], abs=2.0)


def test_plates_that_run_into_each_other_have_a_negative_distance(plates: Mesh) -> None:
    gaps = facing_gaps(plates, lifting(plates, -GAP - 0.3), "outside")
    assert gaps.distances.min() < 0
    starts = gaps.starts[gaps.distances < 0][:, 2]
    assert set(np.round(starts, 9)) == {LOWER, UPPER}  # each one's face is inside the other


@pytest.mark.parametrize("depth", [0.01, 0.3])
def test_the_negative_distance_is_the_depth_of_the_overlap(plates: Mesh, depth: float) -> None:
    gaps = facing_gaps(plates, lifting(plates, -GAP - depth), "outside")
    inside = gaps.distances[gaps.distances < 0]
    assert inside == pytest.approx(-depth, abs=1e-9)


def test_plates_that_do_not_overlap_sideways_face_nothing(plates: Mesh) -> None:
    displacement = np.zeros_like(plates.nodes)
    displacement[plates.nodes[:, 2] > LOWER + GAP / 2, 0] = 50
    assert len(facing_gaps(plates, displacement, "outside").distances) == 0


def test_a_tilted_plate_is_seen_along_its_normal(plates: Mesh) -> None:
    """By 20 degrees about a line through its bottom's middle: distances fan out about the gap."""
    upper = plates.nodes[:, 2] > LOWER + GAP / 2
    pivot, angle = np.array([2.0, 2.0, 3.0]), np.radians(20)
    c, s = np.cos(angle), np.sin(angle)
    raised = plates.nodes + np.array([0, 0, 3.0 - UPPER])
    turned = (raised - pivot) @ np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]]).T + pivot
    gaps = facing_gaps(plates, np.where(upper[:, None], turned - plates.nodes, 0), "outside")
    below = gaps.starts[:, 2] == LOWER
    x = gaps.starts[below][:, 0]
    expected = 2.0 - np.tan(angle) * (x - 2.0)  # from the lower plate straight up
    assert gaps.distances[below] == pytest.approx(expected, abs=1e-9)


def test_an_unknown_surface_is_refused_by_name(plates: Mesh) -> None:
    with pytest.raises(ValueError, match="no surface is called 'inside'"):
        facing_gaps(plates, np.zeros_like(plates.nodes), "inside")
