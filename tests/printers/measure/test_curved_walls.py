"""Which curved walls count, along sweeps in one direction: the verdict changes once at most."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from printers import PrinterProfile, check_printability
from printers.measure.curved_walls import facet_turn, on_flat_faces
from printers.measure.surface import Surface


def cylinder(solids: SimpleNamespace, radius: float, height: float, sides: int) -> Any:
    return solids.Manifold.cylinder(height, radius, radius, sides)


def can(solids: SimpleNamespace, shift: float, sides: int) -> Any:
    """Walls of 2 mm, five lines, with a bore beside the middle."""
    bore = cylinder(solids, 6.0, 10.0, sides).translate((shift, 0.0, 2.0))
    return cylinder(solids, 8.0, 14.0, sides) - bore


def bar(solids: SimpleNamespace, inner: float, outer: float, sides: int) -> Any:
    """Upright bar with walls of 1.2 mm whose upright edges are rounded, inside and outside."""

    def rounded(size: float, radius: float) -> Any:
        core = solids.CrossSection.square((size - 2 * radius, size - 2 * radius), center=True)
        round_ = solids.JoinType.Round
        return core.offset(radius, round_, circular_segments=sides) if radius else core

    hollow = solids.Manifold.extrude(rounded(24.0, inner), 21.6).translate((0.0, 0.0, 1.2))
    return solids.Manifold.extrude(rounded(26.4, outer), 24.0) - hollow


def verdicts(solids: SimpleNamespace, solid: Any, profile: PrinterProfile) -> set[str]:
    rules = check_printability(solids.model(solid), profile).rules
    return {
        rule.verdict
        for rule in rules
        if rule.rule == "wall_multiple_measured" and rule.unit == "lines"
    }


@pytest.mark.parametrize("sides", [48, 96])
def test_a_wall_around_a_shifted_bore_tapers_from_some_shift_on(
    solids: SimpleNamespace, prusa: PrinterProfile, sides: int
) -> None:
    """At 0.8 mm the thin side has three lines and the thick one infill; in between it tapers."""
    shifts = (0.0, 0.02, 0.1, 0.3, 0.8, 1.2, 1.5)
    fails = ["fail" in verdicts(solids, can(solids, shift, sides), prusa) for shift in shifts]
    assert fails == [False, False, True, True, True, True, True]


@pytest.mark.parametrize("sides", [48, 96])
@pytest.mark.parametrize("inner", [0.5, 2.0, 8.0])
@pytest.mark.thorough
def test_no_fillet_makes_a_wall_of_a_corner(
    solids: SimpleNamespace, prusa: PrinterProfile, inner: float, sides: int
) -> None:
    for less in (0.0, 0.05, 0.2, 0.4, 0.8, inner + 1.2):
        solid = bar(solids, inner, inner + 1.2 - less, sides)
        assert verdicts(solids, solid, prusa) == {"pass"}, less


def test_facets_are_told_from_flat_faces(solids: SimpleNamespace) -> None:
    for sides in (32, 64, 128):
        surface = Surface(*solids.arrays(cylinder(solids, 4.0, 10.0, sides)))
        upright = np.abs(surface.normals[:, 2]) < 0.5
        assert not on_flat_faces(surface)[upright].any()
        assert on_flat_faces(surface)[~upright].all()
        assert facet_turn(surface)[upright] == pytest.approx(360 / sides, rel=1e-6)
    box = Surface(*solids.arrays(solids.block((4, 4, 4), (0, 0, 0))))
    assert on_flat_faces(box).all() and not facet_turn(box).any()


def test_a_round_bore_in_a_block_becomes_a_wall_once(
    solids: SimpleNamespace, prusa: PrinterProfile
) -> None:
    """Of 1.3 mm at its narrowest: beside a narrow bore that is a spot, beside a wide one a wall."""
    fails = []
    for radius in (1.0, 3.0, 8.0, 20.0):
        side = 2 * radius + 2.6
        block = solids.block((20, side, side), (0, -side / 2, -side / 2))
        bore = solids.bore(radius, (1.2, 0.0, 0.0), 17.6)
        fails.append("fail" in verdicts(solids, block - bore, prusa))
    assert fails == sorted(fails) and fails[0] is False and fails[-1] is True
