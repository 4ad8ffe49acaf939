"""The wall around an opening is measured there, not on other walls as thick."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from printers import DeclaredWall, Opening, PrinterProfile, RuleResult, check_printability

PORT = Opening("port", (-6.0, 5.2, 5.2), (-1.0, 0.0, 0.0), 1.0)


def with_boss(solids: SimpleNamespace, wall: float, length: float = 6.0, shift: float = 0.0) -> Any:
    """`hollow_box` with walls of 1.2 mm and a round boss of another wall around its port."""
    boss = solids.bore(1.0 + wall, (-length, 5.2 + shift, 5.2), length + 0.5)
    return solids.hollow_box(port=False) + boss - solids.bore(1.0, (-length - 1, 5.2, 5.2), 12.0)


def results(
    solids: SimpleNamespace, solid: Any, profile: PrinterProfile, wall: float, opening: Opening
) -> dict[str, RuleResult]:
    declared = (DeclaredWall("boss", wall, around=opening),)
    report = check_printability(solids.model(solid, walls=declared, openings=(opening,)), profile)
    return {r.rule: r for r in report.rules if r.where == "boss"}


@pytest.mark.parametrize("length", [2.0, 6.0])
@pytest.mark.parametrize("wall", [1.2, 1.6, 2.0, 2.8])
def test_a_boss_is_as_thick_as_it_is_declared(
    solids: SimpleNamespace, prusa: PrinterProfile, wall: float, length: float
) -> None:
    mouth = Opening("port", (-length, 5.2, 5.2), (-1.0, 0.0, 0.0), 1.0)
    found = results(solids, with_boss(solids, wall, length), prusa, wall, mouth)
    assert {name: result.verdict for name, result in found.items()} == {
        "wall_multiple": "pass",
        "wall_as_declared": "pass",
        "minimum_lines": "pass",
    }
    assert found["wall_as_declared"].measured == pytest.approx(wall, abs=0.005)
    assert found["wall_as_declared"].uncertainty == 0.02


def test_other_walls_of_the_declared_thickness_do_not_stand_for_the_boss(
    solids: SimpleNamespace, prusa: PrinterProfile
) -> None:
    """The box is 1.2 mm thick all over, its boss 1.6 or 0.8 mm."""
    for thick in (1.6, 0.8):
        found = results(solids, with_boss(solids, thick), prusa, 1.2, PORT)["wall_as_declared"]
        assert found.verdict == "fail"
        assert found.measured == pytest.approx(thick, abs=0.005)


def test_the_narrowest_side_of_a_shifted_boss_counts(
    solids: SimpleNamespace, prusa: PrinterProfile
) -> None:
    measured = []
    for shift in (0.0, 0.1, 0.3, 0.5):
        found = results(solids, with_boss(solids, 1.6, shift=shift), prusa, 1.6, PORT)
        measured.append(found["wall_as_declared"].measured)
        assert found["wall_as_declared"].verdict == ("pass" if shift == 0 else "fail")
        assert found["minimum_lines"].verdict == ("pass" if shift < 0.4 else "fail")
    assert measured == sorted(measured, reverse=True)
    assert measured == pytest.approx([1.6, 1.5, 1.3, 1.1], abs=0.03)


def test_a_boss_of_two_lines_does_not_seal_however_short_it_is(
    solids: SimpleNamespace, prusa: PrinterProfile
) -> None:
    mouth = Opening("port", (-2.0, 5.2, 5.2), (-1.0, 0.0, 0.0), 1.0)
    found = results(solids, with_boss(solids, 0.8, 2.0), prusa, 0.8, mouth)
    assert found["wall_as_declared"].verdict == "pass"
    assert found["minimum_lines"].verdict == "fail"
    assert "3 lines of 0.4 mm" in found["minimum_lines"].message


def test_an_opening_without_a_bore_has_no_wall(
    solids: SimpleNamespace, prusa: PrinterProfile
) -> None:
    wider = Opening("port", (-6.0, 5.2, 5.2), (-1.0, 0.0, 0.0), 1.4)
    found = results(solids, with_boss(solids, 1.6), prusa, 1.6, wider)
    assert (found["wall_as_declared"].verdict, found["wall_as_declared"].measured) == (
        "fail",
        "none",
    )
