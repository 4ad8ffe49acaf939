"""A mesh cut at a plane fills the same place, and its displacements stay what they are."""

from __future__ import annotations

import cadquery as cq
import numpy as np
import pytest
from closed_surfaces import volume_of_cells

from bellows_design.deformed.joined.cutting import SECTION, cut
from bellows_design.geometry.named_solids import named
from solver import Mesh
from solver.mesh.mid_nodes import jacobian_ratios
from solver.meshing import MeshOptions

RADIUS, AT = 5.0, 1.3


@pytest.fixture(scope="module")
def ball() -> Mesh:
    """A ball about the origin: all its outer elements are curved."""
    solid = cq.Solid.makeSphere(RADIUS, angleDegrees1=-90, angleDegrees2=90)
    return named(solid, "outside").meshed(MeshOptions(size=1.8), 60.0)


def test_the_pieces_have_the_volume_of_the_whole(ball: Mesh) -> None:
    pieces = [piece.mesh for piece in cut(ball, AT)]
    volumes = [volume_of_cells(piece, piece.nodes) for piece in pieces]
    whole = volume_of_cells(ball, ball.nodes)  # by a rule that is not exact in curved elements
    assert sum(volumes) == pytest.approx(whole, rel=1e-6)
    height = RADIUS - AT
    cap = np.pi * height**2 * (3 * RADIUS - height) / 3
    assert volumes[1] == pytest.approx(cap, rel=2e-3)


def test_no_element_of_a_piece_is_folded(ball: Mesh) -> None:
    assert all(jacobian_ratios(p.mesh.nodes, p.mesh.tets).min() > 0 for p in cut(ball, AT))


def test_the_section_lies_in_the_plane_and_closes_the_piece(ball: Mesh) -> None:
    for piece, side in zip(cut(ball, AT), (-1, 1), strict=True):
        mesh = piece.mesh
        assert mesh.boundary_surfaces == {"outside", SECTION}
        assert len(mesh.outer_faces) == sum(map(len, mesh.surfaces.values()))
        corners = mesh.nodes[np.unique(mesh.surfaces[SECTION][:, :3])]
        assert corners[:, 0] == pytest.approx(AT, abs=1e-3 * ball.edge)
        assert (side * (mesh.nodes[:, 0] - AT) > -0.05).all()


def test_a_quadratic_field_is_kept_exactly(ball: Mesh) -> None:
    """In straight elements; the whole and its pieces have the same quadratic map."""
    straight = ball.nodes.copy()
    for middle, (a, b) in enumerate(((0, 1), (1, 2), (0, 2), (0, 3), (2, 3), (1, 3)), start=4):
        straight[ball.tets[:, middle]] = straight[ball.tets[:, [a, b]]].mean(axis=1)
    mesh = ball.moved(straight)

    def field(nodes: np.ndarray) -> np.ndarray:
        x, y, z = nodes.T
        return np.stack([x * y - z**2, 1 + y * z, x**2 + 3 * y], axis=1)

    for piece in cut(mesh, AT):
        assert piece.positions @ field(straight) == pytest.approx(
            field(piece.mesh.nodes), abs=1e-12
        )


def test_values_keep_their_bounds_and_a_constant(ball: Mesh) -> None:
    random = np.random.default_rng(3).uniform(1, 2, len(ball.nodes))
    for piece in cut(ball, AT):
        assert piece.values @ np.ones(len(ball.nodes)) == pytest.approx(1)
        assert piece.positions @ np.ones(len(ball.nodes)) == pytest.approx(1)
        values = piece.values @ random
        assert values.min() >= random.min() and values.max() <= random.max()


def test_a_plane_through_nodes_makes_no_needles(ball: Mesh) -> None:
    """A node a hair off the plane counts as on it."""
    x = float(ball.nodes[ball.tets[len(ball.tets) // 2, 0], 0]) + 1e-7
    for piece in cut(ball, x):
        assert piece.mesh.boundary_surfaces == {"outside", SECTION}
        mesh = piece.mesh
        corners = mesh.nodes[mesh.tets[:, :4]]
        volumes = np.linalg.det(corners[:, 1:] - corners[:, :1]) / 6
        assert volumes.min() > 1e-9 * ball.edge**3


def test_a_plane_on_a_face_takes_no_section_from_it() -> None:
    """A step whose riser lies in the plane: only what is behind the riser was cut."""
    step = (
        cq.Workplane()
        .box(4, 2, 4, centered=False)
        .union(cq.Workplane().box(8, 2, 2, centered=False))
    )
    mesh = named(step.val(), "outside").meshed(MeshOptions(size=1.0), 60.0)
    first, second = (piece.mesh for piece in cut(mesh, 4.0, "end"))
    for piece, outside in ((first, 2 * 16 + 3 * 8 + 4), (second, 4 * 8 + 4)):
        assert piece.boundary_surfaces == {"outside", "end"}
        assert area(piece, "end") == pytest.approx(4, rel=1e-4)
        assert area(piece, "outside") == pytest.approx(outside, rel=1e-4)


def area(mesh: Mesh, name: str) -> float:
    """Of the flat triangles on the corners of a surface, mm²."""
    a, b, c = (mesh.nodes[mesh.surfaces[name][:, corner]] for corner in range(3))
    return float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2)
