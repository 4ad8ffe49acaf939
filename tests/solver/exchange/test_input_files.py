"""Input files of Abaqus and CalculiX: the forms that people have, and what is wrong in them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from solver import Mesh, read_mesh
from solver.errors import SolverError

NODES = """*Node
 10, 0., 0., 0.
 20, 1., 0., 0.
 30, 0., 1., 0.
 40, 0., 0., 1.
"""
ONE = NODES + "*Element, type=C3D4, elset=Body\n 5, 10, 20, 30, 40\n"
MIDDLES = """ 12, .5, 0., 0.
 23, .5, .5, 0.
 13, 0., .5, 0.
 14, 0., 0., .5
 24, .5, 0., .5
 34, 0., .5, .5
"""
TEN = (
    NODES
    + MIDDLES
    + "*ELEMENT, TYPE=C3D10MH,\n ELSET=Body\n 5, 10, 20, 30, 40, 12, 23, 13,\n 14, 24, 34\n"
)


def read(text: str, folder: Path) -> Mesh:
    (folder / "job.inp").write_text(text)
    return read_mesh(folder / "job.inp")


def corners(mesh: Mesh, name: str) -> set[tuple[float, ...]]:
    """Where the corners of a surface lie."""
    return {tuple(row) for row in mesh.nodes[np.unique(mesh.surfaces[name][:, :3])].tolist()}


def test_each_node_of_ten_stands_in_the_middle_of_its_edge(tmp_path: Path) -> None:
    """Abaqus: (1,2) (2,3) (3,1) (1,4) (2,4) (3,4); the element stands on two lines."""
    mesh = read(TEN, tmp_path)
    from solver.mesh.elements import TETRAHEDRON_EDGES

    (tet,) = mesh.tets
    for place, ends in enumerate(TETRAHEDRON_EDGES, start=4):
        assert mesh.nodes[tet[place]] == pytest.approx(mesh.nodes[tet[list(ends)]].mean(axis=0))


@pytest.mark.parametrize("text", [ONE, TEN])
@pytest.mark.parametrize(
    ("face", "opposite"),
    [("S1", (0, 0, 1)), ("S2", (0, 1, 0)), ("S3", (0, 0, 0)), ("S4", (1, 0, 0))],
)
def test_the_faces_are_those_of_the_manual(
    text: str, face: str, opposite: tuple[float, ...], tmp_path: Path
) -> None:
    """1-2-3, 1-4-2, 2-4-3, 3-4-1: opposite to the nodes 4, 3, 1 and 2; normals point outwards."""
    mesh = read(f"{text}*Surface, name=Wall\nBody, {face}\n", tmp_path)
    every = {(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)}
    assert corners(mesh, "Wall") == every - {tuple(map(float, opposite))}
    assert mesh.boundary_surfaces == {"Wall"}


def test_names_count_without_regard_to_case(tmp_path: Path) -> None:
    mesh = read(f"{ONE}*SURFACE, NAME=Wall, TYPE=ELEMENT\nBODY, s2\n", tmp_path)
    assert list(mesh.surfaces) == ["Wall"]


def test_a_surface_may_name_single_elements(tmp_path: Path) -> None:
    mesh = read(f"{ONE}*SURFACE, NAME=wall\n5, S1\n5, S2\n", tmp_path)
    assert len(mesh.surfaces["wall"]) == 2


@pytest.mark.parametrize(
    "sets",
    [
        "*NSET, NSET=bottom\n10, 20,\n30\n",
        "*NSET, NSET=bottom, GENERATE\n10, 30, 10\n",
        "*NSET, NSET=low\n10, 20\n*NSET, NSET=bottom\nlow, 30\n",
        "*NSET, NSET=bottom, INSTANCE=Part-1-1\n 10, 20, 30\n",
        "*NSET, NSET=low\n10, 20, 30\n*SURFACE, TYPE=NODE, NAME=bottom\nlow, 1.5\n",
        "** a comment\n\n*NSET, NSET=bottom\n 10 , 20\n** another\n 30\n",
        "*ELEMENT, TYPE=M3D3, ELSET=foil\n6, 10, 20, 30\n*NSET, NSET=bottom, ELSET=foil\n",
    ],
)
def test_a_set_of_nodes_is_the_faces_in_it(sets: str, tmp_path: Path) -> None:
    mesh = read(ONE + sets, tmp_path)
    assert corners(mesh, "bottom") == {(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)}
    assert len(mesh.surfaces["bottom"]) == 1


def test_a_set_of_nodes_without_a_face_or_with_all_is_no_surface(tmp_path: Path) -> None:
    text = ONE + "*NSET, NSET=edge\n10, 20\n*NSET, NSET=every, GENERATE\n10, 40, 10\n"
    assert not read(text, tmp_path).surfaces


def test_steps_materials_and_all_else_are_passed_over(tmp_path: Path) -> None:
    more = "*MATERIAL, NAME=r\n*HYPERELASTIC, NEO HOOKE\n1., 0.\n*STEP\n*STATIC\n*END STEP\n"
    assert len(read(ONE + more, tmp_path).tets) == 1


def test_a_file_of_abaqus_cae_with_one_part_is_read(tmp_path: Path) -> None:
    text = f"""*Heading
*Part, name=Part-1
{ONE}*End Part
*Assembly, name=Assembly
*Instance, name=Part-1-1, part=Part-1
*End Instance
*Elset, elset=_Surf-1_S1, internal, instance=Part-1-1
 5,
*Surface, type=ELEMENT, name=Surf-1
_Surf-1_S1, S1
*End Assembly
"""
    mesh = read(text, tmp_path)
    assert list(mesh.surfaces) == ["Surf-1"] and not mesh.regions


def test_shells_and_membranes_name_surfaces_and_bars_nothing(tmp_path: Path) -> None:
    text = f"{ONE}*ELEMENT, TYPE=S3, ELSET=skin\n6, 10, 20, 30\n*ELEMENT, TYPE=T3D2\n7, 10, 20\n"
    mesh = read(text, tmp_path)
    assert list(mesh.surfaces) == ["skin"] and mesh.boundary_surfaces == {"skin"}


def test_included_files_are_read_from_beside(tmp_path: Path) -> None:
    (tmp_path / "nodes.inc").write_text(NODES)
    text = "*INCLUDE, INPUT=nodes.inc\n*ELEMENT, TYPE=C3D4\n5, 10, 20, 30, 40\n"
    assert len(read(text, tmp_path).nodes) == 10


def test_lines_of_data_are_read_from_files_beside(tmp_path: Path) -> None:
    (tmp_path / "nodes.txt").write_text("** of the part\n" + NODES.partition("\n")[2])
    (tmp_path / "elements.txt").write_text("5, 10, 20, 30, 40\n")
    text = "*NODE, INPUT=nodes.txt\n*ELEMENT, TYPE=C3D4, INPUT=elements.txt\n"
    assert len(read(text, tmp_path).nodes) == 10
    (tmp_path / "elements.txt").write_text("5, 10, 20, 30\n")
    with pytest.raises(SolverError, match=r"job\.inp: elements\.txt, 1: element 5 has 3 of 4"):
        read(text, tmp_path)
    (tmp_path / "elements.txt").write_text("*STEP\n")
    with pytest.raises(SolverError, match=r"elements\.txt, 1: a keyword among lines of data"):
        read(text, tmp_path)


def test_a_byte_order_mark_is_passed_over(tmp_path: Path) -> None:
    assert len(read("\N{ZERO WIDTH NO-BREAK SPACE}" + ONE, tmp_path).tets) == 1


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("1, 2, 3\n", "line 1: data stand before the first keyword"),
        (NODES, "it has no tetrahedra"),
        (NODES + "*ELEMENT\n5, 10, 20, 30, 40\n", "line 6: *ELEMENT lacks TYPE=."),
        (NODES + "*ELEMENT, TYPE=C3D8\n", "line 6: elements of the type C3D8 are no tetrahedra"),
        (NODES + "*ELEMENT, TYPE=C3D4\n5, 10, 20, 30\n", "line 7: element 5 has 3 of 4 nodes"),
        (NODES + "*ELEMENT, TYPE=C3D4\n5, 10, 20, 30, 40, 41\n", "has 4 nodes, got 5"),
        (NODES + "*ELEMENT, TYPE=C3D4\n5, 10, 20, 30, 50\n", "names node 50, which is not there"),
        (ONE + "5, 10, 20, 30, 40\n", "line 8: element 5 is given twice"),
        (ONE.replace("1., 0., 0.", "1., o, 0."), "line 3: coordinates must be numbers"),
        (ONE.replace("1., 0., 0.", "nan, 0, 0."), "line 3: coordinates must be finite"),
        (ONE + "*NODE\n10, 0., 0., 5.\n", "node 10 is given twice, at two places"),
        (ONE + "*NSET, NSET=a\nother\n", "line 9: needs a label, or the name of a set above"),
        (ONE + "*NSET, NSET=a\n77\n", "the set of nodes 'a' names node 77"),
        (ONE + "*SURFACE, NAME=a\nBody, S5\n", "line 9: a surface needs a face S1 to S4"),
        (ONE + "*SURFACE, NAME=a\nOther, S1\n", "line 9: needs a label, or the name of a set"),
        (ONE + "*NGEN\n1, 2\n", "line 8: *NGEN is not read"),
        (ONE + "*NSET, NSET=a, GENERATE\n1, 9, 0\n", "line 9: the step must not be 0"),
        (ONE + "*INSTANCE, NAME=b\n1., 0., 0.\n", "the instance 'b' is moved from its part"),
        (ONE + 2 * "*INSTANCE, NAME=b\n", "line 9: a second instance; one, of one part, is read"),
        (ONE + "*NSET, NSET=a, ELSET=b\n", "line 8: there is no set of elements 'b' above"),
        (ONE + "*ELSET, ELSET=a, GENERATE\n1, 1000000000000\n", "a set of more than 50000000"),
        (ONE + f"*NSET, NSET=a\n{10**20}\n", f"line 9: {10**20} is too large"),
        (NODES + "*ELEMENT, TYPE=C3D4, INPUT=no.txt\n", "line 6: there is no file"),
        (ONE + "*INCLUDE, INPUT=no.inc\n", "line 8: there is no file"),
        (ONE + "*INCLUDE, INPUT=job.inp\n", "more than 8 files within each other"),
        (NODES.replace("*Node", "*Node, system=C") + "*ELEMENT", "another than rectangular"),
        (TEN + "*ELEMENT, TYPE=C3D4\n6, 10, 20, 30, 40\n", "four-node and ten-node"),
    ],
)
def test_what_is_wrong_is_said_with_its_line(text: str, sentence: str, tmp_path: Path) -> None:
    with pytest.raises(SolverError) as caught:
        read(text, tmp_path)
    assert str(caught.value).startswith("job.inp: ") and sentence in str(caught.value)
    assert "\n" not in str(caught.value)
