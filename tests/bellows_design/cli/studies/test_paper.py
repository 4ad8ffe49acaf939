"""``bellows study paper``, with made-up evaluations."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from fakes import FakeEvaluation

from bellows_design.study.paper import TABLE_4

Bellows = Callable[..., tuple[int, str, str]]
ASKED = ("study", "paper", "--no-cache")


@pytest.fixture
def evaluated(monkeypatch: pytest.MonkeyPatch) -> Callable[..., None]:
    """Call it with what every fake evaluation shall have instead of the usual."""

    def install(**changes: Any) -> None:
        monkeypatch.setattr(
            "bellows_design.analysis.evaluate.evaluate",
            lambda design, *_, **__: FakeEvaluation(design=design, **changes),
        )

    return install


def test_json_has_a_row_for_every_design_of_the_paper(
    bellows: Bellows, evaluated: Callable[..., None]
) -> None:
    evaluated()
    status, out, err = bellows(*ASKED, "--json")
    rows = json.loads(out)["rows"]
    assert status == 0 and [row["design"] for row in rows] == [each.label for each in TABLE_4]
    assert rows[3]["paper"]["max_von_mises_mpa"] == 5.211
    assert "13 of 13" in err


def test_every_name_and_number_shows_in_full_on_eighty_columns(
    bellows: Bellows, evaluated: Callable[..., None], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("COLUMNS", "80")
    evaluated()
    status, out, _ = bellows(*ASKED)
    assert status == 0 and "…" not in out
    for result in TABLE_4:
        assert out.count(f" {result.label} ") >= 2 and f"{result.max_stress_mpa:.2f}" in out


def test_rows_that_do_not_agree_have_a_footnote(
    bellows: Bellows, evaluated: Callable[..., None]
) -> None:
    evaluated(bending_angle_deg=220.0, max_von_mises_mpa=4.547)
    _, out, _ = bellows(*ASKED)
    assert "* bubble width 16: not accounted for." in out
    assert "* bubble thickness 1.2: the sign of the change in stress." in " ".join(out.split())
    assert "* Prototype 1:" not in out


def test_what_is_printed_is_written_too_and_drawn(
    bellows: Bellows, evaluated: Callable[..., None], tmp_path: Path
) -> None:
    pytest.importorskip("matplotlib")
    evaluated()
    output, plot = tmp_path / "rows.json", tmp_path / "rows.png"
    status, out, _ = bellows(*ASKED, "--json", "--output", str(output), "--plot", str(plot))
    assert status == 0 and json.loads(output.read_text("utf-8")) == json.loads(out)
    assert plot.read_bytes().startswith(b"\x89PNG")


def test_a_load_that_is_not_reached_is_status_3_and_said(
    bellows: Bellows, evaluated: Callable[..., None]
) -> None:
    evaluated(converged=False, message="it stopped at half of it")
    status, out, _ = bellows(*ASKED)
    assert status == 3 and "NOT CONVERGED: it stopped at half of it" in " ".join(out.split())


@pytest.mark.parametrize("option", ["--output", "--plot"])
def test_a_file_that_cannot_be_written_is_refused_before_the_work(
    option: str, bellows: Bellows, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    def forbidden(*_: object, **__: object) -> None:
        raise AssertionError

    monkeypatch.setattr("bellows_design.analysis.evaluate.evaluate", forbidden)
    status, _, err = bellows(*ASKED, option, str(tmp_path / "rows.txt"))
    assert status == 2 and "must end in" in err
