"""Arcs against their closed forms."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from printers.errors import PrintersError
from printers.gcode.arcs import CHORD_ERROR
from printers.gcode.reading import GCode

AREA = np.pi * 1.75**2 / 4
TO_START = "M83\nG1 Z.2\nG0 X10 Y0\n"

# From (10, 0) about the origin: command, angle swept.
ARCS = {
    "quarter": ("G3 X0 Y10 I-10 J0 E1", np.pi / 2),
    "three quarters": ("G2 X0 Y10 I-10 E1", -3 * np.pi / 2),
    "half": ("G3 X-10 I-10 E1", np.pi),
    "circle": ("G3 I-10 J0 E1", 2 * np.pi),
    "circle, clockwise": ("G2 X10 Y0 I-10 J0 E1", -2 * np.pi),
    "radius": ("G3 X0 Y10 R10 E1", np.pi / 2),
    "radius, longer way": ("G2 X0 Y10 R-10 E1", -3 * np.pi / 2),
    "radius, half": ("G2 X-10 Y0 R10 E1", -np.pi),
}


@pytest.mark.parametrize("name", ARCS)
def test_an_arc_keeps_its_circle_its_angle_and_its_plastic(
    read: Callable[..., GCode], name: str
) -> None:
    command, swept = ARCS[name]
    beads = read(f"{TO_START}{command}\n").beads
    assert beads.volume.sum() == pytest.approx(AREA, rel=1e-12)
    np.testing.assert_allclose(np.linalg.norm(beads.start, axis=1), 10, atol=1e-9)
    np.testing.assert_array_equal(beads.end[:-1], beads.start[1:])
    angles = np.unwrap(np.arctan2(*np.vstack((beads.start, beads.end[-1:])).T[::-1]))
    assert angles[-1] - angles[0] == pytest.approx(swept, abs=1e-9)
    assert len(set(beads.path.tolist())) == 1


@pytest.mark.parametrize(
    ("setting", "arc"),
    [
        ("G90.1", "G3 I5 J0 E1"),
        ("G90.1\nG91", "G3 I5 J0 E1"),
        ("G92 X110\nG90.1", "G3 I105 J0 E1"),
        ("G90.1\nG20", "G3 I.1968503937007874 J0 E.03937007874015748"),
        ("G90.1\nG91.1", "G3 I-5 J0 E1"),
        ("", "G3 I-5 J0 E1"),
    ],
)
def test_centres_are_places_after_g90_1(read: Callable[..., GCode], setting: str, arc: str) -> None:
    """A full circle about (5, 0), from (10, 0)."""
    beads = read(f"{TO_START}{setting}\n{arc}\n").beads
    np.testing.assert_allclose(np.hypot(beads.start[:, 0] - 5, beads.start[:, 1]), 5, atol=1e-9)
    assert beads.volume.sum() == pytest.approx(AREA, rel=1e-9)


def test_a_place_of_a_centre_needs_both_numbers(read: Callable[..., GCode]) -> None:
    with pytest.raises(PrintersError, match="line 5 of the G-code has an arc without a centre"):
        read(f"{TO_START}G90.1\nG3 I5 E1\n")


def test_chords_leave_the_arc_by_no_more_than_the_error_and_not_by_much_less(
    read: Callable[..., GCode],
) -> None:
    for radius in (0.05, 0.5, 5.0, 50.0):
        beads = read(f"M83\nG1 Z.2\nG0 X{radius}\nG3 X{radius} I{-radius} E1\n").beads
        middles = (beads.start + beads.end) / 2
        sagitta = radius - np.linalg.norm(middles, axis=1)
        assert sagitta.max() <= CHORD_ERROR * (1 + 1e-9)
        assert sagitta.max() >= CHORD_ERROR / 4 or len(beads) <= 8


def test_length_of_a_parted_circle_converges_to_that_of_the_circle(
    read: Callable[..., GCode], monkeypatch: pytest.MonkeyPatch
) -> None:
    errors = []
    for error in (0.02, 0.005):
        monkeypatch.setattr("printers.gcode.arcs.CHORD_ERROR", error)
        beads = read("M83\nG1 Z.2\nG0 X10\nG3 X10 I-10 E1\n").beads
        errors.append(1 - beads.length.sum() / (20 * np.pi))
    assert 3 < errors[0] / errors[1] < 5  # the error of the length goes with that of the chord


def test_arcs_in_inches_are_the_arcs_in_millimetres(read: Callable[..., GCode]) -> None:
    one = read("M83\nG1 Z.254\nG0 X25.4\nG3 X0 Y25.4 I-25.4 E2.54\n").beads
    other = read("G20\nM83\nG1 Z.01\nG0 X1\nG3 X0 Y1 I-1 E.1\n").beads
    np.testing.assert_allclose(one.end, other.end, atol=1e-9)
    np.testing.assert_allclose(one.volume, other.volume)


def test_an_arc_whose_end_is_rounded_still_ends_there(read: Callable[..., GCode]) -> None:
    beads = read("M83\nG1 Z.2\nG0 X10\nG3 X0.004 Y9.996 I-10 E1\nG1 X0 Y20 E1\n").beads
    np.testing.assert_array_equal(beads.start[-1], [0.004, 9.996])
    np.testing.assert_array_equal(beads.end[-2], [0.004, 9.996])


def test_arcs_without_plastic_are_travel_whatever_they_are(read: Callable[..., GCode]) -> None:
    code = read("M83\nG1 Z.2\nG1 X5 E1\nG17\nG2 Z.6 I.86 J.86 P1\nG1 Z.2\nG1 X9 E1\n")
    assert len(code.beads) == 2 and code.beads.path.tolist() == [0, 1]


@pytest.mark.parametrize(
    ("command", "message"),
    [
        ("G2 X5 E1", "without a centre"),
        ("G2 X5 Y5 I-10 J0 E1", "does not lie on its circle"),
        ("G2 X5 R1 E1", "does not lie on its circle"),
        ("G2 R1 E1", "does not lie on its circle"),
        ("G2 I0 J0 E1", "does not lie on its circle"),
        ("G2 X0 Y10 I-10 P2 E1", "several turns"),
        ("G18\nG2 X0 I-10 E1", "not in the plane of the bed"),
        ("G2 X9 I99999 E1", "leads farther"),
    ],
)
def test_an_arc_that_is_none_is_refused(
    read: Callable[..., GCode], command: str, message: str
) -> None:
    with pytest.raises(PrintersError, match=message):
        read(f"{TO_START}{command}\n")


def test_arcs_that_would_fill_the_memory_are_refused(
    read: Callable[..., GCode], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("printers.gcode.reading.MOST_BEADS", 1000)
    with pytest.raises(PrintersError, match="more than 1000 straight pieces"):
        read("M83\nG1 Z.2\nG0 X9000\n" + "G3 X9000 I-9000 E1\n" * 3)
