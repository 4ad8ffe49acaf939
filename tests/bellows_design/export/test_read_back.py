"""What stands on the disk is compared with the part before it is an export."""

from __future__ import annotations

import io
import re
import zipfile
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from bellows_design.approval import Verdict
from bellows_design.export import approved
from bellows_design.export.approved import export_approved
from bellows_design.export.formats import WRITERS, Part
from bellows_design.export.read_back import READERS, NotThePart
from bellows_design.files.errors import CannotWrite
from bellows_design.geometry.tessellation import ClosedMesh

APPROVED = Verdict(())


@pytest.mark.parametrize("suffix", WRITERS)
def test_every_format_can_be_read_back(suffix: str, cube_part: Part) -> None:
    READERS[suffix](cube_part, WRITERS[suffix](cube_part))


def other_parts(part: Part) -> list[Part]:
    """The part with a vertex moved, with a triangle gone, and turned inside out."""
    vertices, triangles = part.mesh.vertices, part.mesh.triangles
    moved = np.where(np.arange(len(vertices))[:, None] == 3, vertices + 0.001, vertices)
    moved = moved.astype(np.float32).astype(np.float64)
    meshes = (
        ClosedMesh(moved, triangles),
        ClosedMesh(vertices, triangles[1:]),
        ClosedMesh(vertices, triangles[:, ::-1]),
    )
    return [replace(part, mesh=mesh) for mesh in meshes]


@pytest.mark.parametrize("suffix", [".stl", ".3mf"])
@pytest.mark.parametrize("number", range(3))
def test_another_mesh_is_noticed(suffix: str, number: int, cube_part: Part) -> None:
    with pytest.raises(NotThePart):
        READERS[suffix](cube_part, WRITERS[suffix](other_parts(cube_part)[number]))


def test_another_solid_is_noticed(cube_part: Part) -> None:
    import cadquery as cq

    larger = replace(cube_part, solid=cq.Solid.makeBox(10, 10, 10.0001))
    with pytest.raises(NotThePart, match="another volume"):
        READERS[".step"](cube_part, WRITERS[".step"](larger))


def test_another_solid_of_the_same_volume_is_noticed(cube_part: Part) -> None:
    """A box of other sides, a sphere, and the cube elsewhere."""
    import cadquery as cq

    radius = (3 * 1000 / (4 * np.pi)) ** (1 / 3)
    for solid in (
        cq.Solid.makeBox(5, 20, 10),
        cq.Solid.makeBox(10, 10, 10, cq.Vector(0.001, 0, 0)),
        cq.Solid.makeSphere(radius, angleDegrees1=-90, angleDegrees2=90),
    ):
        content = WRITERS[".step"](replace(cube_part, solid=solid))
        with pytest.raises(NotThePart, match="faces"):
            READERS[".step"](cube_part, content)


@pytest.mark.parametrize(
    ("old", "new"),
    [
        (b'unit="millimeter"', b'unit="inch"'),
        (b"<build", b'<build><item objectid="1"/></build><build'),
        (b"</build>", b'<item objectid="1"/></build>'),
        (b'objectid="1"', b'objectid="1" transform="0.5 0 0 0 0.5 0 0 0 0.5 0 0 0"'),
        (b'objectid="1"', b'objectid="1" transform="1 0 0 0 1 0 0 0 1 0 0 0.001"'),
        (b'objectid="1"', b'objectid="1" transform="1 0 0"'),
        (b'objectid="1"', b'objectid="1" transform="x"'),
        (b'objectid="1"', b'objectid="1" printable="0"'),
        (b'objectid="1"', b'objectid="2"'),
        (b'type="model"', b'type="support"'),
        (b"</resources>", b'<object id="2"><mesh/></object></resources>'),
        (b"</mesh>", b"<beamlattice/></mesh>"),
        (b"</vertices>", b"<vertex/></vertices>"),
        (b"</vertices>", b'<point x="1" y="1" z="1"/></vertices>'),
        (b'x="10.000000"', b'x="NaN"'),
    ],
)
def test_the_same_triangles_built_otherwise_are_another_part(
    old: bytes, new: bytes, cube_part: Part
) -> None:
    content = WRITERS[".3mf"](cube_part)
    model = files_in(content)[MODEL]
    model = re.sub(rb' transform="[^"]*"', b"", model)  # the cube stands as it was made
    READERS[".3mf"](cube_part, package(files_in(content) | {MODEL: model}))
    assert old in model
    with pytest.raises(NotThePart):
        changed = files_in(content) | {MODEL: model.replace(old, new, 1)}
        READERS[".3mf"](cube_part, package(changed))


@pytest.mark.parametrize("name", ["3D/other.model", "Metadata/Slic3r_PE.config", "setup.exe"])
def test_a_3mf_holds_nothing_beside_the_part(name: str, cube_part: Part) -> None:
    files = files_in(WRITERS[".3mf"](cube_part))
    with pytest.raises(NotThePart):
        READERS[".3mf"](cube_part, package(files | {name: b"; temperature = 400"}))


def test_a_number_that_is_none_is_told(cube_part: Part) -> None:
    files = files_in(WRITERS[".3mf"](cube_part))
    broken = files[MODEL].replace(b'x="10.000000"', b'x="ten"', 1)
    with pytest.raises(NotThePart, match=r"^a number in it is none"):
        READERS[".3mf"](cube_part, package(files | {MODEL: broken}))


def test_a_3mf_with_the_parts_own_settings_is_the_part(cube_part: Part) -> None:
    from bellows_design.export.companions import three_mf_with_settings
    from printers import load_profile

    part = replace(cube_part, profile=load_profile("prusa_i3"))
    READERS[".3mf"](part, three_mf_with_settings(part))
    with pytest.raises(
        NotThePart, match=r"^it does not stand"
    ):  # placed on the bed, which the cube has not
        READERS[".3mf"](cube_part, WRITERS[".3mf"](part))


MODEL = "3D/3dmodel.model"


def files_in(content: bytes) -> dict[str, bytes]:
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


def package(files: dict[str, bytes]) -> bytes:
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w") as archive:
        for name, content in files.items():
            archive.writestr(name, content)
    return file.getvalue()


def without_its_model(content: bytes) -> bytes:
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w"):
        return file.getvalue()


@pytest.mark.parametrize("suffix", WRITERS)
@pytest.mark.parametrize(
    "damage",
    [
        lambda content: content[: len(content) // 2],
        lambda content: b"",
        without_its_model,
    ],
    ids=["half", "empty", "without a model"],
)
def test_damaged_content_is_noticed(
    suffix: str, damage: Callable[[bytes], bytes], cube_part: Part
) -> None:
    with pytest.raises(NotThePart):
        READERS[suffix](cube_part, damage(WRITERS[suffix](cube_part)))


@pytest.mark.parametrize("harm", ["changed", "deleted", "added", "manifest"])
def test_what_others_do_to_the_hidden_folder_is_no_approval(
    harm: str, cube_part: Part, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    export_approved(cube_part, APPROVED, {"run": 1}, tmp_path)
    before = {path.name: path.read_bytes() for path in (tmp_path / "cube").iterdir()}
    fill = approved._fill

    def harmed(folder: Path, *arguments: object) -> None:
        fill(folder, *arguments)  # type: ignore[arg-type]
        if harm == "changed":
            content = bytearray((folder / "cube.stl").read_bytes())
            content[-20] ^= 1
            (folder / "cube.stl").write_bytes(content)
        elif harm == "deleted":
            (folder / "cube.step").unlink()
        elif harm == "added":
            (folder / "virus").touch()
        else:
            (folder / "manifest.json").write_text("{}")

    monkeypatch.setattr(approved, "_fill", harmed)
    with pytest.raises(CannotWrite, match="it is approved, but not exported"):
        export_approved(cube_part, APPROVED, {"run": 2}, tmp_path)
    assert {path.name: path.read_bytes() for path in (tmp_path / "cube").iterdir()} == before
    assert [path.name for path in tmp_path.iterdir()] == ["cube"]
