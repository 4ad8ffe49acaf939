"""One cavity, one opening: decided by topology, with the fault named."""

from __future__ import annotations

import re
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from printers import Opening, PrinterProfile, RuleResult, load_profile
from printers.measure.leakage.leaks import find_leaks
from printers.measure.plugging import Sealing
from printers.rules.airtightness import check_airtightness

ANY_PRINTER: PrinterProfile = load_profile("prusa_i3")


def judged(solids: SimpleNamespace, solid: object, *openings: Opening) -> RuleResult:
    (result,) = check_airtightness(solids.part(solid, ANY_PRINTER, openings=openings))
    return result


def sealing(solids: SimpleNamespace, solid: object, *openings: Opening) -> Sealing:
    return solids.part(solid, ANY_PRINTER, openings=openings).sealing


def test_a_box_with_a_port_has_one_cavity_of_its_inner_volume(solids: SimpleNamespace) -> None:
    result = judged(solids, solids.hollow_box(), solids.port_of())
    assert (result.verdict, result.measured) == ("pass", "1 cavity, 1 opening")
    # The plug reaches one radius, less than the wall, into the bore: 1.2 - 1.0 mm of bore remain.
    volume = 12 * 8 * 8 + np.pi * 0.2
    reported = float(result.message.split(" of ")[1].split(" mm³")[0])
    assert reported == pytest.approx(volume, abs=0.1)


@settings(max_examples=15, deadline=None)
@given(angle=st.floats(0, 360), tilt=st.floats(-80, 80))
def test_turning_the_part_leaves_it_airtight(
    solids: SimpleNamespace, angle: float, tilt: float
) -> None:
    port = solids.port_of()
    a, b = np.radians(angle), np.radians(tilt)
    about_z = np.array([[np.cos(a), -np.sin(a), 0], [np.sin(a), np.cos(a), 0], [0, 0, 1]])
    about_y = np.array([[np.cos(b), 0, np.sin(b)], [0, 1, 0], [-np.sin(b), 0, np.cos(b)]])
    rotation = about_z @ about_y
    solid = solids.hollow_box().transform(np.column_stack([rotation, np.zeros(3)]))
    turned = Opening(
        "port", tuple(rotation @ port.centre), tuple(rotation @ port.direction), port.radius
    )
    assert judged(solids, solid, turned).verdict == "pass"


def test_a_cavity_without_opening_is_a_sealed_void(solids: SimpleNamespace) -> None:
    result = judged(solids, solids.hollow_box(port=False), solids.port_of())
    assert result.verdict == "fail"
    assert "no opening leads into the sealed cavity of 768.0 mm³" in result.message


def test_an_undeclared_port_is_not_accepted(solids: SimpleNamespace) -> None:
    result = judged(solids, solids.hollow_box())
    assert result.verdict == "fail"
    assert "no opening is declared" in result.message


def test_a_blind_port_does_not_reach_the_cavity(solids: SimpleNamespace) -> None:
    blind = solids.hollow_box(wall=3.0, port=False) - solids.bore(1.0, (-1, 7, 5.2), 2.5)
    port = Opening("port", (0, 7, 5.2), (-1, 0, 0), 1.0)
    result = judged(solids, blind, port)
    assert result.verdict == "fail"
    assert "port does not reach the sealed cavity of 768.0 mm³" in result.message


def test_a_port_declared_at_the_wrong_place_is_named(solids: SimpleNamespace) -> None:
    elsewhere = Opening("port", (6.0, 5.2, 10.4), (0, 0, 1), 1.0)
    result = judged(solids, solids.hollow_box(), elsewhere)
    assert result.verdict == "fail"
    assert "there is no opening at port" in result.message
    in_the_air = Opening("port", (-20.0, 5.2, 5.2), (-1, 0, 0), 1.0)
    result = judged(solids, solids.hollow_box(), in_the_air)
    assert result.verdict == "fail"
    assert "no material to seal against" in result.message


def test_a_solid_block_has_no_cavity(solids: SimpleNamespace) -> None:
    port = Opening("port", (0.0, 5.0, 5.0), (-1, 0, 0), 1.0)
    result = judged(solids, solids.block((10, 10, 10), (0, 0, 0)), port)
    assert result.verdict == "fail"
    assert result.measured == "0 cavities, 0 openings"


def test_two_chambers_that_do_not_meet_are_named(solids: SimpleNamespace) -> None:
    wall = solids.block((1.2, 10.4, 10.4), (8, 0, 0))
    result = judged(solids, solids.hollow_box() + wall, solids.port_of())
    assert result.verdict == "fail"
    assert "sealed cavity" in result.message
    ported = solids.hollow_box() + wall - solids.bore(1.0, (12, 5.2, 5.2), 4)
    other = Opening("outlet", (14.4, 5.2, 5.2), (1, 0, 0), 1.0)
    result = judged(solids, ported, solids.port_of(), other)
    assert result.verdict == "fail"
    assert "2 unconnected cavities" in result.message


def test_two_declared_ports_of_one_cavity_are_airtight(solids: SimpleNamespace) -> None:
    ported = solids.hollow_box() - solids.bore(1.0, (12, 5.2, 5.2), 4)
    other = Opening("outlet", (14.4, 5.2, 5.2), (1, 0, 0), 1.0)
    assert judged(solids, ported, solids.port_of(), other).verdict == "pass"
    assert judged(solids, ported, solids.port_of()).verdict == "fail"


def test_a_crack_beside_the_port_is_not_hidden_by_its_plug(solids: SimpleNamespace) -> None:
    port = Opening("port", (0.0, 5.2, 5.2), (-1, 0, 0), 1.6)
    plain = judged(solids, solids.hollow_box(), port)
    assert plain.verdict == "pass"
    cracked = solids.hollow_box() - solids.bore(0.1, (-1, 5.2, 6.6), 3)
    result = judged(solids, cracked, port)
    assert result.verdict == "fail"
    assert "2 openings lie at port, where 1 is declared" in result.message


def test_a_pillar_in_the_cavity_and_a_mounting_hole_leak_nothing(solids: SimpleNamespace) -> None:
    pillar = solids.block((1.2, 1.2, 10.4), (7, 5, 0))
    lug = solids.block((5, 5, 3), (13, 3, 0)) - solids.bore(1.0, (16, 5.5, -1), 5, axis=2)
    result = judged(solids, solids.hollow_box() + pillar + lug, solids.port_of())
    assert (result.verdict, result.measured) == ("pass", "1 cavity, 1 opening")


@settings(max_examples=15, deadline=None)
@given(
    x=st.floats(2.5, 12),
    y=st.floats(2.5, 8),
    radius=st.floats(0.05, 0.6),
)
@pytest.mark.thorough
def test_a_hole_in_the_roof_is_found_where_it_is(
    solids: SimpleNamespace, x: float, y: float, radius: float
) -> None:
    leaking = solids.hollow_box() - solids.bore(radius, (x, y, 8), 5, axis=2)
    result = judged(solids, leaking, solids.port_of())
    assert (result.verdict, result.measured) == ("fail", "0 closed cavities, 2 openings")
    closed = sealing(solids, leaking, solids.port_of()).closed
    found = find_leaks(closed.surface, (solids.port_of(),))
    assert found is not None
    (leak,) = found.leaks
    assert np.allclose(leak.centre[:2], (x, y), atol=0.02)
    assert 9.2 - 1e-6 <= leak.centre[2] <= 10.4 + 1e-6
    assert leak.width == pytest.approx(2 * radius, rel=0.01)


def test_two_holes_are_both_located_the_narrow_one_first(solids: SimpleNamespace) -> None:
    leaking = solids.hollow_box() - solids.bore(0.4, (5, 4, 8), 5, axis=2)
    leaking = leaking - solids.bore(0.2, (10, 7, 8), 5, axis=2)
    result = judged(solids, leaking, solids.port_of())
    assert result.measured == "0 closed cavities, 3 openings"
    assert "(10.0, 7.0," in result.where.split(";")[0]
    assert "(5.0, 4.0," in result.where.split(";")[1]


def test_a_missing_side_leaks_without_a_place(solids: SimpleNamespace) -> None:
    result = judged(
        solids, solids.hollow_box() - solids.block((6, 20, 20), (9, -5, -5)), solids.port_of()
    )
    assert result.verdict == "fail"
    assert "leaks" in result.message


@pytest.mark.parametrize("width", [1e-4, 1e-3, 0.03])
def test_no_leak_has_a_width_of_nothing(solids: SimpleNamespace, width: float) -> None:
    part = solids.hollow_box() - solids.block((4.0, 2.0, width), (5.0, 9.1, 5.03))
    result = judged(solids, part, solids.port_of())
    shown = re.search(r"\(([\d.]+) mm wide\)", result.message)
    assert shown and float(shown[1]) == pytest.approx(2 * width, rel=0.1)  # hydraulic


def test_a_port_that_is_declared_twice_is_one_opening(solids: SimpleNamespace) -> None:
    result = judged(solids, solids.hollow_box(), solids.port_of(), solids.port_of())
    assert result.verdict == "fail" and result.measured == "1 cavity, 1 opening"
    assert "1 opening lies at port and port, where 2 are declared" in result.message


def test_a_crack_through_the_port_is_open_beside_its_plug(solids: SimpleNamespace) -> None:
    part = solids.hollow_box() - solids.block((1.4, 3.6, 0.3), (-0.1, 5.2, 5.05))
    result = judged(solids, part, solids.port_of())
    assert result.verdict == "fail" and "still open near" in result.message
    x, y, z = (float(number) for number in re.findall(r"-?\d+\.\d+", result.where)[:3])
    assert 0 <= x <= 1.2 and 6.2 <= y <= 8.8 and z == pytest.approx(5.2, abs=0.15)
