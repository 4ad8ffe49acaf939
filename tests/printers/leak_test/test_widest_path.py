"""The widest path between beads laid by hand, against closed forms.

Half-way between two beads at the distance p, F is p over their width w. Between two round ends with
a gap g of air, their axes ending g + w from each other, it is 1 + g / w.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from bead_boxes import (
    CAVITY,
    PITCH,
    WIDTH,
    Box,
    beads_of,
    in_pieces,
    joined_beads,
    rotation,
    with_gap,
)

from printers import Opening, PrintersError
from printers.leak_test.field import Field, paint
from printers.leak_test.field import ratio_of as field_ratio
from printers.leak_test.painting import SHALLOWEST
from printers.leak_test.plugs import cavity_start
from printers.leak_test.widest_path import crossing, narrowest, widest_path

VOXEL = 0.05
LINE = 0.4


def ratio_of(box: Box, voxel: float = VOXEL) -> float:
    return widest_path(field_of(box, voxel), [box.opening]).ratio


def field_of(box: Box, voxel: float = VOXEL) -> Field:
    return paint(box.beads, voxel, LINE)


def test_air_passes_a_sound_box_half_way_between_its_beads() -> None:
    assert ratio_of(Box()) == pytest.approx(PITCH / WIDTH, abs=0.01)


@pytest.mark.parametrize("gap", [0.05, 0.1, 0.2, 0.4])
def test_a_gap_in_all_loops_gives_its_width(gap: float) -> None:
    box = Box(wall=with_gap(gap, lambda z, number: 2.3 < z < 2.5))
    field = field_of(box)
    path = widest_path(field, [box.opening])
    computed = gap <= 0.2  # wider gaps are summed from cell to cell
    assert path.ratio == pytest.approx(1 + gap / WIDTH, abs=0.03 if computed else 0.1)
    place = field.place_of(np.array([narrowest(field, crossing(field, path))]))[0]
    assert np.abs(place - [(CAVITY + box.outer) / 2, 0, 2.3]).max() < box.wall_thickness / 2 + 0.1
    assert abs(place[1]) < 0.05 and abs(place[2] - 2.3) < 0.11


def test_a_gap_in_one_of_three_loops_is_closed_by_the_others() -> None:
    box = Box(wall=with_gap(0.3, lambda z, number: number == 1))
    assert ratio_of(box) == pytest.approx(PITCH / WIDTH, abs=0.01)


@pytest.mark.parametrize("voxel", [0.1, VOXEL, VOXEL / 2])
def test_gaps_that_do_not_lie_on_each_other_are_closed(voxel: float) -> None:
    """The innermost loop is open below, the others above: their beads overlap by a tenth."""
    box = Box(wall=with_gap(0.3, lambda z, number: (number == 0) == (z < 3)))
    assert ratio_of(box, voxel) == pytest.approx(PITCH / WIDTH, abs=0.03)


SPACED = 0.5
"""mm between the lines of a grate: half-way between two of them F is 0.5 / 0.42 = 1.19."""


def step_of(turn: float, shift: float, angle: float, voxel: float) -> float:
    """The widest step between two grates on each other, the upper one turned and shifted."""
    layers = []
    for layer, (own, aside) in enumerate([(0.0, 0.0), (turn, shift)]):
        for number in range(-8, 9):
            ends = np.array([[-4.0, number * SPACED + aside], [4.0, number * SPACED + aside]])
            line = ends @ rotation(own + angle).T
            layers.append(beads_of(line, 0.2 * (layer + 1), 0.2, 20 * layer + number))
    field = paint(joined_beads(layers), voxel, LINE)
    middle = [slice(count // 2 - round(1 / voxel), count // 2 + round(1 / voxel))
              for count in field.levels.shape[1:]]  # fmt: skip
    return float(field_ratio(field.links[1][tuple(middle)].max()))


@pytest.mark.parametrize("voxel", [0.1, VOXEL, VOXEL / 2])
@pytest.mark.parametrize("angle", [0.0, 17.0, 45.0, 73.0])
def test_voids_of_two_layers_meet_where_they_cross(angle: float, voxel: float) -> None:
    assert step_of(90.0, 0.13, angle, voxel) == pytest.approx(SPACED / WIDTH, abs=0.03)


@pytest.mark.parametrize("voxel", [0.1, VOXEL, VOXEL / 2])
@pytest.mark.parametrize("angle", [0.0, 17.0, 45.0, 73.0])
@pytest.mark.parametrize("shift", [0.0125, 0.025, 0.05, 0.1, 0.15])
def test_a_step_between_voids_beside_each_other_is_their_widest_common_point(
    shift: float, angle: float, voxel: float
) -> None:
    """Half-way between two ridges at the distance d either F is (p - d) / w."""
    assert step_of(0.0, shift, angle, voxel) == pytest.approx((SPACED - shift) / WIDTH, abs=0.03)


@pytest.mark.parametrize("voxel", [0.1, VOXEL, VOXEL / 2])
@pytest.mark.parametrize("angle", [0.0, 17.0, 45.0])
def test_there_is_no_step_between_voids_half_a_line_apart(angle: float, voxel: float) -> None:
    """F is 0.6 at most; below `SHALLOWEST` what is found may be too large, never beyond it."""
    assert step_of(0.0, SPACED / 2, angle, voxel) <= SHALLOWEST + 0.01


def test_air_goes_up_from_layer_to_layer() -> None:
    """Gaps of two layers that touch make one path."""
    low, high = (lambda z: 2.3 < z < 2.7), (lambda z: 2.5 < z < 2.9)
    one = Box(wall=with_gap(0.2, lambda z, number: low(z) if number == 0 else high(z)))
    assert ratio_of(one) == pytest.approx(1 + 0.2 / WIDTH, abs=0.03)


@pytest.mark.parametrize("angle", [17.0, 45.0, 90.0])
@pytest.mark.parametrize("gap", [None, 0.03, 0.2])
def test_turning_the_part_moves_it_by_less_than_three_hundredths(
    angle: float, gap: float | None
) -> None:
    box = Box() if gap is None else Box(wall=with_gap(gap))
    assert ratio_of(replace(box, angle=angle)) == pytest.approx(ratio_of(box), abs=0.03)


@pytest.mark.parametrize("angle", [0.0, 17.0])
@pytest.mark.parametrize("gap", [None, 0.03, 0.2])
def test_halving_the_voxel_moves_it_by_less_than_three_hundredths(
    angle: float, gap: float | None
) -> None:
    box = Box(angle=angle) if gap is None else Box(wall=with_gap(gap), angle=angle)
    assert ratio_of(box, VOXEL / 2) == pytest.approx(ratio_of(box), abs=0.03)


def test_right_angles_are_closed_by_their_mitres() -> None:
    """Between round joins at the distance p√2 along the diagonal, F is 1.17 p / w.

    The distance d from the inner corner and the one from the outer loop's sides are equal where
    d (1 + 1 / √2) = p √2 / √2, so F = 2 d / w = 2 p / (1 + 1 / √2) / w = 1.17 p / w.
    """
    round_joins = 2 / (1 + 0.5**0.5) * PITCH / WIDTH
    assert round_joins > 1.05
    assert ratio_of(Box()) < 0.95
    pieces = Box(lines=2, wall=in_pieces, floor=8)
    inner = field_of(pieces)
    layer = inner.layer_at(3.0)
    corner = CAVITY + 2 / (1 + 0.5**0.5) * PITCH / 2 / 2**0.5
    i, j = (round((corner - start) / VOXEL) for start in inner.corner)
    around = inner.levels[layer, j - 2 : j + 3, i - 2 : i + 3].max()
    assert around / 125 == pytest.approx(round_joins, abs=0.05)


def test_a_bead_fills_all_layers_it_reaches_through() -> None:
    """A bridge twice as high as a layer closes the gap in the layer below its own too."""
    box = Box(wall=with_gap(0.3, lambda z, number: 2.3 < z < 2.7))  # two layers are open
    assert ratio_of(box) > 1.05
    ends = np.array([[1.0, 0.0], [3.0, 0.0]])
    bridge = beads_of(ends, 2.6, 0.4, 10_000)
    closed = paint(joined_beads([box.beads, bridge]), VOXEL, LINE)
    assert widest_path(closed, [box.opening]).ratio < 0.95
    flat = paint(joined_beads([box.beads, replace(bridge, height=np.array([0.2]))]), VOXEL, LINE)
    assert widest_path(flat, [box.opening]).ratio > 1.05


def test_an_opening_off_the_part_is_refused() -> None:
    field = field_of(Box())
    beside = Opening("port", (30.0, 0.0, 3.0), (0.0, 0.0, 1.0), 0.8)
    with pytest.raises(PrintersError, match="no opening of the sliced part"):
        cavity_start(field, [beside])


def test_an_opening_that_points_inwards_has_no_air_behind_it() -> None:
    box = Box()
    field = field_of(box)
    inwards = replace(box.opening, direction=(0.0, 0.0, -1.0))
    with pytest.raises(PrintersError, match=r"no opening|no air lies"):
        cavity_start(field, [inwards])
