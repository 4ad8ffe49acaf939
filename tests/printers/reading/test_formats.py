"""The same part out of every format."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from part_files import (
    binary_stl,
    mesh_xml,
    model_xml,
    object_xml,
    package,
    text_stl,
    three_mf,
)
from small_solids import arrays, hollow_box

from printers.measure.surface import merged_surface
from printers.reading.part import ReadPart
from printers.reading.read import read_part

VERTICES, TRIANGLES = arrays(hollow_box())
VOLUME = merged_surface(VERTICES, TRIANGLES).volume()
IDENTITY = "1 0 0 0 1 0 0 0 1 0 0 0"


def read(content: bytes, suffix: str, folder: Path) -> ReadPart:
    path = folder / f"part{suffix}"
    path.write_bytes(content)
    return read_part(path)


def require_the_box(part: ReadPart, scale: float = 1.0) -> None:
    surface = merged_surface(part.vertices, part.triangles)
    assert surface.is_closed and len(surface.triangles) == len(TRIANGLES)
    assert surface.volume() == pytest.approx(VOLUME * scale**3, rel=1e-5)
    np.testing.assert_allclose(surface.bounds[1], VERTICES.max(axis=0) * scale, rtol=1e-6)


@pytest.mark.parametrize(
    ("content", "suffix", "kind"),
    [
        (binary_stl(VERTICES, TRIANGLES), ".stl", "STL, binary"),
        (binary_stl(VERTICES, TRIANGLES, b"solid facet of a program"), ".stl", "STL, binary"),
        (binary_stl(VERTICES, TRIANGLES) + b"\0" * 512, ".stl", "STL, binary"),
        (binary_stl(VERTICES, TRIANGLES) + b"made by me", ".STL", "STL, binary"),
        (text_stl(VERTICES, TRIANGLES), ".stl", "STL, text"),
        (text_stl(VERTICES, TRIANGLES, "\r\n", "two words"), ".stl", "STL, text"),
        (text_stl(VERTICES, TRIANGLES, "\n", ""), ".stl", "STL, text"),
        (b"\xef\xbb\xbf" + text_stl(VERTICES, TRIANGLES) + b"\n \n", ".stl", "STL, text"),
        (text_stl(VERTICES, TRIANGLES).upper(), ".stl", "STL, text"),
        (three_mf(VERTICES, TRIANGLES), ".3mf", "3MF"),
    ],
)
def test_every_dialect_gives_the_same_surface(
    content: bytes, suffix: str, kind: str, tmp_path: Path
) -> None:
    part = read(content, suffix, tmp_path)
    assert part.format == kind
    require_the_box(part)


@pytest.mark.slow
def test_a_step_file_gives_the_same_surface(tmp_path: Path) -> None:
    """Its tessellation is its own; the shape is plane but for the port."""
    import cadquery as cq

    wall, inner = 1.2, (12.0, 8.0, 8.0)
    outer = cq.Workplane().box(14.4, 10.4, 10.4, centered=False)
    cavity = cq.Workplane().box(*inner, centered=False).translate((wall, wall, wall))
    port = cq.Workplane("YZ").center(5.2, 5.2).circle(1).extrude(2)
    path = tmp_path / "part.stp"
    cq.exporters.export(outer.cut(cavity).cut(port), str(path), "STEP")
    part = read_part(path)
    surface = merged_surface(part.vertices, part.triangles)
    assert part.format == "STEP" and part.units == "millimetre" and part.notes == ()
    assert surface.is_closed and surface.volume() == pytest.approx(VOLUME, rel=1e-3)


def test_lengths_of_a_3mf_are_in_its_own_unit(tmp_path: Path) -> None:
    for unit, scale in (("inch", 25.4), ("centimeter", 10.0), ("micron", 1e-3), (None, 1.0)):
        part = read(three_mf(VERTICES, TRIANGLES, unit), ".3mf", tmp_path)
        require_the_box(part, scale)
        assert part.units == (unit or "not stated: millimeter, as 3MF has it then")


def test_an_stl_states_no_units_and_that_is_said(tmp_path: Path) -> None:
    assert "not stated" in read(binary_stl(VERTICES, TRIANGLES), ".stl", tmp_path).units


def test_items_and_components_stand_at_their_places(tmp_path: Path) -> None:
    """Two copies, one of them mirrored and turned, in an object that is itself moved."""
    objects = object_xml(1, mesh_xml(VERTICES, TRIANGLES)) + object_xml(
        2,
        '<components><component objectid="1"/>'
        '<component objectid="1" transform="-1 0 0 0 1 0 0 0 1 0 20 0"/></components>',
    )
    build = '<item objectid="2" transform="1 0 0 0 1 0 0 0 1 100 0 5"/>'
    part = read(package(model_xml(objects, build)), ".3mf", tmp_path)
    surface = merged_surface(part.vertices, part.triangles)
    assert surface.volume() == pytest.approx(2 * VOLUME)  # the mirror image is not inside out
    np.testing.assert_allclose(surface.bounds, [[85.6, 0, 5], [114.4, 30.4, 15.4]], atol=1e-9)


def test_an_object_in_another_file_of_the_package_is_found(tmp_path: Path) -> None:
    other = model_xml(object_xml(7, mesh_xml(VERTICES, TRIANGLES)), "")
    link = '<components><component objectid="7" p:path="/3D/other.model"/></components>'
    model = model_xml(object_xml(1, link), '<item objectid="1"/>')
    require_the_box(read(package(model, **{"3D/other.model": other}), ".3mf", tmp_path))


def test_supports_and_what_is_not_printed_are_left_out_and_named(tmp_path: Path) -> None:
    mesh = mesh_xml(VERTICES, TRIANGLES)
    objects = object_xml(1, mesh) + object_xml(2, mesh, "support")
    build = '<item objectid="1"/><item objectid="2"/><item objectid="1" printable="0"/>'
    part = read(package(model_xml(objects, build)), ".3mf", tmp_path)
    require_the_box(part)
    assert any("1 supports left out" in note for note in part.notes)
    assert any("1 items left out" in note for note in part.notes)


def test_several_solids_in_one_text_are_said(tmp_path: Path) -> None:
    twice = text_stl(VERTICES, TRIANGLES) + text_stl(VERTICES + 50, TRIANGLES)
    part = read(twice, ".stl", tmp_path)
    assert len(part.triangles) == 2 * len(TRIANGLES) and part.notes == ("2 solids in one file",)
