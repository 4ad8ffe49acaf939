"""Any text is read or refused in one sentence; what is written is read back."""

from __future__ import annotations

import re
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import pytest
from damage import FUZZ
from hypothesis import given, settings
from hypothesis import strategies as st

from printers.errors import PrintersError
from printers.gcode.reading import GCode, read_gcode

PIECES = (
    *"XYZEFIJRSDP",
    *("G0", "G1", "G2", "G3", "G5", "G10", "G11", "G18", "G20", "G28", "G90", "G91", "G92"),
    *("M82", "M83", "M200", "T0", "T1", "N1", "*", ";", "(", ")", " ", "\n", "\n", "\n", "\r"),
    *("1", "-2", ".5", "0.2", "100", "1e9", "99999999999", "-", ".", "nan", "é", "\x01", "_"),
    *(";TYPE:Perimeter\n", ";WIDTH:0.4\n", ";HEIGHT:0.2\n", ";LAYER_CHANGE\n", ";TYPE:Custom\n"),
    *("G1 X5 E1\n", "G1 Z.2\n", "G1 X0 Y3 E1\n", "; filament_diameter = 1.75\n", "G3 I-2 E1\n"),
)


def reading(text: bytes) -> GCode | str:
    """The G-code, or the sentence that refuses it."""
    with TemporaryDirectory() as folder:
        path = Path(folder, "a.gcode")
        path.write_bytes(text)
        try:
            return read_gcode(path, 1.75)
        except PrintersError as error:
            return str(error)


def check(found: GCode | str) -> None:
    if isinstance(found, str):
        assert "\n" not in found and len(found) < 600
        return
    beads = found.beads
    part = beads.chosen(beads.of_part)
    for values in (part.start, part.end, part.top, part.height, part.width):
        assert np.isfinite(values).all()
    assert (beads.height > 0).all() and (beads.width > 0).all() and (beads.length > 0).all()
    assert beads.volume.sum() <= found.filament_length * np.pi * 1.75**2 / 4 * (1 + 1e-9)


@settings(FUZZ, max_examples=300)
@given(st.lists(st.sampled_from(PIECES), max_size=60))
def test_pieces_of_gcode_in_any_order_are_read_or_refused(parts: list[str]) -> None:
    check(reading("".join(parts).encode()))


@settings(FUZZ, max_examples=100)
@given(st.binary(max_size=300))
def test_any_bytes_are_read_or_refused(content: bytes) -> None:
    check(reading(content))


LENGTHS = st.floats(-100, 100).map(lambda value: round(value, 3))
MOVES = st.lists(
    st.tuples(LENGTHS, LENGTHS, st.floats(0, 5).map(lambda value: round(value, 5))),
    min_size=1,
    max_size=30,
)


@settings(FUZZ, max_examples=100)
@given(MOVES)
def test_absolute_and_relative_extrusion_say_the_same(
    moves: list[tuple[float, float, float]],
) -> None:
    fed, absolute, relative = 0.0, ["M82", "G1 Z.2"], ["M83", "G1 Z.2"]
    for x, y, feed in moves:
        fed = round(fed + feed, 5)
        absolute.append(f"G1 X{x:.3f} Y{y:.3f} E{fed:.5f}")
        relative.append(f"G1 X{x:.3f} Y{y:.3f} E{feed:.5f}")
    one, other = (reading("\n".join(lines).encode()) for lines in (absolute, relative))
    if isinstance(one, str) or isinstance(other, str):
        no_name = re.compile(r"'.*?'")
        assert no_name.sub("", str(one)) == no_name.sub("", str(other))
        return
    assert len(one.beads) == len(other.beads)
    np.testing.assert_allclose(one.beads.volume, other.beads.volume, atol=1e-9)
    np.testing.assert_array_equal(one.beads.end, other.beads.end)
    assert one.filament_length == pytest.approx(fed, abs=1e-9)
