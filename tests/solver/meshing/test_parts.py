"""One mesh of several solids that touch, against the solids."""

from __future__ import annotations

from collections import Counter
from io import BytesIO
from pathlib import Path

import cadquery as cq
import numpy as np
import pytest
from numpy.typing import NDArray

from solver import Mesh, Ogden, Problem, Supports, reaction, solve
from solver.errors import MeshingError
from solver.mesh.elements import tetrahedron_rule, triangle_rule
from solver.mesh.mid_nodes import SMALLEST_RATIO, jacobian_ratios
from solver.meshing import MeshOptions, Part, SizeField, mesh_solids

Array = NDArray[np.float64]
Triangles = NDArray[np.int32]

COARSE = MeshOptions(2.0, 0)
SIDES = {"x": 0, "y": 1, "z": 2}


def box(size: tuple[float, float, float], corner: tuple[float, float, float]) -> cq.Shape:
    return cq.Solid.makeBox(*size, cq.Vector(*corner))


def brep(solid: cq.Shape) -> bytes:
    content = BytesIO()
    solid.exportBrep(content)
    return content.getvalue()


def side_of(face: cq.Face) -> str:
    """The side of a box: x0 to z1, by the face's outward normal."""
    normal = face.normalAt().toTuple()
    axis = int(np.abs(normal).argmax())
    return f"{'xyz'[axis]}{int(normal[axis] > 0)}"


def part(name: str, solid: cq.Shape, size: float | None = None) -> Part:
    names = [f"{name} {side_of(face)}" for face in solid.Faces()]
    return Part(name, brep(solid), names, size)


def skin_part(name: str, solid: cq.Shape, surface: str = "skin") -> Part:
    return Part(name, brep(solid), [surface] * len(solid.Faces()))


def area_vectors(mesh: Mesh, triangles: Triangles) -> tuple[Array, Array]:
    """Points (k, q, 3) and weighted normals (k, q, 3) of curved triangles."""
    rule = triangle_rule()
    points = np.einsum("qa,kai->kqi", rule.quadratic, mesh.nodes[triangles])
    along = np.einsum("qad,kai->dkqi", rule.gradients, mesh.nodes[triangles])
    return points, np.cross(along[0], along[1]) * rule.weights[:, None]


def area(mesh: Mesh, name: str) -> float:
    return float(np.linalg.norm(area_vectors(mesh, mesh.triangles(name))[1], axis=2).sum())


def enclosed(mesh: Mesh, triangles: Triangles) -> float:
    """Volume by the divergence theorem; exact for curved triangles."""
    points, normals = area_vectors(mesh, triangles)
    return float(np.einsum("kqi,kqi->", points, normals) / 3)


def volume(mesh: Mesh, region: str) -> float:
    rule = tetrahedron_rule()
    corners = mesh.nodes[mesh.tets[mesh.regions[region]]]
    jacobians = np.linalg.det(np.einsum("qad,kai->kqdi", rule.gradients, corners))
    return float((jacobians * rule.weights).sum())


def outer_names(mesh: Mesh) -> list[str]:
    return [name for name in mesh.surfaces if "|" not in name]


def check_outside_is_watertight(mesh: Mesh) -> None:
    """The outer surfaces are exactly the faces of one tetrahedron, and close around it all."""
    faces = mesh.tets[:, [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]]].reshape(-1, 3)
    uses = Counter(map(tuple, np.sort(faces, axis=1).tolist()))
    outside = mesh.triangles(*outer_names(mesh))
    rows = list(map(tuple, np.sort(outside[:, :3], axis=1).tolist()))
    assert len(set(rows)) == len(rows)
    assert set(rows) == {face for face, count in uses.items() if count == 1}
    _, normals = area_vectors(mesh, outside)
    assert normals.sum(axis=(0, 1)) == pytest.approx(np.zeros(3), abs=1e-8)
    whole = sum(volume(mesh, region) for region in mesh.regions)
    assert enclosed(mesh, outside) == pytest.approx(whole, rel=1e-9)


def check_regions_share_the_elements(mesh: Mesh) -> None:
    numbers = np.concatenate(list(mesh.regions.values()))
    assert np.array_equal(np.sort(numbers), np.arange(len(mesh.tets)))
    assert np.array_equal(np.unique(mesh.tets), np.arange(len(mesh.nodes)))


def test_two_boxes_share_the_nodes_of_the_piece_where_they_touch() -> None:
    """A 6 x 4 x 3 below, a smaller 4 x 4 x 2 on it: the common piece is 4 x 3."""
    low, high = box((6, 4, 3), (0, 0, 0)), box((4, 4, 2), (1, 1, 3))
    mesh = mesh_solids([part("low", low), part("high", high)], COARSE)
    check_regions_share_the_elements(mesh)
    check_outside_is_watertight(mesh)
    assert volume(mesh, "low") == pytest.approx(72, rel=1e-9)
    assert volume(mesh, "high") == pytest.approx(32, rel=1e-9)
    assert area(mesh, "low|high") == pytest.approx(12, rel=1e-9)
    assert area(mesh, "low z1") == pytest.approx(24 - 12, rel=1e-9)
    assert area(mesh, "high z0") == pytest.approx(16 - 12, rel=1e-9)
    assert area(mesh, "low z0") == pytest.approx(24, rel=1e-9)
    shared = np.intersect1d(*(mesh.tets[mesh.regions[name]] for name in ("low", "high")))
    assert np.array_equal(shared, mesh.surface_nodes("low|high"))


@pytest.mark.parametrize("order", [("low", "high"), ("high", "low")])
def test_a_common_surface_points_out_of_the_first_part(order: tuple[str, str]) -> None:
    boxes = {"low": box((4, 4, 2), (0, 0, 0)), "high": box((4, 4, 2), (0, 0, 2))}
    mesh = mesh_solids([part(name, boxes[name]) for name in order], COARSE)
    _, normals = area_vectors(mesh, mesh.triangles("|".join(order)))
    up = 1 if order[0] == "low" else -1
    assert normals.sum(axis=(0, 1)) == pytest.approx([0, 0, up * 16], abs=1e-9)
    assert not len(mesh.triangles("low z1")) and not len(mesh.triangles("high z0"))


def test_faces_of_one_name_make_one_surface_across_three_layers() -> None:
    layers = [box((5, 4, h), (0, 0, z)) for h, z in ((1, 0), (0.5, 1), (2, 1.5))]
    parts = [
        Part(name, brep(solid), [side_of(face) for face in solid.Faces()])
        for name, solid in zip(("a", "b", "c"), layers, strict=True)
    ]
    mesh = mesh_solids(parts, COARSE)
    check_regions_share_the_elements(mesh)
    check_outside_is_watertight(mesh)
    assert set(mesh.surfaces) == {"x0", "x1", "y0", "y1", "z0", "z1", "a|b", "b|c"}
    assert area(mesh, "x1") == pytest.approx(4 * 3.5, rel=1e-9)
    assert [area(mesh, name) for name in ("z0", "b|c")] == pytest.approx([20, 20], rel=1e-9)


def channelled_block() -> cq.Shape:
    """10 x 10 x 4 with a chamber 8 x 8 x 2 open below, and a tunnel 2 x 2 through x = 0."""
    block = box((10, 10, 4), (0, 0, 0))
    return block.cut(box((8, 8, 2), (1, 1, 0)), box((1, 2, 2), (0, 4, 0))).Solids()[0]


def closed_by_a_film(film_size: float | None = None) -> Mesh:
    block = channelled_block()
    names = []
    for face in block.Faces():
        x, y, z = face.Center().toTuple()
        inside = 1e-6 < x < 10 - 1e-6 and 1e-6 < y < 10 - 1e-6 and 1e-6 < z < 4 - 1e-6
        names.append("chamber" if inside else f"block {side_of(face)}")
    film = box((10, 10, 0.5), (0, 0, -0.5))
    return mesh_solids([Part("block", brep(block), names), part("film", film, film_size)], COARSE)


def test_a_film_closes_chambers_and_tunnels() -> None:
    mesh = closed_by_a_film()
    check_regions_share_the_elements(mesh)
    check_outside_is_watertight(mesh)
    open_below = 8 * 8 + 1 * 2
    assert volume(mesh, "block") == pytest.approx(400 - 2 * open_below, rel=1e-9)
    assert volume(mesh, "film") == pytest.approx(50, rel=1e-9)
    assert area(mesh, "block|film") == pytest.approx(100 - open_below, rel=1e-9)
    assert area(mesh, "film z1") == pytest.approx(open_below, rel=1e-9)
    assert len(mesh.triangles("block z0")) == 0


def test_walls_of_a_cavity_of_two_parts_enclose_its_volume() -> None:
    """The chamber's walls, the tunnel's, and the film under both; the mouth in x = 0 is open."""
    mesh = closed_by_a_film()
    points, normals = area_vectors(mesh, mesh.triangles("chamber", "film z1"))
    mouth = -normals.sum(axis=(0, 1))
    assert mouth == pytest.approx([4, 0, 0], abs=1e-9)  # out of the solid at the mouth's place
    assert -np.einsum("kqi,kqi->", points, normals) / 3 == pytest.approx(132, rel=1e-9)


def test_a_part_can_be_finer_than_the_others() -> None:
    coarse, fine = closed_by_a_film(), closed_by_a_film(1.0)
    counts = [{name: len(mesh.regions[name]) for name in mesh.regions} for mesh in (coarse, fine)]
    assert counts[1]["film"] > 2 * counts[0]["film"]
    assert counts[1]["block"] < 3 * counts[0]["block"]
    check_outside_is_watertight(fine)


def ball_in_a_box() -> list[Part]:
    block = box((10, 10, 10), (-5, -5, -5))
    ball = cq.Solid.makeSphere(3.0, angleDegrees1=-90)
    return [skin_part("block", block.cut(ball).Solids()[0], "wall"), skin_part("ball", ball)]


def test_curved_elements_agree_on_the_interface_of_a_ball_in_a_box() -> None:
    mesh = mesh_solids(ball_in_a_box(), MeshOptions(2.5, 8))
    check_regions_share_the_elements(mesh)
    check_outside_is_watertight(mesh)
    around = np.linalg.norm(mesh.nodes[mesh.surface_nodes("block|ball")], axis=1)
    assert around == pytest.approx(3.0, abs=1e-6)
    assert volume(mesh, "ball") == pytest.approx(36 * np.pi, rel=3e-3)
    whole = volume(mesh, "ball") + volume(mesh, "block")
    assert whole == pytest.approx(1000, rel=1e-12)  # nothing lost between both
    assert enclosed(mesh, mesh.triangles("block|ball")) == pytest.approx(-volume(mesh, "ball"))
    assert len(mesh.triangles("skin")) == 0


def test_mid_nodes_that_were_moved_back_agree_on_the_interface() -> None:
    """A wall of 0.2 mm around a core, meshed coarsely: without moving them, elements fold."""
    core = cq.Solid.makeCylinder(2.8, 12.0)
    wall = cq.Solid.makeCylinder(3.0, 12.0).cut(core).Solids()[0]
    mesh = mesh_solids([skin_part("wall", wall), skin_part("core", core)], MeshOptions(3.0, 0))
    middles = np.setdiff1d(mesh.surface_nodes("wall|core"), mesh.tets[:, :4])
    radii = np.linalg.norm(mesh.nodes[middles][:, :2], axis=1)
    assert (radii < 2.8 - 1e-3).any()  # some were moved
    assert jacobian_ratios(mesh.nodes, mesh.tets).min() >= SMALLEST_RATIO
    check_outside_is_watertight(mesh)
    for name in mesh.regions:
        assert np.isin(mesh.surfaces["wall|core"], mesh.tets[mesh.regions[name]]).all()


def test_a_field_of_sizes_refines_across_parts() -> None:
    parts = [part("low", box((6, 6, 3), (0, 0, 0))), part("high", box((6, 6, 3), (0, 0, 3)))]
    coarse = mesh_solids(parts, COARSE)
    wanted = np.where(coarse.nodes[:, 0] < 2, 0.6, 2.0)
    fine = mesh_solids(parts, MeshOptions(2.0, 0, field=SizeField(coarse, wanted)))
    check_outside_is_watertight(fine)
    for name in ("low", "high"):
        centres = fine.nodes[fine.tets[fine.regions[name], :4]].mean(axis=1)
        assert (centres[:, 0] < 2).sum() > 3 * (centres[:, 0] > 4).sum()


def test_two_equal_runs_give_equal_meshes() -> None:
    one, two = (mesh_solids(ball_in_a_box(), MeshOptions(2.5, 4)) for _ in range(2))
    assert np.array_equal(one.nodes, two.nodes) and np.array_equal(one.tets, two.tets)
    for name, triangles in one.surfaces.items():
        assert np.array_equal(two.surfaces[name], triangles)


def test_two_solids_of_a_step_file_make_one_mesh(tmp_path: Path) -> None:
    path = str(tmp_path / "pair.step")
    pair = cq.Compound.makeCompound([box((4, 4, 2), (0, 0, 0)), box((4, 4, 1), (0, 0, 2))])
    cq.exporters.export(cq.Workplane(pair), path)
    solids = cq.importers.importStep(path).solids().vals()
    mesh = mesh_solids([part(f"body {k}", solid) for k, solid in enumerate(solids)], COARSE)
    assert [volume(mesh, name) for name in mesh.regions] == pytest.approx([32, 16], rel=1e-9)
    assert area(mesh, "body 0|body 1") == pytest.approx(16, rel=1e-9)
    check_outside_is_watertight(mesh)


def test_one_part_is_a_mesh_with_one_region(tmp_path: Path) -> None:
    path = tmp_path / "box.brep"
    path.write_bytes(brep(box((3, 3, 3), (0, 0, 0))))
    mesh = mesh_solids([Part("all", path, ["skin"] * 6)], COARSE)
    assert set(mesh.surfaces) == {"skin"} and set(mesh.regions) == {"all"}
    check_outside_is_watertight(mesh)


def test_meshed_layers_bear_what_each_would_alone() -> None:
    """Stretched to 1.5 times along the layers: homogeneous if both are incompressible."""
    solids = {"soft": box((8, 1, 0.6), (0, 0, 0)), "stiff": box((8, 1, 0.4), (0, 0, 0.6))}
    parts = [
        Part(name, brep(solid), [side_of(face) for face in solid.Faces()])
        for name, solid in solids.items()
    ]

    def motion(positions: Array, load: float) -> Array:
        free = np.full(len(positions), np.nan)
        return np.stack([load * 0.5 * positions[:, 0], free, free], axis=1)

    supports = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2}, prescribed={"x1": motion})
    soft, stiff = Ogden.neo_hooke(1.0), Ogden.neo_hooke(30.0)
    mesh = mesh_solids(parts, COARSE)
    solution = solve(Problem(mesh, soft, supports, materials={"stiff": stiff}))
    assert solution.converged, solution.message
    expected = (1.0 * 0.6 + 30.0 * 0.4) * (1.5 - 1.5**-2)
    assert reaction(solution, "x1").force[0] == pytest.approx(expected, rel=1e-6)


@pytest.mark.parametrize("gap", [8e-6, -8e-6])
def test_parts_touch_as_exactly_as_cad_files_are_written(gap: float) -> None:
    boxes = box((4, 4, 2), (0, 0, 0)), box((3, 3, 1), (0.5, 0.5, 2 + gap))
    mesh = mesh_solids([part(str(k), solid) for k, solid in enumerate(boxes)], COARSE)
    assert area(mesh, "0|1") == pytest.approx(9, rel=1e-5)
    check_outside_is_watertight(mesh)


def test_a_film_much_thinner_than_its_elements_is_meshed() -> None:
    """0.1 mm under edges of 2 mm, between two blocks: no better elements are possible there."""
    layers = {"low": (0, 3), "film": (3, 0.1), "high": (3.1, 3)}
    parts = [part(name, box((16, 12, h), (0, 0, z))) for name, (z, h) in layers.items()]
    mesh = mesh_solids(parts, COARSE)
    assert volume(mesh, "film") == pytest.approx(16 * 12 * 0.1, rel=1e-9)
    assert jacobian_ratios(mesh.nodes, mesh.tets).min() >= SMALLEST_RATIO
    check_outside_is_watertight(mesh)


CUBE = box((2, 2, 2), (0, 0, 0))


@pytest.mark.parametrize(
    ("solids", "words"),
    [
        ([CUBE, box((2, 2, 2), (1, 0, 0))], "'0' and '1' overlap in 4 mm"),
        ([CUBE, box((1, 1, 1), (0.5, 0.5, 0.5))], "'0' and '1' overlap in 1 mm"),
        ([CUBE, box((2, 2, 2), (2.001, 0, 0))], "no face of the part '1' touches '0'"),
        ([CUBE, box((2, 2, 2), (2, 2, 0))], "no face of the part '1' touches '0'"),  # an edge
        (
            [
                CUBE,
                box((2, 2, 2), (2, 0, 0)),
                box((2, 2, 2), (9, 0, 0)),
                box((2, 2, 2), (11, 0, 0)),
            ],
            "no face of the part '2' touches '0' or '1'",
        ),
    ],
)
def test_parts_that_overlap_or_lie_apart_are_refused(solids: list[cq.Shape], words: str) -> None:
    with pytest.raises(MeshingError, match=words):
        mesh_solids([part(str(k), solid) for k, solid in enumerate(solids)], COARSE)


def test_a_part_of_two_solids_is_refused() -> None:
    pair = cq.Compound.makeCompound([CUBE, box((2, 2, 2), (3, 0, 0))])
    with pytest.raises(MeshingError, match=r"^part 'pair': the CAD file holds 2 solids"):
        mesh_solids([Part("pair", brep(pair), ["skin"] * 12)])


def test_parts_that_cannot_be_told_apart_are_refused() -> None:
    with pytest.raises(ValueError, match=r"^mesh: two parts are called 'a'"):
        mesh_solids([part("a", CUBE), part("a", box((2, 2, 2), (2, 0, 0)))])
    with pytest.raises(ValueError, match=r"^mesh: parts must have at least one Part"):
        mesh_solids([])


@pytest.mark.parametrize(
    ("name", "faces", "words"),
    [
        ("a|b", ["skin"] * 6, "^part 'a|b': the name 'a|b' must not have a '|'"),
        ("a", ["left|right"] * 6, r"the name 'left\|right' must not have a '\|'"),
        ("", ["skin"] * 6, "^part: name must be a text"),
    ],
)
def test_names_that_mean_something_else_are_refused(
    name: str, faces: list[str], words: str
) -> None:
    with pytest.raises(ValueError, match=words):
        Part(name, brep(CUBE), faces)


def test_a_wrong_number_of_names_is_refused_with_the_part() -> None:
    other = Part("b", brep(box((2, 2, 2), (2, 0, 0))), ["skin"] * 5)
    with pytest.raises(ValueError, match=r"^part 'b': 5 names for 6 faces of the solid\.$"):
        mesh_solids([part("a", CUBE), other])


@pytest.mark.parametrize("size", [0.0, -1.0, float("nan"), float("inf")])
def test_a_size_of_a_part_must_be_a_length(size: float) -> None:
    with pytest.raises(ValueError, match=r"^part 'a': size = .* must be finite and above 0"):
        part("a", CUBE, size)


def test_a_size_of_a_part_below_the_smallest_is_refused() -> None:
    with pytest.raises(ValueError, match=r"at least the options' smallest_size = 0\.1 mm"):
        mesh_solids([part("a", CUBE, 0.05)])
