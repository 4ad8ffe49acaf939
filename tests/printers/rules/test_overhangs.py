"""Roofs over air and faces that hang free."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from printers import PrinterProfile, RuleResult, check_printability


def over_air(
    solids: SimpleNamespace, solid: object, profile: PrinterProfile
) -> dict[str, RuleResult]:
    rules = check_printability(solids.model(solid), profile).rules
    return {r.rule: r for r in rules if r.rule in ("bridge", "overhang", "support")}


@settings(max_examples=8, deadline=None)
@given(width=st.floats(3, 14), angle=st.floats(0, 180))
def test_the_roof_of_a_cavity_spans_its_shorter_side(
    solids: SimpleNamespace, prusa: PrinterProfile, width: float, angle: float
) -> None:
    box = solids.hollow_box(inner=(30.0, width, 6.0), port=False).rotate((0.0, 0.0, angle))
    result = over_air(solids, box, prusa)["bridge"]
    # Rays every 15 degrees meet the shortest way to within 7.5 degrees.
    assert width - 0.01 <= result.measured <= width / np.cos(np.radians(7.5)) + 0.01
    if abs(width - 10) > 0.2:
        assert result.verdict == ("pass" if width < 10 else "fail")


def test_a_roof_outside_that_is_too_wide_is_a_warning(
    solids: SimpleNamespace, prusa: PrinterProfile
) -> None:
    gate = solids.block((24, 6, 10), (0, 0, 0)) - solids.block((12, 8, 8), (6, -1, -1))
    result = over_air(solids, gate, prusa)["bridge"]
    assert result.verdict == "warn"
    assert result.measured == pytest.approx(12, abs=0.2)


def test_a_balcony_hangs_free(solids: SimpleNamespace, prusa: PrinterProfile) -> None:
    house = solids.block((10, 10, 10), (0, 0, 0)) + solids.block((5, 10, 2), (10, 0, 6))
    results = over_air(solids, house, prusa)
    assert results["overhang"].verdict == "warn"
    assert results["overhang"].measured == pytest.approx(50, rel=0.1)
    assert results["bridge"].verdict == "pass"


def test_two_houses_do_not_bridge_the_street_below_their_balconies(
    solids: SimpleNamespace, prusa: PrinterProfile
) -> None:
    street = solids.block((30, 10, 1), (0, 0, 0))
    for x, balcony in ((0.0, 10.0), (20.0, 17.0)):
        street = street + solids.block((10, 10, 10), (x, 0, 0))
        street = street + solids.block((3, 10, 2), (balcony, 0, 6))
    assert over_air(solids, street, prusa)["overhang"].measured == pytest.approx(60, rel=0.1)


@pytest.mark.parametrize(("lean", "verdict"), [(30.0, "pass"), (44.0, "pass"), (60.0, "warn")])
def test_a_funnel_is_printed_up_to_45_degrees_from_the_vertical(
    solids: SimpleNamespace, prusa: PrinterProfile, lean: float, verdict: str
) -> None:
    top = 3 + 6 * np.tan(np.radians(lean))
    funnel = solids.Manifold.cylinder(6.0, 3.0, top, 64)
    assert over_air(solids, funnel, prusa)["overhang"].verdict == verdict


def test_what_is_printed_over_air_inside_is_said_to_stay_without_support(
    solids: SimpleNamespace, prusa: PrinterProfile
) -> None:
    result = over_air(solids, solids.hollow_box(port=False), prusa)["support"]
    assert result.measured == pytest.approx(12 * 8, rel=0.05)
    assert "could not be removed" in result.message
