"""The whole way with real stages: an approved design leaves as files, a refused one does not."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
import trimesh
from fakes import FakeEstimate, FakeEvaluation

from bellows_design import load_design, with_overrides
from bellows_design.files.errors import CannotWrite
from bellows_design.pipeline import run

TWO_BUBBLES = ("length=18", "number_of_bubbles=2")


def test_a_short_finger_is_approved_and_leaves_whole(tmp_path: Path) -> None:
    design = with_overrides(load_design("finger"), TWO_BUBBLES)
    outcome = run(design, tmp_path)
    assert outcome.verdict.approved, outcome.verdict.reasons
    folder = tmp_path / "finger"
    manifest = json.loads((folder / "manifest.json").read_text("utf-8"))
    written = sorted(path.name for path in folder.iterdir())
    assert written == [
        "finger.3mf",
        "finger.orcaslicer.filament.json",
        "finger.orcaslicer.machine.json",
        "finger.orcaslicer.process.json",
        "finger.prusaslicer.ini",
        "finger.step",
        "finger.stl",
        "finger_sheet.html",
        "finger_sheet.md",
        "leak_test.json",
        "manifest.json",
        "run.json",
    ]
    for file in set(written) - {"manifest.json", "run.json"}:
        digest = hashlib.sha256((folder / file).read_bytes()).hexdigest()
        assert digest in json.dumps(manifest)
    mesh = trimesh.load_mesh(folder / "finger.stl")
    assert mesh.is_watertight
    assert mesh.is_winding_consistent
    assert mesh.volume > 0
    assert manifest["digest"] == design.digest
    assert manifest["evaluation"]["max_von_mises_mpa"] < 4


@pytest.mark.thorough
def test_walls_of_no_whole_lines_are_refused_and_leave_nothing(tmp_path: Path) -> None:
    design = with_overrides(load_design("prototype_1"), TWO_BUBBLES)
    outcome = run(design, tmp_path)
    rules = {reason.rule for reason in outcome.verdict.reasons}
    assert {"wall_multiple", "wall_multiple_measured"} <= rules
    assert list(tmp_path.iterdir()) == []


def test_an_open_verdict_asks_for_a_finer_mesh_and_is_decided_again(
    stub_stages: Callable[..., None], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    finer = FakeEvaluation(max_von_mises_mpa=3.8, error_estimate=FakeEstimate(1.0))
    coarse = replace(finer, error_estimate=FakeEstimate(20.0))
    asked: list[str] = []

    def evaluate(*_: Any, open_question: Callable[..., str], **__: Any) -> FakeEvaluation:
        asked.extend(open_question(state) for state in (coarse, finer))
        return finer if asked[0] else coarse

    stub_stages(finer)
    monkeypatch.setattr("bellows_design.analysis.evaluate.evaluate", evaluate)
    assert run(load_design("prototype_2"), tmp_path).verdict.approved
    question = "3.800 MPa are too near to the limit of 4 MPa for their estimated error"
    assert asked == [question, ""]


def test_a_refusal_is_told_though_the_earlier_export_cannot_be_removed(
    stub_stages: Callable[..., None], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(*_: Any) -> None:
        raise PermissionError(13, "Permission denied")

    stub_stages(FakeEvaluation(max_von_mises_mpa=9.0))
    monkeypatch.setattr("bellows_design.export.approved.withdraw", fail)
    with pytest.raises(CannotWrite, match=r"denied; it is refused \(max_von_mises\), but its"):
        run(load_design("prototype_2"), tmp_path)


@pytest.mark.slow
def test_prototype_2_is_refused_for_its_stress_alone(tmp_path: Path) -> None:
    """Its mesh-converged stress exceeds the limit that the paper says it keeps."""
    outcome = run(load_design("prototype_2"), tmp_path)
    assert [reason.rule for reason in outcome.verdict.reasons] == ["max_von_mises"]
    assert outcome.verdict.reasons[0].kind == "stress"
