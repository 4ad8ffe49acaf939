"""``bellows study sensitivity``: what it prints, writes and refuses."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from pathlib import Path

import pytest
from fakes import FakeEvaluation
from responding import Responding

from bellows_design.design.shipped import load_design
from bellows_design.design.variation import counted

Bellows = Callable[..., tuple[int, str, str]]
ASKED = ("study", "sensitivity", "finger", "--no-cache", "--samples", "10")
FINGER = counted(load_design("finger"))
STUB = Responding(
    FINGER, {"bubble_width": 1.2, "bubble_thickness": -1.0, "material.mu[1]": -0.4, "offset": 1e-4}
)


@pytest.fixture
def stubbed(monkeypatch: pytest.MonkeyPatch) -> Callable[..., None]:
    """Call it with what a fake evaluation shall have instead of the usual."""

    def install(**changes: object) -> None:
        found = FakeEvaluation(
            design=FINGER,
            **{"bending_angle_deg": 400.0, "max_von_mises_mpa": 400.0} | changes,
        )
        monkeypatch.setattr("bellows_design.analysis.evaluate.evaluate", lambda *_, **__: found)
        study = "bellows_design.study.sensitivity.study.sensitivities"
        monkeypatch.setattr(study, lambda _: STUB.sensitivities())
        session = "bellows_design.batch.session.Session"
        monkeypatch.setattr(f"{session}.begin", lambda *_: None)
        monkeypatch.setattr(f"{session}.answer", lambda _, question: STUB.answer(question))

    return install


def test_every_table_fits_into_eighty_columns_and_shows_every_name(
    bellows: Bellows, stubbed: Callable[..., None], monkeypatch: pytest.MonkeyPatch
) -> None:
    pytest.importorskip("SALib")
    monkeypatch.setenv("COLUMNS", "80")
    stubbed()
    status, out, _ = bellows(*ASKED)
    assert status == 0 and "…" not in out
    assert max(map(len, out.splitlines())) <= 80
    assert out.count(" bubble_thickness ") == 2  # its elasticities, and its indices
    assert re.search(r"bending angle: 400° ± \d+° \(print\) ± 16° \(material\) ± 4° \(mesh\)", out)
    assert re.search(r"bending angle +\d+ +1\.0000", out)


def test_json_and_file_hold_the_same_and_the_picture_is_one(
    bellows: Bellows, stubbed: Callable[..., None], tmp_path: Path
) -> None:
    pytest.importorskip("SALib")
    pytest.importorskip("matplotlib")
    stubbed()
    file, picture = tmp_path / "study.json", tmp_path / "tornado.png"
    status, out, _ = bellows(*ASKED, "--json", "--output", str(file), "--plot", str(picture))
    answer = json.loads(out)
    assert status == 0 and answer == json.loads(file.read_text("utf-8"))
    assert answer["global"]["parameters"] == ["bubble_width", "bubble_thickness", "material.mu[1]"]
    assert answer["global"]["samples"] == 10
    assert answer["tolerance"]["margins"]["bending_angle_deg"]["mesh"]["likely"] == 4.0
    assert picture.read_bytes().startswith(b"\x89PNG")


def test_without_sobol_neither_samples_nor_salib_are_needed(
    bellows: Bellows, stubbed: Callable[..., None], monkeypatch: pytest.MonkeyPatch
) -> None:
    stubbed()
    monkeypatch.setattr("bellows_design.study.sensitivity.indices.find_spec", lambda _: None)
    status, out, _ = bellows(*ASKED, "--no-sobol", "--json")
    assert status == 0 and json.loads(out)["global"] is None
    status, _, err = bellows(*ASKED)
    assert status == 2 and "extra “studies”" in err and "--no-sobol" in err


@pytest.mark.parametrize(
    ("option", "value", "named"),
    [
        ("--range", "25", "range is 25 % but must lie from 0.5 to 20 %"),
        ("--samples", "3", "samples is 3 but must lie from 10 to 10000"),
        ("--wall", "-1", "wall is -1 mm but must lie from 0 to 1 mm"),
        ("--modulus", "80", "modulus is 80 % but must lie from 0 to 50 %"),
        ("--seed", "-1", "seed is -1 but must be at least 0"),
        ("--output", "study.txt", "must end in .json"),
        ("--plot", "study.jpg", "must end in .png"),
    ],
)
def test_options_out_of_bounds_are_refused_before_anything_is_computed(
    option: str, value: str, named: str, bellows: Bellows, monkeypatch: pytest.MonkeyPatch
) -> None:
    def never(*_: object, **__: object) -> None:
        raise AssertionError("computed")

    monkeypatch.setattr("bellows_design.analysis.evaluate.evaluate", never)
    status, _, err = bellows(*ASKED, option, value)
    assert status == 2 and named in err


def test_a_design_that_does_not_reach_its_pressure_is_not_studied(
    bellows: Bellows, stubbed: Callable[..., None]
) -> None:
    stubbed(converged=False, message="stopped at 0.06 MPa.")
    status, out, _ = bellows(*ASKED, "--json")
    assert status == 3
    assert json.loads(out) == {
        "schema": "bellows error 1",
        "error": "finger has no state to study: stopped at 0.06 MPa.",
        "exit_status": 3,
    }
