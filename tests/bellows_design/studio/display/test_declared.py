"""Lights before there is a solid agree with those that are measured on it."""

from __future__ import annotations

import pytest

from bellows_design.design.design import Design
from bellows_design.design.shipped import load_design, shipped_designs
from bellows_design.pipeline import build_part, check
from bellows_design.studio.choices.changed import changed
from bellows_design.studio.display.declared import declared_lights


def verdicts(design: Design) -> dict[tuple[str, str], str]:
    return {(each["rule"], each["where"]): each["verdict"] for each in declared_lights(design)}


@pytest.mark.parametrize("name", shipped_designs())
@pytest.mark.thorough
def test_declared_lights_are_those_of_the_whole_check(name: str) -> None:
    design = load_design(name)
    report = check(design, build_part(design))
    measured = {(each.rule, each.where): each.verdict for each in report.rules}
    found = verdicts(design)
    assert {rule for rule, _ in found} >= {"wall_multiple", "layer_height", "cross_section"}
    assert found.items() <= measured.items()


def test_a_wall_that_is_no_whole_number_of_lines_fails_at_once() -> None:
    design = changed(load_design("finger"), {"bubble_thickness": 1.0})
    assert verdicts(design)["wall_multiple", "bubble_thickness"] == "fail"


def test_a_wide_bubble_leaves_the_cross_section_at_once() -> None:
    design = changed(load_design("prototype_1"), {"bubble_width": 24.0})
    assert verdicts(design)["cross_section", "y × z"] == "fail"


def test_a_long_finger_does_not_fit_the_printer_at_once() -> None:
    design = changed(load_design("prototype_1"), {"length": 400.0, "number_of_bubbles": 5})
    assert verdicts(design)["build_volume", "whole part"] == "fail"
