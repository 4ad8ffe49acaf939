"""The slicer itself, on parts that take it a fraction of a second."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from manifold3d import Manifold

from printers import available_profiles, load_profile
from printers.errors import PrintersError
from printers.gcode.reading import read_gcode
from printers.profile import PrinterProfile
from printers.slicing.finding import required_slicer
from printers.slicing.making import refuse_other_settings, run_slicer, slice_mesh
from printers.slicing.prusa import prusa_settings
from printers.slicing.stl import binary_stl

pytestmark = pytest.mark.slicer

PROFILE = load_profile("prusa_i3")
Box = tuple[Any, Any]


def with_seam(seam: str) -> PrinterProfile:
    return PROFILE.model_copy(update={"slicer": PROFILE.slicer.model_copy(update={"seam": seam})})


@pytest.mark.parametrize("name", available_profiles())
def test_the_slicer_keeps_every_setting_of_every_profile(name: str, box: Box) -> None:
    profile = load_profile(name)
    sliced = slice_mesh(*box, profile)
    assert sliced.gcode.slicer == "PrusaSlicer" and sliced.warnings == ()
    assert sliced.gcode.beads.layer.max() + 1 == pytest.approx(
        1 + (4 - profile.first_layer_height) / profile.layer_height, abs=1
    )


@pytest.mark.parametrize("rotation", [0, 17, 90])
def test_beads_fill_the_part_in_its_own_coordinates(rotation: float, box: Box) -> None:
    sliced = slice_mesh(*box, PROFILE, rotation=rotation)
    beads = sliced.gcode.beads
    points = sliced.placement.to_part(np.column_stack((beads.start, beads.top)))
    half = PROFILE.line_width / 2
    np.testing.assert_allclose(points.min(axis=0)[:2], [40 + half, 50 + half], atol=0.1)
    np.testing.assert_allclose(points.max(axis=0), [52 - half, 58 - half, 64], atol=0.1)
    # Solid infill of 110 % that runs into the walls by half a line: more than the box, not twice.
    assert 1.0 < beads.volume.sum() / (12 * 8 * 4) < 1.4
    assert beads.volume.sum() == pytest.approx(
        sliced.gcode.filament_length * np.pi * PROFILE.filament.diameter**2 / 4, rel=1e-6
    )
    assert sliced.gcode.filament_length == pytest.approx(
        sliced.gcode.stated_filament_length, rel=1e-3
    )


def test_effective_widths_are_the_slicers_own_with_the_flow(box: Box) -> None:
    """A bead is a rectangle with round sides: as wide as stated, less h (1 - pi / 4)."""
    beads = slice_mesh(*box, PROFILE).gcode.beads
    long = beads.length > 1  # the rounding of short beads says nothing
    expected = beads.nominal_width - beads.height * (1 - np.pi / 4)
    ratio = beads.width[long] / expected[long] / (PROFILE.slicer.flow / 100)
    np.testing.assert_allclose(ratio, 1, atol=0.01)


def wall_with_a_handle() -> Box:
    """A curved wall of three lines: run as it is, the slicer lays it down differently each time."""
    outer = Manifold.cylinder(4, 10, 10, 96) + Manifold.cube((16, 6, 4)).translate((0, -3, 0))
    inner = Manifold.cylinder(4, 8.8, 8.8, 96) + Manifold.cube((14.8, 3.6, 4)).translate(
        (0, -1.8, 0)
    )
    mesh = (outer - inner).to_mesh()
    return mesh.vert_properties[:, :3], mesh.tri_verts


@pytest.mark.parametrize("seam", ["random", "rear"])
@pytest.mark.thorough
def test_slicing_is_reproducible_where_it_says_so(
    seam: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    one = slice_mesh(*wall_with_a_handle(), with_seam(seam))
    monkeypatch.setenv("MORE", "more" * 1000)
    other = slice_mesh(*wall_with_a_handle(), with_seam(seam))
    if not one.reproducible:
        pytest.skip("this system cannot fix a program's addresses")
    for name in one.gcode.beads.__dataclass_fields__:
        np.testing.assert_array_equal(
            getattr(one.gcode.beads, name), getattr(other.gcode.beads, name)
        )


def test_a_setting_that_the_slicer_does_not_know_is_noticed(box: Box, tmp_path: Path) -> None:
    settings = prusa_settings(PROFILE) + "airtightness = 1\n"
    (tmp_path / "settings.ini").write_text(settings)
    (tmp_path / "part.stl").write_bytes(binary_stl(box[0][box[1]].reshape(-1, 3)))
    assert run_slicer(required_slicer(), tmp_path, PROFILE, 60) == ()
    with pytest.raises(PrintersError, match=r"settings: airtightness = 1 was dropped$"):
        refuse_other_settings(settings, read_gcode(tmp_path / "part.gcode"))


@pytest.mark.parametrize("length", [0, 84, 300, -1])
def test_a_truncated_stl_is_noticed(length: int, box: Box, tmp_path: Path) -> None:
    (tmp_path / "settings.ini").write_text(prusa_settings(PROFILE))
    (tmp_path / "part.stl").write_bytes(binary_stl(box[0][box[1]].reshape(-1, 3))[:length])
    with pytest.raises(PrintersError, match=r"the slicer failed with status|made no G-code"):
        run_slicer(required_slicer(), tmp_path, PROFILE, 60)


def test_a_part_thinner_than_the_slicer_prints_is_an_error(box: Box) -> None:
    vertices, triangles = box
    with pytest.raises(PrintersError, match=r"the slicer failed with status .*empty"):
        slice_mesh(vertices * [0.004, 1, 1], triangles, PROFILE)


def test_what_floats_is_warned_of_in_the_slicers_words(box: Box) -> None:
    vertices, triangles = box
    both = np.concatenate((vertices, vertices + np.array([0, 0, 10])))
    sliced = slice_mesh(both, np.concatenate((triangles, triangles + len(vertices))), PROFILE)
    assert any("Empty layer" in warning for warning in sliced.warnings)


def test_the_time_limit_ends_the_slicer(box: Box) -> None:
    with pytest.raises(PrintersError, match=r"did not end within 0\.01 s"):
        slice_mesh(*box, PROFILE, seconds=0.01)
