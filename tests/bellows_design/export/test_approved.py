"""Files: what they hold, and that they are there completely or not at all."""

from __future__ import annotations

import hashlib
import json
import os
import zipfile
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from bellows_design.approval import Reason, Verdict
from bellows_design.errors import DesignError
from bellows_design.export import approved as export
from bellows_design.export import formats
from bellows_design.export.approved import export_approved, withdraw
from bellows_design.export.formats import WRITERS, Part, write_part
from bellows_design.files import atomic
from bellows_design.geometry.tessellation import ClosedMesh, TessellationError, tessellate

APPROVED = Verdict(())
REFUSED = Verdict((Reason("stress", "max_von_mises", 5.0, 4.0, "MPa", "Too much."),))


def names_below(folder: Path) -> list[str]:
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*"))


def test_stl_holds_exactly_the_checked_mesh(cube_part: Part, tmp_path: Path) -> None:
    write_part(cube_part, tmp_path / "cube.stl")
    content = (tmp_path / "cube.stl").read_bytes()
    assert not content.startswith(b"solid") and b"cube" in content[:80]
    count = int.from_bytes(content[80:84], "little")
    rows = np.frombuffer(content[84:], dtype=[("f", "<f4", 12), ("a", "<u2")])
    assert count == len(rows) == len(cube_part.mesh.triangles)
    corners = rows["f"][:, 3:].reshape(-1, 3, 3).astype(np.float64)
    assert np.array_equal(corners, cube_part.mesh.vertices[cube_part.mesh.triangles])
    outward = np.einsum("ij,ij->i", rows["f"][:, :3], corners.mean(axis=1) - 5)
    assert np.all(outward > 0)


def test_3mf_carries_title_description_digest_and_millimetres(
    cube_part: Part, tmp_path: Path
) -> None:
    write_part(cube_part, tmp_path / "cube.3mf")
    model = zipfile.ZipFile(tmp_path / "cube.3mf").read("3D/3dmodel.model").decode()
    assert 'unit="millimeter"' in model
    assert ">cube<" in model and "ten by ten &lt;by&gt; ten µm" in model
    assert cube_part.digest in model
    assert model.count("<triangle ") == len(cube_part.mesh.triangles)


def test_step_holds_the_exact_solid_and_its_name(cube_part: Part, tmp_path: Path) -> None:
    import cadquery as cq

    write_part(cube_part, tmp_path / "cube.step")
    assert cube_part.digest in (tmp_path / "cube.step").read_text("utf-8").replace("'\n,'", "")
    assert "FILE_NAME('cube'" in (tmp_path / "cube.step").read_text("utf-8")
    (solid,) = cq.importers.importStep(str(tmp_path / "cube.step")).solids().vals()
    assert solid.Volume() == pytest.approx(1000, rel=1e-12)


def test_an_unknown_suffix_is_refused_and_writes_nothing(cube_part: Part, tmp_path: Path) -> None:
    with pytest.raises(DesignError, match=r"\.stl, \.3mf, \.step"):
        write_part(cube_part, tmp_path / "cube.obj")
    assert names_below(tmp_path) == []


@pytest.mark.parametrize("suffix", WRITERS)
def test_a_writer_that_fails_leaves_the_old_file(
    suffix: str, cube_part: Part, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def half_written(part: Part, path: Path, content: bytes) -> None:
        path.write_text("half")
        raise KeyboardInterrupt

    target = tmp_path / f"cube{suffix}"
    target.write_text("old")
    monkeypatch.setattr(formats, "require_same", half_written)
    with pytest.raises(KeyboardInterrupt):
        write_part(cube_part, target)
    assert names_below(tmp_path) == [target.name] and target.read_text() == "old"


def test_new_files_are_as_readable_as_any_other(cube_part: Part, tmp_path: Path) -> None:
    write_part(cube_part, tmp_path / "cube.stl")
    (tmp_path / "plain").touch()
    assert (tmp_path / "cube.stl").stat().st_mode == (tmp_path / "plain").stat().st_mode


def test_a_curved_solid_is_tessellated_within_the_stated_tolerance() -> None:
    import cadquery as cq

    solid = cq.Solid.makeSphere(5, angleDegrees1=-90)
    mesh = tessellate(solid, tolerance=0.02)
    middles = mesh.vertices[mesh.triangles].mean(axis=1)
    assert np.linalg.norm(middles, axis=1).min() > 5 - 0.02
    assert mesh.volume == pytest.approx(solid.Volume(), rel=0.01)


def test_a_mesh_with_a_hole_is_refused(cube_part: Part) -> None:
    from bellows_design.geometry.tessellation import _verify

    opened = ClosedMesh(cube_part.mesh.vertices, cube_part.mesh.triangles[1:])
    with pytest.raises(TessellationError, match="watertight"):
        _verify(opened, 1000.0)
    flipped = ClosedMesh(cube_part.mesh.vertices, cube_part.mesh.triangles[:, ::-1])
    with pytest.raises(TessellationError):
        _verify(flipped, 1000.0)


def test_an_approved_export_is_complete_and_its_hashes_are_true(
    cube_part: Part, tmp_path: Path
) -> None:
    folder = export_approved(cube_part, APPROVED, {"check": {"verdict": "pass"}}, tmp_path / "out")
    expected = ["cube.3mf", "cube.step", "cube.stl", "manifest.json", "run.json"]
    assert folder == tmp_path / "out" / "cube"
    assert names_below(tmp_path / "out") == ["cube", *(f"cube/{name}" for name in expected)]
    manifest = json.loads((folder / "manifest.json").read_text("utf-8"))
    empty: dict[str, Any] = {"reasons": [], "warnings": [], "not_judged": []}
    assert manifest["verdict"] == {"approved": True} | empty
    assert manifest["digest"] == cube_part.digest and manifest["check"] == {"verdict": "pass"}
    assert sorted(manifest["files"]) == expected[:3]
    for name, fingerprint in manifest["files"].items():
        content = (folder / name).read_bytes()
        assert fingerprint == {
            "sha256": hashlib.sha256(content).hexdigest(),
            "bytes": len(content),
        }


def test_a_refused_part_cannot_be_exported(cube_part: Part, tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="not approved"):
        export_approved(cube_part, REFUSED, {}, tmp_path / "out")
    assert names_below(tmp_path) == []


def test_a_later_approval_replaces_the_earlier_one(cube_part: Part, tmp_path: Path) -> None:
    export_approved(cube_part, APPROVED, {"run": 1}, tmp_path)
    export_approved(replace(cube_part, digest="cd" * 32), APPROVED, {"run": 2}, tmp_path)
    manifest = json.loads((tmp_path / "cube" / "manifest.json").read_text("utf-8"))
    assert (manifest["run"], manifest["digest"]) == (2, "cd" * 32)
    assert [path.name for path in tmp_path.iterdir()] == ["cube"]


@pytest.mark.parametrize("failing", ["write", "rename"])
def test_a_failed_export_leaves_the_earlier_one_as_it_was(
    failing: str, cube_part: Part, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    export_approved(cube_part, APPROVED, {"run": 1}, tmp_path)
    before = {path: path.read_bytes() for path in (tmp_path / "cube").iterdir()}

    def fail(*_: Any) -> None:
        raise OSError(28, "No space left on device")

    real_rename, failures = os.rename, []

    def rename_fails_into_place(source: Path, target: Path) -> None:
        if target == tmp_path / "cube" and not failures:
            failures.append(source)
            fail()
        real_rename(source, target)

    if failing == "write":
        monkeypatch.setattr(export.os, "fsync", fail)
    else:
        monkeypatch.setattr(export.os, "rename", rename_fails_into_place)
    with pytest.raises(OSError, match="No space left"):
        export_approved(cube_part, APPROVED, {"run": 2}, tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["cube"]
    assert {path: path.read_bytes() for path in (tmp_path / "cube").iterdir()} == before


@pytest.mark.parametrize("foreign", ["file", "extra", "empty", "link", "plain file"])
def test_what_is_not_ours_alone_is_never_replaced(
    foreign: str, cube_part: Part, tmp_path: Path
) -> None:
    root, elsewhere = tmp_path / "out", tmp_path / "elsewhere"
    root.mkdir()
    elsewhere.mkdir()
    target = root / "cube"
    if foreign == "link":
        target.symlink_to(elsewhere)
    elif foreign == "plain file":
        target.write_text("mine")
    else:
        if foreign == "extra":
            export_approved(cube_part, APPROVED, {}, root)
        target.mkdir(exist_ok=True)
        if foreign != "empty":
            (target / "thesis.doc").write_text("mine")
    before = names_below(tmp_path)
    with pytest.raises(DesignError, match="not an export of ours alone"):
        export_approved(cube_part, APPROVED, {}, root)
    assert names_below(tmp_path) == before


def test_withdrawing_removes_an_export_of_ours(cube_part: Part, tmp_path: Path) -> None:
    folder = export_approved(cube_part, APPROVED, {}, tmp_path)
    assert withdraw("cube", tmp_path) == folder
    assert names_below(tmp_path) == []
    assert withdraw("cube", tmp_path) is None


def test_withdrawing_spares_what_is_not_ours(cube_part: Part, tmp_path: Path) -> None:
    folder = export_approved(cube_part, APPROVED, {}, tmp_path / "out")
    (folder / "notes.txt").write_text("mine")
    (tmp_path / "outside.txt").write_text("mine")
    manifest = json.loads((folder / "manifest.json").read_text("utf-8"))
    manifest["files"] |= {"../../outside.txt": {}, "..": {}, "": {}}
    (folder / "manifest.json").write_text(json.dumps(manifest))
    withdraw("cube", tmp_path / "out")
    assert names_below(tmp_path) == ["out", "out/cube", "out/cube/notes.txt", "outside.txt"]


def test_a_folder_without_our_manifest_is_not_withdrawn(tmp_path: Path) -> None:
    (tmp_path / "cube").mkdir()
    (tmp_path / "cube" / "manifest.json").write_text('{"files": {"thesis.doc": {}}}')
    (tmp_path / "cube" / "thesis.doc").write_text("mine")
    assert withdraw("cube", tmp_path) is None
    assert (tmp_path / "cube" / "thesis.doc").exists()


def test_replacing_needs_the_folder(tmp_path: Path) -> None:
    with (
        pytest.raises(OSError, match=r"“file\.txt” cannot be written: No such file"),
        atomic.replacing(tmp_path / "missing" / "file.txt"),
    ):
        pass
