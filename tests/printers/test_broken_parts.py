"""Every deliberately broken part is caught by the right rule at the right place, no sound one."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from broken_parts import BROKEN, SOUND, BrokenPart

from printers import (
    PrintabilityReport,
    PrintedModel,
    PrinterProfile,
    RuleResult,
    check_printability,
    load_profile,
)
from printers.report import place

PAGE = Path(__file__).parents[2] / "docs" / "printability.md"
POINT = re.compile(r"\(([-\d.]+), ([-\d.]+), ([-\d.]+)\) mm")
NEAR = 1.0  # mm
WITHOUT_PLACE = ("normals inverted",)


def checked(part: BrokenPart, profile: PrinterProfile) -> PrintabilityReport:
    model = PrintedModel(part.vertices, part.triangles, openings=(part.opening,))
    return check_printability(model, profile)


@cache
def report_on(name: str) -> PrintabilityReport:
    return checked(BROKEN[name](), load_profile("prusa_i3"))


def places(result: RuleResult) -> Iterator[tuple[float, ...]]:
    yield from (point for point in result.points if place(point) in result.where)


@pytest.mark.parametrize("name", BROKEN)
@pytest.mark.thorough
def test_the_fault_is_caught_by_its_rule_at_its_place(name: str) -> None:
    part, report = BROKEN[name](), report_on(name)
    caught = [r for r in report.rules if (r.rule, r.verdict) == (part.rule, part.verdict)]
    assert caught, [(r.rule, r.verdict) for r in report.rules if r.verdict not in ("pass", "info")]
    nearest = min((part.distance(p) for r in caught for p in places(r)), default=np.inf)
    assert nearest <= NEAR or name in WITHOUT_PLACE, [result.where for result in caught]


@pytest.mark.parametrize("name", BROKEN)
def test_every_place_in_words_is_there_in_numbers(name: str) -> None:
    for result in report_on(name).rules:
        words = POINT.finditer(f"{result.where} {result.message}")
        named = {tuple(float(number) for number in each.groups()) for each in words}
        written = {tuple(round(each, 1) for each in point) for point in result.points}
        assert named == written, result


LEAKS = ("pin hole", "slit", "root")


@pytest.mark.parametrize("name", [name for name in BROKEN if name.startswith(LEAKS)])
def test_a_leak_alone_makes_no_other_rule_fail(name: str) -> None:
    failures = {result.rule for result in report_on(name).failures}
    assert failures == {"airtightness"}


@pytest.mark.parametrize("make", SOUND.values(), ids=SOUND)
def test_the_sound_parts_raise_no_alarm(
    make: Callable[[], BrokenPart], prusa: PrinterProfile
) -> None:
    report = checked(make(), prusa)
    assert report.verdict == "pass", report.failures
    assert {warning.rule for warning in report.warnings} <= {"overhang"}  # under round bubbles


def test_the_detection_table_lists_every_broken_part_with_its_rule() -> None:
    rows = dict(re.findall(r"^\| ([^|]+) \| (`[^|]+) \|$", PAGE.read_text("utf-8"), re.MULTILINE))
    expected = {
        name: f"`{part.rule}`{' warns' if part.verdict == 'warn' else ''}"
        for name, part in ((name, make()) for name, make in BROKEN.items())
    }
    assert {name: rows.get(name) for name in BROKEN} == expected
