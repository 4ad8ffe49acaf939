"""Turning a part, and its places back."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from manifold3d import Manifold
from small_solids import arrays, hollow_box, port_of

from printers import PrintedModel, PrinterProfile, PrintersError
from printers.measure.part import MeasuredPart
from printers.orientation.turning import AXES, in_file, parse_up, place_in_file, turned
from printers.report import PrintabilityReport, RuleResult, place
from printers.rules.envelope import check_bed_contact


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
    assert placed.vertices[:, 2].min() == pytest.approx(0.0, abs=1e-12)
    np.testing.assert_allclose(
        place_in_file(placed.vertices, part, turning), part.vertices, atol=1e-12
    )
    where = place(opening.centre)
    result = RuleResult("airtightness", "fail", "", "", "", where, f"a leak at {where} here")
    report = PrintabilityReport("any", (result.at(opening.centre),))
    (there,) = in_file(report, part, turning).rules
    assert there.points == (port_of().centre,)
    assert there.where == "(0.0, 5.2, 5.2) mm"
    assert there.message == "a leak at (0.0, 5.2, 5.2) mm here"


@pytest.mark.parametrize("up", ["X", "-Z", "1,2,3", "-0.3,0.2,-1"])
def test_heights_of_a_turned_part_count_from_the_bed(up: str, prusa: PrinterProfile) -> None:
    part = turned(model(hollow_box().translate((30, -40, 50))), parse_up(up))
    (result,) = check_bed_contact(MeasuredPart(part, prusa))
    assert "on the bed at z = 0.00 mm" in result.message
    assert "-0" not in str(result.measured)


@pytest.mark.parametrize("tilt", 10.0 ** np.arange(-18, 0))
@pytest.mark.parametrize("upright", [1.0, -1.0])
def test_near_an_axis_the_turn_is_a_rotation_too(tilt: float, upright: float) -> None:
    turning = parse_up(f"{0.6 * tilt},{-0.8 * tilt},{upright}")
    np.testing.assert_allclose(turning.matrix @ turning.matrix.T, np.eye(3), atol=1e-14)
    np.testing.assert_allclose(turning.matrix @ turning.up, (0, 0, 1), atol=1e-14)
    assert np.linalg.det(turning.matrix) == pytest.approx(1.0, abs=1e-14)


def test_a_part_that_stands_as_it_is_stays_the_same() -> None:
    part = model(hollow_box())
    assert turned(part, parse_up("Z")) is part
