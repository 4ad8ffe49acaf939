"""The thinnest seal of boxes whose walls are known."""

from __future__ import annotations

import pytest
from bead_boxes import CAVITY, PITCH, WIDTH, Box, with_gap

from printers.leak_test.depth import CLOSED_VOID, Crossing, thinnest_seal
from printers.leak_test.field import level_of, paint
from printers.leak_test.painting import AIR
from printers.leak_test.widest_path import air

LINE = 0.4


def seal(box: Box, stretch: float = 1.0, open_from: int = AIR, voxel: float = 0.05) -> Crossing:
    field = paint(box.beads, voxel, LINE)
    marks, leaking = air(field, [box.opening], open_from)
    assert not leaking
    return thinnest_seal(field, marks, open_from, stretch)


@pytest.mark.parametrize("lines", [1, 2, 3, 4])
@pytest.mark.parametrize("angle", [0.0, 17.0, 45.0])
def test_walls_are_as_deep_as_their_lines(lines: int, angle: float) -> None:
    box = Box(lines=lines, floor=12, angle=angle)
    assert seal(box).millimetres == pytest.approx(box.wall_thickness, abs=0.06)


def test_a_floor_is_as_deep_as_its_layers() -> None:
    box = Box(lines=5, floor=5)
    found = seal(box)
    assert found.millimetres == pytest.approx(1.0, abs=0.03)
    assert found.middle[2] == pytest.approx(0.5, abs=0.05)


def test_stretched_heights_make_a_floor_deeper_than_a_wall() -> None:
    box = Box(lines=3, floor=5)  # 1.18 mm of wall, 1 mm of floor
    assert abs(seal(box).middle[2] - 0.5) < 0.1
    wall = seal(box, stretch=1.5)
    assert wall.middle[2] > 1.0
    assert wall.length == pytest.approx(box.wall_thickness, abs=0.05)


def test_the_place_is_the_middle_of_the_thin_wall() -> None:
    """One layer's innermost loop is open: two loops seal there."""
    box = Box(wall=with_gap(0.4, lambda z, number: number == 0 and 4.3 < z < 4.5), floor=12)
    found = seal(box)
    assert found.millimetres == pytest.approx(PITCH + WIDTH, abs=0.06)
    assert found.middle[0] == pytest.approx(CAVITY + 1.5 * PITCH, abs=0.1)
    assert abs(found.middle[1]) < 0.25


@pytest.mark.parametrize("gap", [0.03, 0.3])
def test_only_narrow_voids_count_as_closed(gap: float) -> None:
    """A gap of 0.03 mm has F up to 1.07, one of 0.3 mm up to 1.7."""
    box = Box(wall=with_gap(gap, lambda z, number: number == 0), floor=12)
    every = seal(box)
    melted = seal(box, open_from=level_of(CLOSED_VOID))
    assert every.length < box.wall_thickness - 0.8 * PITCH
    assert (melted.length > every.length + 0.2) == (gap < 0.1)


def test_coarser_cells_find_the_same_depth() -> None:
    """Within a quarter of the coarser cells' four to a line."""
    fine, coarse = (seal(Box(), voxel=voxel).length for voxel in (0.05, 0.1))
    assert coarse == pytest.approx(fine, abs=0.12)
