"""What the leak test has to do with the verdict, and with the files."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from fakes import FakeEvaluation, fake_report

from bellows_design import load_design, with_overrides
from bellows_design.design.design import Design
from bellows_design.geometry.tessellation import ClosedMesh
from bellows_design.leak_test.record import LeakOutcome, LeakTester, Unavailable
from bellows_design.pipeline import Outcome, run
from printers import PrintersError, RuleResult

NO_SLICER = Unavailable("there is no slicer")


def rule(verdict: Any, figure: float = 0.88) -> RuleResult:
    return RuleResult("leak_path", verdict, figure, 0.95, "", "wall", f"r* is {figure}.")


DEEP = RuleResult("printed_depth", "pass", 2.8, 2.25, "lines", "wall", "It is deep enough.")


def leak_tester_of(*rules: RuleResult, asked: list[str] | None = None) -> LeakTester:
    """A leak test that finds these, and walls that are deep enough."""

    def test(design: Design, mesh: ClosedMesh) -> LeakOutcome:
        if asked is not None:
            asked.append(design.name)
        return LeakOutcome("FakeSlicer", "1.0", "ab" * 32, (*rules, DEEP), {"ratio": 0.88}, 1.5)

    return test


def design(setting: str) -> Design:
    return with_overrides(load_design("finger"), [f"limits.leak_test={setting}"])


def outcome(
    setting: str, test: LeakTester | Unavailable, folder: Path, stub: Callable[..., None]
) -> Outcome:
    stub(FakeEvaluation(design=load_design("finger")))
    return run(design(setting), folder, leak_tester=test)


def leak_test_file(found: Outcome) -> dict[str, Any]:
    assert found.folder is not None
    content: dict[str, Any] = json.loads((found.folder / "leak_test.json").read_text("utf-8"))
    return content


@pytest.mark.parametrize("setting", ["if-available", "required"])
def test_a_part_that_seals_is_approved(
    setting: str, tmp_path: Path, stub_stages: Callable[..., None]
) -> None:
    found = outcome(setting, leak_tester_of(rule("pass")), tmp_path, stub_stages)
    assert found.verdict.approved and not found.verdict.not_judged[1:]
    stated = leak_test_file(found)
    assert stated["result"] == "pass" and stated["slicer"] == "FakeSlicer 1.0"
    assert stated["profile_sha256"] == "ab" * 32
    assert stated["rules"] == [
        {"rule": name, "verdict": "pass"} for name in ("leak_path", "printed_depth")
    ]
    assert found.folder is not None
    measured = json.loads((found.folder / "run.json").read_text("utf-8"))["leak_test"]
    assert measured["figures"] == {"ratio": 0.88} and measured["seconds"] == 1.5


@pytest.mark.parametrize("setting", ["if-available", "required"])
def test_a_leak_is_a_reason(setting: str, tmp_path: Path, stub_stages: Callable[..., None]) -> None:
    found = outcome(setting, leak_tester_of(rule("pass"), rule("fail", 1.3)), tmp_path, stub_stages)
    (reason,) = found.verdict.reasons
    assert (reason.kind, reason.rule, reason.measured) == ("printability", "leak_path", 1.3)
    assert found.folder is None and list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("rules", "missing"),
    [
        ((), ["leak_path", "printed_depth"]),
        ((rule("pass"),), ["printed_depth"]),
        ((DEEP,), ["leak_path"]),
    ],
)
def test_a_leak_test_that_asked_too_little_is_no_pass(
    rules: tuple[RuleResult, ...], missing: list[str], tmp_path: Path,
    stub_stages: Callable[..., None],
) -> None:  # fmt: skip
    def test(design: Design, mesh: ClosedMesh) -> LeakOutcome:
        return LeakOutcome("FakeSlicer", "1.0", "ab" * 32, rules)

    found = outcome("if-available", test, tmp_path, stub_stages)
    assert found.leak_test.result == "fail" and not found.verdict.approved
    assert [(each.rule, each.measured) for each in found.verdict.reasons] == [
        (name, "not checked") for name in missing
    ]


def test_the_required_rules_are_those_of_the_leak_test() -> None:
    from bellows_design.leak_test.record import REQUIRED_RULES
    from printers.rule_table import RULES

    assert all(RULES[name].severity == "fail" for name in REQUIRED_RULES)


def test_a_marginal_seal_is_a_warning_without_figures(
    tmp_path: Path, stub_stages: Callable[..., None]
) -> None:
    """Figures depend on seams, which are random: the manifest must not."""
    found = outcome("if-available", leak_tester_of(rule("warn", 0.97)), tmp_path, stub_stages)
    assert found.verdict.approved
    assert found.verdict.warnings == ("The leak test warns: leak_path.",)
    assert leak_test_file(found)["result"] == "warn"


def test_without_a_slicer_it_is_not_judged_and_the_manifest_says_so(
    tmp_path: Path, stub_stages: Callable[..., None]
) -> None:
    found = outcome("if-available", NO_SLICER, tmp_path, stub_stages)
    assert found.verdict.approved and found.folder is not None
    assert ("leak_test", "there is no slicer") in [
        (each.rule, each.why) for each in found.verdict.not_judged
    ]
    manifest = json.loads((found.folder / "manifest.json").read_text("utf-8"))
    assert manifest["leak_test"] == {
        "setting": "if-available", "result": "not run", "why": "there is no slicer", "slicer": None
    }  # fmt: skip


def test_off_is_off_though_there_is_a_slicer(
    tmp_path: Path, stub_stages: Callable[..., None]
) -> None:
    asked: list[str] = []
    found = outcome("off", leak_tester_of(rule("fail"), asked=asked), tmp_path, stub_stages)
    assert found.verdict.approved and asked == []
    assert leak_test_file(found)["why"] == "the design switches it off"


@pytest.mark.parametrize("setting", ["off", "if-available", "required"])
def test_a_misnamed_slicer_stops_only_a_run_that_requires_it(
    setting: str, tmp_path: Path, stub_stages: Callable[..., None], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("BELLOWS_SLICER", "/nope")
    stub_stages(FakeEvaluation(design=load_design("finger")))
    if setting == "required":
        with pytest.raises(PrintersError, match="names '/nope', which is no program"):
            run(design(setting), tmp_path)
        return
    found = run(design(setting), tmp_path)
    assert found.verdict.approved and found.leak_test.result == "not run"
    assert ("nope" in found.leak_test.why) == (setting == "if-available")


def test_required_without_a_slicer_is_refused_before_the_evaluation(
    tmp_path: Path, stub_stages: Callable[..., None]
) -> None:
    stub_stages(AssertionError("evaluated"))
    found = run(design("required"), tmp_path, leak_tester=NO_SLICER)
    (reason,) = found.verdict.reasons
    assert reason.rule == "leak_test" and "there is no slicer" in reason.message
    assert found.evaluation is None and list(tmp_path.iterdir()) == []
    assert found.to_dict()["evaluation"] is None


def test_a_part_that_is_refused_anyway_is_not_sliced(
    tmp_path: Path, stub_stages: Callable[..., None]
) -> None:
    asked: list[str] = []
    stub_stages(FakeEvaluation(max_von_mises_mpa=9.0))
    found = run(design("required"), tmp_path, leak_tester=leak_tester_of(rule("pass"), asked=asked))
    assert asked == [] and [each.rule for each in found.verdict.reasons] == ["max_von_mises"]
    assert found.leak_test.why == "the design is refused without it"


def failing(design: Design, mesh: ClosedMesh) -> LeakOutcome:
    raise PrintersError("the slicer made no file.")


def test_a_slicer_that_fails_is_a_warning_or_a_reason(
    tmp_path: Path, stub_stages: Callable[..., None]
) -> None:
    optional = outcome("if-available", failing, tmp_path, stub_stages)
    assert optional.verdict.approved
    assert optional.verdict.warnings[-1].endswith("not be finished: the slicer made no file.")
    required = outcome("required", failing, tmp_path, stub_stages)
    assert [each.rule for each in required.verdict.reasons] == ["leak_test"]
    assert required.withdrawn is not None


@pytest.mark.parametrize("setting", ["if-available", "required"])
def test_what_a_slicer_says_is_the_same_in_every_run(
    setting: str, tmp_path: Path, stub_stages: Callable[..., None]
) -> None:
    """Its folder has another name each time, and its text may hold anything."""

    def written(folder: str) -> tuple[dict[str, bytes], tuple[str, ...]]:
        def test(design: Design, mesh: ClosedMesh) -> LeakOutcome:
            raise PrintersError(f"failed:\n\x1b[31m{folder}/part.stl\x1b[0m is bad\a in {folder}.")

        found = outcome(setting, test, tmp_path / "out", stub_stages)
        said = (*found.verdict.warnings, *(each.message for each in found.verdict.reasons))
        place = tmp_path / "out" / "finger"
        files = {
            each.name: each.read_bytes() for each in place.glob("*") if each.name != "run.json"
        }
        return files, said

    one, two = written("/tmp/bellows-slicing-1a2b"), written("/var/xy/bellows-slicing-3c4d")
    assert one == two and bool(one[0]) == (setting == "if-available")
    assert any("part.stl is bad? in …" in text for text in one[1])
    assert all(text.isprintable() for text in one[1])
    assert not [name for name, content in one[0].items() if b"slicing-" in content]


def test_every_failure_of_the_check_is_named_beside_a_missing_slicer(
    tmp_path: Path, stub_stages: Callable[..., None]
) -> None:
    thin = RuleResult("minimum_lines", "fail", 2, 3, "lines", "wall", "Too thin.")
    stub_stages(AssertionError("evaluated"), fake_report(thin))
    found = run(design("required"), tmp_path, leak_tester=NO_SLICER)
    assert [each.rule for each in found.verdict.reasons] == ["minimum_lines", "leak_test"]


def test_the_default_leaves_digests_as_they_are() -> None:
    plain = load_design("finger")
    assert plain.limits.leak_test == "if-available"
    assert plain.digest.startswith("6864549071c8487e")
    assert len({design(each).digest for each in ("off", "if-available", "required")}) == 3


def test_what_is_equal_with_and_without_a_slicer(
    tmp_path: Path, stub_stages: Callable[..., None]
) -> None:
    with_slicer = outcome("if-available", leak_tester_of(rule("pass")), tmp_path / "1", stub_stages)
    without = outcome("if-available", NO_SLICER, tmp_path / "2", stub_stages)
    assert with_slicer.folder is not None and without.folder is not None
    different = {
        file.name
        for file in with_slicer.folder.iterdir()
        if file.read_bytes() != (without.folder / file.name).read_bytes()
    }
    sheets = {"finger_sheet.md", "finger_sheet.html"}
    assert different == {"manifest.json", "run.json", "leak_test.json"} | sheets


def test_the_text_names_slicer_and_rules(tmp_path: Path, stub_stages: Callable[..., None]) -> None:
    from bellows_design.reports.outcome import _leak_test

    found = outcome("if-available", leak_tester_of(rule("warn", 0.97)), tmp_path, stub_stages)
    lines = [str(line) for line in _leak_test(found.leak_test)]
    assert lines[1:] == [
        "warn: r* is 0.97.",
        "pass: It is deep enough.",
        "leak test with FakeSlicer 1.0: warn",
    ]
