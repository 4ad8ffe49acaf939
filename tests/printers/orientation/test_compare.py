"""Which way to stand prints best, on parts where that is plain."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from manifold3d import Manifold
from small_solids import arrays, block, bore, hollow_box, port_of

from printers import PrintedModel, PrinterProfile, check_printability
from printers.measure.part import MeasuredPart
from printers.orientation.candidates import MOST, onto_faces, stances
from printers.orientation.compare import JudgedStance, compare_orientations
from printers.orientation.turning import parse_up, turned


def model(solid: Manifold, **declared: Any) -> PrintedModel:
    return PrintedModel(*arrays(solid), **declared)


def compared(part: PrintedModel, profile: PrinterProfile) -> tuple[JudgedStance, ...]:
    return compare_orientations(part, profile, lambda each: check_printability(each, profile))


def standing_on_its_end(length: float) -> PrintedModel:
    """A long hollow box, its length along z, its port low on one side."""
    inner = (length, 8.0, 8.0)
    box = model(hollow_box(inner=inner), openings=(port_of(inner=inner),))
    return turned(box, parse_up("-X"))


def test_a_long_box_lies_down(prusa: PrinterProfile) -> None:
    """It then has a fifth of the layers, and every rule passes either way."""
    best, *others = compared(standing_on_its_end(40.0), prusa)
    assert best.report.verdict == "pass" and best.stance.height == pytest.approx(10.4)
    assert best.stance.alike == 3 and best.layers == 104
    assert {round(each.stance.height, 1) for each in others} == {42.4}


def test_a_wide_roof_inside_stands_on_its_side(prusa: PrinterProfile) -> None:
    """Lying flat, its roof spans 14 mm of air; on its side 8 mm, with less height than on end."""
    inner = (30.0, 14.0, 8.0)
    part = model(hollow_box(inner=inner), openings=(port_of(inner=inner),))
    best, *others = compared(part, prusa)
    assert best.report.verdict == "pass" and best.stance.turning.name in ("Y", "-Y")
    flat = next(each for each in others if each.stance.turning.name == "Z")
    assert [rule.rule for rule in flat.report.failures] == ["bridge"]
    assert "spans 14" in flat.reason


def test_what_does_not_fit_or_hold_is_not_judged_further(prusa: PrinterProfile) -> None:
    long = block((230, 12, 12), (0, 0, 0)) - bore(2.0, (-1, 6, 6), 100.0)
    judged: list[PrintedModel] = []

    def judge(part: PrintedModel):  # type: ignore[no-untyped-def]
        judged.append(part)
        return check_printability(part, prusa)

    found = compare_orientations(model(long), prusa, judge)
    upright = [each for each in found if each.stance.height > 200]
    assert upright and all(not each.is_whole for each in upright)
    assert all(each.report.failures[0].rule == "build_volume" for each in upright)
    assert len(judged) == len(found) - len(upright)


def test_a_ball_on_a_foot_has_one_way_to_stand(prusa: PrinterProfile) -> None:
    """Facets of the ball are no faces to stand on."""
    part = Manifold.sphere(8.0, 48).translate((0, 0, 12)) + Manifold.cylinder(8, 5, 5, 48)
    found = stances(MeasuredPart(model(part), prusa).surface)
    assert [stance.turning.name for stance in found] == ["Z"]


def test_places_are_those_of_the_file(prusa: PrinterProfile) -> None:
    part = standing_on_its_end(40.0)
    best = compared(part, prusa)[0]
    where = next(rule.where for rule in best.report.rules if rule.rule == "opening_width")
    numbers = [float(word.strip("(),")) for word in where.split()[:3]]
    np.testing.assert_allclose(numbers, part.openings[0].centre, atol=0.11)


def test_there_are_never_many(prusa: PrinterProfile) -> None:
    rng = np.random.default_rng(4)
    part = Manifold.hull_points(rng.normal(size=(60, 3)) * 10)
    assert 1 <= len(stances(MeasuredPart(model(part), prusa).surface)) <= MOST


def test_of_a_round_part_only_the_faces_that_may_carry_it_are_looked_at() -> None:
    """Looking at each of thousands would take a time that grows with their square."""
    dome = Manifold.sphere(8.0, 200).translate((0, 0, 2)) ^ block((20, 20, 20), (-10, -10, 0))
    vertices, triangles = arrays(dome)
    assert len(triangles) > 10_000
    assert [turning.name for turning in onto_faces(vertices)] == ["Z"]


@pytest.mark.parametrize(("sides", "faces"), [(4, 6), (100, 102), (150, 152), (1000, 2)])
def test_every_face_of_a_prism_that_may_carry_it_is_looked_at(sides: int, faces: int) -> None:
    """Each side of 150 has 2.1 % of the footprint, each of 1000 has 0.3 %."""
    prism = Manifold.cylinder(30.0, 5.0, 5.0, sides)
    assert len(onto_faces(arrays(prism)[0])) == faces
