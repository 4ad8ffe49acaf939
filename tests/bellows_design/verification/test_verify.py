"""Whatever was done to an export is named, and nothing of it is trusted."""

from __future__ import annotations

import json
import os
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from fakes import FakeEvaluation, fake_report
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from bellows_design import load_design
from bellows_design.analysis.whole_actuator import Reading
from bellows_design.design.design import Design
from bellows_design.errors import DesignError
from bellows_design.export.contents import part_files
from bellows_design.export.formats import Part
from bellows_design.export.manifest import MANIFEST, RUN, fingerprint
from bellows_design.export.seal import sealed
from bellows_design.geometry.tessellation import ClosedMesh
from bellows_design.leak_test.record import LeakOutcome, Unavailable
from bellows_design.pipeline import build_part, run
from bellows_design.verification.agreement import Others, text_judgement
from bellows_design.verification.record import Verification
from bellows_design.verification.verify import Means, verify
from printers import RuleResult

Bellows = Callable[..., tuple[int, str, str]]

PATH = (Reading(0.0, 0.0, 0.0, 500.0), Reading(0.04, 250.0, 1.5, 800.0), Reading(0.1, 400, 3, 1000))
NO_SLICER = Unavailable("there is none")
MEANS = Means(leak_tester=NO_SLICER)
LEAK_RULES = tuple(
    RuleResult(name, "pass", 0.88, 0.95, "", "wall", "It seals.")
    for name in ("leak_path", "printed_depth")
)


@pytest.fixture
def export(stub_stages: Callable[..., None], tmp_path: Path) -> Path:
    """The export of a cube with made-up results."""
    stub_stages(FakeEvaluation(design=load_design("finger"), path=PATH))
    folder = run(load_design("finger"), tmp_path, leak_tester=NO_SLICER).folder
    assert folder is not None
    return folder


def named(found: Verification) -> set[str]:
    """Files that are not as written."""
    return {file.name for file in found.files if file.state != "as written"}


def forge(folder: Path, change: Callable[[dict[str, Any]], object]) -> None:
    """Change the manifest and seal it again, and the file of the run as well."""
    manifest = json.loads((folder / MANIFEST).read_text("utf-8"))
    change(manifest)
    del manifest["sha256"]
    content = sealed(manifest)
    (folder / MANIFEST).write_bytes(content)
    run_ = json.loads((folder / RUN).read_text("utf-8"))
    del run_["sha256"]
    (folder / RUN).write_bytes(sealed(run_ | {"manifest": fingerprint(content)["sha256"]}))


def test_an_export_is_verified_and_rebuilt_to_the_byte(export: Path) -> None:
    found = verify(export, means=MEANS)
    assert found.verified and not named(found) and found.same_bytes
    assert found.verdict is not None and found.verdict.approved
    assert {file.name for file in found.files} == {file.name for file in export.iterdir()}
    assert not found.versions and not found.fields
    assert {file.name for file in found.rebuilt} == set(os.listdir(export)) - {RUN}


def test_a_quick_verification_says_that_nothing_was_evaluated(export: Path) -> None:
    found = verify(export, quick=True, means=MEANS)
    assert not found.problems and found.quick and found.verdict is not None
    assert [rule.rule for rule in found.verdict.not_judged] == ["evaluation", "leak_test"]
    assert {file.name for file in found.rebuilt} == {
        "finger.stl", "finger.3mf", "finger.step"
    }  # fmt: skip


@given(data=st.data())
@settings(
    max_examples=60,
    deadline=None,
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)
def test_a_flipped_bit_in_any_file_names_it(export: Path, data: st.DataObject) -> None:
    name = data.draw(st.sampled_from(sorted(os.listdir(export))))
    content = (export / name).read_bytes()
    place = data.draw(st.integers(0, len(content) - 1))
    flipped = bytearray(content)
    flipped[place] ^= 1 << data.draw(st.integers(0, 7))
    try:
        (export / name).write_bytes(flipped)
        found = verify(export, quick=True, means=MEANS)
        assert named(found) == {name}
        assert any(problem.startswith(f"{name}: changed") for problem in found.problems)
    finally:
        (export / name).write_bytes(content)


@pytest.mark.parametrize("name", ["finger.stl", "finger_sheet.html", "leak_test.json", RUN])
def test_a_missing_file_is_named(name: str, export: Path) -> None:
    (export / name).unlink()
    found = verify(export, quick=True, means=MEANS)
    assert named(found) == {name} and f"{name}: missing" in found.problems


def test_what_is_not_listed_is_named(export: Path) -> None:
    (export / "notes.txt").write_text("mine")
    (export / "sub").mkdir()
    found = verify(export, quick=True, means=MEANS)
    assert named(found) == {"notes.txt", "sub"}
    assert found.problems == ("notes.txt: not listed", "sub: not listed")


def test_links_and_folders_are_no_files(export: Path, tmp_path: Path) -> None:
    (tmp_path / "elsewhere").write_bytes((export / "finger.stl").read_bytes())
    (export / "finger.stl").unlink()
    (export / "finger.stl").symlink_to(tmp_path / "elsewhere")
    (export / "finger.3mf").unlink()
    (export / "finger.3mf").mkdir()
    found = verify(export, quick=True, means=MEANS)
    states = {file.name: file.state for file in found.files}
    assert states["finger.stl"] == states["finger.3mf"] == "no file"


def test_names_that_lead_out_are_not_opened(export: Path, tmp_path: Path) -> None:
    (tmp_path / "secret").write_text("secret")
    outside = {"../secret": fingerprint(b"secret"), "/etc/passwd": {}, "a\0b": {}}
    forge(export, lambda manifest: manifest["files"].update(outside))
    found = verify(export, quick=True, means=MEANS)
    led_out = [file for file in found.files if "leads out" in file.why]
    assert len(led_out) == 3 and len(named(found)) == 3


@pytest.mark.parametrize("versions", [{}, {"numpy": "0.0.1", "bellows-design": "0.0.1"}])
@pytest.mark.thorough
def test_another_part_with_true_hashes_is_not_the_part(
    versions: dict[str, str], export: Path, cube_part: Part
) -> None:
    """Whoever changes a file may change the manifest, too; the design tells, whatever differs."""
    import cadquery as cq

    from bellows_design.geometry.tessellation import tessellate

    solid = cq.Solid.makeBox(10, 10, 10.5)
    other = replace(cube_part, name="finger", solid=solid, mesh=tessellate(solid))
    files = part_files(other)
    for name, content in files.items():
        (export / name).write_bytes(content)
    prints = {name: fingerprint(content) for name, content in files.items()}

    def change(manifest: dict[str, Any]) -> None:
        manifest["files"].update(prints)
        manifest["evaluation"]["versions"].update(versions)

    forge(export, change)
    found = verify(export, quick=True, means=MEANS)
    assert not named(found)
    assert {file.name for file in found.rebuilt if file.difference} == set(files)
    assert sum("not the part" in problem for problem in found.problems) == 3


def test_a_forged_figure_is_named(export: Path) -> None:
    forge(export, lambda manifest: manifest["evaluation"].update(max_von_mises_mpa=1.0))
    found = verify(export, means=MEANS)
    assert [(each.name, each.then, each.now) for each in found.fields] == [
        ("evaluation.max_von_mises_mpa", 1.0, 3.0)
    ]
    assert found.problems == (f"{MANIFEST}: evaluation.max_von_mises_mpa is 1.0 instead of 3.0",)


def test_other_versions_are_told_and_no_problem_by_themselves(export: Path) -> None:
    forge(export, lambda manifest: manifest["evaluation"]["versions"].update(numpy="0.0.1"))
    found = verify(export, means=MEANS)
    assert [(each.name, each.then) for each in found.versions] == [("numpy", "0.0.1")]
    assert not found.same_bytes and found.verified


def test_an_extra_file_that_a_forged_manifest_lists_is_named(export: Path) -> None:
    (export / "virus.exe").write_bytes(b"x")
    forge(export, lambda manifest: manifest["files"].update({"virus.exe": fingerprint(b"x")}))
    assert verify(export, means=MEANS).problems[-1] == (
        "virus.exe: an export of this design holds no such file"
    )


def test_a_design_that_would_be_refused_now_is_no_success(
    export: Path, stub_stages: Callable[..., None]
) -> None:
    failed = RuleResult("minimum_lines", "fail", 2, 3, "lines", "wall", "Too thin.")
    stub_stages(FakeEvaluation(design=load_design("finger"), path=PATH), fake_report(failed))
    for quick in (False, True):
        found = verify(export, quick, MEANS)
        assert found.problems[-1] == "this version would refuse the design: minimum_lines"


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda design: design["bellows"].update(length=-1), "length"),
        (lambda design: design.update(printer="../../secret.toml"), "is a file"),
        (lambda design: design["load"].update(pressure=0.05), "digest"),
        (lambda design: design.clear(), "name"),
    ],
)
def test_a_design_that_cannot_be_rebuilt_is_told(
    change: Callable[[dict[str, Any]], object], words: str, export: Path
) -> None:
    forge(export, lambda manifest: change(manifest["design"]))
    found = verify(export, means=MEANS)
    assert words in found.failure and found.verdict is None
    assert any("cannot be rebuilt" in problem for problem in found.problems)


def test_a_printer_that_is_unknown_here_is_told(export: Path) -> None:
    def change(manifest: dict[str, Any]) -> None:
        manifest["design"]["printer"] = "no_such_printer"
        manifest["digest"] = Design.of(manifest["design"]).digest

    forge(export, change)
    assert "no_such_printer" in verify(export, means=MEANS).failure


def test_an_export_of_an_earlier_version_is_told(export: Path) -> None:
    manifest = json.loads((export / MANIFEST).read_text("utf-8"))
    del manifest["sha256"]
    manifest["format"] = "bellows-design manifest 1"
    (export / MANIFEST).write_text(json.dumps(manifest))
    assert "earlier version" in verify(export, means=MEANS).problems[0]


@pytest.mark.parametrize(
    "content",
    [
        b"",
        b"[" * 100_000,
        b'{"a": NaN}',
        b'{"a": 1' + b"0" * 100_000 + b"}",
        b"\xff\xfe",
        b'{"format": "bellows-design manifest 2", "files": {}}',
    ],
    ids=["empty", "deep", "NaN", "huge number", "no text", "no seal"],
)
def test_a_manifest_that_is_none_is_named(content: bytes, export: Path) -> None:
    (export / MANIFEST).write_bytes(content)
    assert named(verify(export, means=MEANS)) == {MANIFEST}


@pytest.mark.parametrize(
    "content", ["[]", "1", '"x"', "{}", '{"name": "app", "icons": []}', '{"files": ["a.js"]}']
)
def test_a_manifest_of_another_program_is_bad_input(
    content: str, tmp_path: Path, bellows: Bellows
) -> None:
    (tmp_path / MANIFEST).write_text(content)
    status, out, err = bellows("verify", str(tmp_path))
    assert (status, out) == (2, "") and "no manifest of bellows-design" in err


@pytest.mark.parametrize(
    "content",
    [{"files": {}}, {"format": "bellows-design manifest 2"}, {"format": [], "files": 1}],
)
def test_a_sealed_file_that_is_no_manifest_is_bad_input(
    content: dict[str, Any], tmp_path: Path
) -> None:
    (tmp_path / MANIFEST).write_bytes(sealed(content))
    with pytest.raises(DesignError, match="manifest"):
        verify(tmp_path, means=MEANS)


def test_prints_of_any_kind_are_no_hashes(export: Path) -> None:
    prints = {"finger.stl": None, "finger.3mf": {"sha256": 1, "bytes": 10**30}, "finger.step": []}
    forge(export, lambda manifest: manifest["files"].update(prints))
    assert named(verify(export, quick=True, means=MEANS)) == set(prints)


def test_a_file_longer_than_listed_is_not_read(
    export: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    os.truncate(export / "finger.stl", 10**12)  # sparse: takes no room
    assert named(verify(export, quick=True, means=MEANS)) == {"finger.stl"}


def test_the_commands_status_says_whether_an_export_is_good(
    export: Path, bellows: Bellows, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setenv("BELLOWS_SLICER", "")
    status, out, _ = bellows("verify", str(export), "--quick")
    assert status == 0 and "VERIFIED" in out and "evaluation and leak test were left out" in out
    (export / "finger.step").write_bytes(b"ISO-10303-21;")
    status, out, _ = bellows("verify", str(export), "--quick", "--json")
    content = json.loads(out)
    assert status == 1 and not content["verified"] and len(content["problems"]) == 1
    (tmp_path / "file").touch()
    for nothing in (tmp_path / "nowhere", tmp_path, tmp_path / "file"):
        status, out, err = bellows("verify", str(nothing))
        assert status == 2 and out == "" and err.count("\n") == 1


def test_what_other_versions_do_not_decide_is_wrong_all_the_same(export: Path) -> None:
    """Whoever forges may name another version, too: that excuses what depends on it alone."""
    sheet = export / "finger_sheet.md"
    sheet.write_text(
        sheet.read_text("utf-8").replace("Proof pressure: 0.1 MPa", "Proof pressure: 1 MPa")
    )

    def change(manifest: dict[str, Any]) -> None:
        manifest["evaluation"]["versions"]["numpy"] = "0.0.1"
        manifest["evaluation"]["bending_angle_deg"] = 500.0
        manifest["files"][sheet.name] = fingerprint(sheet.read_bytes())

    forge(export, change)
    found = verify(export, means=MEANS)
    assert found.problems == (
        f"{MANIFEST}: evaluation.bending_angle_deg is 500.0 instead of 400.0",
        "finger_sheet.md: it says “Proof pressure: 1 MPa (1 bar), the design pressure” "
        "instead of “Proof pressure: 0.1 MPa (1 bar), the design pressu”",
    )
    assert not found.verified


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda manifest: manifest["verdict"].update(approved=False), "verdict.approved"),
        (lambda manifest: manifest["printer"].update(nozzle_diameter=0.8), "nozzle_diameter"),
        (lambda manifest: manifest["evaluation"].update(max_von_mises_mpa=0.1), "max_von_mises"),
        (lambda manifest: manifest.update(note="mine"), "note"),
        (lambda manifest: manifest["files"].clear(), "finger.stl: it is not listed"),
        (lambda manifest: manifest["files"].pop("finger_sheet.md"), "it is not listed"),
        (lambda manifest: manifest["files"].update({"setup.exe": {}}), "no such file"),
    ],
)
@pytest.mark.parametrize("versions", [{"numpy": "0.0.1"}, {"invented": "1"}, {"python": None}])
def test_no_other_library_excuses_a_forgery(
    versions: dict[str, str], change: Callable[[dict[str, Any]], object], words: str, export: Path
) -> None:
    def forged(manifest: dict[str, Any]) -> None:
        manifest["evaluation"]["versions"].update(versions)
        change(manifest)

    forge(export, forged)
    found = verify(export, means=MEANS)
    assert found.versions and any(words in problem for problem in found.problems)


def test_what_another_program_may_decide_is_not_compared(export: Path) -> None:
    def forged(manifest: dict[str, Any]) -> None:
        manifest["evaluation"]["versions"]["gmsh"] = "0.0.1"
        manifest["evaluation"]["bending_angle_deg"] *= 1.03
        manifest["evaluation"]["message"] = "other words"

    forge(export, forged)
    found = verify(export, means=MEANS)
    assert not found.problems and not found.verified
    assert found.not_compared == (f"{MANIFEST}: evaluation.message",)


def test_a_figure_of_another_version_may_differ_as_meshes_do(export: Path) -> None:
    def forged(manifest: dict[str, Any]) -> None:
        manifest["evaluation"]["versions"]["gmsh"] = "0.0.1"
        manifest["evaluation"]["bending_angle_deg"] *= 1.03

    forge(export, forged)
    assert verify(export, means=MEANS).verified


def test_the_leak_test_of_a_slicer_that_is_not_here_is_not_compared(
    stub_stages: Callable[..., None], tmp_path: Path
) -> None:
    """And nothing else is excused by it."""

    def tester(design: Design, mesh: ClosedMesh) -> LeakOutcome:
        return LeakOutcome("Slicer", "1.0", "ab" * 32, LEAK_RULES)

    stub_stages(FakeEvaluation(design=load_design("finger"), path=PATH))
    folder = run(load_design("finger"), tmp_path, leak_tester=tester).folder
    assert folder is not None
    found = verify(folder, means=MEANS)
    assert not found.problems and not found.verified
    names = {each.partition(":")[0] for each in found.not_compared}
    assert names == {MANIFEST, "leak_test.json", "finger_sheet.md", "finger_sheet.html"}
    forge(folder, lambda manifest: manifest["evaluation"].update(message="mine"))
    assert verify(folder, means=MEANS).problems[0].startswith(f"{MANIFEST}: evaluation.message")


def test_without_its_versions_an_export_is_of_other_ones(export: Path) -> None:
    """Settings may be another version's then, and are not said to be right."""
    forge(export, lambda manifest: manifest["evaluation"].pop("versions"))
    found = verify(export, means=MEANS)
    assert "bellows-design" in {each.name for each in found.versions}


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda manifest: manifest["files"].update({"setup.exe": fingerprint(b"MZ")}), "setup.exe"),
        (lambda manifest: manifest["files"].clear(), "finger_sheet.html: it is not listed"),
        (lambda manifest: manifest.update(name="rocket"), "name"),
        (lambda manifest: manifest["verdict"].update(approved=False), "verdict.approved"),
        (lambda manifest: manifest["check"].update(printer="other"), "check.printer"),
    ],
)
def test_a_quick_verification_asks_for_all_that_needs_no_evaluation(
    change: Callable[[dict[str, Any]], object], words: str, export: Path
) -> None:
    (export / "setup.exe").write_bytes(b"MZ")
    forge(export, change)
    problems = verify(export, quick=True, means=MEANS).problems
    assert any(words in problem for problem in problems if "not listed, " not in problem)


def test_the_names_of_an_exports_files_are_known_without_its_evaluation(export: Path) -> None:
    from bellows_design.export.contents import file_names

    part = build_part(load_design("finger"))
    names = {name for name in os.listdir(export)} - {MANIFEST, RUN}
    assert file_names(replace(part, profile=None)) == names
    assert len(file_names(part)) == len(names) + 4


SETTING = "finger.prusaslicer.ini"


@pytest.mark.parametrize("name", [SETTING, "finger.orcaslicer.machine.json"])
@pytest.mark.parametrize(
    ("others", "judgement"),
    [
        (Others(libraries=True, slicer=True), "is another"),
        (Others(own=True), "not compared"),
    ],
)
def test_settings_follow_from_this_program_alone(name: str, others: Others, judgement: str) -> None:
    assert text_judgement(name, b"temperature = 400", b"temperature = 238", others)[0] == judgement


@pytest.mark.parametrize(
    "text",
    ["1\nVERIFIED\n\x1b[8m", "a\x1b[2Jb.txt", "a\ud800b.txt", "\x9b31m", "[bold]x[/bold]"],
)
def test_no_text_of_a_manifest_reaches_the_terminal_as_it_is(
    text: str, export: Path, bellows: Bellows, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("BELLOWS_SLICER", "")

    def change(manifest: dict[str, Any]) -> None:
        manifest["evaluation"]["versions"].update({"numpy": text, text: "1"})
        manifest["check"][text] = text
        manifest["files"][text] = {}
        manifest["leak_test"]["slicer"] = text

    forge(export, change)
    status, out, err = bellows("verify", str(export))
    assert status == 1 and "\nVERIFIED" not in out
    assert all(line.isprintable() for line in out.splitlines())
    assert not {"\x1b", "\x9b"} & set(out + err)


@pytest.mark.parametrize(
    "printer",
    [
        {"filament": "/tmp/evil.toml"},
        {"extends": "../evil.TOML"},
        {"extends": "prusa_i3", "filament": {"extends": "evil.toml"}},
    ],
)
def test_no_file_that_a_design_names_is_opened(
    printer: dict[str, Any], export: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    forge(export, lambda manifest: manifest["design"].update(printer=printer))
    monkeypatch.setattr(Design, "of", lambda table: pytest.fail("it was read"))
    assert "is a file" in verify(export, means=MEANS).failure
