"""The thinnest way from the cavity to the outside."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from printers import Opening, PrintedModel, PrinterProfile, RuleResult, check_printability


def thinnest(
    solids: SimpleNamespace, solid: object, profile: PrinterProfile, **declared: object
) -> dict[str, RuleResult]:
    report = check_printability(solids.model(solid, **declared), profile)
    return {r.rule: r for r in report.rules if r.rule.startswith("minimum_")}


@settings(max_examples=15, deadline=None)
@given(wall=st.floats(0.3, 2.5), angle=st.floats(0, 360))
def test_the_sides_of_a_box_seal_from_three_lines_on(
    solids: SimpleNamespace, prusa: PrinterProfile, wall: float, angle: float
) -> None:
    box = solids.hollow_box(wall=wall, floor=2.0, port=False).rotate((0.0, 0.0, angle))
    lines = thinnest(solids, box, prusa)["minimum_lines"]
    assert lines.measured == pytest.approx(wall, abs=0.002)
    if abs(wall - 1.18) > 0.005:  # 1.2 mm less the stated facet tolerance
        assert lines.verdict == ("pass" if wall > 1.18 else "fail")


@pytest.mark.parametrize(("floor", "verdict"), [(0.8, "pass"), (0.9, "pass"), (0.7, "fail")])
def test_a_floor_may_be_thinner_than_a_side_down_to_eight_layers(
    solids: SimpleNamespace, prusa: PrinterProfile, floor: float, verdict: str
) -> None:
    results = thinnest(solids, solids.hollow_box(floor=floor, port=False), prusa)
    assert results["minimum_layers"].verdict == verdict
    assert results["minimum_layers"].measured == pytest.approx(floor, abs=1e-6)
    assert results["minimum_lines"].verdict == "pass"


def test_a_groove_under_the_floor_is_judged_by_its_layers(
    solids: SimpleNamespace, prusa: PrinterProfile
) -> None:
    grooved = solids.hollow_box() - solids.block((2.4, 6.0, 0.4), (6, 2.2, 0))
    results = thinnest(solids, grooved, prusa, openings=(solids.port_of(),))
    assert results["minimum_layers"].verdict == "pass"
    assert results["minimum_layers"].measured == pytest.approx(0.8, abs=1e-6)
    assert results["minimum_lines"].verdict == "pass"
    deep = solids.hollow_box() - solids.block((2.4, 6.0, 0.6), (6, 2.2, 0))
    assert thinnest(solids, deep, prusa)["minimum_layers"].verdict == "fail"


@settings(max_examples=10, deadline=None)
@given(shift=st.floats(0, 1.5), angle=st.floats(0, 2 * np.pi))
def test_a_shifted_bore_is_as_thin_as_geometry_says(
    solids: SimpleNamespace, prusa: PrinterProfile, shift: float, angle: float
) -> None:
    x, y = shift * np.cos(angle), shift * np.sin(angle)
    can = solids.bore(8.0, (0, 0, 0), 14, axis=2) - solids.bore(6.0, (x, y, 2), 10, axis=2)
    lines = thinnest(solids, can, prusa)["minimum_lines"]
    sag = 8 * (1 - np.cos(np.pi / 96))  # the polygon lies this far inside its circle
    assert lines.measured == pytest.approx(2 - shift, abs=2 * sag)


def test_an_edge_that_points_at_a_fillet_is_found(
    solids: SimpleNamespace, prusa: PrinterProfile
) -> None:
    # Flat walls are 1.2 mm, but the sharp edge of the cavity is nearer to the fillet outside:
    # sqrt(2) (1.9 - 1.2) mm from its centre, 1.9 mm of radius.
    part = solids.rounded_bar(14.4, 14.4, 14.4, 1.9, (0, 0, 0)) - solids.block(
        (12, 12, 12), (1.2, 1.2, 1.2)
    )
    upright = part.rotate((90.0, 0.0, 0.0))
    lines = thinnest(solids, upright, prusa)["minimum_lines"]
    assert lines.verdict == "fail"
    assert lines.measured == pytest.approx(1.9 - np.sqrt(2) * 0.7, abs=0.01)


def test_the_edge_of_the_port_is_no_thin_wall(
    solids: SimpleNamespace, prusa: PrinterProfile
) -> None:
    results = thinnest(solids, solids.hollow_box(), prusa, openings=(solids.port_of(),))
    assert results["minimum_lines"].measured == pytest.approx(1.2, abs=1e-6)


def test_the_walls_of_a_cavity_that_leaks_are_judged_all_the_same(
    solids: SimpleNamespace, prusa: PrinterProfile
) -> None:
    for wall, verdict in ((1.2, "pass"), (0.8, "fail")):
        leaking = solids.hollow_box(wall=wall) - solids.bore(0.5, (5, 5, 5), 20)
        lines = thinnest(solids, leaking, prusa, openings=(solids.port_of(wall=wall),))
        assert lines["minimum_lines"].verdict == verdict
        assert lines["minimum_lines"].measured == wall


@pytest.mark.parametrize("gap", [0.0, 1e-9, 1e-4, 0.01])
@pytest.mark.parametrize("rule", ["minimum_layers", "minimum_lines"])
def test_a_cavity_that_touches_the_outside_has_no_thickness(
    solids: SimpleNamespace, prusa: PrinterProfile, rule: str, gap: float
) -> None:
    """The cavity reaches up to the plane of the roof, or of the side, within rounding or more."""
    inner, hole = (12.0, 8.0, 8.0), (1.2, 1.2, 1.2)
    outer = (13.2 + gap, 10.4, 10.4) if rule == "minimum_lines" else (14.4, 10.4, 9.2 + gap)
    vertices, triangles = solids.arrays(solids.block(outer, (0, 0, 0)))
    cavity, inwards = solids.arrays(solids.block(inner, hole))
    both = np.concatenate([triangles, inwards[:, ::-1] + len(vertices)])
    part = PrintedModel(np.concatenate([vertices, cavity]), both)
    report = check_printability(part, prusa)
    results = {r.rule: r for r in report.rules if r.rule.startswith("minimum_")}
    assert results[rule].verdict == "fail"
    assert results[rule].measured == pytest.approx(gap, abs=1e-3)
    needed = prusa.minimum_wall if rule == "minimum_lines" else prusa.minimum_floor
    assert results[rule].required == pytest.approx(needed)
    (other,) = {"minimum_layers", "minimum_lines"} - {rule}
    assert results[other].verdict == "pass"


def with_short_boss(solids: SimpleNamespace, wall: float, chamfer: float = 0.0) -> Any:
    """A hollow box whose bore, and a boss of 1.5 mm around it, end at x = -1.5."""
    boss = solids.bore(1.0 + wall, (-1.5, 5.2, 5.2), 2.0)
    if chamfer:
        cone = solids.Manifold.cylinder(1.0 + wall, 1.0 + wall - chamfer, 2.0 + 2 * wall - chamfer)
        boss = boss ^ cone.rotate((0.0, 90.0, 0.0)).translate((-1.5, 5.2, 5.2))
    return solids.hollow_box(port=False) + boss - solids.bore(1.0, (-2.5, 5.2, 5.2), 4.0)


SHORT = Opening("opening", (-1.5, 5.2, 5.2), (-1.0, 0.0, 0.0), 1.0)


@pytest.mark.parametrize(("wall", "verdict"), [(0.4, "fail"), (0.8, "fail"), (1.2, "pass")])
def test_the_wall_around_an_opening_nobody_declared_must_seal_too(
    solids: SimpleNamespace, prusa: PrinterProfile, wall: float, verdict: str
) -> None:
    """Behind a mouth, where the cavity is as near to the outside as the mouth is."""
    lines = thinnest(solids, with_short_boss(solids, wall), prusa, openings=(SHORT,))[
        "minimum_lines"
    ]
    assert lines.verdict == verdict and lines.measured == pytest.approx(wall, abs=0.005)


def test_above_a_bore_layers_count(solids: SimpleNamespace, prusa: PrinterProfile) -> None:
    for roof, verdict in ((0.8, "pass"), (0.6, "fail")):
        height = 10.4 - roof - 1.0
        box = solids.hollow_box(port=False) - solids.bore(1.0, (-1.0, 5.2, height), 2.2)
        port = Opening("port", (0.0, 5.2, height), (-1.0, 0.0, 0.0), 1.0)
        layers = thinnest(solids, box, prusa, openings=(port,))["minimum_layers"]
        assert layers.verdict == verdict and layers.measured == pytest.approx(roof, abs=0.005)


def test_the_face_around_a_mouth_is_no_thin_wall(
    solids: SimpleNamespace, prusa: PrinterProfile
) -> None:
    """A chamfered boss, and a bore into a round can, whose outside falls away beside the mouth."""
    chamfered = with_short_boss(solids, 2.0, chamfer=1.0)
    assert thinnest(solids, chamfered, prusa, openings=(SHORT,))["minimum_lines"].verdict == "pass"
    can = solids.bore(5.2, (0, 0, 0), 14, axis=2) - solids.bore(4.0, (0, 0, 2), 10, axis=2)
    drilled = can - solids.bore(1.0, (-6.0, 0.0, 7.0), 4.0)
    port = Opening("port", (-5.2, 0.0, 7.0), (-1.0, 0.0, 0.0), 1.0)
    lines = thinnest(solids, drilled, prusa, openings=(port,))["minimum_lines"]
    assert lines.verdict == "pass" and lines.measured == pytest.approx(1.2, abs=0.01)


def test_the_wall_of_a_square_bore_is_measured_too(
    solids: SimpleNamespace, prusa: PrinterProfile
) -> None:
    boss = solids.block((2.0, 3.6, 3.6), (-1.5, 3.4, 3.4))
    square = solids.block((4.0, 2.0, 2.0), (-2.5, 4.2, 4.2))
    port = Opening("opening", (-1.5, 5.2, 5.2), (-1.0, 0.0, 0.0), 1.0, reach=1.42)
    part = solids.hollow_box(port=False) + boss - square
    lines = thinnest(solids, part, prusa, openings=(port,))["minimum_lines"]
    assert lines.verdict == "fail" and lines.measured == pytest.approx(0.8, abs=0.001)
