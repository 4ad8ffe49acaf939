"""`bellows check` of parts in files: same rules, same report, and what was understood is said."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from part_files import binary_stl, text_stl, three_mf
from small_solids import arrays, block, bore, hollow_box, port_of

from bellows_design.design.shipped import load_design, shipped_designs
from bellows_design.printability import port_opening
from printers import RULES, PrintabilityReport, PrintedModel, check_printability, load_profile

Bellows = Callable[..., tuple[int, str, str]]
VERTICES, TRIANGLES = arrays(hollow_box())
ROOT = Path(__file__).parents[4]


def written(path: Path, content: bytes) -> str:
    path.write_bytes(content)
    return str(path)


@pytest.fixture
def box(tmp_path: Path) -> str:
    return written(tmp_path / "box.stl", binary_stl(VERTICES, TRIANGLES))


def answer(bellows: Bellows, *arguments: str) -> tuple[int, dict[str, Any]]:
    status, out, _ = bellows("check", *arguments, "--json")
    return status, json.loads(out)


def compared(rule: Mapping[str, Any]) -> tuple[str, str, Any]:
    """What two formats must agree upon; which of many equal places is named, hangs on rounding."""
    return rule["rule"], rule["verdict"], rule["measured"]


def verdicts(report: PrintabilityReport) -> list[tuple[str, str]]:
    return [(rule.rule, rule.verdict) for rule in report.rules]


@pytest.mark.thorough
def test_a_file_gets_the_report_that_its_mesh_and_port_get(bellows: Bellows, box: str) -> None:
    status, found = answer(bellows, box)
    declared = PrintedModel(VERTICES, TRIANGLES, openings=(port_of(),))
    expected = check_printability(declared, load_profile("prusa_i3"))
    assert status == 0 and found["verdict"] == "pass"
    assert [(each["rule"], each["verdict"]) for each in found["rules"]] == verdicts(expected)
    assert "wall_as_declared" not in {each["rule"] for each in found["rules"]}
    assert found["units"] == "not stated: taken as mm" and found["up"] == "Z"
    (opening,) = found["openings"]
    np.testing.assert_allclose(opening["centre_mm"], port_of().centre, atol=1e-5)
    assert opening["diameter_mm"] == pytest.approx(2.0, abs=1e-5)


@pytest.mark.parametrize(
    ("name", "content"),
    [("box.STL", text_stl(VERTICES, TRIANGLES)), ("box.3mf", three_mf(VERTICES, TRIANGLES))],
)
def test_every_format_gets_the_same_report(
    bellows: Bellows, box: str, tmp_path: Path, name: str, content: bytes
) -> None:
    found, expected = answer(bellows, written(tmp_path / name, content)), answer(bellows, box)
    assert [compared(rule) for rule in found[1]["rules"]] == [
        compared(rule) for rule in expected[1]["rules"]
    ]


def test_a_person_reads_units_opening_and_stand(bellows: Bellows, box: str) -> None:
    status, out, _ = bellows("check", box)
    assert status == 0 and "units not stated: taken as mm" in out
    assert "opening found at (0.0, 5.2, 5.2) mm (2.00 mm wide)" in out
    assert "stands on the bed as in its file" in out and "printability: pass" in out


def test_a_leak_beside_the_port_fails_where_it_is(bellows: Bellows, tmp_path: Path) -> None:
    leaky = hollow_box() - bore(0.15, (6.0, 5.0, 8.0), 4.0, 2)
    status, found = answer(bellows, written(tmp_path / "l.stl", binary_stl(*arrays(leaky))))
    (rule,) = [each for each in found["rules"] if each["rule"] == "airtightness"]
    assert status == 1 and rule["verdict"] == "fail" and "the cavity leaks" in rule["message"]
    assert np.linalg.norm(np.array(numbers(rule["where"])) - (6.0, 5.0, 9.8)) < 1.0


def numbers(where: str) -> list[float]:
    return [float(word.strip("(),")) for word in where.split()[:3]]


def test_a_turned_part_is_judged_as_it_stands_and_placed_as_in_its_file(
    bellows: Bellows, box: str
) -> None:
    status, found = answer(bellows, box, "--up", "-X")
    rules = {each["rule"]: each for each in found["rules"]}
    assert status == 0 and found["up"] == "-X"
    assert rules["build_volume"]["measured"] == "10.40 × 10.40 × 14.40"
    assert numbers(rules["opening_width"]["where"]) == [0.0, 5.2, 5.2]
    np.testing.assert_allclose(numbers(rules["bed_contact"]["where"]), (14.4, 5.2, 5.2), atol=0.11)


@pytest.mark.thorough
def test_orientations_are_compared_and_the_best_is_judged(bellows: Bellows, tmp_path: Path) -> None:
    inner = (30.0, 14.0, 8.0)
    path = written(tmp_path / "flat.stl", binary_stl(*arrays(hollow_box(inner=inner))))
    assert answer(bellows, path)[0] == 1
    status, found = answer(bellows, path, "--orientation", "auto")
    assert status == 0 and found["up"] == found["orientations"][0]["up"] != "Z"
    flat = next(each for each in found["orientations"] if each["up"] == "Z")
    assert flat["failed"] == ["bridge"] and "spans 14" in flat["reason"]
    status, out, _ = bellows("check", path, "--orientation", "auto")
    assert status == 0 and "orientations, the best first" in out and "alike)" in out


def test_an_opening_may_be_named(bellows: Bellows, tmp_path: Path) -> None:
    two = hollow_box() - bore(1.0, (10.0, 5.2, 5.2), 8.0)
    path = written(tmp_path / "two.stl", binary_stl(*arrays(two)))
    status, out, err = bellows("check", path)
    assert status == 2 and "2 mouths" in err and out == ""
    status, found = answer(bellows, path, "--opening", "0,5,5", "--opening", "14,5,5")
    assert status == 0 and [each["name"] for each in found["openings"]] == [
        "opening 1",
        "opening 2",
    ]
    status, found = answer(bellows, path, "--opening", "0,5,5,2.4")
    failed = {each["rule"] for each in found["rules"] if each["verdict"] == "fail"}
    assert status == 1 and {"airtightness", "opening_width"} <= failed


def test_a_port_with_a_crack_into_it_never_passes(bellows: Bellows, tmp_path: Path) -> None:
    cracked = hollow_box() - block((1.4, 3.6, 0.3), (-0.1, 5.2, 5.05))
    path = written(tmp_path / "crack.stl", binary_stl(*arrays(cracked)))
    status, out, err = bellows("check", path)
    assert status == 2 and "--opening X,Y,Z,DIAMETER" in err and out == ""
    status, found = answer(bellows, path, "--opening", "0,5.2,5.2,2")
    failed = {each["rule"] for each in found["rules"] if each["verdict"] == "fail"}
    assert status == 1 and failed == {"airtightness"}


def test_a_mouth_that_is_not_round_can_be_sealed_and_judged(
    bellows: Bellows, tmp_path: Path
) -> None:
    square = hollow_box(port=False) - block((4, 2.5, 2.5), (-2, 4, 4))
    status, found = answer(bellows, written(tmp_path / "s.stl", binary_stl(*arrays(square))))
    assert status == 0 and found["verdict"] == "pass"


def test_a_mesh_that_does_not_close_fails_by_its_rules(bellows: Bellows, tmp_path: Path) -> None:
    path = written(tmp_path / "open.stl", binary_stl(VERTICES, TRIANGLES[1:]))
    status, found = answer(bellows, path)
    failed = {each["rule"] for each in found["rules"] if each["verdict"] == "fail"}
    assert status == 1 and {"watertight", "airtightness"} <= failed
    assert any("meshes that close" in note for note in found["notes"])


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("--set", "bubble_thickness=1"), "a file has no parameters"),
        (("--opening", "1,2"), "X,Y,Z"),
        (("--opening", "0,5,5,-1"), "between 0.05 and 200 mm"),
        (("--opening", "0,5.2,5.2,1e-300"), "between 0.05 and 200 mm"),
        (("--opening", "0,5.2,5.2,0.049"), "between 0.05 and 200 mm"),
        (("--opening", "0,5.2,5.2,201"), "between 0.05 and 200 mm"),
        (("--opening", "0,5.2,5.2,nan"), "X,Y,Z,DIAMETER"),
        (("--opening", "0,5.2,5.2", "--opening", "0,5,5"), "name each mouth once"),
        (("--opening", "auto", "--opening", "0,5,5"), "auto alone"),
        (("--up", "up"), "--up is “up”; it must be X, -X, Y, -Y, Z, -Z or a vector"),
        (("--up=",), "--up is “”; it must be"),
        (("--up=", "--orientation", "auto"), "one of them"),
        (("--orientation=",), "it can be auto"),
        (("--printer=",), "printer profile"),
        (("--filament=",), "filament"),
        (("--up", "X", "--orientation", "auto"), "one of them"),
        (("--orientation", "best"), "it can be auto"),
        (("--picture", "leak.png"), "it needs --slice"),
        (("--keep-gcode", "part.gcode"), "it needs --slice"),
        (("--require-slicer",), "it needs --slice"),
        (("--printer", "no_such"), "no_such"),
        (("--filament", "no_such"), "no_such"),
        (("--slice", "--keep-gcode", "part.txt"), "must end in .gcode"),
    ],
)
def test_options_that_cannot_be_meant_get_one_sentence(
    bellows: Bellows, box: str, arguments: tuple[str, ...], words: str, tmp_path: Path
) -> None:
    before = set(tmp_path.iterdir())
    status, out, err = bellows("check", box, *arguments)
    last = err.splitlines()[-1]
    assert status == 2 and out == "" and words in last and last.startswith("bellows: ")
    assert set(tmp_path.iterdir()) == before


@pytest.mark.parametrize("scale", [0.01, 1e3])
def test_a_part_of_a_size_that_cannot_be_meant_is_named(
    bellows: Bellows, tmp_path: Path, scale: float
) -> None:
    path = written(tmp_path / "units.stl", binary_stl(scale * VERTICES, TRIANGLES))
    status, out, err = bellows("check", path)
    assert status == 2 and out == "" and "units.stl' cannot be taken as a part" in err
    assert "are the units millimetres?" in err


@pytest.mark.parametrize(
    ("name", "arguments", "words"),
    [
        ("finger", ("--opening", "0,0,0"), "a design declares its port"),
        ("finger", ("--up", "X"), "only a part in a file"),
        ("finger", ("--up=",), "only a part in a file"),
        ("finger", ("--orientation", "auto"), "only a part in a file"),
        ("part.gcode", (), "--opening X,Y,Z,DIAMETER"),
        ("part.gcode", ("--opening", "1,2,3"), "--opening X,Y,Z,DIAMETER"),
        ("part.gcode", ("--opening", "1,2,3,4", "--slice"), "sliced already"),
        ("part.stl", (), "there is no file “part.stl”"),
    ],
)
def test_what_means_nothing_for_this_input_is_refused(
    bellows: Bellows, name: str, arguments: tuple[str, ...], words: str
) -> None:
    status, out, err = bellows("check", name, *arguments)
    assert status == 2 and out == "" and words in err


def test_a_file_of_another_kind_is_told_what_is_read(bellows: Bellows, tmp_path: Path) -> None:
    status, _, err = bellows("check", written(tmp_path / "part.obj", b"v 0 0 0"))
    assert status == 2 and ".stl, .3mf, .step" in err
    status, _, err = bellows("check", "that_is_not_there.obj")
    assert status == 2 and ".stl, .3mf, .step" in err


def test_another_filament_is_taken_with_its_settings(bellows: Bellows, box: str) -> None:
    assert answer(bellows, box, "--filament", "fiberflex_40d")[0] == 0


@pytest.mark.parametrize(("named", "words"), [("", "no slicer"), ("/nope", "names '/nope'")])
def test_without_a_slicer_the_geometric_rules_stand_and_that_is_said(
    bellows: Bellows, box: str, monkeypatch: pytest.MonkeyPatch, named: str, words: str
) -> None:
    monkeypatch.setenv("BELLOWS_SLICER", named)
    status, found = answer(bellows, box, "--slice")
    assert status == 0 and found["slicing"] is None
    assert any(words in note for note in found["notes"])
    status, found = answer(bellows, box, "--slice", "--require-slicer")
    rule = found["rules"][-1]
    assert status == 1 and rule["rule"] == "leak_test" and words in rule["message"]
    assert (rule["severity"], rule["source"]) == ("fail", RULES["leak_test"].source)


@pytest.mark.slow
@pytest.mark.parametrize("name", [*shipped_designs(), "examples/finger_nine.toml"])
def test_the_stl_of_a_design_gets_the_verdicts_of_the_design(
    bellows: Bellows, name: str, tmp_path: Path
) -> None:
    """Rule by rule, but for those on what only a design declares; Prototype 1 fails either way."""
    path, name = tmp_path / "part.stl", name if "/" not in name else str(ROOT / name)
    assert bellows("design", name, "-o", str(path))[0] == 0
    of_design, of_file = answer(bellows, name)[1], answer(bellows, str(path))[1]
    kept = [each["rule"] for each in of_file["rules"]]
    undeclared = [
        compared(each)
        for each in of_design["rules"]
        if each["rule"] in kept and each["where"] != "port.wall"
    ]
    assert [compared(each) for each in of_file["rules"]] == undeclared
    assert of_file["verdict"] == of_design["verdict"]
    port, (opening,) = port_opening(load_design(name)), of_file["openings"]
    np.testing.assert_allclose(opening["centre_mm"], port.centre, atol=0.05)
    np.testing.assert_allclose(opening["direction"], port.direction, atol=1e-3)
    assert opening["diameter_mm"] == pytest.approx(2 * port.radius, abs=0.05)
