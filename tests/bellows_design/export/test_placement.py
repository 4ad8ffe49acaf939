"""A part in a 3MF stands in the middle of its printer's bed, as it is printed."""

from __future__ import annotations

import zipfile
from dataclasses import replace
from io import BytesIO

import numpy as np
import pytest

from bellows_design.export.formats import WRITERS, Part
from bellows_design.export.placement import STANDING_AS_MADE, placement
from bellows_design.geometry.tessellation import ClosedMesh
from printers import PrinterProfile, load_profile


@pytest.fixture(scope="module")
def profile() -> PrinterProfile:
    """Its bed is 250 mm wide and 210 mm deep."""
    return load_profile("prusa_i3")


def stretched(part: Part, profile: PrinterProfile, *sides: float) -> Part:
    """The cube as a box of these sides, mm, somewhere in space."""
    vertices = part.mesh.vertices / 10 * np.array(sides) + np.array([-3.0, 7.0, -2.0])
    return replace(part, mesh=ClosedMesh(vertices, part.mesh.triangles), profile=profile)


@pytest.mark.parametrize("sides", [(10, 10, 10), (200, 30, 20), (249, 209, 5)])
def test_a_part_stands_in_the_middle_of_the_bed_on_z_0(
    sides: tuple[float, ...], cube_part: Part, profile: PrinterProfile
) -> None:
    part = stretched(cube_part, profile, *sides)
    points = placement(part)(part.mesh.vertices)
    middle = (points.min(axis=0) + points.max(axis=0)) / 2
    assert np.allclose(middle[:2], (125, 105), atol=1e-5) and abs(points[:, 2].min()) < 1e-5
    assert np.allclose(np.ptp(points, axis=0), sides)


def test_a_part_longer_than_the_bed_is_wide_is_turned(
    cube_part: Part, profile: PrinterProfile
) -> None:
    deep = profile.model_copy(update={"build_volume": (100.0, 300.0, 100.0)})
    part = stretched(cube_part, deep, 200, 30, 20)
    points = placement(part)(part.mesh.vertices)
    assert np.allclose(np.ptp(points, axis=0), (30, 200, 20)) and points.min() > -1e-5
    corners = points[part.mesh.triangles]
    volume = np.einsum("ij,ij->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6
    assert volume == pytest.approx(200 * 30 * 20)  # turned, not mirrored


def test_a_part_without_a_printer_keeps_its_place(cube_part: Part) -> None:
    assert placement(cube_part) == STANDING_AS_MADE


def test_the_3mf_places_the_item_and_keeps_the_mesh(
    cube_part: Part, profile: PrinterProfile
) -> None:
    content = WRITERS[".3mf"](stretched(cube_part, profile, 10, 10, 10))
    model = zipfile.ZipFile(BytesIO(content)).read("3D/3dmodel.model").decode()
    assert 'transform="1 0 0 0 1 0 0 0 1 123 93 2"' in model
    assert 'x="-3.000000" y="7.000000"' in model
