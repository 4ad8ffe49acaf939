"""Meshes and decks of a design for other programs, and what is refused."""

from __future__ import annotations

import json
import struct
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import meshio
import numpy as np
import pytest

from bellows_design.analysis.models import HALF
from bellows_design.design.design import Design
from bellows_design.design.overrides import with_overrides
from bellows_design.design.shipped import load_design
from bellows_design.errors import DesignError
from bellows_design.exchange import Written, design_problem, write_design_mesh
from bellows_design.exchange.formats import program_for
from bellows_design.files.errors import CannotWrite
from solver import Supports, cavity_volume, read_mesh, solve

Bellows = Callable[..., tuple[int, str, str]]
SHORT = ("length=11.5", "offset=3", "number_of_bubbles=1", "material=ninjaflex_yeoh")


@pytest.fixture(scope="module")
def design() -> Design:
    return with_overrides(load_design("prototype_1"), [*SHORT, "load.pressure=0.01"])


@pytest.fixture(scope="module")
def for_sofa(design: Design, tmp_path_factory: pytest.TempPathFactory) -> Written:
    return write_design_mesh(design, tmp_path_factory.mktemp("sofa") / "one.vtk", size=4.0)


def test_a_deck_solved_again_bends_as_far(design: Design, tmp_path: Path) -> None:
    """The mesh of the deck, with the surfaces of the half model held as it holds them."""
    written = write_design_mesh(design, tmp_path / "one.inp", size=4.0)
    text = (tmp_path / "one.inp").read_text()
    assert text.startswith("*HEADING\nprototype_1, 0.01 MPa, by bellows-design\n")
    assert (written.model, written.program) == ("half", "abaqus")
    assert "root, 1, 3\n" in text and "symmetry, 2, 2\n" in text and "cavity, P, 0.01\n" in text
    assert any("left out" in note for note in written.notes)
    free = replace(written.problem, contacts=())
    again = replace(
        free,
        mesh=read_mesh(tmp_path / "one.inp"),
        supports=Supports(clamped=("root",), symmetry={"symmetry": 1}),
    )
    one, other = solve(free, 0.01), solve(again, 0.01)
    assert one.converged and np.abs(one.displacement).max() > 0.3
    assert other.displacement == pytest.approx(one.displacement, abs=1e-6)


@pytest.mark.parametrize("suffix", [".msh", ".vtu"])
def test_a_mesh_has_the_names_of_its_faces(suffix: str, design: Design, tmp_path: Path) -> None:
    written = write_design_mesh(design, tmp_path / f"cell{suffix}", "unit-cell", size=4.0)
    mesh = read_mesh(tmp_path / f"cell{suffix}")
    assert {"cavity", "outside", "symmetry", "bubble_middle", "gap_middle"} <= set(mesh.surfaces)
    assert np.array_equal(mesh.tets, written.mesh.tets) and written.program == ""


def test_a_smaller_size_is_a_finer_mesh(design: Design) -> None:
    coarse, fine = (design_problem(design, "unit-cell", size).mesh for size in (6.0, 1.5))
    assert len(fine.tets) > 2 * len(coarse.tets)


@pytest.mark.parametrize("size", [0.01, 50.0])
def test_sizes_out_of_bounds_are_refused(size: float, design: Design) -> None:
    with pytest.raises(DesignError, match=r"must lie between 0.15 and 7.5 mm"):
        design_problem(design, size=size)


def test_sofas_volume_is_the_whole_body_in_linear_tetrahedra(for_sofa: Written) -> None:
    volume, cavity, scene = for_sofa.files
    assert [path.name for path in (volume, cavity, scene)] == [
        "one.vtk",
        "one_cavity.stl",
        "one_scene.py",
    ]
    head = volume.read_text().splitlines()[:5]
    assert head[0] == "# vtk DataFile Version 2.0" and head[2] == "ASCII"
    assert head[3] == "DATASET UNSTRUCTURED_GRID" and head[4].startswith("POINTS ")
    read = meshio.vtk.read(volume)
    (cells,) = read.cells
    assert cells.type == "tetra" and len(cells.data) == len(for_sofa.mesh.tets)
    corners = read.points[cells.data]
    volumes = np.linalg.det(corners[:, 1:] - corners[:, :1]) / 6
    assert (volumes > 0).all() and for_sofa.model == "full"
    assert volumes.sum() == pytest.approx(_volume(for_sofa), rel=0.02)  # flat faces


def _volume(written: Written) -> float:
    """Of the body, inside all its outer faces."""
    mesh = written.mesh
    faces = ("outside", "cavity", "root", "tip")
    return -cavity_volume(mesh, np.zeros(mesh.nodes.shape), faces)


def test_the_normals_around_the_air_point_out_of_it(for_sofa: Written) -> None:
    """SOFA pushes along them; the triangles close around the volume of the cavity."""
    import trimesh

    found = trimesh.load_mesh(for_sofa.files[1])
    mesh = for_sofa.mesh
    assert found.is_watertight and found.is_winding_consistent
    air = cavity_volume(mesh, np.zeros(mesh.nodes.shape), ("cavity",))
    assert found.volume == pytest.approx(air, rel=0.05) and found.volume > 0
    count = struct.unpack("<I", for_sofa.files[1].read_bytes()[80:84])[0]
    assert count == len(mesh.surfaces["cavity"])


def test_the_scene_is_python_that_names_the_files(for_sofa: Written) -> None:
    """What it builds is recorded by a node that takes everything."""
    text = for_sofa.files[2].read_text()
    names: dict[str, object] = {"__file__": str(for_sofa.files[2])}
    exec(compile(text, "one_scene.py", "exec"), names)
    node = _Node()
    names["createScene"](node)  # type: ignore[operator]
    made = {kind: options for kind, options in node.all()}
    assert Path(made["MeshVTKLoader"]["filename"]).is_file()
    assert Path(made["MeshSTLLoader"]["filename"]).is_file()
    assert made["SurfacePressureForceField"]["pressure"] == pytest.approx(10.0)  # kPa
    shear = for_sofa.problem.material.shear_modulus
    assert made["TetrahedronFEMForceField"]["youngModulus"] == pytest.approx(3000 * shear, rel=1e-4)
    low, high = np.reshape(made["BoxROI"]["box"], (2, 3))
    root = for_sofa.mesh.nodes[for_sofa.mesh.surface_nodes("root")]
    assert ((low < root) & (root < high)).all()
    assert "has not run it" in text and any("not run here" in note for note in for_sofa.notes)


class _Node:
    """What SOFA hands to a scene, as far as ours uses it."""

    def __init__(self) -> None:
        self.made: list[tuple[str, dict]] = []
        self.children: list[_Node] = []

    def addObject(self, kind: str, **options: object) -> None:
        self.made.append((kind, options))

    def addChild(self, _: str) -> _Node:
        self.children.append(_Node())
        return self.children[-1]

    def all(self) -> list[tuple[str, dict]]:
        return [*self.made, *(each for child in self.children for each in child.all())]


@pytest.mark.parametrize(
    ("path", "program", "found"),
    [
        ("a.inp", None, "abaqus"),
        ("a.INP", "calculix", "calculix"),
        ("a.vtk", None, "sofa"),
        ("a.msh", None, ""),
    ],
)
def test_the_ending_says_what_a_file_is_for(path: str, program: str | None, found: str) -> None:
    assert program_for(Path(path), program) == found


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (("-o", "a.stl"), "“a.stl” must end in .inp, .vtk, .msh, .vtu or .xdmf."),
        (("-o", "a.inp", "--for", "sofa"), "a file for sofa must end in .vtk."),
        (("-o", "a.vtu", "--for", "calculix"), "a file for calculix must end in .inp."),
        (("-o", "a.inp", "--for", "ansys"), "--for “ansys” must be one of abaqus, calculix, sofa."),
        (("-o", "a.inp", "--model", "unit-cell"), "no other program has the unit cell's"),
        (("-o", "no/where/a.inp"), "there is no folder"),
        (("-o", "a.inp", "--size", "90"), "size = 90 mm must lie between"),
    ],
)
def test_bad_input_is_one_sentence_and_no_file(
    arguments: tuple[str, ...],
    sentence: str,
    bellows: Bellows,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tmp_path)
    status, out, err = bellows("mesh", "prototype_1", *arguments)
    assert status == 2 and out == ""
    assert sentence in err.splitlines()[-1] and not list(tmp_path.iterdir())


def test_the_command_counts_what_it_wrote(
    bellows: Bellows, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    settings = [word for each in SHORT for word in ("--set", each)]
    asked = ("prototype_1", "-o", "one.inp", "--for", "calculix", "--size", "4", *settings)
    status, out, _ = bellows("mesh", *asked, "--json")
    found = json.loads(out)
    mesh = read_mesh("one.inp")
    assert status == 0 and found["program"] == "calculix" and found["model"] == "half"
    assert (found["nodes"], found["elements"]) == (len(mesh.nodes), len(mesh.tets))
    assert found["surfaces"] == {name: len(each) for name, each in mesh.surfaces.items()}
    assert found["files"] == ["one.inp"] and any("hybrid" in note for note in found["notes"])
    status, out, _ = bellows("mesh", *asked)
    assert status == 0 and f"one.inp: half, {len(mesh.tets)} tetrahedra" in out
    assert "note: " in out


def test_files_are_all_there_or_none(
    design: Design, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def failing(*_: object) -> bytes:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("bellows_design.exchange.sofa.surface_stl", failing)
    (tmp_path / "one.vtk").write_text("as it was")
    with pytest.raises(CannotWrite):
        write_design_mesh(design, tmp_path / "one.vtk", "half", size=4.0)
    assert [path.name for path in tmp_path.iterdir()] == ["one.vtk"]
    assert (tmp_path / "one.vtk").read_text() == "as it was"


def test_the_problem_is_the_one_that_is_evaluated(design: Design) -> None:
    problem = design_problem(design, "half", size=4.0)
    again = HALF.problem(design, problem.mesh)
    assert (again.supports, again.pressurised) == (problem.supports, problem.pressurised)
    assert again.contacts == problem.contacts
