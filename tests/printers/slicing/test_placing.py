"""Where the part stands on the bed."""

from __future__ import annotations

import numpy as np
import pytest

from printers import load_profile
from printers.arrays import Floats
from printers.errors import PrintersError
from printers.gcode.beads import EXTERNAL_PERIMETER, SKIRT, Beads
from printers.slicing.placing import misplaced, placed, turned_to_fit

PROFILE = load_profile("prusa_i3")
POINTS = np.random.default_rng(1).uniform(-30, 60, (50, 3))


@pytest.mark.parametrize("rotation", [0, 17, 45, 90, -90, 180, 270, 360, 725.5])
def test_the_part_lies_in_the_middle_of_the_bed_and_finds_back(rotation: float) -> None:
    placement = placed(POINTS, rotation, PROFILE)
    on_bed = placement.to_gcode(POINTS)
    middle = (on_bed.min(axis=0) + on_bed.max(axis=0)) / 2
    np.testing.assert_allclose(middle[:2], [125, 105])
    assert on_bed[:, 2].min() == pytest.approx(0, abs=1e-12)
    np.testing.assert_allclose(placement.to_part(on_bed), POINTS, atol=1e-12)
    distances = np.linalg.norm(np.diff(POINTS, axis=0), axis=1)
    np.testing.assert_allclose(np.linalg.norm(np.diff(on_bed, axis=0), axis=1), distances)


def test_turns_are_anticlockwise_seen_from_above() -> None:
    on_bed = placed(np.array([[0.0, 0, 0], [10, 0, 0]]), 90, PROFILE).to_gcode(np.eye(3) * 10)
    np.testing.assert_array_equal(on_bed[0] - on_bed[1], [10, 10, 0])


def test_quarter_turns_are_exact() -> None:
    turned = placed(POINTS, 90, PROFILE).to_gcode(POINTS)
    again = placed(POINTS, 360 + 90, PROFILE).to_gcode(POINTS)
    np.testing.assert_array_equal(turned, again)


@pytest.mark.parametrize(("axis", "size"), [(0, 250.1), (1, 210.1), (2, 210.1)])
def test_a_part_that_does_not_fit_is_refused_by_its_side(axis: int, size: float) -> None:
    corner = np.full(3, 10.0)
    corner[axis] = size
    with pytest.raises(PrintersError, match=rf"{size} mm long in {'xyz'[axis]}; prusa_i3 prints"):
        placed(np.array([np.zeros(3), corner]), 0, PROFILE)


@pytest.mark.parametrize("rotation", [float("nan"), float("inf"), -1e9])
def test_a_rotation_that_is_none_is_refused(rotation: float) -> None:
    with pytest.raises(PrintersError, match=r"rotation is .*; it must lie within ±36000°"):
        placed(POINTS, rotation, PROFILE)


def test_a_long_part_fits_when_it_is_turned() -> None:
    long = np.array([[0, 0, 0], [5.0, 230, 5]])
    with pytest.raises(PrintersError, match=r"230\.0 mm long in y"):
        placed(long, 0, PROFILE)
    placed(long, 90, PROFILE)


def loop(
    lower: list[float],
    upper: list[float],
    kind: int = EXTERNAL_PERIMETER,
    bottom: float = 0.0,
    top: float = 10.0,
) -> Beads:
    """Beads 0.4 mm wide whose outer sides are the rectangle, in one layer."""
    (x0, y0), (x1, y1) = np.array(lower) + 0.2, np.array(upper) - 0.2
    corners = np.array([[x0, y0], [x1, y0], [x1, y1], [x0, y1], [x0, y0]])
    full = np.full(4, 0.4)
    count = np.zeros(4, dtype=np.int64)
    tops, height = np.full(4, top), np.full(4, top - bottom)
    return Beads(corners[:-1], corners[1:], tops, height, full, full, count + kind, count, count)


ON_BED: Floats = np.array([[100.0, 100, 0], [130, 120, 10]])


def test_beads_as_wide_as_the_part_are_well_placed() -> None:
    assert misplaced(loop([100, 100], [130, 120]), ON_BED, 0.4) == []
    assert misplaced(loop([99.7, 100.3], [130.3, 119.7]), ON_BED, 0.4) == []


def test_a_part_that_the_slicer_moved_is_refused() -> None:
    with pytest.raises(PrintersError, match=r"moved the part by 1\.50 mm in x"):
        misplaced(loop([101.5, 100], [131.5, 120]), ON_BED, 0.4)
    with pytest.raises(PrintersError, match=r"moved the part by -0\.50 mm in y"):
        misplaced(loop([100, 99.5], [130, 119.5]), ON_BED, 0.4)


def test_a_side_that_the_slicer_left_out_is_told() -> None:
    (note,) = misplaced(loop([100, 100], [127, 120]), ON_BED, 0.4)
    assert "nothing is laid down on the last 3.00 mm towards +x" in note
    assert len(misplaced(loop([103, 100], [127, 120]), ON_BED, 0.4)) == 2


@pytest.mark.parametrize(
    ("bottom", "top", "told"),
    [(0.0, 5.0, "5.00 mm towards +z"), (2.0, 10.0, "2.00 mm towards -z"), (0.3, 9.7, None)],
)
def test_layers_that_are_missing_are_told(bottom: float, top: float, told: str | None) -> None:
    notes = misplaced(loop([100, 100], [130, 120], bottom=bottom, top=top), ON_BED, 0.4)
    assert len(notes) == (told is not None) and (told is None or told in notes[0])


def test_a_part_that_floats_is_refused() -> None:
    with pytest.raises(PrintersError, match=r"moved the part by 1\.50 mm in z"):
        misplaced(loop([100, 100], [130, 120], bottom=1.5, top=11.5), ON_BED, 0.4)


@pytest.mark.parametrize(
    ("length", "width", "turned"),
    [(100, 240, True), (240, 100, False), (250, 210, False), (210, 250, True), (100, 100, False),
     (251, 100, False), (100, 251, False), (250, 211, False), (230, 215, False)],
)  # fmt: skip
def test_a_part_is_turned_where_it_fits_only_so(length: int, width: int, turned: bool) -> None:
    """The bed is 250 by 210 mm; what fits neither way is left as it is."""
    corners = np.array([[0.0, 0, 0], [length, width, 5]])
    assert turned_to_fit(corners, PROFILE) is turned
    if turned:
        placed(corners, 90, PROFILE)


def test_the_box_of_the_part_is_that_of_its_plastic() -> None:
    lower, upper = loop([100, 100], [130, 120], bottom=1, top=3).part_box
    np.testing.assert_allclose([lower, upper], [[100, 100, 1], [130, 120, 3]])


def test_skirts_say_nothing_of_the_part() -> None:
    with pytest.raises(PrintersError, match="nothing of the part"):
        misplaced(loop([90, 90], [140, 130], SKIRT), ON_BED, 0.4)
