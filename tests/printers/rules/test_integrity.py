"""Closed, outward, not through itself, one body."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from printers import PrintedModel, PrinterProfile, RuleResult, check_printability, load_profile
from printers.check import Rule
from printers.measure.part import MeasuredPart
from printers.rules.integrity import check_one_body, check_self_intersection, check_watertight

ANY_PRINTER = load_profile("prusa_i3")


def meshed(vertices: np.ndarray, triangles: np.ndarray) -> MeasuredPart:
    return MeasuredPart(PrintedModel(vertices, triangles), ANY_PRINTER)


def judged(rule: Rule, part: MeasuredPart) -> RuleResult:
    (result,) = rule(part)
    return result


def test_a_hollow_box_is_closed_and_nowhere_cuts_itself(solids: SimpleNamespace) -> None:
    box = meshed(*solids.arrays(solids.hollow_box()))
    assert judged(check_watertight, box).verdict == "pass"
    assert judged(check_self_intersection, box).verdict == "pass"
    assert judged(check_one_body, box).verdict == "pass"


def test_a_triangle_soup_in_single_precision_closes_again(solids: SimpleNamespace) -> None:
    vertices, triangles = solids.arrays(solids.hollow_box().rotate((0.0, 0.0, 17.0)))
    soup = vertices[triangles].reshape(-1, 3).astype(np.float32)
    joined = meshed(soup.astype(float), np.arange(len(soup)).reshape(-1, 3))
    assert len(joined.surface.vertices) == len(vertices)
    assert judged(check_watertight, joined).verdict == "pass"
    assert judged(check_self_intersection, joined).verdict == "pass"


def test_a_missing_triangle_is_found_where_it_is_missing(solids: SimpleNamespace) -> None:
    vertices, triangles = solids.arrays(solids.block((4, 4, 4), (0, 0, 0)))
    lost = vertices[triangles[5]].mean(axis=0)
    result = judged(check_watertight, meshed(vertices, np.delete(triangles, 5, axis=0)))
    assert (result.verdict, result.measured) == ("fail", 3)
    place = np.array([float(value) for value in result.where.strip("() m").split(",")])
    assert np.linalg.norm(place - lost) <= 4


def test_a_turned_triangle_breaks_the_orientation(solids: SimpleNamespace) -> None:
    vertices, triangles = solids.arrays(solids.block((4, 4, 4), (0, 0, 0)))
    triangles[3] = triangles[3, ::-1]
    result = judged(check_watertight, meshed(vertices, triangles))
    assert result.verdict == "fail"
    assert "opposite orientation" in result.message


def test_an_edge_of_three_triangles_is_no_edge_of_a_solid(solids: SimpleNamespace) -> None:
    vertices, triangles = solids.arrays(solids.block((4, 4, 4), (0, 0, 0)))
    fin = [*triangles[0, :2], len(vertices)]
    mesh = np.vstack([vertices, [9, 9, 9]]), np.vstack([triangles, fin])
    result = judged(check_watertight, meshed(*mesh))
    assert (result.verdict, result.measured) == ("fail", 3)
    assert "2 open edges, 1 edges shared by more than two triangles" in result.message


def test_an_inside_out_part_has_no_body(solids: SimpleNamespace) -> None:
    vertices, triangles = solids.arrays(solids.hollow_box())
    result = judged(check_one_body, meshed(vertices, triangles[:, ::-1]))
    assert result.verdict == "fail"
    assert "inside out" in result.message


def test_two_boxes_side_by_side_are_two_bodies(solids: SimpleNamespace) -> None:
    pair = solids.block((4, 4, 4), (0, 0, 0)) + solids.block((4, 4, 4), (5, 0, 0))
    result = judged(check_one_body, meshed(*solids.arrays(pair)))
    assert (result.verdict, result.measured) == ("fail", 2)


def overlapping(solids: SimpleNamespace, depth: float) -> MeasuredPart:
    """Two boxes that were thrown together without a union, reaching into each other."""
    first = solids.arrays(solids.block((4, 4, 4), (0, 0, 0)))
    second = solids.arrays(solids.block((4, 2, 2), (4 - depth, 1, 1)))
    vertices = np.concatenate([first[0], second[0]])
    return meshed(vertices, np.concatenate([first[1], second[1] + len(first[0])]))


@pytest.mark.parametrize("depth", [0.001, 0.3, 2.0])
def test_solids_that_reach_into_each_other_cut_the_surface(
    solids: SimpleNamespace, depth: float
) -> None:
    part = overlapping(solids, depth)
    assert judged(check_watertight, part).verdict == "pass"
    assert judged(check_self_intersection, part).verdict == "fail"


def test_solids_that_keep_apart_do_not(solids: SimpleNamespace) -> None:
    assert judged(check_self_intersection, overlapping(solids, -0.001)).verdict == "pass"


@pytest.mark.parametrize("thickness", [0.0, 1e-9, 1e-6])
def test_a_flat_surface_is_not_called_inside_out(solids: SimpleNamespace, thickness: float) -> None:
    vertices, triangles = solids.arrays(solids.block((4, 4, 4), (0, 0, 0)))
    for axis in range(3):
        flat = vertices * np.where(np.arange(3) == axis, thickness / 4, 1.0)
        result = judged(check_one_body, meshed(flat, triangles))
        assert result.verdict == "fail" and "the surface is flat" in result.message


@pytest.mark.parametrize("damage", ["open", "inside out"])
def test_nothing_is_called_airtight_without_a_closed_mesh(
    solids: SimpleNamespace, prusa: PrinterProfile, damage: str
) -> None:
    vertices, triangles = solids.arrays(solids.hollow_box())
    broken = triangles[1:] if damage == "open" else triangles[:, ::-1]
    model = PrintedModel(vertices, broken, openings=(solids.port_of(),))
    report = check_printability(model, prusa)
    rules: dict[str, RuleResult] = {result.rule: result for result in report.rules}
    assert report.verdict == "fail"
    for rule in ("airtightness", "minimum_lines", "minimum_layers", "wall_multiple_measured"):
        assert rules[rule].verdict == "fail"
        assert rules[rule].measured == "not measured"
