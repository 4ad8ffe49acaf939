"""What goes wrong between a mesh and its G-code, with programs that do what slicers did."""

from __future__ import annotations

import errno
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from pretended_slicer import SETTINGS_BLOCK, loop

from printers import load_profile
from printers.errors import PrintersError
from printers.slicing.finding import Slicer, find_slicer
from printers.slicing.making import run_slicer, slice_mesh
from printers.slicing.prusa import prusa_settings, settings_digest
from printers.slicing.stl import binary_stl

PROFILE = load_profile("prusa_i3")
GOOD = f"{loop(125, 105, 11.6, 7.6)}; {SETTINGS_BLOCK}"

Pretended = Callable[[str], Slicer]
Box = tuple[Any, Any]


def test_what_the_slicer_makes_is_read_back(pretended: Pretended, box: Box) -> None:
    sliced = slice_mesh(*box, PROFILE, pretended(GOOD), seconds=20)
    assert (sliced.slicer, sliced.version) == ("PrusaSlicer", "2.5.0")
    assert sliced.profile_digest == settings_digest(prusa_settings(PROFILE))
    beads = sliced.gcode.beads
    assert len(beads) == 80 and sliced.warnings == ()
    points = np.column_stack((beads.start, np.zeros(80)))
    found = sliced.placement.to_part(points)
    np.testing.assert_allclose(found.min(axis=0), [40.2, 50.2, 60])
    assert sliced.notes == () if sliced.reproducible else len(sliced.notes) == 1


def test_the_slicer_gets_the_part_on_its_bed_and_our_settings(
    pretended: Pretended, box: Box, tmp_path: Path
) -> None:
    slice_mesh(*box, PROFILE, pretended(f'echo "$@" > asked; {GOOD}'), 0.0, tmp_path, 20)
    asked = (tmp_path / "asked").read_text()
    assert "--load settings.ini" in asked and "--center 125,105" in asked
    assert (tmp_path / "settings.ini").read_text() == prusa_settings(PROFILE)
    shape = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    corners = np.frombuffer((tmp_path / "part.stl").read_bytes()[84:], dtype=shape)["corners"]
    np.testing.assert_allclose(corners.min(axis=(0, 1)), [119, 101, 0])
    np.testing.assert_allclose(corners.max(axis=(0, 1)), [131, 109, 4])


@pytest.mark.parametrize(
    ("body", "message"),
    [
        ("exit 0", "the slicer ended well, but made no G-code$"),
        ("touch part.gcode", "the slicer ended well, but made no G-code$"),
        (
            "echo 'part.stl: Loading of a model file failed.'; exit 1",
            "failed with status 1: part.stl: Loading of a model file failed.",
        ),
        ("kill -6 $$", "failed with status -6$"),
        ("sleep 30", r"did not end within 0\.5 s"),
        ("head -c 1000 /dev/zero > part.gcode", "no text, so no G-code"),
        ("echo 'G1 X5' > part.gcode", "lays down no plastic"),
        (
            f"{GOOD}; sed -i '/seam_position/d' part.gcode",
            "did not keep its settings: seam_position = random was dropped$",
        ),
        (
            f"{GOOD}; sed -i 's/perimeters = 3/perimeters = 2/' part.gcode",
            "did not keep its settings: perimeters = 3 became 2$",
        ),
        (
            loop(125, 105, 11.6, 7.6) + "; echo '; filament_diameter = 1.75' >> part.gcode",
            "did not keep its settings: .* was dropped; .* and [0-9]+ more$",
        ),
        (f"{loop(128, 105, 11.6, 7.6)}; {SETTINGS_BLOCK}", r"moved the part by 3\.00 mm in x"),
    ],
)
def test_what_slicers_do_in_silence_is_noticed(
    pretended: Pretended, box: Box, body: str, message: str
) -> None:
    seconds = 0.5 if "sleep" in body else 20
    with pytest.raises(PrintersError, match=message):
        slice_mesh(*box, PROFILE, pretended(body), seconds=seconds)


def test_half_of_the_part_is_told(pretended: Pretended, box: Box) -> None:
    half = f"{loop(125, 105, 11.6, 7.6, layers=10)}; {SETTINGS_BLOCK}"
    notes = slice_mesh(*box, PROFILE, pretended(half), seconds=20).notes
    assert any("on the last 2.00 mm towards +z" in note for note in notes)


def test_an_old_file_is_not_taken_for_the_slicers(
    pretended: Pretended, box: Box, tmp_path: Path
) -> None:
    (tmp_path / "part.gcode").write_text("G1 X5 E1\n")
    with pytest.raises(PrintersError, match="made no G-code"):
        slice_mesh(*box, PROFILE, pretended("exit 0"), 0.0, tmp_path, 20)
    with pytest.raises(PrintersError, match="made no G-code"):
        run_slicer(pretended("exit 0"), tmp_path, PROFILE, 20)


def test_what_the_slicer_got_and_said_is_kept_when_it_fails(
    pretended: Pretended, box: Box, tmp_path: Path
) -> None:
    with pytest.raises(PrintersError, match="status 1: Why"):
        slice_mesh(*box, PROFILE, pretended("echo Why; exit 1"), 0.0, tmp_path / "kept", 20)
    kept = {path.name for path in (tmp_path / "kept").iterdir()}
    assert kept == {"output.txt", "part.stl", "settings.ini"}
    assert (tmp_path / "kept" / "output.txt").read_text() == "Why\n"


def test_warnings_are_in_the_slicers_own_words(pretended: Pretended, box: Box) -> None:
    said = "10 => Processing\\n[2026-11-26 21:28:17] [0x7f] [trace]   Starting\\n"
    said += (
        "print warning: Empty layer between 4 and 10.\\n\\nObject name: part.stl\\n\\nMake sure.\\n"
    )
    said += "print warning: Loose extrusions.\\n[2026] [0x7f] [error]   Odd.\\n"
    said += "Slicing result exported to part.gcode\\n"
    sliced = slice_mesh(*box, PROFILE, pretended(f"printf '{said}'; {GOOD}"), seconds=20)
    assert sliced.warnings == (
        "Empty layer between 4 and 10. Make sure.",
        "Loose extrusions.",
        "Odd.",
    )


def test_nothing_is_left_behind(
    pretended: Pretended, box: Box, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    slicer = pretended(GOOD)
    (tmp_path / "temporary").mkdir()
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path / "temporary"))
    slice_mesh(*box, PROFILE, slicer, seconds=20)
    with pytest.raises(PrintersError):
        slice_mesh(*box, PROFILE, pretended("exit 1"), seconds=20)
    assert os.listdir(tmp_path / "temporary") == []


def full(*_: object, **__: object) -> None:
    raise OSError(errno.ENOSPC, "No space left on device")


@pytest.mark.parametrize("name", ["pathlib.Path.write_bytes", "pathlib.Path.open", "os.mkdir"])
def test_a_full_temporary_folder_is_one_sentence(
    pretended: Pretended, box: Box, monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    """As for any other fault of the slicer, the caller decides what follows from it."""
    slicer = pretended(GOOD)
    monkeypatch.setattr(name, full)
    with pytest.raises(PrintersError, match=r"slicer cannot be written: No space left on device$"):
        slice_mesh(*box, PROFILE, slicer, seconds=20)


@pytest.mark.parametrize("name", ["pathlib.Path.open", "os.mkdir"])
def test_a_slicer_that_cannot_be_asked_for_want_of_space_is_one_sentence(
    pretended: Pretended, monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    path = str(pretended(GOOD).path)
    monkeypatch.setattr(name, full)
    with pytest.raises(PrintersError, match=r"slicer cannot be written: No space left on device$"):
        find_slicer({"BELLOWS_SLICER": path})


def test_without_a_slicer_the_sentence_says_how_to_get_one(box: Box) -> None:
    with pytest.raises(PrintersError, match="there is no slicer: install PrusaSlicer"):
        slice_mesh(*box, PROFILE)


def test_meshes_that_are_none_are_refused_before_the_slicer(pretended: Pretended, box: Box) -> None:
    vertices, triangles = box
    slicer = pretended("touch ran; exit 1")
    with pytest.raises(PrintersError, match="no triangles"):
        slice_mesh(vertices, triangles[:0], PROFILE, slicer)
    for number in (-1, len(vertices)):
        with pytest.raises(PrintersError, match="triangles without vertices"):
            slice_mesh(vertices, np.array([[0, 1, number]]), PROFILE, slicer)
    with pytest.raises(PrintersError, match="no numbers"):
        slice_mesh(vertices * np.nan, triangles, PROFILE, slicer)
    with pytest.raises(PrintersError, match=r"1200\.0 mm long in x"):
        slice_mesh(vertices * 100, triangles, PROFILE, slicer)


def test_vertices_of_no_triangle_do_not_move_the_part(pretended: Pretended, box: Box) -> None:
    vertices, triangles = box
    astray = np.concatenate((vertices, [[500.0, 500, 500], [np.nan] * 3]))
    sliced = slice_mesh(astray, triangles, PROFILE, pretended(GOOD), seconds=20)
    expected = slice_mesh(vertices, triangles, PROFILE, pretended(GOOD), seconds=20)
    np.testing.assert_array_equal(sliced.placement.shift, expected.placement.shift)


def test_the_stl_is_the_mesh(box: Box) -> None:
    import io

    import trimesh

    vertices, triangles = box
    content = binary_stl(vertices[triangles].reshape(-1, 3))
    assert content[:80] == bytes(80) and len(content) == 84 + 50 * len(box[1])
    mesh = trimesh.load(io.BytesIO(content), file_type="stl")
    assert mesh.volume == pytest.approx(12 * 8 * 4) and mesh.is_watertight
