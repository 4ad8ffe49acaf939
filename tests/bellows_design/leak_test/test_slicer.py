"""The leak test with the slicer of this machine, put together."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from bellows_design import load_design, with_overrides
from bellows_design.leak_test.record import Unavailable
from bellows_design.leak_test.slicer import usual_tester
from bellows_design.pipeline import build_part
from printers import PrintersError

TWO_BUBBLES = ["length=18", "number_of_bubbles=2"]


def test_an_empty_name_of_the_slicer_stands_for_none(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("BELLOWS_SLICER", "")
    tester = usual_tester()
    assert isinstance(tester, Unavailable) and "BELLOWS_SLICER" in tester.why


def test_a_wrong_name_of_the_slicer_is_an_error(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("BELLOWS_SLICER", "no_such_program")
    with pytest.raises(PrintersError, match="no_such_program"):
        usual_tester()


@pytest.mark.slicer
@pytest.mark.slow
def test_a_short_finger_is_sliced_and_sealed() -> None:
    design = with_overrides(load_design("finger"), TWO_BUBBLES)
    tester = usual_tester()
    assert not isinstance(tester, Unavailable)
    found = tester(design, build_part(design).mesh)
    assert found.slicer == "PrusaSlicer" and len(found.profile_sha256) == 64
    assert found.rules and not [rule for rule in found.rules if rule.verdict == "fail"]
    json.dumps(found.figures, allow_nan=False)


@pytest.mark.slicer
@pytest.mark.slow
def test_prusaslicer_takes_place_and_settings_from_the_3mf(tmp_path: Path) -> None:
    from bellows_design.export.companions import three_mf_with_settings
    from bellows_design.export.placement import placement
    from printers.gcode.reading import read_gcode
    from printers.slicing.finding import required_slicer
    from printers.slicing.running import run

    part = build_part(with_overrides(load_design("finger"), TWO_BUBBLES))
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
