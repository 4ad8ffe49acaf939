"""Scenes that approval must hold: what each of them says for and against a design."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from fakes import FakeEstimate, FakeEvaluation, fake_report
from linear_finger import DESIGN, linear_law

from bellows_design.approval import Verdict, decide, open_question
from bellows_design.design import Design
from bellows_design.design.scenes.scene import named_scene
from bellows_design.errors import UnreachedError
from bellows_design.export.statements import grounds
from bellows_design.force.curve import force_curve
from bellows_design.force.finger_law import FingerLaw, Uncertainty
from bellows_design.force.required_scenes import required_scenes
from bellows_design.force.result import SceneResult
from bellows_design.leak_test.record import Unavailable
from bellows_design.pipeline import run
from bellows_design.reports.outcome import outcome_table

GOOD = FakeEvaluation(max_von_mises_mpa=2.0, error_estimate=FakeEstimate(2.0))
CUP = {
    "kind": "grip", "size": 30.0, "mass_g": 50.0, "distance": 18.0, "place": 44.0,
}  # fmt: skip

FAR = 1000.0
"""N mm: more than any section bears."""


def holding(*names: str, **scenes: Any) -> Design:
    """Prototype 1 with scenes, and names of those that it must hold."""
    table = DESIGN.model_dump()
    return Design.of(table | {"scenes": scenes, "limits": {"scenes": list(names)}})


def result(design: Design, name: str, law: FingerLaw | None = None, **facts: Any) -> SceneResult:
    """A scene's result by the linear law."""
    _, scene = named_scene(name, design.scenes)
    law = law or linear_law(**({"reach": FAR} | facts))
    return SceneResult(name, force_curve(design, scene, (0.1,), law, name=name, by_distance=False))


def verdict(design: Design, *results: SceneResult) -> Verdict:
    """Where all else is well."""
    return decide(design, fake_report(), GOOD, results)


def test_a_design_that_holds_its_scene_is_approved() -> None:
    design = holding("blocked")
    assert verdict(design, result(design, "blocked")).approved


def test_a_scene_without_result_is_no_pass() -> None:
    design = holding("blocked", "free")
    found = verdict(design, result(design, "blocked"))
    assert [(each.kind, each.rule) for each in found.reasons] == [("scene", "free")]
    failed = verdict(design, result(design, "blocked"), SceneResult("free", failure="no mesh"))
    assert [each.message for each in failed.reasons] == ["The scene free has no result: no mesh."]


@pytest.mark.parametrize(("stress", "approved"), [(3.8, True), (3.82, False), (4.5, False)])
def test_the_stress_under_a_scenes_load_counts_with_its_error(
    stress: float, approved: bool
) -> None:
    """Prototype 1 yields at 4 MPa, and the law is good for 5 %."""
    design = holding("blocked")
    found = verdict(design, result(design, "blocked", von_mises=stress))
    assert found.approved == approved
    assert [(each.kind, each.unit) for each in found.reasons] == [("scene", "MPa")] * (not approved)


def test_a_grip_that_slips_refuses() -> None:
    heavy = CUP | {"mass_g": 5000.0}
    design = holding("cup", cup=heavy)
    (reason,) = verdict(design, result(design, "cup")).reasons
    assert (reason.kind, reason.required, reason.unit) == ("scene", 5000.0, "g")
    assert isinstance(reason.measured, float) and 0 < reason.measured < 5000
    light = holding("cup", cup=CUP)
    assert verdict(light, result(light, "cup")).approved


def test_an_object_that_does_not_come_to_rest_refuses() -> None:
    design = holding("cup", cup=CUP | {"place": 38.0})
    (reason,) = verdict(design, result(design, "cup")).reasons
    assert (reason.kind, reason.measured) == ("scene", "no equilibrium")
    assert "draw the object towards their roots" in reason.message


@pytest.mark.parametrize(("share", "approved"), [(0.9, True), (0.98, False)])
def test_the_error_of_the_payload_counts(share: float, approved: bool) -> None:
    unsure = Uncertainty(mesh=0.01)
    light = holding("cup", cup=CUP)
    found = result(light, "cup", rotations=unsure).found
    assert found is not None and found.last.largest_payload_g is not None
    error = found.last.largest_payload_error_percent
    assert error is not None and 2 < error < 10
    heavy = holding("cup", cup=CUP | {"mass_g": share * found.last.largest_payload_g})
    decided = verdict(heavy, result(heavy, "cup", rotations=unsure))
    assert decided.approved == approved
    assert [each.kind for each in decided.reasons] == ["accuracy"] * (not approved)
    assert decided.undecided is not approved


def test_a_law_beyond_its_table_or_out_of_time_decides_nothing() -> None:
    design = holding("blocked")
    (beyond,) = verdict(design, result(design, "blocked", reach=1.0)).reasons
    assert (beyond.kind, beyond.measured) == ("accuracy", "extrapolated")
    unfinished = replace(linear_law(reach=FAR), complete=False)
    (early,) = verdict(design, result(design, "blocked", unfinished)).reasons
    assert (early.kind, early.measured) == ("accuracy", "unfinished")


def test_a_finger_that_jumps_refuses() -> None:
    design = holding("blocked")
    whole = result(design, "blocked")
    assert whole.found is not None and not whole.found.jumped
    jumped = SceneResult("blocked", replace(whole.found, jumped=True))
    (reason,) = verdict(design, jumped).reasons
    assert (reason.kind, reason.measured) == ("scene", "a jump")


def test_a_scene_that_is_not_reached_or_unstable_refuses() -> None:
    design = holding("blocked")
    whole = result(design, "blocked")
    assert whole.found is not None
    last = replace(whole.found.last, pressure_mpa=0.06)
    short = replace(whole.found, converged=False, message="It snaps.", curve=(last,))
    (reason,) = verdict(design, SceneResult("blocked", short)).reasons
    assert (reason.measured, reason.required, reason.unit) == (0.06, 0.1, "MPa")
    shaky = replace(whole.found, curve=(replace(whole.found.last, stable=False),))
    (reason,) = verdict(design, SceneResult("blocked", shaky)).reasons
    assert reason.measured == "unstable"


def test_scenes_leave_no_question_to_a_finer_mesh() -> None:
    assert open_question(holding("blocked"), fake_report(), GOOD) == ""


def test_a_run_states_its_scenes_and_a_design_without_any_states_nothing(
    stub_stages: Callable[..., None], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    stub_stages(replace(GOOD, design=DESIGN))
    by_linear_laws(monkeypatch)
    design = holding("blocked", "cup", cup=CUP)
    found = run(design, tmp_path, leak_tester=Unavailable("it is not tried"))
    assert found.verdict.approved, found.verdict.reasons
    manifest = json.loads((tmp_path / design.name / "manifest.json").read_text("utf-8"))
    assert [each["scene"] for each in manifest["scenes"]] == ["blocked", "cup"]
    force = manifest["scenes"][0]["force_n"]
    assert force == float(f"{found.to_dict()['scenes'][0]['force_n']:.7e}")
    assert Design.of(manifest["design"]).digest == design.digest == manifest["digest"]
    plain = run(DESIGN, tmp_path / "plain", leak_tester=Unavailable("it is not tried"))
    assert "scenes" not in plain.to_dict() and "scenes" not in grounds(plain)


def by_linear_laws(monkeypatch: pytest.MonkeyPatch) -> list[Design]:
    """Required scenes by the linear law; the designs whose law was asked for."""
    asked: list[Design] = []

    def cell_law(design: Design, **_: object) -> FingerLaw:
        asked.append(design)
        return linear_law(reach=FAR)

    monkeypatch.setattr("bellows_design.force.required_scenes.cell_law", cell_law)
    return asked


def test_all_scenes_of_a_design_share_its_law(monkeypatch: pytest.MonkeyPatch) -> None:
    asked = by_linear_laws(monkeypatch)
    design = holding("blocked", "free", "cup", cup=CUP)
    assert all(each.found is not None for each in required_scenes(design))
    assert asked == [design]
    assert required_scenes(DESIGN) == () and len(asked) == 1


def test_where_there_is_no_law_every_scene_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    def cell_law(design: Design, **_: object) -> FingerLaw:
        raise UnreachedError("there is no law of the bubbles.")

    monkeypatch.setattr("bellows_design.force.required_scenes.cell_law", cell_law)
    found = required_scenes(holding("blocked", "free"))
    assert {each.failure for each in found} == {"there is no law of the bubbles."}


def test_a_scene_that_cannot_be_refuses_in_its_own_words(
    stub_stages: Callable[..., None], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    stub_stages(replace(GOOD, design=DESIGN))
    by_linear_laws(monkeypatch)
    design = holding("far", far={"kind": "blocked", "support": "wall", "distance": 90.0})
    found = run(design, tmp_path, leak_tester=Unavailable("it is not tried"))
    (reason,) = found.verdict.reasons
    assert reason.kind == "scene" and "is not reached at 0.1 MPa" in reason.message
    assert found.folder is None and found.to_dict()["scenes"][0]["converged"] is False
    assert any("is not reached" in str(line) for line in outcome_table(found))
