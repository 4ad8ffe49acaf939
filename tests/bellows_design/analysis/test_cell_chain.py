"""The actuator laid out from copies of one cell."""

from __future__ import annotations

import cadquery as cq
import numpy as np
import pytest
from numpy.typing import NDArray

from bellows_design.analysis.cell_chain import chain
from bellows_design.analysis.mesh_plan import first_plan
from bellows_design.analysis.models import UNIT_CELL
from bellows_design.analysis.wall_contact import WallContact, contact_of
from bellows_design.design.design import Design
from bellows_design.design.overrides import with_overrides
from bellows_design.design.shipped import load_design
from bellows_design.geometry.actuator import half_body
from solver import Mesh, Problem, Solution, rotation

Array = NDArray[np.float64]
COUNT = 3


@pytest.fixture(scope="module")
def design() -> Design:
    return with_overrides(load_design("prototype_1"), [f"number_of_bubbles={COUNT}", "length=30"])


@pytest.fixture(scope="module")
def problem(design: Design) -> Problem:
    return UNIT_CELL.problem(design, first_plan(UNIT_CELL.solid(design), design).made())


def turned(problem: Problem, tilt: float, shift: float) -> Solution:
    """A made-up state: every section stays plane and turns in proportion to its x."""
    x, _, z = problem.mesh.nodes.T
    share = x / x.max()
    moved = [shift * share + z * np.sin(tilt * share), 0 * x, z * (np.cos(tilt * share) - 1)]
    return Solution(
        problem=problem,
        pressure=0.1,
        displacement=np.stack(moved, axis=1),
        hydrostatic_pressure=np.zeros(len(problem.mesh.vertices)),
        path=(),
        converged=True,
        message="made up",
        newton_iterations=0,
        factorizations=0,
        load_steps=0,
        refused_steps=0,
        linear_solver="none",
        negative_pivots=None,
        seconds=0.0,
        plane=(tilt, shift),
    )


def copies(points: Array) -> Array:
    """Points of all copies of the cell, (2 bubbles, nodes of a cell, 3)."""
    return points.reshape(2 * COUNT, -1, 3)


def test_at_rest_it_is_the_actuator_without_its_ends(design: Design, problem: Problem) -> None:
    bellows = design.bellows
    mesh, displacement = chain(bellows, turned(problem, 0.0, 0.0))
    assert abs(displacement).max() < 1e-12
    for number, nodes in enumerate(copies(mesh.nodes)):
        side = -1 if number % 2 == 0 else 1
        from_middle = nodes - [bellows.bubble_middles[number // 2], 0, 0]
        assert from_middle * [side, 1, 1] == pytest.approx(problem.mesh.nodes, abs=1e-12)
    solid = half_body(bellows, None)
    for name in ("outside", "symmetry"):
        faces = cq.Compound.makeCompound(solid.faces(name))
        corners = np.unique(mesh.surfaces[name][:, :3])
        for point in mesh.nodes[corners[:: len(corners) // 40]]:
            assert cq.Vertex.makeVertex(*point).distance(faces) < 1e-6, name


def test_its_surfaces_face_outwards_and_make_up_those_of_the_cells(
    design: Design, problem: Problem
) -> None:
    mesh, _ = chain(design.bellows, turned(problem, 0.0, 0.0))
    assert set(mesh.surfaces) == {"outside", "symmetry", "root", "tip"} and not len(mesh.tets)
    for name, own in (("outside", "outside"), ("symmetry", "symmetry"), ("tip", "gap_middle")):
        times = 1 if name == "tip" else 2 * COUNT
        assert len(mesh.surfaces[name]) == times * len(problem.mesh.surfaces[own])
    normal = {name: area_vector(mesh, name) for name in mesh.surfaces}
    area = 2 * COUNT * area_vector(problem.mesh, "symmetry")[1]
    assert normal["symmetry"] == pytest.approx([0, area, 0], abs=1e-9) and area < 0
    gap = area_vector(problem.mesh, "gap_middle")[0]
    assert normal["tip"] == pytest.approx([gap, 0, 0], abs=1e-9) and gap > 0
    assert normal["root"] == pytest.approx([-gap, 0, 0], abs=1e-9)
    assert normal["outside"][0] == pytest.approx(0.0, abs=1e-9)
    assert normal["outside"][1] == pytest.approx(
        2 * COUNT * area_vector(problem.mesh, "outside")[1], abs=1e-9
    )


def area_vector(mesh: Mesh, name: str) -> Array:
    """Sum of the normals of flat triangles between the corners, mm^2."""
    a, b, c = (mesh.nodes[mesh.surfaces[name][:, corner]] for corner in range(3))
    return np.cross(b - a, c - a).sum(axis=0) / 2


@pytest.mark.parametrize(("tilt", "shift"), [(0.2, 0.3), (-0.4, -0.2), (0.9, 0.0)])
def test_neighbours_share_the_nodes_of_their_common_planes(
    design: Design, problem: Problem, tilt: float, shift: float
) -> None:
    mesh, displacement = chain(design.bellows, turned(problem, tilt, shift))
    moved, cell = copies(mesh.nodes + displacement), problem.mesh
    gap, middle = cell.surface_nodes("gap_middle"), cell.surface_nodes("bubble_middle")
    for bubble in range(COUNT):
        left, right = moved[2 * bubble], moved[2 * bubble + 1]
        assert left[middle] == pytest.approx(right[middle], abs=1e-9)
        if bubble:
            assert left[gap] == pytest.approx(moved[2 * bubble - 1][gap], abs=1e-9)


@pytest.mark.parametrize("tilt", [0.1, -0.4, 1.3])
def test_the_last_plane_is_turned_by_twice_the_tilt_for_every_bubble(
    design: Design, problem: Problem, tilt: float
) -> None:
    mesh, displacement = chain(design.bellows, turned(problem, tilt, 0.1))
    ends = [mesh.surface_nodes(name) for name in ("root", "tip")]
    assert abs(displacement[ends[0]]).max() < 1e-12  # the root stays
    total = COUNT * 2 * tilt
    lowest, highest = (ends[1][pick(mesh.nodes[ends[1], 2])] for pick in (np.argmin, np.argmax))
    upright = (mesh.nodes + displacement)[highest] - (mesh.nodes + displacement)[lowest]
    height = mesh.nodes[highest, 2] - mesh.nodes[lowest, 2]
    assert upright[[0, 2]] == pytest.approx(
        height * np.array([np.sin(total), np.cos(total)]), abs=1e-9
    )
    assert rotation(mesh, displacement) == pytest.approx(np.degrees(total), abs=1e-6)


def test_the_middles_of_bubbles_lie_on_an_arc(design: Design, problem: Problem) -> None:
    """Chords of one length, each turned by twice the tilt against the one before."""
    tilt, shift = 0.3, 0.2
    mesh, displacement = chain(design.bellows, turned(problem, tilt, shift))
    bottom = np.flatnonzero((abs(problem.mesh.nodes) < 1e-9).all(axis=1))
    places = copies(mesh.nodes + displacement)[1::2, bottom, :][:, 0, [0, 2]]
    chords = np.diff(places, axis=0)
    assert np.hypot(*chords.T) == pytest.approx(
        2 * (design.bellows.pitch / 2 + shift) * np.cos(tilt), abs=1e-9
    )
    angles = -np.arctan2(chords[:, 1], chords[:, 0])
    assert angles == pytest.approx(2 * tilt * np.arange(1, COUNT), abs=1e-9)


def test_contact_is_seen_in_the_chain(design: Design, problem: Problem) -> None:
    """Bent away from the bubbles their gaps open; bent towards them they meet."""
    gap = design.bellows.bubble_distance

    def contact(tilt: float) -> WallContact:
        return contact_of(design.bellows, *chain(design.bellows, turned(problem, tilt, 0.0)))

    still, opened, closed = contact(0.0), contact(0.1), contact(-0.2)
    assert not still.detected and not still.overlaps_itself
    assert still.min_gap_mm == pytest.approx(gap, abs=1e-6)
    assert not opened.detected
    assert opened.min_gap_mm is not None and opened.min_gap_mm > gap
    assert closed.detected
