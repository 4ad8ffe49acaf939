"""What the commands mean: known lengths, volumes and places, whatever mode they are written in."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from printers.errors import PrintersError
from printers.gcode import machine, words
from printers.gcode.reading import GCode

AREA = np.pi * 1.75**2 / 4

L_SHAPE = """
G21
G90
M83
G1 Z0.2
G0 X10 Y10
G1 X30 Y10 E1
G1 X30 Y20 E.5
"""
"""20 mm along x, then 10 mm along y, 1.5 mm of filament."""


def same(one: GCode, other: GCode) -> None:
    for name in one.beads.__dataclass_fields__:
        np.testing.assert_allclose(
            getattr(one.beads, name), getattr(other.beads, name), atol=1e-9, err_msg=name
        )


def test_lengths_widths_and_volumes_follow_from_the_moves(read: Callable[..., GCode]) -> None:
    beads = read(L_SHAPE).beads
    np.testing.assert_allclose(beads.length, [20, 10])
    np.testing.assert_allclose(beads.height, 0.2)
    np.testing.assert_allclose(beads.width, AREA * 0.05 / 0.2)
    assert beads.volume.sum() == pytest.approx(1.5 * AREA, rel=1e-12)
    assert beads.path.tolist() == [0, 0] and beads.layer.tolist() == [0, 0]


@pytest.mark.parametrize(
    "text",
    [
        "M82\nG92 E7\nG1 Z0.2\nG0 X10 Y10\nG1 X30 Y10 E8\nG92 E0\nG1 X30 Y20 E0.5\n",
        "G91\nG1 Z0.2\nG0 X10 Y10\nG1 X20 E1\nG1 Y10 E.5\n",
        "G20\nM83\nG1 Z0.007874015748031496\nG0 X0.3937007874015748 Y0.3937007874015748\n"
        "G1 X1.1811023622047243 E0.03937007874015748\n"
        "G1 Y0.7874015748031495 E0.01968503937007874\n",
        "N1 M83*12\nN2 G1 Z0.2 *3\nN3 G0 X10Y10\nN4 G1X30Y10E1*99\nN5 g1 x30 y20 e.5\n",
        "M83\nG1 Z0.2\nG92 X5 Y5\nG0 X15 Y15\nG1 X35 E1\nG92 X0\nG1 Y25 E.5\n",
        "M83\nG28\nG1 Z0.2(up)\nG0 X10 Y10 ; there\nG1 X30 E1 F900\nG1 F1200\n"
        "G1 Y20 E.5 ;TYPE:Nothing\n",
        f"M200 D1.75\nM83\nG1 Z0.2\nG0 X10 Y10\nG1 X30 E{AREA:.12f}\nM200 D0\nG1 Y20 E.5\n",
        "M83\nG1 Z0.2 E5 F3\nG0 X10 Y10\nG1 X30 E1\nG1 E3\nG1 Y20 E.5\n",
    ],
    ids=["absolute", "G91", "inches", "numbered", "G92", "comments", "volumetric", "blobs"],
)
def test_every_way_to_write_the_same_moves_gives_the_same_beads(
    read: Callable[..., GCode], text: str
) -> None:
    same(read(text), read(L_SHAPE))


@pytest.mark.parametrize("percent", [0, 60, 95, 130])
def test_flow_scales_the_plastic_from_its_line_on(read: Callable[..., GCode], percent: int) -> None:
    """Marlin, M221: what leaves the nozzle is the E that is asked for, times S per cent."""
    text = f"M82\nG1 Z.2\nG1 X10 E1\nM221 S{percent}\nG1 X20 E2\nM221 S100\nG1 X30 E3\n"
    code = read(text)
    laid = [1, percent / 100, 1] if percent else [1, 1]
    assert code.beads.volume == pytest.approx(AREA * np.array(laid))
    assert code.filament_length == pytest.approx(2 + percent / 100)
    assert any("(M221)" in note for note in code.notes) == (percent > 0)


def test_a_flow_of_60_percent_halves_neither_places_nor_what_the_slicer_states(
    read: Callable[..., GCode],
) -> None:
    """The slicer's own account of its filament knows nothing of M221."""
    text = "M83\nM221 S60\nG1 Z.2\nG1 X10 E1\n; filament used [mm] = 1.0\n"
    code = read(text)
    np.testing.assert_allclose(code.beads.width, 0.6 * AREA / 10 / 0.2)
    assert code.beads.length == pytest.approx([10])
    assert not [note for note in code.notes if "misread" in note]


@pytest.mark.parametrize("line", ["M221 S", "M221 X0 Y0 Z0", "M221 Z0", "M221"])
def test_the_end_stops_of_bambu_are_no_flow(read: Callable[..., GCode], line: str) -> None:
    code = read(f"M83\n{line}\nG1 Z.2\nG1 X10 E1\n")
    assert code.beads.volume == pytest.approx([AREA])


@pytest.mark.parametrize(
    "command",
    ["SET_EXTRUDE_FACTOR FACTOR=0.6", "M92 E400", "SET_GCODE_OFFSET Z=.2", "N4 m579 X2", "G59.1"],
)
def test_other_commands_that_change_plastic_or_places_are_told(
    read: Callable[..., GCode], command: str
) -> None:
    text = "M83\nG1 Z.2\nG1 X10 E1\n"
    name = command.removeprefix("N4 ").split()[0].upper()
    assert any(note.startswith(f"{name}: passed over") for note in read(text + command).notes)
    unlike = f"; {command}\nM922\nM92_MINE\nG54\n"
    assert not [note for note in read(text + unlike).notes if "passed over" in note]


def test_extrusion_is_relative_after_incremental_moves_too(read: Callable[..., GCode]) -> None:
    text = "M82\nG90\nG1 Z.2\nG1 X10 E1\nG91\nG1 X10 E1\nG90\nG1 X30 E3\n"
    assert read(text).beads.volume == pytest.approx(np.full(3, AREA))


def test_filament_that_was_pulled_back_is_no_plastic_when_it_returns(
    read: Callable[..., GCode],
) -> None:
    text = "M83\nG1 Z.2\nG1 X10 E1\nG1 E-.8\nG0 X20\nG1 E.8\nG1 X30 E1\n"
    code = read(text)
    np.testing.assert_allclose(code.beads.volume, AREA)
    assert code.beads.path.tolist() == [0, 1]
    assert code.filament_length == pytest.approx(2)


def test_a_wipe_that_pulls_back_lays_down_nothing(read: Callable[..., GCode]) -> None:
    text = "M83\nG1 Z.2\nG1 X10 E1\nG1 X5 E-.3\nG1 X0 E-.5\nG1 Y9\nG1 X2 E.8\nG1 X12 E1\n"
    code = read(text)
    np.testing.assert_allclose(code.beads.start, [[0, 0], [2, 9]])
    np.testing.assert_allclose(code.beads.volume, AREA)


def test_what_returns_beyond_the_retraction_is_plastic(read: Callable[..., GCode]) -> None:
    code = read("M83\nG1 Z.2\nG1 X10 E1\nG1 E-.5\nG1 X20 E1.5\n")
    assert code.beads.volume == pytest.approx([AREA, AREA])


def test_retraction_by_the_firmware_parts_paths(read: Callable[..., GCode]) -> None:
    code = read("M83\nG1 Z.2\nG1 X10 E1\nG10\nG11\nG1 X20 E1\nG10 P0 S200\nG1 X30 E1\n")
    assert code.beads.path.tolist() == [0, 1, 1]


@pytest.mark.parametrize("travel", ["G0 Y5\nG0 Y0", "G1 Z.6\nG1 Z.2", "G1 E-1\nG1 E1"])
def test_paths_end_where_the_flow_ends(read: Callable[..., GCode], travel: str) -> None:
    code = read(f"M83\nG1 Z.2\nG1 X10 E1\nG1 F900\nM117 E5\n{travel}\nG1 X20 E1\n")
    assert code.beads.path.tolist() == [0, 1]


def test_macros_and_subcommands_are_passed_over(read: Callable[..., GCode]) -> None:
    text = "M83\nG1 Z.2\nG1_CLEAN X5\nG92.1 X99\nG29.2 S0\nM622 J1\nT1000\nEXCLUDE_OBJECT NAME=a\n"
    assert read(f"{text}G1 X10 E1\n").beads.end.tolist() == [[10, 0]]


def test_homing_sets_the_named_axes(read: Callable[..., GCode]) -> None:
    code = read("M83\nG1 Z.2\nG0 X7 Y7\nG28 X\nG1 X5 E1\n")
    assert code.beads.start.tolist() == [[0, 7]]


def test_windows_line_ends_are_read(read: Callable[..., GCode]) -> None:
    same(read(L_SHAPE.replace("\n", "\r\n")), read(L_SHAPE))


def test_a_file_read_in_pieces_is_read_as_one(
    read: Callable[..., GCode], monkeypatch: pytest.MonkeyPatch
) -> None:
    text = ";TYPE:Perimeter\n" + L_SHAPE + ";TYPE:Solid infill\n" + "G1 X9 E.1\nG1 X3 E.1\n" * 20
    whole = read(text)
    monkeypatch.setattr("printers.gcode.pieces.PIECE", 7)
    same(read(text), whole)


def test_lexer_and_machine_agree_on_letters_and_commands() -> None:
    columns = [machine._X, machine._Y, machine._Z, machine._E_WORD, machine._I, machine._J]
    columns += [machine._R, machine._S, machine._D, machine._P]
    assert columns == [words.LETTERS.index(letter) for letter in "XYZEIJRSDP"]
    assert (machine._G, machine._M, machine._HOME) == (words.G, words.M, words.HOME)
    assert machine._WORD_TOOL == words.TOOL


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("M83\nG1 Z.2\nG1 X20000 E1\n", "line 3 of the G-code leads farther than 10 m"),
        ("M83\nG1 X1e9 E1\n", "line 2 of the G-code has a letter twice"),
        ("M83\nG1 X E1\n", "line 2 of the G-code has a letter without a number"),
        ("M83\nG1 Xnan E1\n", "line 2 of the G-code has a letter without a number"),
        ("M83\nG1 X" + "9" * 400 + " E1\n", "line 2 of the G-code leads farther"),
        ("M83\nG1 X0." + "9" * 400 + " E1\n", "line 2 of the G-code has a letter without"),
        ("M83\nG1 Z.2\nG1 X1 E" + "9" * 30 + "\n", "line 3 of the G-code feeds more than"),
        ("M83\nG1 X\x01 E1\n", "line 2"),
        ("M83\nG1 X1 7 E1\n", "line 2 of the G-code has a number without a letter"),
        ("M83\nG5 X1 Y1 I0 J1 P0 Q1 E1\n", "line 2 of the G-code has a spline"),
        ("M83\nG1 X5 E1\n", "at or below the bed"),
        ("M83\nG1 Z-1\nG1 X5 E1\n", "at or below the bed"),
        ("M83\nM221 S-5\n", "line 2 of the G-code sets the flow"),
        ("M83\nM221 S99999\n", "line 2 of the G-code sets the flow"),
        ("G92 X" + "9" * 300 + "\n", "leads farther"),
        ("M83\nG1 Z.2\nG91\n" + "G1 X9000\n" * 3, "leads farther"),
    ],
)
def test_what_no_printer_does_is_refused_by_its_line(
    read: Callable[..., GCode], text: str, message: str
) -> None:
    with pytest.raises(PrintersError, match=message):
        read(text)
