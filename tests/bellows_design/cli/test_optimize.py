"""``bellows optimize``: from options to files, with made-up responses in place of evaluations."""

from __future__ import annotations

import json

import pytest
from fakes import FakeEvaluation, fake_report
from power_law import answered

from bellows_design.approval import Reason, Verdict
from bellows_design.design.design import Design
from bellows_design.study.optimize.goal import Goal
from bellows_design.study.optimize.stages import Effort
from bellows_design.study.optimize.verification import Verification
from solver.errors import MeshingError

GOAL = Goal("angle", 4.0)
SMALL = ("optimize", "finger", "--workers", "0", "--lines", "3", "--no-verify", "--minutes", "1")


class Answering:
    """In the place of a session."""

    asked = 0

    def __init__(self, *_: object, **__: object) -> None:
        pass

    def answer(self, question):
        type(self).asked += 1
        return answered(question)


def little(seed: int) -> Effort:
    """A short search."""
    return Effort(global_designs=6, starts=1, front_limits=(0.9,), seed=seed)


@pytest.fixture
def made_up(monkeypatch):
    """Made-up answers, and few of them."""
    kind = type("Counting", (Answering,), {})
    monkeypatch.setattr("bellows_design.batch.session.Session", kind)
    monkeypatch.setattr("bellows_design.cli.studies.optimize._effort", little)
    return kind


@pytest.mark.thorough
def test_the_front_is_written_as_designs_that_are_read_back(bellows, made_up, tmp_path):
    folder = tmp_path / "out"
    status, out, _ = bellows(*SMALL, "-o", str(folder), "--json")
    found = json.loads(out)
    assert status == 0
    assert found["best"] == "finger-best"
    rows = {row["design"]: row for row in found["front"]}
    for name, row in rows.items():
        design = Design.from_toml((folder / f"{name}.toml").read_text("utf-8"))
        assert (design.name, design.digest) == (name, row["digest"])
    assert json.loads((folder / "optimum.json").read_text("utf-8")) == found
    best = rows["finger-best"]
    assert best["max_von_mises_mpa"] * 1.02 <= 4.0 * 1.001
    assert found["evaluations"]["asked"] == made_up.asked


@pytest.mark.thorough
def test_the_same_command_goes_on_without_asking_again(bellows, made_up, tmp_path):
    command = (*SMALL, "-o", str(tmp_path / "out"), "--json")
    first = json.loads(bellows(*command)[1])
    asked = made_up.asked
    again = json.loads(bellows(*command)[1])
    assert made_up.asked == asked > 0
    assert again["evaluations"]["asked"] == 0
    assert again["front"] == first["front"]


@pytest.mark.thorough
def test_an_optimum_that_does_not_hold_is_refused(bellows, made_up, tmp_path, monkeypatch):
    def verified(design, *_):
        reason = Reason("stress", "max_von_mises", 4.2, 4.0, "MPa", "It is above the limit.")
        cell = FakeEvaluation(max_von_mises_mpa=4.2)
        return Verification(design, GOAL, fake_report(), cell, Verdict((reason,)))

    monkeypatch.setattr("bellows_design.study.optimize.run.verified", verified)
    arguments = [each for each in SMALL if each != "--no-verify"]
    status, out, _ = bellows(*arguments, "-o", str(tmp_path / "out"), "--json")
    assert status == 1
    found = json.loads(out)["verification"]
    assert (found["holds"], found["reasons"][0]["rule"]) == (False, "max_von_mises")


def test_no_design_within_the_limits_is_no_optimum(bellows, made_up, tmp_path):
    status, out, _ = bellows(
        *SMALL, "--goal", "stress", "--angle", "5000", "-o", str(tmp_path / "out"), "--json"
    )
    assert status == 3
    found = json.loads(out)
    assert found["best"] is None
    written = {path.stem for path in (tmp_path / "out").glob("*.toml")}
    assert written == {row["design"] for row in found["front"]}


@pytest.mark.thorough
def test_a_verification_that_fails_refuses_and_keeps_the_front(
    bellows, made_up, tmp_path, monkeypatch
):
    def verified(*_):
        raise MeshingError("no mesh.")

    monkeypatch.setattr("bellows_design.study.optimize.run.verified", verified)
    arguments = [each for each in SMALL if each != "--no-verify"]
    status, out, _ = bellows(*arguments, "-o", str(tmp_path / "out"), "--json")
    assert status == 1
    assert json.loads(out)["verification_failure"] == "no mesh."
    assert (tmp_path / "out" / "finger-best.toml").exists()


@pytest.mark.thorough
def test_designs_that_left_the_front_are_removed_and_nothing_else(bellows, made_up, tmp_path):
    folder = tmp_path / "out"
    command = (*SMALL, "-o", str(folder), "--json")
    bellows(*command)
    summary = json.loads((folder / "optimum.json").read_text("utf-8"))
    gone, mine = folder / "finger-99.toml", folder / "finger-98.toml"
    gone.write_text("old")
    mine.write_text("mine")
    summary["front"].append({"design": "finger-99"})
    (folder / "optimum.json").write_text(json.dumps(summary), "utf-8")
    bellows(*command)
    assert not gone.exists()
    assert mine.read_text() == "mine"


def test_a_folder_with_other_files_is_refused(bellows, tmp_path):
    (tmp_path / "finger-1.toml").write_text("mine")
    status, _, err = bellows("optimize", "finger", "-o", str(tmp_path))
    assert status == 2
    assert "holds other files" in err


def test_the_picture_of_the_front_is_drawn(bellows, made_up, tmp_path):
    pytest.importorskip("matplotlib")
    plot = tmp_path / "front.png"
    bellows(*SMALL, "-o", str(tmp_path / "out"), "--plot", str(plot))
    assert plot.read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        (("--goal", "stress"), "give one with --angle, in degrees"),
        (("--angle", "-3"), "angle is -3° but must be above 0°"),
        (("--stress", "nan"), "stress limit is nan MPa"),
        (("--minutes", "0"), "--minutes is 0 but must lie above 0"),
        (("--lines", "2"), "--lines is “2” but must lie between 3 and 20"),
        (("--lines", "three"), "must be whole numbers, such as 3,4 or 7-10"),
        (("--bubbles", "9-7"), "--bubbles is “9-7” but must lie between 3 and 100"),
        (("--gap", "0.1"), "--gap is 0.1 mm but must be 0.4 to 20 mm"),
        (("--passage", "30"), "--passage is 30 mm but must be 0.4 to 20 mm"),
        (("--bubbles", "60"), "no number of bubbles fits into length = 50 mm"),
        (("--seed", "-1"), "--seed is -1 but must be 0 or more"),
        (("--stress", "4.5"), "--stress is 4.5 MPa but must not exceed the design's limit of 4"),
        (("--passage", "19"), "no number of bubbles fits"),
        (("--set", "load.pressure=-0.03"), "load.pressure is -0.03 MPa, but an optimization needs"),
        (("--plot", "front.jpg"), "must end in .png"),
        (("--workers", "-1"), "--workers is -1"),
    ],
)
def test_bad_options_are_one_sentence_and_nothing_is_written(bellows, tmp_path, options, sentence):
    folder = tmp_path / "out"
    status, _, err = bellows("optimize", "finger", *options, "-o", str(folder))
    assert status == 2
    assert sentence in err.strip().splitlines()[-1]
    assert not folder.exists()


@pytest.mark.thorough
def test_a_folder_of_another_optimum_is_refused(bellows, made_up, tmp_path):
    folder = str(tmp_path / "out")
    bellows(*SMALL, "-o", folder)
    status, _, err = bellows(*SMALL, "--stress", "3.5", "-o", folder)
    assert status == 2
    assert "holds another study, which differs in most_stress_mpa" in err


def test_a_file_in_the_place_of_the_folder_is_refused(bellows, tmp_path):
    place = tmp_path / "out"
    place.write_text("mine")
    status, _, err = bellows("optimize", "finger", "-o", str(place))
    assert (status, place.read_text()) == (2, "mine")
    assert "is a file, not a folder" in err
