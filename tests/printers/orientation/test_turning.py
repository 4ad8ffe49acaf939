"""Turning a part, and its places back."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from manifold3d import Manifold
from small_solids import arrays, hollow_box, port_of

from printers import PrintedModel, PrintersError
from printers.orientation.turning import AXES, parse_up, places_in_file, turned
from printers.report import place


def model(solid: Manifold, **declared: Any) -> PrintedModel:
    return PrintedModel(*arrays(solid), **declared)


@pytest.mark.parametrize("up", [*AXES, "1,2,3", "0,0.1,-1", "-1e-3,0,-7"])
def test_the_direction_points_up_and_the_turn_is_a_rotation(up: str) -> None:
    turning = parse_up(up)
    np.testing.assert_allclose(turning.matrix @ turning.up, (0, 0, 1), atol=1e-9)
    np.testing.assert_allclose(turning.matrix @ turning.matrix.T, np.eye(3), atol=1e-9)
    assert np.linalg.det(turning.matrix) == pytest.approx(1.0)


@pytest.mark.parametrize("axis", AXES)
def test_turns_onto_an_axis_are_exact_and_named_by_it(axis: str) -> None:
    turning = parse_up(axis.lower())
    assert turning.name == axis and set(np.abs(turning.matrix).ravel()) == {0.0, 1.0}


@pytest.mark.parametrize("text", ["", "U", "0,0,0", "1,2", "nan,0,1", "1,2,3,4", "inf,0,0"])
def test_what_is_no_direction_is_refused(text: str) -> None:
    with pytest.raises(PrintersError, match="it must be X, -X"):
        parse_up(text)


@pytest.mark.parametrize("up", ["X", "-Y", "-Z", "1,1,0"])
def test_openings_turn_with_the_part_and_places_turn_back(up: str) -> None:
    turning, part = parse_up(up), model(hollow_box(), openings=(port_of(),))
    placed = turned(part, turning)
    (opening,) = placed.openings
    np.testing.assert_allclose(turning.matrix @ port_of().centre, opening.centre, atol=1e-12)
    there = places_in_file(f"a leak at {place(opening.centre)} here", turning)
    # a place is written with one digit, on the bed and in the file
    numbers = [float(word.strip("(),")) for word in there.split()[3:6]]
    np.testing.assert_allclose(numbers, port_of().centre, atol=0.15)
    assert there.startswith("a leak at (") and there.endswith(" mm here")


def test_a_part_that_stands_as_it_is_stays_the_same() -> None:
    part = model(hollow_box())
    assert turned(part, parse_up("Z")) is part
