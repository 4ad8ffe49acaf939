"""`bellows check --slice`, and of G-code: the leak test beside the geometric rules."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from bead_boxes import Box
from part_files import binary_stl
from small_solids import arrays, bore, hollow_box

from bellows_design.cli.checking.gcode import opening_on
from printers.gcode.beads import PERIMETER, SKIRT, Beads

Bellows = Callable[..., tuple[int, str, str]]
WIDTH = 0.4


def beads_around_a_box() -> Beads:
    """One loop of 20 × 10 mm from 0 to 6 mm height, and a skirt around it."""
    loop = np.array([[0.0, 0.0], [20.0, 0.0], [20.0, 10.0], [0.0, 10.0]])
    skirt = loop * 3 - 20
    start = np.concatenate([loop, skirt])
    end = np.concatenate([np.roll(loop, -1, axis=0), np.roll(skirt, -1, axis=0)])
    count = len(start)
    kind = np.repeat([PERIMETER, SKIRT], 4)
    level = np.zeros(count, dtype=np.int64)
    ones = np.ones(count)
    return Beads(start, end, 6 * ones, 6 * ones, WIDTH * ones, ones, kind, level, level)


@pytest.mark.parametrize(
    ("point", "direction"),
    [
        ((-0.2, 5.0, 3.0), (-1.0, 0.0, 0.0)),
        ((20.0, 5.0, 3.0), (1.0, 0.0, 0.0)),
        ((8.0, 0.1, 3.0), (0.0, -1.0, 0.0)),
        ((8.0, 10.2, 3.0), (0.0, 1.0, 0.0)),
        ((8.0, 5.0, 6.0), (0.0, 0.0, 1.0)),
        ((8.0, 5.0, 0.0), (0.0, 0.0, -1.0)),
    ],
)
def test_an_opening_in_gcode_faces_the_nearest_side_of_the_part(
    point: tuple[float, float, float], direction: tuple[float, float, float]
) -> None:
    opening = opening_on(beads_around_a_box(), (*point, 2.0), "opening")
    assert opening.centre == point and opening.radius == 1.0
    assert opening.direction == direction


@pytest.mark.thorough
def test_gcode_that_is_none_gets_one_sentence(bellows: Bellows, tmp_path: Path) -> None:
    path = tmp_path / "part.gcode"
    path.write_bytes(b"\x89PNG\r\n" * 100)
    status, out, err = bellows("check", str(path), "--opening", "1,2,3,4")
    assert status == 2 and out == "" and str(path) in err.splitlines()[-1]


def written(beads: Beads, path: Path) -> str:
    """The beads as G-code, with filament of 1.75 mm."""
    lines = ["; filament_diameter = 1.75", "M83"]
    fed = beads.volume / (np.pi * 1.75**2 / 4)
    each = zip(beads.top, beads.start.tolist(), beads.end.tolist(), fed, strict=True)
    for top, (x0, y0), (x1, y1), length in each:
        lines += [f"G0 X{x0:.5f} Y{y0:.5f} Z{top:.4f}", f"G1 X{x1:.5f} Y{y1:.5f} E{length:.7f}"]
    path.write_text("\n".join(lines))
    return str(path)


@pytest.mark.thorough
def test_gcode_with_layers_that_leak_is_refused(bellows: Bellows, tmp_path: Path) -> None:
    """It seals in the model of the beads, but its layers are 0.2 mm high."""
    path = written(Box().beads, tmp_path / "box.gcode")
    x, y, z = Box().opening.centre
    opening = f"{x},{y},{z},{2 * Box().opening.radius}"
    status, found, err = answer(bellows, path, "--opening", opening)
    rules = {each["rule"]: each for each in found["rules"]}
    assert rules["leak_path"]["verdict"] == "pass", err
    assert (rules["layer_height"]["verdict"], rules["layer_height"]["measured"]) == ("fail", 0.2)
    assert status == 1 and found["verdict"] == "fail"
    assert not {"rules", "notes"} & set(found["leak_test"]), "they stand beside it"
    assert all(each["severity"] and each["source"] for each in found["rules"])


def answer(bellows: Bellows, *arguments: str) -> tuple[int, dict[str, Any], str]:
    status, out, err = bellows("check", *arguments, "--json")
    return status, json.loads(out), err


def part(tmp_path: Path, leak: float = 0.0) -> str:
    """A box, with a pin hole through its roof if asked for."""
    solid = hollow_box()
    if leak:
        solid = solid - bore(leak / 2, (9.0, 5.0, 8.0), 4.0, 2)
    path = tmp_path / f"box_{leak:g}.stl"
    path.write_bytes(binary_stl(*arrays(solid)))
    return str(path)


@pytest.mark.slow
@pytest.mark.slicer
def test_a_sound_box_passes_and_its_gcode_by_itself_too(bellows: Bellows, tmp_path: Path) -> None:
    kept = tmp_path / "box.gcode"
    status, found, err = answer(bellows, part(tmp_path), "--slice", "--keep-gcode", str(kept))
    rules = {each["rule"]: each["verdict"] for each in found["rules"]}
    assert rules["leak_path"] == "pass" and status == 0, (err, found)
    assert found["slicing"]["slicer"] == "PrusaSlicer"
    assert len(found["slicing"]["profile_sha256"]) == 64
    # The box, 14.4 by 10.4 mm, stands in the middle of a bed of 250 by 210 mm.
    status, alone, err = answer(bellows, str(kept), "--opening", "117.8,105,5.2,2")
    assert status == 0 and alone["slicer"] == "PrusaSlicer", err
    assert alone["leak_test"]["ratio"] == pytest.approx(
        found["slicing"]["leak_test"]["ratio"], abs=0.03
    )


@pytest.mark.slow
@pytest.mark.slicer
def test_a_pin_hole_is_found_in_the_gcode_of_a_turned_part(
    bellows: Bellows, tmp_path: Path
) -> None:
    """Half a millimetre wide; its place is that in the file, not on the bed."""
    options = ("--up", "-X", "--opening", "0,5.2,5.2", "--slice")
    status, found, err = answer(bellows, part(tmp_path, leak=0.5), *options)
    rules = {each["rule"]: each for each in found["rules"]}
    assert status == 1 and rules["leak_path"]["verdict"] == "fail", err
    place = found["slicing"]["leak_test"]["leaks"][0]["place"]
    off = np.array(place) - (9.0, 5.0, 9.8)
    assert np.linalg.norm(off[:2]) < 1.0 and abs(off[2]) < 1.6  # along the hole, 1.2 mm long
