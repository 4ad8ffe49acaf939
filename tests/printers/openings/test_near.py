"""Openings that are named by a point."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from small_solids import arrays, block, bore, hollow_box

from printers import Opening, PrintedModel, check_printability, load_profile
from printers.errors import PrintersError
from printers.measure.surface import Surface, merged_surface
from printers.openings.find import FoundOpenings, find_mouths
from printers.openings.near import named_opening, require_apart

PART = merged_surface(*arrays(hollow_box() - bore(1.0, (10.0, 5.2, 5.2), 8.0)))


def named(*numbers: float, surface: Surface = PART) -> FoundOpenings:
    x, y, z, *rest = numbers
    point = (x, y, z, rest[0] if rest else None)
    return named_opening(surface, find_mouths(surface), point, "opening")


@pytest.mark.parametrize(("x", "centre"), [(-0.5, 0.0), (1.0, 0.0), (13.0, 14.4)])
def test_a_point_names_the_nearest_mouth(x: float, centre: float) -> None:
    found = named(x, 5.0, 5.2)
    (opening,) = found.openings
    np.testing.assert_allclose(opening.centre, (centre, 5.2, 5.2), atol=1e-5)
    assert opening.radius == pytest.approx(1.0)
    assert f"{np.hypot(x - centre, 0.2):.2f} mm from the point" in found.notes[0]


def test_a_diameter_that_is_given_counts() -> None:
    (opening,) = named(0.0, 5.2, 5.2, 1.6).openings
    assert opening.radius == 0.8 and opening.reach == pytest.approx(1.0)  # the plug still closes it
    (opening,) = named(0.0, 5.2, 5.2, 3.0).openings
    assert opening.radius == 1.5 and opening.reach is None


def test_where_no_mouth_is_one_is_declared_along_the_normal() -> None:
    found = named(7.0, 5.0, 10.4, 2.0)
    (opening,) = found.openings
    assert opening.centre == (7.0, 5.0, 10.4) and opening.radius == 1.0
    np.testing.assert_allclose(opening.direction, (0, 0, 1), atol=1e-12)
    assert "no mouth was found" in found.notes[0]


def test_without_a_mouth_or_a_diameter_the_nearest_mouth_is_told() -> None:
    with pytest.raises(PrintersError, match=r"no mouth .* nearest is .* \(0\.0, 5\.2, 5\.2\) mm"):
        named(6.0, 5.0, 10.4)
    solid = merged_surface(*arrays(block((9, 9, 9), (0, 0, 0))))
    with pytest.raises(PrintersError, match="no mouth was found"):
        named(0.0, 5.0, 5.0, surface=solid)


def test_a_point_far_from_the_part_is_refused() -> None:
    with pytest.raises(PrintersError, match="too far"):
        named(0.0, 0.0, 50.0, 2.0)


CRACKED = hollow_box() - block((1.4, 3.6, 0.3), (-0.1, 5.2, 5.05))


def test_beside_a_port_with_a_diameter_a_crack_into_it_is_a_leak() -> None:
    surface = merged_surface(*arrays(CRACKED))
    with pytest.raises(PrintersError, match="runs into it"):
        named(0.0, 5.2, 5.2, surface=surface)
    openings = named(-0.5, 5.2, 5.2, 2.0, surface=surface).openings
    assert openings[0].centre == pytest.approx((0.0, 5.2, 5.2), abs=1e-5)
    assert openings[0].reach is None
    model = PrintedModel(*arrays(CRACKED), openings=openings)
    rules = {rule.rule: rule for rule in check_printability(model, load_profile("prusa_i3")).rules}
    assert rules["airtightness"].verdict == "fail"
    assert "still open near (0." in rules["airtightness"].message  # beside it, in the wall at x = 0
    assert rules["opening_width"].verdict == "pass"


def test_one_mouth_named_twice_is_refused() -> None:
    once, again = named(0.0, 5.2, 5.2).openings[0], named(0.0, 5.0, 5.2).openings[0]
    overlapping = named(0.0, 5.2, 6.0, 1.0, surface=surface_of_a_sealed_box()).openings[0]
    for other in (again, overlapping):
        with pytest.raises(PrintersError, match=r"same mouth, .* name each mouth once"):
            require_apart((once, other))
    require_apart((once, named(14.4, 5.2, 5.2).openings[0]))


def test_both_ends_of_a_short_hole_are_two_openings() -> None:
    ends = [Opening(f"end {x:+g}", (x, 0.0, 0.0), (x, 0.0, 0.0), 2.0) for x in (-1.0, 1.0)]
    require_apart(ends)
    with pytest.raises(PrintersError, match=r"end -1 .* and again"):
        require_apart([*ends, replace(ends[0], name="again")])


def surface_of_a_sealed_box() -> Surface:
    return merged_surface(*arrays(hollow_box(port=False)))
