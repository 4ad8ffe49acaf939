"""The leak test with the slicer of this machine, put together."""

from __future__ import annotations

import json
import tempfile
from pathlib import Path

import pytest
from fakes import FakeEvaluation

from bellows_design import load_design, with_overrides
from bellows_design.export.statements import files_of
from bellows_design.leak_test.record import Unavailable
from bellows_design.leak_test.slicer import usual_tester
from bellows_design.pipeline import build_part, examine
from bellows_design.web.layers import packed_layers
from printers import PrintersError

ONE_BUBBLE = [
    "number_of_bubbles=1", "length=12", "bubble_width=14", "bubble_height=14", "port.depth=4"
]  # fmt: skip
"""The least that is sliced like a finger."""


def test_an_empty_name_of_the_slicer_stands_for_none(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("BELLOWS_SLICER", "")
    for setting in ("if-available", "required"):
        tester = usual_tester(setting)
        assert isinstance(tester, Unavailable) and "BELLOWS_SLICER" in tester.why


def old_slicer(folder: Path) -> str:
    path = folder / "prusa-slicer"
    path.write_text("#!/bin/sh\necho 'PrusaSlicer-2.4.0 based on Slic3r'\n")
    path.chmod(0o755)
    return str(path)


@pytest.mark.parametrize(("name", "words"), [("", "2.4.0"), ("no_such_program", "no_such_program")])
def test_a_slicer_that_cannot_be_used_stops_only_what_requires_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str, words: str
) -> None:
    monkeypatch.setenv("BELLOWS_SLICER", name or old_slicer(tmp_path))
    found = usual_tester("if-available")
    assert isinstance(found, Unavailable) and words in found.why
    with pytest.raises(PrintersError, match=words):
        usual_tester("required")


def test_a_slicer_on_the_path_that_is_too_old_is_as_one_that_is_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    old_slicer(tmp_path)
    monkeypatch.delenv("BELLOWS_SLICER", raising=False)
    monkeypatch.setenv("PATH", f"{tmp_path}:/usr/bin:/bin")
    found = usual_tester("if-available")
    assert isinstance(found, Unavailable) and "it must be 2.5 or newer" in found.why


def test_where_the_test_is_off_no_slicer_is_asked(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "slicer"
    path.write_text(f"#!/bin/sh\ntouch {tmp_path}/asked\n")
    path.chmod(0o755)
    monkeypatch.setenv("BELLOWS_SLICER", str(path))
    assert isinstance(usual_tester("off"), Unavailable)
    assert not (tmp_path / "asked").exists()


@pytest.mark.slicer
@pytest.mark.slow
def test_two_runs_with_a_slicer_seal_and_write_the_same_bytes(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Only the evaluation is made up: part, rules, slicing, leak test and files are the real ones.

    The slicer works in other folders, and is asked anew.
    """
    design = with_overrides(load_design("finger"), ONE_BUBBLE)
    evaluation = FakeEvaluation(design=design)
    monkeypatch.setattr("bellows_design.analysis.evaluate.evaluate", lambda *_, **__: evaluation)
    contents = []
    for name in ("one", "two"):
        (tmp_path / name).mkdir()
        monkeypatch.setattr(tempfile, "tempdir", str(tmp_path / name))
        found = examine(design)
        test = found.leak_test.outcome
        assert test is not None and found.verdict.approved, found.verdict.reasons
        assert test.slicer == "PrusaSlicer" and len(test.profile_sha256) == 64
        assert not [rule for rule in test.rules if rule.verdict == "fail"]
        json.dumps(test.figures, allow_nan=False)
        assert test.layers is not None and len(packed_layers(test.layers)) < 1.5e6
        assert "rules" not in test.figures and all(rule.severity for rule in test.rules)
        contents.append(files_of(found))
    assert contents[0] == contents[1] and len(contents[0]) == 11


@pytest.mark.slicer
@pytest.mark.slow
def test_prusaslicer_takes_place_and_settings_from_the_3mf(tmp_path: Path) -> None:
    from bellows_design.export.companions import three_mf_with_settings
    from bellows_design.export.placement import placement
    from printers.gcode.reading import read_gcode
    from printers.slicing.finding import required_slicer
    from printers.slicing.running import run

    part = build_part(with_overrides(load_design("finger"), ONE_BUBBLE))
    (tmp_path / "part.3mf").write_bytes(three_mf_with_settings(part))
    command = [str(required_slicer().path), "--export-gcode", "--dont-arrange", "--datadir"]
    ended = run([*command, str(tmp_path / "data"), "part.3mf"], tmp_path, 300)
    assert ended.status == 0, ended.output
    (made,) = tmp_path.glob("*.gcode")
    gcode = read_gcode(made)
    text = made.read_text("utf-8")
    for key, value in (("layer_height", "0.1"), ("infill_overlap", "50%"), ("perimeters", "3")):
        assert f"; {key} = {value}\n" in text
    on_bed = placement(part)(part.mesh.vertices)
    beads = gcode.beads.chosen(gcode.beads.of_part)
    width = beads.width.max()
    assert abs(beads.start.min(axis=0) - on_bed.min(axis=0)[:2]).max() < width
    assert abs(beads.start.max(axis=0) - on_bed.max(axis=0)[:2]).max() < width
