"""Rounded boxes against closed forms, and names that survive boolean operations."""

from __future__ import annotations

import math

import cadquery as cq
import pytest

from bellows_design.geometry.named_solids import (
    GeometryError,
    box,
    cut,
    fused,
    named,
    prism,
    rounded_box,
)

SIZES = [
    ((2.0, 5.0, 7.0), 0.5),
    ((2.0, 5.0, 7.0), 1.0),  # full round along x
    ((1.4, 17.6, 17.6), 0.7),  # the chamber of Prototype 2
    ((3.8, 20.0, 20.0), 1.9),  # its bubble
    ((1.1, 2.3, 9.0), 0.55),  # half of a length without exact binary form
    ((4.0, 4.0, 9.0), 2.0),  # a capsule
    ((9.0, 4.0, 4.0), 2.0),
    ((3.0, 3.0, 3.0), 1.5),  # a ball
]


def steiner_volume(size: tuple[float, float, float], radius: float) -> float:
    """Volume of a box rounded on all edges: its core thickened by ``radius`` (Steiner)."""
    a, b, c = (extent - 2 * radius for extent in size)
    faces, edges = 2 * (a * b + b * c + c * a), math.pi * (a + b + c)
    return a * b * c + faces * radius + edges * radius**2 + 4 / 3 * math.pi * radius**3


def steiner_area(size: tuple[float, float, float], radius: float) -> float:
    a, b, c = (extent - 2 * radius for extent in size)
    edges = 2 * math.pi * (a + b + c)
    return 2 * (a * b + b * c + c * a) + edges * radius + 4 * math.pi * radius**2


def placed(size: tuple[float, float, float], radius: float) -> cq.Solid:
    lower = (-3.0, 0.25, 1.6)
    x, y, z = (low + extent for low, extent in zip(lower, size, strict=True))
    return rounded_box(lower, (x, y, z), radius)


@pytest.mark.parametrize(("size", "radius"), SIZES)
def test_a_rounded_box_has_the_volume_and_area_of_its_closed_form(
    size: tuple[float, float, float], radius: float
) -> None:
    solid = placed(size, radius)
    assert solid.Volume() == pytest.approx(steiner_volume(size, radius), rel=1e-6)
    assert solid.Area() == pytest.approx(steiner_area(size, radius), rel=1e-6)


@pytest.mark.parametrize(("size", "radius"), SIZES)
def test_a_rounded_box_keeps_its_place(size: tuple[float, float, float], radius: float) -> None:
    bounds = placed(size, radius).BoundingBox(1e-4)
    assert (bounds.xmin, bounds.ymin, bounds.zmin) == pytest.approx((-3.0, 0.25, 1.6), abs=1e-3)
    assert (bounds.xlen, bounds.ylen, bounds.zlen) == pytest.approx(size, abs=1e-3)


@pytest.mark.parametrize(("size", "radius"), SIZES)
def test_a_full_round_has_no_slivers(size: tuple[float, float, float], radius: float) -> None:
    """Faces are octants, quarter cylinders and planes, or absent; nothing in between."""
    solid = placed(size, radius)
    assert solid.isValid()
    flat = sum(extent - 2 * radius > 1e-9 for extent in size)
    expected = 8 + 4 * flat + {3: 6, 2: 2, 1: 0, 0: 0}[flat]
    assert len(solid.Faces()) == expected
    assert min(face.Area() for face in solid.Faces()) > 0.4 * radius**2


def test_without_a_radius_it_is_a_box() -> None:
    solid = placed((2.0, 5.0, 7.0), 0.0)
    assert len(solid.Faces()) == 6
    assert solid.Volume() == pytest.approx(70)


def test_a_radius_beyond_half_of_the_box_is_refused() -> None:
    with pytest.raises(ValueError, match=r"radius = 1\.1 mm exceeds half of the box, 1 mm"):
        placed((2.0, 5.0, 7.0), 1.1)


def test_a_prism_stands_on_its_profile_across_y() -> None:
    corners = [cq.Vector(x, 0, z) for x, z in ((0, 0), (3, 0), (0, 2), (0, 0))]
    solid = prism(cq.Wire.makePolygon(corners), -1.5, 4.0)
    bounds = solid.BoundingBox()
    assert solid.Volume() == pytest.approx(3 * 5.5)
    assert (bounds.ymin, bounds.ymax) == pytest.approx((-1.5, 4.0), abs=1e-5)


def test_a_hollow_has_the_name_of_what_was_cut() -> None:
    body = cut(named(box((0, 0, 0), (4, 4, 4)), "skin"), named(box((1, 1, 1), (2, 3, 3)), "hollow"))
    assert body.area("skin") == pytest.approx(6 * 16)
    assert body.area("hollow") == pytest.approx(2 * (2 + 2 + 4))
    assert set(body.face_names) == {"skin", "hollow"}


def test_a_joint_disappears_and_shared_faces_keep_the_first_name() -> None:
    left = named(box((0, 0, 0), (3, 2, 2)), "left")
    right = named(box((2, 0, 0), (5, 2, 2)), "right")  # flush with the left on 2 < x < 3
    joined = fused(left, right)
    assert joined.solid.Volume() == pytest.approx(20)
    assert joined.area("left") == pytest.approx(4 + 4 * 2 * 3)
    assert joined.area("right") == pytest.approx(4 + 4 * 2 * 2)


def test_renaming_sees_every_face() -> None:
    block = named(box((0, 0, 0), (1, 2, 3)), "side").renamed(
        lambda face, own: "top" if face.normalAt().z > 0.5 else own
    )
    assert block.area("top") == pytest.approx(2)
    assert block.area("side") == pytest.approx(22 - 2)


def test_pieces_that_do_not_touch_are_no_part() -> None:
    far = named(box((9, 0, 0), (10, 1, 1)), "far")
    with pytest.raises(GeometryError, match="falls into 2 solids instead of one"):
        fused(named(box((0, 0, 0), (1, 1, 1)), "near"), far)
    slab = named(box((0.4, -1, -1), (0.6, 2, 2)), "saw")
    with pytest.raises(GeometryError, match="falls into 2 solids instead of one"):
        cut(named(box((0, 0, 0), (1, 1, 1)), "near"), slab)
