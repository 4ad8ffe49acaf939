"""Mouths that nobody declared, on solids whose mouths are known."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest
from broken_parts import BROKEN
from manifold3d import CrossSection, Manifold
from small_solids import SEGMENTS, arrays, bellows, block, bore, hollow_box

from printers.errors import PrintersError
from printers.measure.surface import Surface, merged_surface
from printers.openings.find import FoundOpenings, find_mouths, only_opening

BLOCK = block((20, 20, 12), (0, 0, 0))
CHORD = 1 - np.cos(np.pi / SEGMENTS)  # mm: by which the sides of a bore of 1 mm lie inside it
TURNS = [(0.0, 0.0, 0.0), (17.0, 33.0, 71.0), (90.0, 0.0, 45.0)]


def surface_of(solid: Manifold) -> Surface:
    return merged_surface(*arrays(solid))


def found_on(solid: Manifold) -> FoundOpenings:
    return only_opening(find_mouths(surface_of(solid)))


def moved(point: Sequence[float], turn: Sequence[float]) -> np.ndarray:
    """Where a turn as manifold3d makes it takes a point."""
    speck = Manifold.cube((1e-3, 1e-3, 1e-3), True).translate(tuple(point)).rotate(tuple(turn))
    return np.asarray(speck.bounding_box()).reshape(2, 3).mean(axis=0)


def can(length: float, radius: float, wall: float) -> Manifold:
    """A tube closed at z = 0."""
    outer = Manifold.cylinder(length, radius, radius, SEGMENTS)
    inner = Manifold.cylinder(length, radius - wall, radius - wall, SEGMENTS)
    return outer - inner.translate((0, 0, wall))


@pytest.mark.parametrize("turn", TURNS)
@pytest.mark.parametrize(
    ("solid", "centre", "direction", "radius"),
    [
        (hollow_box(), (0.0, 5.2, 5.2), (-1.0, 0.0, 0.0), 1.0),
        (bellows(1.2, 1.2, 1.6, 1.2, 3), (-4.0, 0.0, 3.2), (-1.0, 0.0, 0.0), 1.0),
        (can(30.0, 4.0, 1.2), (0.0, 0.0, 30.0), (0.0, 0.0, 1.0), 2.8),
        (can(9.0, 4.0, 1.2), (0.0, 0.0, 9.0), (0.0, 0.0, 1.0), 2.8),
    ],
)
@pytest.mark.thorough
def test_a_round_mouth_is_found_at_its_rim(
    solid: Manifold,
    centre: tuple[float, float, float],
    direction: tuple[float, float, float],
    radius: float,
    turn: tuple[float, float, float],
) -> None:
    (opening,) = found_on(solid.rotate(turn)).openings
    np.testing.assert_allclose(opening.centre, moved(centre, turn), atol=1e-5)
    np.testing.assert_allclose(opening.direction, moved(direction, turn), atol=1e-5)
    assert opening.radius == pytest.approx(radius, abs=1e-5) and opening.reach is None


def test_a_socket_before_a_narrower_channel_is_the_mouth() -> None:
    part = hollow_box() - bore(1.6, (-1.0, 5.2, 5.2), 1.6)
    (opening,) = found_on(part).openings
    np.testing.assert_allclose(opening.centre, (0.0, 5.2, 5.2), atol=1e-5)
    assert opening.radius == pytest.approx(1.6, abs=1e-5)


def test_a_mouth_in_a_round_wall_has_the_axis_of_its_bore() -> None:
    part = can(30.0, 6.0, 1.2) + Manifold.cylinder(1.2, 6, 6, SEGMENTS).translate((0, 0, 29))
    found = found_on(part - bore(1.5, (0.0, 0.0, 15.0), 10.0))
    (opening,) = found.openings
    np.testing.assert_allclose(opening.direction, (1.0, 0.0, 0.0), atol=1e-5)
    np.testing.assert_allclose(opening.centre[1:], (0.0, 15.0), atol=1e-3)
    assert opening.radius == pytest.approx(1.5, abs=0.01)
    assert any("no plane" in note for note in found.notes)


@pytest.mark.parametrize("turn", TURNS)
def test_a_mouth_that_is_not_round_says_so(turn: tuple[float, float, float]) -> None:
    part = hollow_box(port=False) - block((4, 4.0, 2.0), (-2, 3.2, 4.2))
    found = found_on(part.rotate(turn))
    (opening,) = found.openings
    np.testing.assert_allclose(opening.centre, moved((0.0, 5.2, 5.2), turn), atol=1e-5)
    assert opening.radius == pytest.approx(1.0, abs=1e-5)  # the pin that enters
    assert opening.reach == pytest.approx(np.hypot(2.0, 1.0), abs=1e-5)
    assert any("not round" in note and "3.19 mm" in note for note in found.notes)  # √(4 · 8 / π)


@pytest.mark.parametrize("diameter", [0.2, 0.3, 0.5, 0.9])
def test_a_pin_hole_beside_the_port_stays_a_leak(diameter: float) -> None:
    found = found_on(hollow_box() - bore(diameter / 2, (6.0, -1.0, 5.0), 5.0, 1))
    (opening,) = found.openings
    np.testing.assert_allclose(opening.centre, (0.0, 5.2, 5.2), atol=1e-5)
    assert any("taken for leaks" in note and "(6.0, 0.0, 5.0) mm" in note for note in found.notes)


@pytest.mark.parametrize("radius", [1.0, 0.6])
def test_two_mouths_of_like_width_are_named_and_asked_about(radius: float) -> None:
    part = hollow_box() - bore(radius, (10.0, 5.2, 5.2), 8.0)
    with pytest.raises(PrintersError) as refusal:
        found_on(part)
    assert "2 mouths" in str(refusal.value) and "--opening" in str(refusal.value)
    assert "(0.0, 5.2, 5.2) mm" in str(refusal.value)
    assert "(14.4, 5.2, 5.2) mm" in str(refusal.value)


def test_a_tube_through_the_part_has_two_mouths() -> None:
    tube = Manifold.cylinder(40, 6, 6, SEGMENTS) - Manifold.cylinder(40, 4, 4, SEGMENTS)
    with pytest.raises(PrintersError, match="2 mouths"):
        found_on(tube)


def test_two_cavities_are_asked_about() -> None:
    part = hollow_box() + hollow_box().mirror((1, 0, 0)).translate((28.8, 0, 0))
    with pytest.raises(PrintersError, match="2 cavities"):
        found_on(part)


def test_bodies_apart_are_left_to_the_rules() -> None:
    """The rule `one_body` has more to say of them."""
    assert len(found_on(hollow_box() + hollow_box().translate((30, 0, 0))).openings) == 1


def test_blind_holes_of_screws_are_left_aside() -> None:
    solid_end = block((8, 10.4, 10.4), (14.3, 0, 0)) - bore(1.0, (19.0, 5.0, 4.4), 10.0, 2)
    found = found_on(hollow_box() + solid_end)
    (opening,) = found.openings
    np.testing.assert_allclose(opening.centre, (0.0, 5.2, 5.2), atol=1e-5)
    assert any("left aside" in note for note in found.notes)


@pytest.mark.parametrize(
    ("solid", "words"),
    [
        (hollow_box(port=False), "one of 768.0 mm³ is sealed"),
        (BLOCK, "no cavity"),
        (BLOCK - block((1.2, 30, 8), (5, -1, 5)), "no cavity"),
        (
            block((20, 20, 12), (0, 0, 0)) - Manifold.sphere(5, 64).translate((10, 10, 13)),
            "no cavity",
        ),
    ],
    ids=["sealed", "solid", "groove", "dent"],
)
def test_what_has_no_mouth_is_said(solid: Manifold, words: str) -> None:
    found = found_on(solid)
    assert found.openings == () and words in found.notes[0]


def test_gaps_between_bubbles_are_no_cavity() -> None:
    """1.2 mm wide and 8 mm deep."""
    assert len(find_mouths(surface_of(bellows(1.2, 1.2, 1.6, 1.2, 3))).all) == 1


def test_an_open_mesh_has_no_inside() -> None:
    vertices, triangles = arrays(hollow_box())
    with pytest.raises(PrintersError, match="not closed"):
        find_mouths(merged_surface(vertices, triangles[1:]))
    with pytest.raises(PrintersError, match="normals outwards"):
        find_mouths(merged_surface(vertices, triangles[:, ::-1]))


@pytest.mark.parametrize("width", [0.1, 0.2, 0.4])
def test_a_long_slit_is_a_leak_whatever_its_area(width: float) -> None:
    """8 mm long it has the area of a port of 1 to 2 mm."""
    part = hollow_box() - block((8.0, width, 4.0), (3.0, 5.0, 8.0))
    found = found_on(part)
    (opening,) = found.openings
    np.testing.assert_allclose(opening.centre, (0.0, 5.2, 5.2), atol=1e-5)
    assert any("taken for leaks" in note for note in found.notes)


NOT_CLOSED = {"normals inverted", "triangle the other way round", "triangle left out"}


@pytest.mark.slow
@pytest.mark.parametrize("name", [name for name in BROKEN if name not in NOT_CLOSED])
def test_the_port_of_a_broken_part_is_found_whatever_its_fault(name: str) -> None:
    """So that the rule for the fault can name it."""
    part = BROKEN[name]()
    (opening,) = only_opening(find_mouths(merged_surface(part.vertices, part.triangles))).openings
    np.testing.assert_allclose(opening.centre, part.opening.centre, atol=0.05)
    assert opening.radius <= part.opening.radius + 0.05


@pytest.mark.parametrize("diameter", [0.002, 0.01, 0.04, 0.1])
def test_a_pin_hole_however_thin_hides_no_port(diameter: float) -> None:
    """No sample lies on the wall of so thin a hole, which must not tear the rims."""
    found = found_on(hollow_box() - bore(diameter / 2, (7.0, 5.0, 9.0), 3.0, 2))
    (opening,) = found.openings
    np.testing.assert_allclose(opening.centre, (0.0, 5.2, 5.2), atol=1e-5)
    assert any("taken for leaks" in note and "(7.0, 5.0, 10.4) mm" in note for note in found.notes)


@pytest.mark.slow
@pytest.mark.parametrize("times", [1, 3, 8, 20, 30])
def test_another_triangulation_of_the_same_faces_has_the_same_mouth(times: int) -> None:
    """Up to 371 000 triangles, of which one in 200 has a sample."""
    (opening,) = found_on(hollow_box().refine(times)).openings
    np.testing.assert_allclose(opening.centre, (0.0, 5.2, 5.2), atol=1e-5)
    assert opening.radius == pytest.approx(1.0, abs=CHORD) and opening.reach is None


@pytest.mark.parametrize("times", [2, 3])
def test_a_finer_mesh_of_a_fine_bellows_has_the_same_mouth(times: int) -> None:
    (opening,) = found_on(bellows(1.2, 1.2, 1.6, 1.2, 3).refine(times)).openings
    np.testing.assert_allclose(opening.centre, (-4.0, 0.0, 3.2), atol=1e-5)
    assert opening.radius == pytest.approx(1.0, abs=CHORD)


THROUGH = 1.4  # mm: through the wall of 1.2 mm
RUNS_IN = {
    "crack": block((THROUGH, 3.6, 0.3), (-0.1, 5.2, 5.05)),
    "fine crack": block((THROUGH, 3.6, 0.01), (-0.1, 5.2, 5.2)),
    "short crack": block((THROUGH, 1.3, 0.1), (-0.1, 5.2, 5.15)),
    "pin hole on the rim": bore(0.15, (-0.1, 6.2, 5.2), THROUGH),
    "thin pin hole on the rim": bore(0.04, (-0.1, 6.2, 5.2), THROUGH),
    "cracks to all sides": block((THROUGH, 5.0, 0.1), (-0.1, 2.7, 5.15))
    + block((THROUGH, 0.1, 5.0), (-0.1, 5.15, 2.7)),
}


@pytest.mark.parametrize("what", RUNS_IN)
@pytest.mark.parametrize("turn", TURNS[:2])
def test_what_runs_into_the_port_is_asked_about(what: str, turn: tuple[float, ...]) -> None:
    """A plug of the whole mouth would close it, and the part pass for tight."""
    with pytest.raises(PrintersError, match=r"runs into it; .*--opening X,Y,Z,DIAMETER"):
        found_on((hollow_box() - RUNS_IN[what]).rotate(turn))


@pytest.mark.parametrize(("length", "asked"), [(2.0, False), (4.0, False), (5.5, True)])
def test_a_slit_is_no_port(length: float, asked: bool) -> None:
    part = hollow_box(port=False) - block((4, length, 2.0), (-2, 5.2 - length / 2, 4.2))
    if asked:
        with pytest.raises(PrintersError, match="is a slit"):
            found_on(part)
    else:
        assert len(found_on(part).openings) == 1


def test_ports_of_other_shapes_are_taken_whole() -> None:
    """A drop, which prints without a support, and a hexagon."""
    across = bore(1.0, (-1.0, 5.2, 5.2), 2.5)
    corner = block((2.5, 1.0, 1.0), (0, 0, 0)).rotate((45, 0, 0)).translate((-1.0, 5.2, 5.2))
    hexagon = Manifold.cylinder(2.5, 1.0, 1.0, 6).rotate((0, 90, 0)).translate((-1.0, 5.2, 5.2))
    for hole in (across + corner, hexagon):
        (opening,) = found_on(hollow_box(port=False) - hole).openings
        assert opening.reach is not None


END = block((6, 10.4, 6), (14.4, 0, 0))  # solid, at the far end of the box


@pytest.mark.parametrize("radius", [0.1, 0.25, 0.5])
def test_a_small_chamber_with_a_mouth_of_its_own_is_asked_about(radius: float) -> None:
    """Its air is a thirtieth of the cavity's."""
    chamber = block((2.4, 4, 3), (15.6, 3, 1.5)) + bore(radius, (17, 5, 3), 4)
    with pytest.raises(PrintersError, match=r"2 cavities .*\(20\.4, 5\.0, 3\.0\) mm"):
        found_on(hollow_box() + END - chamber)


def test_holes_for_screws_right_through_are_left_aside() -> None:
    hole = bore(0.8, (18.0, -1.0, 3.0), 13.0, 1)
    sunk = hole + bore(1.6, (18.0, -1.0, 3.0), 3.0, 1)
    for tool in (hole, sunk):
        assert len(found_on(hollow_box() + END - tool).openings) == 1


@pytest.mark.parametrize("times", [1, 2])
def test_a_port_with_a_fillet_is_found_and_a_crack_into_it_asked_about(times: int) -> None:
    corner = CrossSection.square((1.5, 0.5)) - CrossSection.circle(0.5, 48).translate((1.5, 0.5))
    fillet = Manifold.revolve(corner, SEGMENTS).rotate((0, 90, 0)).translate((0, 5.2, 5.2))
    part = hollow_box() - fillet
    (opening,) = found_on(part.refine(times)).openings
    np.testing.assert_allclose(opening.centre[1:], (5.2, 5.2), atol=0.15)
    assert 0 <= opening.centre[0] <= 0.5 and opening.direction[0] < -0.98
    assert 0.8 < opening.radius < 1.5
    for what in (block((1.4, 3.6, 0.1), (-0.1, 5.2, 5.15)), bore(0.2, (-0.1, 6.2, 5.2), 1.4)):
        with pytest.raises(PrintersError, match="runs into it"):
            found_on((part - what).refine(times))


def test_a_crack_into_a_mouth_in_a_round_wall_is_asked_about() -> None:
    """Its rim lies in no plane."""
    wall = Manifold.cylinder(30, 6, 6, SEGMENTS)
    closed = wall - Manifold.cylinder(27.6, 4.8, 4.8, SEGMENTS).translate((0, 0, 1.2))
    for crack in (block((12, 3, 0.1), (0, 0, 15)), block((12, 0.1, 3), (0, 0, 15))):
        with pytest.raises(PrintersError, match="runs into it"):
            found_on(closed - bore(1.5, (0, 0, 15), 12) - crack)
