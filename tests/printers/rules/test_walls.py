"""Whole numbers of lines and layers, read from the declaration and measured on the mesh."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from printers import DeclaredWall, PrintabilityReport, PrinterProfile, check_printability


def with_lines(profile: PrinterProfile, line_width: float) -> PrinterProfile:
    values = profile.model_dump()
    slicer = values["slicer"] | {"print_speed": 5.0}
    changed = {"line_width": line_width, "nozzle_diameter": line_width, "slicer": slicer}
    return PrinterProfile(**(values | changed))


def verdicts(report: PrintabilityReport, rule: str, unit: str) -> set[str]:
    return {r.verdict for r in report.rules if r.rule == rule and r.unit == unit}


@settings(max_examples=20, deadline=None)
@given(
    lines=st.integers(1, 5),
    line_width=st.sampled_from([0.3, 0.4, 0.42, 0.6]),
    half=st.booleans(),
    angle=st.floats(0, 360),
)
@pytest.mark.thorough
def test_a_wall_of_whole_lines_passes_and_half_a_line_more_fails(
    solids: SimpleNamespace,
    prusa: PrinterProfile,
    lines: int,
    line_width: float,
    half: bool,
    angle: float,
) -> None:
    wall = (lines + half / 2) * line_width
    box = solids.hollow_box(wall=wall, floor=1.2).rotate((0.0, 0.0, angle))
    profile = with_lines(prusa, line_width)
    declared = (DeclaredWall("side", wall), DeclaredWall("floor", 1.2, "layers"))
    report = check_printability(solids.model(box, walls=declared), profile)
    expected = {"fail"} if half else {"pass"}
    assert verdicts(report, "wall_multiple", "lines") == expected
    assert verdicts(report, "wall_multiple_measured", "lines") == expected
    assert verdicts(report, "wall_multiple_measured", "layers") == {"pass"}
    assert {r.verdict for r in report.rules if r.rule == "wall_as_declared"} == {"pass"}
    measured = [r for r in report.rules if r.rule == "wall_multiple_measured" and r.unit == "lines"]
    assert [r.measured for r in measured] == [pytest.approx(lines + half / 2, abs=0.01)]


@settings(max_examples=10, deadline=None)
@given(layers=st.integers(8, 20), half=st.booleans())
def test_a_floor_of_whole_layers_passes_and_half_a_layer_more_fails(
    solids: SimpleNamespace, prusa: PrinterProfile, layers: int, half: bool
) -> None:
    box = solids.hollow_box(wall=1.2, floor=(layers + half / 2) * 0.1)
    report = check_printability(solids.model(box), prusa)
    assert verdicts(report, "wall_multiple_measured", "layers") == {"fail" if half else "pass"}
    assert verdicts(report, "wall_multiple_measured", "lines") == {"pass"}


def test_the_paper_s_first_walls_are_three_and_three_quarter_lines(
    solids: SimpleNamespace, prusa: PrinterProfile
) -> None:
    box = solids.model(solids.hollow_box(wall=1.5), walls=(DeclaredWall("bubble", 1.5),))
    rules = check_printability(box, prusa).rules
    (declared,) = [r for r in rules if r.rule == "wall_multiple"]
    (measured,) = [r for r in rules if r.rule == "wall_multiple_measured" and r.unit == "lines"]
    assert (declared.verdict, declared.measured) == ("fail", 3.75)
    assert (measured.verdict, measured.measured) == ("fail", 3.75)
    assert "1.500 mm" in measured.message


def test_a_thin_wall_of_many_is_found_with_its_place(
    solids: SimpleNamespace, prusa: PrinterProfile
) -> None:
    recess = solids.block((0.4, 6, 6), (14.2, 2.2, 2.2))  # leaves 1.0 of 1.2 mm at x = 14.4
    report = check_printability(solids.model(solids.hollow_box(port=False) - recess), prusa)
    (odd,) = [r for r in report.failures if r.rule == "wall_multiple_measured"]
    assert odd.measured == 2.5
    x, y, z = (float(value) for value in odd.where.strip("() m").split(","))
    assert 13.2 <= x <= 14.2
    assert 2.2 <= y <= 8.2
    assert 2.2 <= z <= 8.2


def test_a_declared_wall_that_the_mesh_does_not_have_is_named(
    solids: SimpleNamespace, prusa: PrinterProfile
) -> None:
    walls = (DeclaredWall("side", 1.6), DeclaredWall("floor", 1.2, "layers"))
    report = check_printability(solids.model(solids.hollow_box(), walls=walls), prusa)
    found = {r.where: r for r in report.rules if r.rule == "wall_as_declared"}
    assert found["floor"].verdict == "pass"
    assert (found["side"].verdict, found["side"].measured) == ("fail", 1.2)


def wedge(solids: SimpleNamespace, thin: float, thick: float) -> Any:
    """Hollow box whose wall at x = 0 grows from thin at the bottom to thick at the top."""
    outer = solids.block((16, 12, 12), (0, 0, 0))
    inner = solids.block((20, 9.6, 9.6), (0, 1.2, 1.2))
    lean = np.array([(thin, 0.0), (14.8, 0.0), (14.8, 12.0), (thick, 12.0)])
    cut = solids.Manifold.extrude(solids.CrossSection([lean]), 12.0)
    return outer - (inner ^ cut.rotate((90.0, 0.0, 0.0)).translate((0.0, 12.0, 0.0)))


def test_a_wedge_is_no_wall_of_whole_lines(solids: SimpleNamespace, prusa: PrinterProfile) -> None:
    report = check_printability(solids.model(wedge(solids, 1.2, 2.0)), prusa)
    tapered = [r for r in report.failures if r.rule == "wall_multiple_measured"]
    assert len(tapered) == 1
    assert "tapers" in tapered[0].message
    straight = check_printability(solids.model(wedge(solids, 1.6, 1.6)), prusa)
    assert not [r for r in straight.failures if r.rule == "wall_multiple_measured"]


def test_every_wedge_up_to_thirty_degrees_tapers(
    solids: SimpleNamespace, prusa: PrinterProfile
) -> None:
    fails = []
    for angle in (0.0, 0.1, 0.5, 2.0, 9.0, 20.0, 28.0):
        rise = 12.0 * np.tan(np.radians(angle))
        report = check_printability(solids.model(wedge(solids, 1.2, 1.2 + rise)), prusa)
        fails.append(any(r.rule == "wall_multiple_measured" for r in report.failures))
    assert fails == [False, False, True, True, True, True, True]


def test_declared_and_measured_walls_agree_along_a_sweep_of_thickness(
    solids: SimpleNamespace, prusa: PrinterProfile
) -> None:
    """Whole numbers of lines pass up to six, all perimeters; infill fits any wall beyond."""
    walls = (1.2, 1.3, 1.6, 1.9, 2.35, 2.4, 2.42, 2.5, 3.0)
    for wall in walls:
        model = solids.model(solids.hollow_box(wall=wall), walls=(DeclaredWall("side", wall),))
        report = check_printability(model, prusa)
        declared, measured = (
            "fail" in {r.verdict for r in report.rules if r.rule == rule and r.unit == "lines"}
            for rule in ("wall_multiple", "wall_multiple_measured")
        )
        whole = wall > 2.4 or round(wall / 0.4, 3).is_integer()
        assert declared == measured == (not whole), wall


@pytest.mark.parametrize(("wall", "verdict"), [(1.2, "pass"), (1.4, "fail")])
def test_a_curved_wall_of_constant_thickness_is_measured(
    solids: SimpleNamespace, prusa: PrinterProfile, wall: float, verdict: str
) -> None:
    can = solids.bore(6 + wall, (0, 0, 0), 14, axis=2) - solids.bore(6, (0, 0, 1.2), 11.6, axis=2)
    report = check_printability(solids.model(can), prusa)
    sides = [r for r in report.rules if r.rule == "wall_multiple_measured" and r.unit == "lines"]
    assert [r.verdict for r in sides] == [verdict]
    assert sides[0].measured == pytest.approx(wall / 0.4, abs=0.02)


def test_corners_whose_fillets_do_not_match_are_no_walls(
    solids: SimpleNamespace, prusa: PrinterProfile
) -> None:
    outer = solids.rounded_bar(14.4, 14.4, 14.4, 1.5, (0, 0, 0))
    inner = solids.rounded_bar(12, 12, 12, 0.5, (1.2, 1.2, 1.2))
    report = check_printability(solids.model(outer - inner), prusa)
    measured = {r.measured for r in report.rules if r.rule == "wall_multiple_measured"}
    assert measured == {3.0, 12.0}


def test_a_flange_that_seals_nothing_may_have_any_thickness(
    solids: SimpleNamespace, prusa: PrinterProfile
) -> None:
    flange = solids.block((3.0, 1.5, 8), (14, 4, 0))
    report = check_printability(solids.model(solids.hollow_box(port=False) + flange), prusa)
    assert not [r for r in report.failures if r.rule == "wall_multiple_measured"]


def measured_walls(report: PrintabilityReport) -> list[tuple[str, str, float]]:
    return [
        (r.verdict, r.unit, float(r.measured))
        for r in report.rules
        if r.rule == "wall_multiple_measured"
    ]


def test_refining_and_renumbering_the_mesh_changes_no_wall(
    solids: SimpleNamespace, prusa: PrinterProfile
) -> None:
    box = solids.hollow_box(wall=1.5, floor=0.8)
    coarse = check_printability(solids.model(box), prusa)
    fine = check_printability(solids.model(box.refine_to_length(0.6)), prusa)
    vertices, triangles = solids.arrays(box)
    order = np.random.default_rng(7).permutation(len(vertices))
    shuffled = np.roll(np.argsort(order)[triangles], 1, axis=1)[::-1]
    model = type(solids.model(box))(vertices[order], shuffled)
    assert measured_walls(coarse) == measured_walls(fine)
    assert measured_walls(coarse) == measured_walls(check_printability(model, prusa))
