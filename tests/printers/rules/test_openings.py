"""The width of declared openings, compared with closed forms."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from printers import Opening, PrinterProfile, RuleResult, check_printability
from printers.rules.openings import check_openings

APOTHEM = float(np.cos(np.pi / 96))  # of a bore with 96 sides around its circle of radius 1
CENTRE = (0.0, 5.2, 5.2)


def width(
    solids: SimpleNamespace, solid: Any, profile: PrinterProfile, opening: Opening
) -> RuleResult:
    (result,) = check_openings(solids.part(solid, profile, openings=(opening,)))
    return result


def bored(solids: SimpleNamespace, radius: float, shift: float = 0.0) -> Any:
    hole = solids.bore(radius, (-1.0, 5.2 + shift, 5.2), 2.5)
    return solids.hollow_box(port=False) - hole


@settings(max_examples=15, deadline=None)
@given(radius=st.floats(0.05, 1.0))
def test_a_bore_is_as_wide_as_the_circle_in_its_polygon(
    solids: SimpleNamespace, prusa: PrinterProfile, radius: float
) -> None:
    result = width(solids, bored(solids, radius), prusa, solids.port_of())
    assert result.measured == pytest.approx(2 * radius * APOTHEM, abs=1e-3)
    if abs(2 * radius - 1.96) > 0.005:  # 2 mm less the stated facet tolerances
        assert result.verdict == ("pass" if radius > 0.98 else "fail")


@settings(max_examples=10, deadline=None)
@given(shift=st.floats(0.0, 0.9))
def test_a_bore_beside_its_declared_axis_lets_a_thinner_pin_enter(
    solids: SimpleNamespace, prusa: PrinterProfile, shift: float
) -> None:
    result = width(solids, bored(solids, 1.0, shift), prusa, solids.port_of())
    assert result.measured == pytest.approx(2 * (1 - shift), abs=2 * (1 - APOTHEM) + 1e-3)


def test_a_cone_is_as_wide_as_one_line_behind_its_mouth(
    solids: SimpleNamespace, prusa: PrinterProfile
) -> None:
    cone = solids.Manifold.cylinder(4.0, 1.4, 0.2, 96).rotate((0.0, 90.0, 0.0))
    part = solids.hollow_box(wall=3.0, port=False) - cone.translate((0.0, 7.0, 5.2))
    mouth = Opening("port", (0.0, 7.0, 5.2), (-1.0, 0.0, 0.0), 1.4)
    result = width(solids, part, prusa, mouth)
    assert result.measured == pytest.approx(2 * (1.4 - 0.3 * prusa.line_width) * APOTHEM, abs=1e-3)


@settings(max_examples=10, deadline=None)
@given(angle=st.floats(0, 360), tilt=st.floats(-80, 80))
def test_turning_the_part_changes_no_width(
    solids: SimpleNamespace, prusa: PrinterProfile, angle: float, tilt: float
) -> None:
    a, b = np.radians(angle), np.radians(tilt)
    about_z = np.array([[np.cos(a), -np.sin(a), 0], [np.sin(a), np.cos(a), 0], [0, 0, 1]])
    about_y = np.array([[np.cos(b), 0, np.sin(b)], [0, 1, 0], [-np.sin(b), 0, np.cos(b)]])
    turn = about_z @ about_y
    solid = bored(solids, 0.7).transform(np.column_stack([turn, np.zeros(3)]))
    port = Opening("port", tuple(turn @ CENTRE), tuple(turn @ (-1.0, 0.0, 0.0)), 1.0)
    result = width(solids, solid, prusa, port)
    assert result.measured == pytest.approx(1.4 * APOTHEM, abs=1e-3)


@pytest.mark.parametrize("port", [False, True])
def test_material_on_the_axis_lets_no_pin_enter(
    solids: SimpleNamespace, prusa: PrinterProfile, port: bool
) -> None:
    bar = solids.block((0.5, 3.0, 0.2), (0.2, 4.0, 5.1))
    result = width(solids, solids.hollow_box(port=port) + bar, prusa, solids.port_of())
    assert (result.verdict, result.measured) == ("fail", 0.0)


def test_a_narrower_hole_behind_the_socket_of_a_tube_does_not_count(
    solids: SimpleNamespace, prusa: PrinterProfile
) -> None:
    socket = solids.bore(2.0, (-1.0, 7.0, 7.0), 2.0)
    part = solids.hollow_box(wall=3.0, port=False) - socket - solids.bore(0.5, (0, 8, 7), 4)
    result = width(solids, part, prusa, Opening("port", (0, 7, 7), (-1, 0, 0), 2.0))
    assert (result.verdict, result.measured) == ("pass", round(4 * APOTHEM, 3))


def test_a_mouth_declared_in_the_air_is_none(
    solids: SimpleNamespace, prusa: PrinterProfile
) -> None:
    mouth = Opening("port", (-3.0, 5.2, 5.2), (-1.0, 0.0, 0.0), 1.0)
    result = width(solids, solids.hollow_box(), prusa, mouth)
    assert (result.verdict, result.measured) == ("fail", "none")


@pytest.mark.parametrize(("radius", "verdict"), [(0.15, "fail"), (0.2, "pass")])
def test_an_opening_narrower_than_the_narrowest_gap_prints_shut(
    solids: SimpleNamespace, prusa: PrinterProfile, radius: float, verdict: str
) -> None:
    port = Opening("port", CENTRE, (-1.0, 0.0, 0.0), radius)
    result = width(solids, bored(solids, radius), prusa, port)
    assert (result.verdict, result.required) == (verdict, 0.4)


def test_a_pinhole_declared_as_a_port_is_airtight_but_refused(
    solids: SimpleNamespace, prusa: PrinterProfile
) -> None:
    model = solids.model(bored(solids, 0.05), openings=(solids.port_of(),))
    rules = {result.rule: result for result in check_printability(model, prusa).rules}
    assert rules["airtightness"].verdict == "pass"
    assert rules["opening_width"].verdict == "fail"
    assert "0.100 mm, less than the 2 mm declared" in rules["opening_width"].message


@pytest.mark.parametrize("declared", [0.5, 1.0, 1.5, 1.9])
def test_a_mouth_wider_than_declared_lets_the_pin_enter(
    solids: SimpleNamespace, prusa: PrinterProfile, declared: float
) -> None:
    """Its reach says how wide the plug must be that closes it."""
    port = Opening("port", CENTRE, (-1.0, 0.0, 0.0), declared / 2, 1.0)
    result = width(solids, bored(solids, 1.0), prusa, port)
    assert (result.verdict, result.measured) == ("pass", round(2 * APOTHEM, 3))
    assert f"1.999 mm, enough for the {declared:g} mm declared" in result.message


def test_a_mouth_wider_than_any_plug_of_the_opening_is_told_so(
    solids: SimpleNamespace, prusa: PrinterProfile
) -> None:
    port = Opening("port", CENTRE, (-1.0, 0.0, 0.0), 0.75)
    result = width(solids, bored(solids, 1.0), prusa, port)
    assert result.verdict == "fail" and "wider than the 1.5 mm declared" in result.message
