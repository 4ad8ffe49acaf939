"""What rules state of their own uncertainty, and that two triangulations agree within it."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from printers import DeclaredGap, DeclaredWall, Opening, PrinterProfile, check_printability

SIDES = (48, 144)
"""Of every round: chords of 0.009 and 0.001 mm at a radius of 4 mm."""


def round_part(solids: SimpleNamespace, sides: int) -> Any:
    """A lying tube on a foot, closed at both ends, with a nozzle and two fins."""

    def rod(radius: float, start: float, length: float, height: float = 6.0) -> Any:
        cylinder = solids.Manifold.cylinder(length, radius, radius, sides)
        return cylinder.rotate((0.0, 90.0, 0.0)).translate((start, 0.0, height))

    outside = rod(5.2, 0.0, 20.0) + rod(2.6, -5.0, 6.0) + solids.block((20, 8, 3), (0, -4, 0))
    for x in (6.0, 8.2):
        outside = outside + solids.block((1.2, 6, 4), (x, -3, 10))
    return outside - rod(4.0, 1.2, 17.6) - rod(1.0, -6.0, 8.0)


def declared() -> dict[str, Any]:
    port = Opening("port", (-5.0, 0.0, 6.0), (-1.0, 0.0, 0.0), 1.0)
    return {
        "walls": (DeclaredWall("nozzle", 1.6, around=port),),
        "gaps": (DeclaredGap("fins", 1.0),),
        "openings": (port,),
        "cross_section_limit": (20.0, 20.0),
    }


def test_two_triangulations_agree_within_the_stated_uncertainty(
    solids: SimpleNamespace, prusa: PrinterProfile
) -> None:
    coarse, fine = (
        check_printability(solids.model(round_part(solids, sides), **declared()), prusa)
        for sides in SIDES
    )
    assert [(r.rule, r.verdict, r.where) for r in coarse.rules if r.uncertainty is None] == [
        (r.rule, r.verdict, r.where) for r in fine.rules if r.uncertainty is None
    ]
    measured = [
        (one, other)
        for one, other in zip(coarse.rules, fine.rules, strict=True)
        if one.uncertainty is not None and not isinstance(one.measured, str)
    ]
    assert len(measured) > 10
    for one, other in measured:
        assert (one.rule, one.verdict) == (other.rule, other.verdict)
        allowed = (one.uncertainty or 0) + (other.uncertainty or 0)
        assert abs(float(one.measured) - float(other.measured)) <= allowed, one.rule


STATED = {
    "watertight", "self_intersection", "one_body", "build_volume", "cross_section", "bed_contact",
    "wall_multiple_measured", "wall_as_declared", "minimum_lines", "minimum_layers", "gap_measured",
    "cavity_width", "gap_as_declared", "opening_width", "bridge", "overhang", "support",
    "slivers", "thinnest_place", "air_passage",
}  # fmt: skip


def test_every_measured_rule_states_its_uncertainty_and_a_declared_one_has_none(
    solids: SimpleNamespace, prusa: PrinterProfile
) -> None:
    model = solids.model(round_part(solids, 48), **declared())
    rules = check_printability(model, prusa).rules
    stating = {r.rule for r in rules if r.uncertainty is not None}
    assert STATED - {"minimum_layers", "minimum_lines"} <= stating
    silent = {r.rule for r in rules if r.uncertainty is None and r.measured != "none"}
    told = {"layer_height", "mass", "filament_length", "print_time"}
    assert silent <= {"wall_multiple", "gap", "airtightness"} | told


@pytest.mark.parametrize("rule", ["gap_measured", "minimum_lines", "bridge"])
@pytest.mark.thorough
def test_a_verdict_changes_once_along_a_sweep(
    solids: SimpleNamespace, prusa: PrinterProfile, rule: str
) -> None:
    """Wider gaps and walls pass from some width on, wider roofs up to some width."""
    values = {
        "gap_measured": (0.2, 0.3, 0.37, 0.39, 0.41, 0.6, 1.0),
        "minimum_lines": (0.6, 0.8, 1.0, 1.17, 1.19, 1.2, 1.6, 2.0),
        "bridge": (4.0, 8.0, 9.5, 9.8, 10.3, 12.0, 14.0),
    }[rule]
    verdicts = []
    for value in values:
        for length in (50.0, 0.8):  # as it is, and with every edge cut down to 0.8 mm
            solid = swept(solids, rule, value).refine_to_length(length)
            rules = check_printability(solids.model(solid), prusa).rules
            (found,) = [r for r in rules if r.rule == rule]
            verdicts.append(found.verdict == "pass")
    assert verdicts[::2] == verdicts[1::2]
    assert verdicts == sorted(verdicts, reverse=rule == "bridge")
    assert {True, False} == set(verdicts)


def swept(solids: SimpleNamespace, rule: str, value: float) -> Any:
    if rule == "minimum_lines":
        return solids.hollow_box(wall=value, floor=2.0, port=False)
    if rule == "bridge":
        return solids.hollow_box(inner=(20.0, value, 5.0), port=False)
    part = solids.hollow_box(port=False)
    for x in (4.0, 5.2 + value):
        part = part + solids.block((1.2, 8, 6), (x, 1, 10))
    return part
