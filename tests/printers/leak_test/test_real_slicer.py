"""The leak test on what PrusaSlicer makes of small parts."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from broken_parts import BrokenPart, dent_inside, pin_hole_in_wall, sound_box

from printers import Opening, load_profile
from printers.leak_test import LeakTest, leak_test
from printers.slicing.making import slice_mesh

pytestmark = [pytest.mark.slow, pytest.mark.slicer]


@cache
def result_of(make: type[BrokenPart], rotation: float = 0.0) -> tuple[BrokenPart, LeakTest]:
    part, profile = make(), load_profile("prusa_i3")
    sliced = slice_mesh(part.vertices, part.triangles, profile, rotation=rotation)
    ahead = np.add(part.opening.centre, part.opening.direction)
    ends = sliced.placement.to_gcode(np.array([part.opening.centre, ahead]))
    centre, direction = (tuple(row) for row in (ends[0], ends[1] - ends[0]))
    opening = Opening("port", centre, direction, part.opening.radius)
    beads, back = sliced.gcode.beads, sliced.placement.to_part
    return part, leak_test(beads, [opening], profile, transform=back, seams=False)


@pytest.mark.parametrize("rotation", [0.0, 17.0, 45.0])
def test_a_sound_box_is_sealed_and_three_lines_deep(rotation: float) -> None:
    _, test = result_of(sound_box, rotation)
    assert test.verdict == "sealed"
    assert test.ratio == pytest.approx(1 / 1.1, abs=0.03)  # beads overlap by the flow
    assert 2.7 < test.depth.lines < 3.4


def test_a_pin_hole_is_found_where_it_is() -> None:
    part, test = result_of(pin_hole_in_wall)
    assert test.verdict == "leaks"
    assert 0.1 < test.width < 0.2
    assert part.distance(test.leaks[0].place) < 0.5


def test_a_dent_is_found_by_its_depth() -> None:
    part, test = result_of(dent_inside)
    assert test.verdict == "sealed"
    assert [rule.verdict for rule in test.rules if rule.rule == "printed_depth"] == ["fail"]
    assert test.depth.place is not None and part.distance(test.depth.place) < 0.5
    assert test.depth.millimetres == pytest.approx(0.5, abs=0.2)
