"""Meshes from files of other programs: their sets, their kinds of cells, and what is wrong."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Iterator
from pathlib import Path

import meshio
import numpy as np
import pytest

from solver import Mesh, Ogden, Problem, Supports, read_mesh, solve, write_mesh
from solver.errors import SolverError
from solver.mesh.faces import face_keys

Boxes = Callable[..., Mesh]
SUFFIXES = (".inp", ".msh", ".vtu")


@pytest.fixture(scope="module")
def named(box: Boxes) -> Mesh:
    """A block with its six sides, two regions, and the face between them."""
    mesh = box((4, 2, 2), (4.0, 2.0, 1.0))
    left = mesh.nodes[mesh.tets[:, :4], 0].mean(axis=1) < 2.0
    between = _interface(mesh, left)
    regions = {"soft": np.flatnonzero(left), "stiff": np.flatnonzero(~left)}
    return mesh.with_regions(regions).with_surfaces({"between": between})


def _interface(mesh: Mesh, left: np.ndarray) -> np.ndarray:
    """Triangles of the left elements in the plane x = 2."""
    from solver.exchange.assembling import face_nodes

    faces = mesh.tets[left][:, face_nodes()].reshape(-1, 6)
    on = (np.abs(mesh.nodes[faces, 0] - 2.0) < 1e-9).all(axis=1)
    return faces[on]


def same_triangles(one: Mesh, other: Mesh, name: str) -> bool:
    """Whether surfaces have the same triangles, turned the same way, mid-nodes included."""
    keys = [np.sort(face_keys(each.surfaces[name], len(one.nodes))) for each in (one, other)]
    nodes = [each.surface_nodes(name) for each in (one, other)]
    return all(np.array_equal(*pair) for pair in (keys, nodes))


@pytest.mark.parametrize("suffix", SUFFIXES)
def test_what_is_written_comes_back(suffix: str, named: Mesh, tmp_path: Path) -> None:
    path = tmp_path / f"block{suffix}"
    write_mesh(path, named)
    read = read_mesh(path)
    assert np.array_equal(read.nodes, named.nodes) and np.array_equal(read.tets, named.tets)
    assert set(read.surfaces) == set(named.surfaces)
    assert all(same_triangles(read, named, name) for name in named.surfaces)
    assert set(read.regions) == set(named.regions)
    assert all(np.array_equal(read.regions[k], named.regions[k]) for k in named.regions)


@pytest.mark.parametrize("suffix", SUFFIXES)
def test_a_problem_on_the_mesh_read_has_the_same_solution(
    suffix: str, named: Mesh, tmp_path: Path
) -> None:
    def solved(mesh: Mesh) -> np.ndarray:
        hard = {"stiff": Ogden.neo_hooke(1.0)}
        problem = Problem(mesh, Ogden.neo_hooke(0.3), Supports(("x0",)), ("z1",), materials=hard)
        return solve(problem, 0.002).displacement

    path = tmp_path / f"block{suffix}"
    write_mesh(path, named)
    assert solved(read_mesh(path)) == pytest.approx(solved(named), abs=1e-9)


@pytest.mark.parametrize("suffix", SUFFIXES)
def test_four_node_tetrahedra_get_middles_of_edges(
    suffix: str, named: Mesh, tmp_path: Path
) -> None:
    """As linear cells in meshio's own files; the straight block is the same with ten nodes."""
    corners = named.tets[:, :4]
    if suffix == ".inp":
        lines = ["*NODE", *(f"{k + 1}, {x}, {y}, {z}" for k, (x, y, z) in enumerate(named.nodes))]
        lines += ["*ELEMENT, TYPE=C3D4, ELSET=soft"]
        lines += [
            f"{k + 1}, {a + 1}, {b + 1}, {c + 1}, {d + 1}" for k, (a, b, c, d) in enumerate(corners)
        ]
        lines += ["*NSET, NSET=x0", ", ".join(str(k + 1) for k in named.surface_nodes("x0"))]
        (tmp_path / "block.inp").write_text("\n".join(lines))
    else:
        x0 = named.surfaces["x0"][:, :3]
        flags = {"x0": [np.zeros(len(corners), int), np.ones(len(x0), int)]}
        groups = {"gmsh:physical": flags["x0"], "gmsh:geometrical": flags["x0"]}
        content = meshio.Mesh(
            named.nodes,
            [("tetra", corners), ("triangle", x0)],
            cell_data=groups if suffix == ".msh" else flags,
            field_data={"x0": np.array([1, 2])},
        )
        kind = "gmsh22" if suffix == ".msh" else "vtu"
        meshio.write(tmp_path / f"block{suffix}", content, kind)
    read = read_mesh(tmp_path / f"block{suffix}")
    assert read.tets.shape == named.tets.shape and len(read.nodes) == len(named.nodes)
    assert {tuple(row) for row in read.nodes.round(9)} == {
        tuple(row) for row in named.nodes.round(9)
    }
    assert len(read.surfaces["x0"]) == len(named.surfaces["x0"])
    assert (np.abs(read.nodes[read.surfaces["x0"], 0]) < 1e-12).all()


@pytest.fixture
def gmsh_model() -> Iterator[object]:
    """Two boxes on each other with named volumes and one named face."""
    import gmsh

    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    occ = gmsh.model.occ
    first, second = occ.addBox(0, 0, 0, 2, 1, 1), occ.addBox(2, 0, 0, 1, 1, 1)
    occ.fragment([(3, first)], [(3, second)])
    occ.synchronize()
    gmsh.model.addPhysicalGroup(3, [1], 7, "long")
    gmsh.model.addPhysicalGroup(3, [2], 8, "short")
    ends = gmsh.model.getEntitiesInBoundingBox(-0.1, -0.1, -0.1, 0.1, 1.1, 1.1, 2)
    gmsh.model.addPhysicalGroup(2, [tag for _, tag in ends], 7, "left")
    gmsh.option.setNumber("Mesh.MeshSizeMax", 0.7)
    gmsh.model.mesh.generate(3)
    yield gmsh
    gmsh.finalize()


@pytest.mark.parametrize("order", [1, 2])
@pytest.mark.parametrize(("version", "binary"), [(2.2, 0), (2.2, 1), (4.1, 0), (4.1, 1)])
def test_gmshs_own_files_are_read(
    order: int, version: float, binary: int, gmsh_model: object, tmp_path: Path
) -> None:
    gmsh = gmsh_model
    gmsh.model.mesh.setOrder(order)
    gmsh.option.setNumber("Mesh.MshFileVersion", version)
    gmsh.option.setNumber("Mesh.Binary", binary)
    gmsh.write(str(tmp_path / "boxes.msh"))
    _check_boxes(read_mesh(tmp_path / "boxes.msh"))


def test_gmshs_input_files_for_abaqus_are_read(gmsh_model: object, tmp_path: Path) -> None:
    """Surfaces are plane elements there, and each set of elements has two names."""
    gmsh = gmsh_model
    gmsh.model.mesh.setOrder(2)
    gmsh.write(str(tmp_path / "boxes.inp"))
    _check_boxes(read_mesh(tmp_path / "boxes.inp"))


def test_groups_without_a_name_stand_beside_named_ones(gmsh_model: object, tmp_path: Path) -> None:
    gmsh = gmsh_model
    right = gmsh.model.getEntitiesInBoundingBox(2.9, -0.1, -0.1, 3.1, 1.1, 1.1, 2)
    gmsh.model.addPhysicalGroup(2, [tag for _, tag in right], 5)
    gmsh.write(str(tmp_path / "boxes.msh"))
    mesh = read_mesh(tmp_path / "boxes.msh")
    assert set(mesh.surfaces) == {"left", "physical_5"}
    assert mesh.nodes[mesh.surfaces["physical_5"], 0] == pytest.approx(3.0)


@pytest.mark.parametrize(
    ("version", "sentence"),
    [(2.2, r"names physical groups \(left, long, short\), but"), (4.1, "can be read")],
)
def test_groups_that_were_not_saved_are_said(
    version: float, sentence: str, gmsh_model: object, tmp_path: Path
) -> None:
    """Gmsh's 2.2 then has the names alone, its 4.1 groups of some elements."""
    gmsh = gmsh_model
    gmsh.option.setNumber("Mesh.MshFileVersion", version)
    gmsh.option.setNumber("Mesh.SaveAll", 1)
    gmsh.write(str(tmp_path / "boxes.msh"))
    with pytest.raises(SolverError, match=rf"^boxes\.msh: it .*{sentence}.*Mesh\.SaveAll = 0"):
        read_mesh(tmp_path / "boxes.msh")


def _check_boxes(mesh: Mesh) -> None:
    from solver.mesh.checks import check_elements
    from solver.mesh.mid_nodes import jacobian_ratios

    check_elements(mesh)
    assert set(mesh.regions) == {"long", "short"} and "left" in mesh.surfaces
    assert jacobian_ratios(mesh.nodes, mesh.tets).min() == pytest.approx(1.0)  # straight edges
    inside = mesh.nodes[mesh.tets[mesh.regions["long"], :4], 0]
    assert inside.max() == pytest.approx(2.0)
    assert (np.abs(mesh.nodes[mesh.surfaces["left"], 0]) < 1e-9).all()
    corners = mesh.nodes[mesh.surfaces["left"][:, :3]]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    assert (normals[:, 0] < 0).all() and -normals[:, 0].sum() / 2 == pytest.approx(1.0)


def test_nodes_of_no_tetrahedron_are_left_out(named: Mesh, tmp_path: Path) -> None:
    write_mesh(tmp_path / "block.inp", named)
    text = (tmp_path / "block.inp").read_text()
    (tmp_path / "block.inp").write_text(text.replace("*NODE\n", "*NODE\n99999, 7., 7., 7.\n", 1))
    assert len(read_mesh(tmp_path / "block.inp").nodes) == len(named.nodes)


def test_a_field_of_several_values_is_a_set_for_each(named: Mesh, tmp_path: Path) -> None:
    values = np.where(np.arange(len(named.tets)) < 10, 3, 0)
    cells = [("tetra", named.tets[:, :4])]
    meshio.Mesh(named.nodes, cells, cell_data={"part": [values + (values == 0) * 5]}).write(
        tmp_path / "block.vtu"
    )
    read = read_mesh(tmp_path / "block.vtu")
    assert {name: len(each) for name, each in read.regions.items()} == {
        "part_3": 10,
        "part_5": len(named.tets) - 10,
    }


def test_overlapping_sets_are_chosen_from(named: Mesh, tmp_path: Path) -> None:
    write_mesh(tmp_path / "block.inp", named)
    with (tmp_path / "block.inp").open("a") as file:
        file.write("*ELSET, ELSET=mine, GENERATE\n1, 9, 2\n")
    with pytest.raises(SolverError, match=r"'soft' and 'mine' share .* choose with regions="):
        read_mesh(tmp_path / "block.inp")
    read = read_mesh(tmp_path / "block.inp", regions=("mine",))
    assert list(read.regions) == ["mine"] and read.regions["mine"].tolist() == [0, 2, 4, 6, 8]
    with pytest.raises(
        SolverError, match=r"no set of elements 'other'; it has: soft, stiff, all_elements, mine"
    ):
        read_mesh(tmp_path / "block.inp", regions=("other",))


def test_other_endings_and_missing_files_are_said(tmp_path: Path) -> None:
    with pytest.raises(SolverError, match=r"must end in \.inp, \.msh or \.vtu, got 'mesh\.stl'"):
        read_mesh("mesh.stl")
    with pytest.raises(FileNotFoundError):
        read_mesh(tmp_path / "nowhere.msh")
    with pytest.raises(SolverError, match="must be the path of a file"):
        read_mesh(3)  # type: ignore[arg-type]


@pytest.mark.parametrize("suffix", SUFFIXES)
@pytest.mark.parametrize("content", [b"", b"nonsense\n", b"\x00\xff" * 500])
def test_files_of_nonsense_are_one_sentence(suffix: str, content: bytes, tmp_path: Path) -> None:
    path = tmp_path / f"broken{suffix}"
    path.write_bytes(content)
    with pytest.raises(SolverError, match=rf"^broken\{suffix}: .*\.$") as caught:
        read_mesh(path)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("suffix", SUFFIXES)
def test_files_cut_short_are_one_sentence_or_another_mesh(
    suffix: str, named: Mesh, tmp_path: Path
) -> None:
    whole, part = tmp_path / f"whole{suffix}", tmp_path / f"part{suffix}"
    write_mesh(whole, named)
    content = whole.read_bytes()
    refused = 0
    for share in (0.2, 0.4, 0.6, 0.8, 0.95):
        part.write_bytes(content[: int(share * len(content))])
        try:
            read_mesh(part)
        except SolverError as error:
            refused += "\n" not in str(error)
    assert refused >= 3


def test_hexahedra_are_refused(tmp_path: Path) -> None:
    nodes = np.array(
        [[x, y, z] for z in (0, 1) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))], float
    )
    meshio.Mesh(nodes, [("hexahedron", [list(range(8))])]).write(tmp_path / "cube.vtu")
    with pytest.raises(SolverError, match=r"cube\.vtu: it has cells of the kind hexahedron"):
        read_mesh(tmp_path / "cube.vtu")


def test_a_tetrahedron_inside_out_is_refused_with_its_place(tmp_path: Path) -> None:
    nodes = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], float)
    meshio.Mesh(nodes, [("tetra", [[1, 0, 2, 3]])]).write(tmp_path / "one.vtu")
    with pytest.raises(SolverError, match=r"one\.vtu: tetrahedron 0 is turned inside out .* at \("):
        read_mesh(tmp_path / "one.vtu")


def test_a_triangle_within_a_cell_is_no_surface(tmp_path: Path) -> None:
    nodes = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [9, 9, 9]], float)
    cells = [("tetra", [[0, 1, 2, 3]]), ("triangle", [[0, 1, 4]])]
    flags = {"side": [np.array([0]), np.array([1])]}
    meshio.Mesh(nodes, cells, cell_data=flags).write(tmp_path / "one.vtu")
    with pytest.raises(SolverError, match="1 of 1 triangles of 'side' are no faces"):
        read_mesh(tmp_path / "one.vtu")


def test_an_xdmf_file_is_one_file_that_vtk_reads(named: Mesh, tmp_path: Path) -> None:
    from vtkmodules.vtkIOXdmf2 import vtkXdmfReader

    write_mesh(tmp_path / "block.xdmf", named)
    assert [path.name for path in tmp_path.iterdir()] == ["block.xdmf"]
    reader = vtkXdmfReader()
    reader.SetFileName(str(tmp_path / "block.xdmf"))
    reader.Update()
    grid = reader.GetOutputDataObject(0)
    assert grid.GetNumberOfPoints() == len(named.nodes)
    data = grid.GetCellData()
    names = {data.GetArrayName(k) for k in range(data.GetNumberOfArrays())}
    assert names == {*named.surfaces, *named.regions}
    shutil.rmtree(tmp_path)
