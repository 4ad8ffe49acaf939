"""The whole check on parts like real actuators."""

from __future__ import annotations

import json
import subprocess
import sys
from dataclasses import fields
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from printers import (
    DeclaredGap,
    DeclaredWall,
    Opening,
    PrintabilityReport,
    PrintedModel,
    PrinterProfile,
    PrintersError,
    RuleResult,
    check_printability,
    load_profile,
)

PORT = Opening("port", (-4.0, 0.0, 3.2), (-1.0, 0.0, 0.0), 1.0)


def actuator(solids: SimpleNamespace, wall: float, **kwargs: Any) -> PrintedModel:
    values = {"tendon_wall": wall, "chamber": 2.0, "gap": 1.2, "bubbles": 3} | kwargs
    return solids.model(
        solids.bellows(wall, **values),
        walls=(DeclaredWall("bubble", wall), DeclaredWall("tendon", values["tendon_wall"])),
        gaps=(DeclaredGap("between bubbles", values["gap"]),),
        openings=(PORT,),
        cross_section_limit=(20.0, 20.0),
    )


def failed(report: PrintabilityReport) -> set[str]:
    return {result.rule for result in report.failures}


def test_walls_of_three_and_four_lines_make_a_printable_actuator(
    solids: SimpleNamespace, prusa: PrinterProfile
) -> None:
    report = check_printability(actuator(solids, 1.2, tendon_wall=1.6), prusa)
    assert report.verdict == "pass", report.failures
    found = {r.where: r.verdict for r in report.rules if r.rule == "wall_as_declared"}
    assert found == {"bubble": "pass", "tendon": "pass"}


def test_walls_of_one_and_a_half_millimetres_are_refused_twice(
    solids: SimpleNamespace, prusa: PrinterProfile
) -> None:
    report = check_printability(actuator(solids, 1.5), prusa)
    assert failed(report) == {"wall_multiple", "wall_multiple_measured"}


def test_the_same_actuator_needs_other_walls_on_another_printer(solids: SimpleNamespace) -> None:
    model = actuator(solids, 1.28)
    thin_lines = load_profile("direct_drive_sealing")
    assert not any("lines" in r.unit for r in check_printability(model, thin_lines).failures)
    assert "wall_multiple" in failed(check_printability(model, load_profile("prusa_i3")))


def test_two_lines_are_whole_but_leak(solids: SimpleNamespace, prusa: PrinterProfile) -> None:
    report = check_printability(actuator(solids, 0.8), prusa)
    assert failed(report) == {"minimum_lines"}


def test_bubbles_too_close_to_each_other_fuse(
    solids: SimpleNamespace, prusa: PrinterProfile
) -> None:
    report = check_printability(actuator(solids, 1.2, gap=0.3), prusa)
    assert failed(report) == {"gap", "gap_measured"}


def test_the_report_is_plain_json(solids: SimpleNamespace, prusa: PrinterProfile) -> None:
    report = check_printability(actuator(solids, 1.2), prusa)
    data = json.loads(json.dumps(report.to_dict(), allow_nan=False))
    assert data["printer"] == "prusa_i3"
    assert data["verdict"] == report.verdict
    assert len(data["rules"]) == len(report.rules)
    keys = {field.name for field in fields(RuleResult)}
    assert all(set(rule) == keys for rule in data["rules"])


def summary(report: PrintabilityReport) -> list[tuple[str, str]]:
    return [(result.rule, result.verdict) for result in report.rules]


def test_the_same_mesh_gives_the_same_report(
    solids: SimpleNamespace, prusa: PrinterProfile
) -> None:
    model = actuator(solids, 1.5)
    assert check_printability(model, prusa) == check_printability(model, prusa)


def test_the_verdicts_do_not_depend_on_the_triangulation(
    solids: SimpleNamespace, prusa: PrinterProfile
) -> None:
    body = solids.bellows(1.2, tendon_wall=1.6, chamber=2.0, gap=1.2, bubbles=3)
    declared = {"openings": (PORT,), "walls": (DeclaredWall("bubble", 1.2),)}
    coarse = check_printability(solids.model(body, **declared), prusa)
    fine = check_printability(solids.model(body.refine_to_length(1.0), **declared), prusa)
    assert summary(coarse) == summary(fine)
    for one, other in zip(coarse.rules, fine.rules, strict=True):
        if isinstance(one.measured, float) and one.unit != "mm²":
            assert one.measured == pytest.approx(other.measured, rel=0.02), one.rule


def test_the_verdicts_do_not_depend_on_where_the_part_lies_on_the_bed(
    solids: SimpleNamespace, prusa: PrinterProfile
) -> None:
    body = solids.bellows(1.2, tendon_wall=1.6, chamber=2.0, gap=1.2, bubbles=2)
    turned = body.rotate((0.0, 0.0, 33.0)).translate((80.0, 40.0, 0.0))
    a = np.radians(33.0)
    out = (-float(np.cos(a)), -float(np.sin(a)), 0.0)
    port = Opening("port", (4 * out[0] + 80, 4 * out[1] + 40, 3.2), out, 1.0)
    here = check_printability(solids.model(body, openings=(PORT,)), prusa)
    there = check_printability(solids.model(turned, openings=(port,)), prusa)
    assert summary(here) == summary(there)


def test_a_mesh_without_area_is_refused(prusa: PrinterProfile) -> None:
    line = np.array([[0, 0, 0], [10, 0, 0], [20, 0, 0], [30, 0, 0]], dtype=float)
    model = PrintedModel(line, np.array([[0, 1, 2], [1, 2, 3], [0, 2, 3], [0, 1, 3]]))
    with pytest.raises(PrintersError, match="no triangle with an area"):
        check_printability(model, prusa)


def test_reading_a_profile_loads_no_compiler_and_no_mesh_library() -> None:
    code = (
        "import sys, printers; printers.load_profile('prusa_i3'); "
        "sys.exit(bool({'numba', 'scipy', 'trimesh', 'manifold3d'} & set(sys.modules)))"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
