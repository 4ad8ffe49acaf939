"""Size, cross-section and the bed."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from printers import PrintedModel, PrinterProfile, check_printability
from printers.measure.part import MeasuredPart
from printers.rules.envelope import check_bed_contact, check_build_volume, check_cross_section


def boxed(
    solids: SimpleNamespace,
    profile: PrinterProfile,
    size: tuple[float, float, float],
    **declared: object,
) -> MeasuredPart:
    return solids.part(solids.block(size, (-3, -4, 2)), profile, **declared)


@pytest.mark.parametrize(
    ("size", "verdict"),
    [
        ((249, 209, 209), "pass"),
        ((209, 249, 209), "pass"),  # turned by 90 degrees on the bed
        ((209, 209, 249), "fail"),  # but not tipped over
        ((251, 10, 10), "fail"),
    ],
)
def test_a_part_may_be_turned_on_the_bed_but_not_tipped(
    solids: SimpleNamespace,
    prusa: PrinterProfile,
    size: tuple[float, float, float],
    verdict: str,
) -> None:
    (result,) = check_build_volume(boxed(solids, prusa, size))
    assert result.verdict == verdict


@pytest.mark.parametrize(
    ("size", "verdict"),
    [((50, 20, 20), "pass"), ((50, 20.5, 20), "fail"), ((50, 20, 21), "fail")],
)
def test_the_cross_section_leaves_out_the_length(
    solids: SimpleNamespace,
    prusa: PrinterProfile,
    size: tuple[float, float, float],
    verdict: str,
) -> None:
    (result,) = check_cross_section(boxed(solids, prusa, size, cross_section_limit=(20, 20)))
    assert result.verdict == verdict
    if verdict == "fail":
        excess = max(size[1] - 20, size[2] - 20)
        assert f"by {excess:.2f} mm" in result.message


def test_a_cross_section_that_counts_from_a_place_on_leaves_out_what_lies_before(
    solids: SimpleNamespace, prusa: PrinterProfile
) -> None:
    """The plate ends at x = 0, where the bar begins: its corners there do not count."""
    plate, bar = solids.block((4, 36, 15), (-4, -18, 0)), solids.block((50, 18, 20), (0, -9, 0))
    for start, measured, verdict in (
        (None, "36.00 × 20.00", "fail"),
        (-4.1, "36.00 × 20.00", "fail"),
        (0.0, "18.00 × 20.00", "pass"),
    ):
        part = solids.part(
            plate + bar, prusa, cross_section_limit=(20, 20), cross_section_start=start
        )
        (result,) = check_cross_section(part)
        assert (result.measured, result.verdict) == (measured, verdict)


def test_a_box_stands_on_all_of_its_footprint_wherever_it_is(
    solids: SimpleNamespace, prusa: PrinterProfile
) -> None:
    (result,) = check_bed_contact(boxed(solids, prusa, (10, 12, 5)))
    assert (result.verdict, result.measured) == ("pass", 120.0)


def test_a_ball_does_not_stand(solids: SimpleNamespace, prusa: PrinterProfile) -> None:
    (result,) = check_bed_contact(solids.part(solids.Manifold.sphere(10.0, 64), prusa))
    assert (result.verdict, result.where) == ("fail", "nowhere")


def test_a_box_on_four_thin_legs_stands_only_if_the_legs_are_wide_enough(
    solids: SimpleNamespace, prusa: PrinterProfile
) -> None:
    for leg, verdict in ((1.0, "fail"), (4.0, "pass")):
        table = solids.block((20, 20, 4), (0, 0, 6))
        for x in (0.0, 20 - leg):
            for y in (0.0, 20 - leg):
                table = table + solids.block((leg, leg, 6), (x, y, 0))
        (result,) = check_bed_contact(solids.part(table, prusa))
        assert result.measured == pytest.approx(4 * leg**2, abs=0.1)
        assert result.verdict == verdict


@pytest.mark.parametrize("axis", [0, 1, 2])
def test_a_flat_mesh_is_judged_like_any_other(
    solids: SimpleNamespace, prusa: PrinterProfile, axis: int
) -> None:
    """All of it lies in one plane; upright it has no footprint, and does not stand."""
    vertices, triangles = solids.arrays(solids.block((5, 5, 5), (0, 0, 0)))
    flat = PrintedModel(vertices * (np.arange(3) != axis), triangles)
    results = {r.rule: r for r in check_printability(flat, prusa).rules}
    assert results["bed_contact"].verdict == ("pass" if axis == 2 else "fail")
    assert results["minimum_lines"].verdict == results["one_body"].verdict == "fail"
