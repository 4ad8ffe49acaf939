"""Meshes against the solids they stand for."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from pathlib import Path

import cadquery as cq
import numpy as np
import pytest
from numpy.typing import NDArray

from solver import Mesh
from solver.errors import MeshingError
from solver.mesh.elements import triangle_rule
from solver.mesh.mid_nodes import SMALLEST_RATIO, jacobian_ratios
from solver.meshing import solid
from solver.meshing.solid import MeshOptions, mesh_solid

Array = NDArray[np.float64]
COARSE, FINE = MeshOptions(size=1.4, elements_per_circle=0), MeshOptions(0.7, 0)
"""Below a tenth of the solids' diagonals: Gmsh by itself goes no coarser."""

BORE = 2.0


def ball() -> cq.Shape:
    return cq.Solid.makeSphere(5.0, angleDegrees1=-90)


def bored_block() -> cq.Shape:
    """A block 10 x 8 x 6 with a bore of 2 mm radius along z and a closed ball inside."""
    block = cq.Solid.makeBox(10, 8, 6)
    bore = cq.Solid.makeCylinder(BORE, 6, cq.Vector(3, 4, 0))
    void = cq.Solid.makeSphere(1.5, angleDegrees1=-90).moved(cq.Location(cq.Vector(7.5, 4, 3)))
    return block.cut(bore, void).Solids()[0]


def name_of(face: cq.Face) -> str:
    return {"CYLINDER": "bore", "SPHERE": "void"}.get(
        face.geomType(), "left" if abs(face.Center().x) < 1e-9 else "side"
    )


def meshed(folder: Path, solid: cq.Shape, options: MeshOptions) -> Mesh:
    brep = folder / "solid.brep"
    solid.exportBrep(str(brep))
    return mesh_solid(brep, [name_of(face) for face in solid.Faces()], options)


@pytest.fixture(scope="module")
def block(tmp_path_factory: pytest.TempPathFactory) -> Mesh:
    return meshed(tmp_path_factory.mktemp("block"), bored_block(), MeshOptions(2.0, 8))


def area_vectors(mesh: Mesh, *names: str) -> tuple[Array, Array]:
    """Points (k, q, 3) and weighted normals (k, q, 3) of curved triangles."""
    rule = triangle_rule()
    corners = mesh.nodes[mesh.triangles(*names)]
    points = np.einsum("qa,kai->kqi", rule.quadratic, corners)
    along_r, along_s = np.moveaxis(np.einsum("qad,kai->dkqi", rule.gradients, corners), 0, 0)
    return points, np.cross(along_r, along_s) * rule.weights[:, None]


def area(mesh: Mesh, *names: str) -> float:
    return float(np.linalg.norm(area_vectors(mesh, *names)[1], axis=2).sum())


def enclosed(mesh: Mesh, *names: str) -> float:
    """Volume by the divergence theorem; exact for curved triangles."""
    points, normals = area_vectors(mesh, *names)
    return float(np.einsum("kqi,kqi->", points, normals) / 3)


@pytest.mark.parametrize("build", [ball, bored_block])
def test_volume_and_area_approach_the_solids_under_refinement(
    build: Callable[[], cq.Shape], tmp_path: Path
) -> None:
    solid = build()
    meshes = [meshed(tmp_path, solid, options) for options in (COARSE, FINE)]
    errors = [abs(enclosed(mesh, *mesh.surfaces) / solid.Volume() - 1) for mesh in meshes]
    skins = [abs(area(mesh, *mesh.surfaces) / solid.Area() - 1) for mesh in meshes]
    assert errors[1] < errors[0] / 5 and errors[1] < 1e-3
    assert skins[1] < skins[0] / 5 and skins[1] < 1e-3


def test_named_surfaces_have_the_areas_of_the_named_faces(block: Mesh) -> None:
    assert set(block.surfaces) == {"left", "side", "bore", "void"}
    assert area(block, "left") == pytest.approx(8 * 6, rel=1e-9)
    assert area(block, "bore") == pytest.approx(2 * np.pi * BORE * 6, rel=2e-3)
    assert area(block, "void") == pytest.approx(4 * np.pi * 1.5**2, rel=5e-3)


def test_surfaces_partition_the_boundary(block: Mesh) -> None:
    faces = [block.tets[:, corners] for corners in ([1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1])]
    uses = Counter(map(tuple, np.sort(np.concatenate(faces), axis=1).tolist()))
    assert set(uses.values()) == {1, 2}
    boundary = {face for face, count in uses.items() if count == 1}
    named = [tuple(row) for row in np.sort(block.triangles(*block.surfaces)[:, :3]).tolist()]
    assert len(named) == len(set(named))
    assert set(named) == boundary


def test_middle_nodes_of_surfaces_are_those_of_the_elements(block: Mesh) -> None:
    triangles = block.triangles(*block.surfaces)
    pairs = {
        (frozenset(tet[list(edge)].tolist()), tet[4 + place])
        for tet in block.tets
        for place, edge in enumerate(((0, 1), (1, 2), (0, 2), (0, 3), (2, 3), (1, 3)))
    }
    for place, edge in enumerate(((0, 1), (1, 2), (2, 0))):
        for row in triangles:
            assert (frozenset(row[list(edge)].tolist()), row[3 + place]) in pairs


def test_normals_point_out_of_the_solid(block: Mesh) -> None:
    points, normals = area_vectors(block, *block.surfaces)
    assert normals.sum(axis=(0, 1)) == pytest.approx(np.zeros(3), abs=1e-9)  # closed
    points, normals = area_vectors(block, "void")
    towards_its_centre = np.einsum("kqi,kqi->kq", points - [7.5, 4, 3], normals)
    assert (towards_its_centre < 0).all()  # out of the solid is into the void
    assert (area_vectors(block, "left")[1][..., 0] < 0).all()
    assert enclosed(block, "void") < 0 < enclosed(block, *block.surfaces)


def test_middle_nodes_lie_on_the_curved_faces(block: Mesh) -> None:
    around = np.linalg.norm(block.nodes[block.surface_nodes("bore")][:, :2] - [3, 4], axis=1)
    assert around == pytest.approx(BORE, abs=1e-6)
    about = np.linalg.norm(block.nodes[block.surface_nodes("void")] - [7.5, 4, 3], axis=1)
    assert about == pytest.approx(1.5, abs=1e-6)


def test_no_element_is_folded_and_every_node_is_used(block: Mesh) -> None:
    assert jacobian_ratios(block.nodes, block.tets).min() >= SMALLEST_RATIO
    assert np.array_equal(np.unique(block.tets), np.arange(len(block.nodes)))


@pytest.mark.parametrize("folded", [1, 2, 3])
def test_a_folded_mesh_is_made_again_a_little_finer(
    folded: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Whether an element folds is chance; another mesh of the same solid has none."""
    tried: list[int] = []

    def unlucky(nodes: Array, tets: NDArray[np.int32]) -> str:
        tried.append(len(tets))
        return "every mesh has a folded element." if len(tried) <= folded else ""

    monkeypatch.setattr(solid, "_folded_element", unlucky)
    if folded == 3:
        with pytest.raises(MeshingError, match="every mesh has a folded element"):
            meshed(tmp_path, ball(), COARSE)
    else:
        assert len(meshed(tmp_path, ball(), COARSE).tets) == tried[-1]
    assert len(set(tried)) == len(tried) == min(folded + 1, 3)


@pytest.mark.parametrize("size", [2.0, 4.0])
def test_elements_larger_than_a_wall_are_straightened_or_refused(
    size: float, tmp_path: Path
) -> None:
    """A tube with a wall of 0.2 mm: middle nodes on one side fold elements of the other."""
    tube = cq.Solid.makeCylinder(3.0, 40.0).cut(cq.Solid.makeCylinder(2.8, 40.0)).Solids()[0]
    try:
        mesh = meshed(tmp_path, tube, MeshOptions(size, elements_per_circle=0))
    except MeshingError as refusal:
        assert "mesh" in str(refusal)
    else:
        assert jacobian_ratios(mesh.nodes, mesh.tets).min() >= SMALLEST_RATIO


def test_two_equal_runs_give_equal_meshes(block: Mesh, tmp_path: Path) -> None:
    again = meshed(tmp_path, bored_block(), MeshOptions(2.0, 8))
    assert np.array_equal(again.nodes, block.nodes)
    assert np.array_equal(again.tets, block.tets)
    for name, triangles in block.surfaces.items():
        assert np.array_equal(again.surfaces[name], triangles)


def test_curved_faces_are_refined_as_asked(tmp_path: Path) -> None:
    coarse, fine = (meshed(tmp_path, bored_block(), MeshOptions(4.0, count)) for count in (0, 16))
    assert len(fine.triangles("bore")) > 2 * len(coarse.triangles("bore"))
    assert len(fine.triangles("left")) < 2 * len(coarse.triangles("left")) + 10


@pytest.mark.parametrize("count", [0, 7, 9])
def test_a_wrong_number_of_names_is_refused(count: int, tmp_path: Path) -> None:
    brep = tmp_path / "solid.brep"
    bored_block().exportBrep(str(brep))
    with pytest.raises(ValueError, match=f"^mesh: {count} names for 8 faces of the solid"):
        mesh_solid(brep, ["side"] * count)


def test_two_solids_are_refused(tmp_path: Path) -> None:
    pair = cq.Compound.makeCompound(
        [cq.Solid.makeBox(1, 1, 1), cq.Solid.makeBox(1, 1, 1, cq.Vector(3, 0, 0))]
    )
    brep = tmp_path / "pair.brep"
    pair.exportBrep(str(brep))
    with pytest.raises(MeshingError, match="holds 2 solids instead of one"):
        mesh_solid(brep, ["side"] * 12)


@pytest.mark.parametrize(
    ("fields", "words"),
    [
        ({"size": 0.05}, "size = 0.05 mm must be finite and at least smallest_size = 0.1 mm"),
        ({"size": float("nan")}, "size = nan mm"),
        ({"size": float("inf")}, "size = inf mm"),
        ({"smallest_size": 0.0}, "which must be above 0"),
        ({"elements_per_circle": -1}, "elements_per_circle = -1 must lie between 0 and 100"),
        ({"elements_per_circle": 101}, "elements_per_circle = 101"),
    ],
)
def test_sizes_that_make_no_mesh_are_refused(fields: dict[str, float], words: str) -> None:
    with pytest.raises(ValueError, match=r"^mesh: ") as error:
        MeshOptions(**fields)
    assert words in str(error.value)
