"""``bellows report`` writes what is asked for, and refuses what cannot be before it computes."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import pytest
from fakes import FakeEvaluation
from report_findings import made_up

from bellows_design import load_design
from bellows_design.reports.page.findings import Findings

Run = Callable[..., tuple[int, str, str]]


@pytest.fixture(autouse=True)
def nothing_solved(monkeypatch: pytest.MonkeyPatch) -> None:
    """Made-up evaluations have no solution to follow or to take derivatives of."""
    for name in ("deformed_of", "sensitivities_of"):
        where = f"bellows_design.reports.page.findings.{name}"
        monkeypatch.setattr(where, lambda *_: "nothing was solved")


@pytest.fixture
def computed(stub_stages: Callable[..., None], monkeypatch: pytest.MonkeyPatch) -> None:
    """Made-up stages; the page names the design alone, as the stub's part is a cube."""
    stub_stages(made_up(load_design("finger")))

    def page(found: Findings) -> bytes:
        return f"<p>{found.outcome.design.name}</p>".encode()

    monkeypatch.setattr("bellows_design.reports.page.make.report_html", page)


@pytest.mark.usefixtures("computed")
def test_the_file_is_named_after_the_design(
    bellows: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    status, out, _ = bellows("report", "finger", "--no-sensitivities")
    assert status == 0 and "finger is approved" in out
    assert (tmp_path / "finger_report.html").read_text("utf-8") == "<p>finger</p>"
    assert [each.name for each in tmp_path.iterdir()] == ["finger_report.html"]


@pytest.mark.usefixtures("computed")
def test_the_answer_says_what_was_found_and_written(bellows: Run, tmp_path: Path) -> None:
    path = tmp_path / "page.html"
    status, out, _ = bellows("report", "finger", "-o", str(path), "--json")
    answer = json.loads(out)
    assert status == 0 and answer["approved"] and answer["files"] == [str(path)]
    assert answer["sensitivities"] is None and answer["no_sensitivities"]
    assert "folder" not in answer


def test_a_refused_design_has_a_report_and_no_failing_status(
    bellows: Run, tmp_path: Path, stub_stages: Callable[..., None],
    monkeypatch: pytest.MonkeyPatch,
) -> None:  # fmt: skip
    stub_stages(FakeEvaluation(design=load_design("finger"), max_von_mises_mpa=9.0))
    monkeypatch.setattr("bellows_design.reports.page.make.report_html", lambda _: b"page")
    path = tmp_path / "page.html"
    status, out, _ = bellows("report", "finger", "-o", str(path))
    assert status == 0 and "finger is refused" in out and path.read_bytes() == b"page"


@pytest.mark.parametrize(
    ("option", "value", "sentence"),
    [
        ("-o", "page.txt", "must end in .html"),
        ("--png", "page.gif", "must end in .png"),
        ("--pdf", "page.txt", "must end in .pdf"),
        ("-o", "nowhere/page.html", "no folder"),
        ("--scene", "desert", "desert"),
    ],
)
def test_what_cannot_be_is_refused_at_once(
    bellows: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, option: str, value: str,
    sentence: str, stub_stages: Callable[..., None],
) -> None:  # fmt: skip
    stub_stages(AssertionError("nothing may be computed"))
    monkeypatch.chdir(tmp_path)
    status, _, err = bellows("report", "finger", option, value)
    assert status == 2 and sentence in err
    assert list(tmp_path.iterdir()) == []


def test_without_pictures_their_absence_is_named(
    bellows: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("bellows_design.reports.page.pictures.libraries.find_spec", lambda _: None)
    path = tmp_path / "page.html"
    status, _, err = bellows("report", "finger", "-o", str(path), "--png", str(tmp_path / "a.png"))
    assert status == 2 and "pyvista and matplotlib" in err


@pytest.mark.slow
def test_a_real_report_has_its_scene_and_its_pictures(
    bellows: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Nothing is made up: a small design of a real material, blocked."""
    monkeypatch.undo()
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    path, png, pdf = (tmp_path / f"page.{kind}" for kind in ("html", "png", "pdf"))
    status, out, _ = bellows(
        "report", "prototype_1", "--scene", "blocked", "--no-sensitivities", "-o", str(path),
        "--png", str(png), "--pdf", str(pdf), "--set", "limits.leak_test=off",
    )  # fmt: skip
    assert status == 0 and out.startswith("prototype_1-"), "a changed design has its digest's name"
    html = path.read_text("utf-8")
    assert "Scene blocked" in html and "Force in the scene blocked" in html
    assert "There is no deformed shape" not in html
    assert png.read_bytes().startswith(b"\x89PNG") and pdf.read_bytes().startswith(b"%PDF-")
