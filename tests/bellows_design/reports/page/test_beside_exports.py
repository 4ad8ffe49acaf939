"""The report beside an export: hashed in run.json, known to verify, and never a reason to fail."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from fakes import FakeEvaluation

from bellows_design import load_design
from bellows_design.design.design import Design
from bellows_design.errors import DesignError
from bellows_design.export.manifest import listed_files
from bellows_design.leak_test.record import Unavailable
from bellows_design.pipeline import Outcome, run
from bellows_design.verification.folder import checked_files, sealed_manifest

NAME = "finger_report.html"
PAGE = b"<!DOCTYPE html><title>a page</title>"


def made(outcome: Outcome, files: Mapping[str, bytes]) -> bytes:
    return PAGE


@pytest.fixture
def export(stub_stages: Callable[..., None], tmp_path: Path) -> Callable[..., Outcome]:
    def export(design: Design | None = None, reporter: Any = made, **changes: Any) -> Outcome:
        chosen = design or load_design("finger")
        stub_stages(replace(FakeEvaluation(design=chosen), **changes))
        absent = Unavailable("there is none")
        return run(chosen, tmp_path, leak_tester=absent, reporter=reporter)

    return export


def test_an_approved_export_has_its_report_with_its_hash_in_the_run(
    export: Callable[..., Outcome], tmp_path: Path
) -> None:
    found = export()
    assert found.page == tmp_path / "finger" / NAME
    assert found.page.read_bytes() == PAGE
    stated = json.loads((tmp_path / "finger/run.json").read_text("utf-8"))["report"]
    assert stated == {NAME: {"sha256": hashlib.sha256(PAGE).hexdigest(), "bytes": len(PAGE)}}
    assert NAME not in json.loads((tmp_path / "finger/manifest.json").read_text("utf-8"))["files"]
    assert found.to_dict()["report"] == str(found.page)


def test_the_report_is_given_the_files_that_it_stands_beside(
    export: Callable[..., Outcome], tmp_path: Path
) -> None:
    seen: dict[str, bytes] = {}

    def remembered(outcome: Outcome, files: Mapping[str, bytes]) -> bytes:
        seen.update(files)
        return PAGE

    export(reporter=remembered)
    assert set(seen) == {each.name for each in (tmp_path / "finger").iterdir()} - {NAME, "run.json"}
    assert all((tmp_path / "finger" / name).read_bytes() == seen[name] for name in seen)


@pytest.mark.parametrize("error", [RuntimeError("no"), MemoryError(), KeyError("style")])
def test_a_report_that_fails_costs_no_export(
    export: Callable[..., Outcome], tmp_path: Path, error: Exception
) -> None:
    def failing(*_: Any) -> bytes:
        raise error

    found = export(reporter=failing)
    assert found.verdict.approved and found.folder is not None and found.page is None
    assert type(error).__name__ in found.no_page
    assert not (tmp_path / "finger" / NAME).exists()
    assert json.loads((tmp_path / "finger/run.json").read_text("utf-8"))["report"] == {}


def test_without_a_reporter_there_is_none_and_nothing_is_said(
    export: Callable[..., Outcome], tmp_path: Path
) -> None:
    found = export(reporter=None)
    assert (found.page, found.no_page) == (None, "")
    assert not (tmp_path / "finger" / NAME).exists()


def test_a_refused_design_gets_no_report(export: Callable[..., Outcome], tmp_path: Path) -> None:
    found = export(max_von_mises_mpa=9.0)
    assert not found.verdict.approved and found.page is None
    assert list(tmp_path.iterdir()) == []


def states(folder: Path) -> dict[str, str]:
    sealed = sealed_manifest(folder)
    assert isinstance(sealed, tuple)
    return {each.name: each.state for each in checked_files(folder, *sealed)}


def test_verify_knows_the_report_and_a_flipped_bit_in_it(
    export: Callable[..., Outcome], tmp_path: Path
) -> None:
    export()
    folder = tmp_path / "finger"
    assert set(states(folder).values()) == {"as written"} and NAME in states(folder)
    (folder / NAME).write_bytes(PAGE[:-1] + b"?")
    assert states(folder)[NAME] == "changed"
    (folder / NAME).unlink()
    assert states(folder)[NAME] == "missing"


def test_a_report_that_no_run_lists_is_named(
    export: Callable[..., Outcome], tmp_path: Path
) -> None:
    export(reporter=None)
    (tmp_path / "finger" / NAME).write_bytes(PAGE)
    assert states(tmp_path / "finger")[NAME] == "not listed"


def test_a_new_export_replaces_the_report_and_a_refusal_withdraws_it(
    export: Callable[..., Outcome], tmp_path: Path
) -> None:
    export()
    assert NAME in (listed_files(tmp_path / "finger") or ())
    export(reporter=None)
    assert not (tmp_path / "finger" / NAME).exists()
    export()
    assert export(max_von_mises_mpa=9.0).withdrawn == tmp_path / "finger"
    assert list(tmp_path.iterdir()) == []


def test_the_report_of_another_design_is_none_of_ours(
    export: Callable[..., Outcome], tmp_path: Path
) -> None:
    export()
    (tmp_path / "finger" / "thesis_report.html").write_bytes(PAGE)
    with pytest.raises(DesignError, match="thesis_report"):
        export()
