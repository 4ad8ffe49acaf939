"""``bellows study indent``, with made-up evaluations."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from fakes import FakeEvaluation

from bellows_design.design.design import Design
from bellows_design.study.indent import search

Bellows = Callable[..., tuple[int, str, str]]
ASKED = ("study", "indent", "--no-cache", "--points", "2")


class Nowhere:
    """A walk that stays where it is."""

    def __init__(self, anchor: Any, *_: Any) -> None:
        self.design = anchor.design

    def best(self, _: Any) -> Design:
        return self.design


def made_up(design: Design, *_: Any, **__: Any) -> FakeEvaluation:
    """Deeper bends more."""
    depth = 0.0 if design.indent is None else design.indent.depth
    return FakeEvaluation(design=design, bending_angle_deg=400 + 100 * depth)


@pytest.fixture(autouse=True)
def fast(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("bellows_design.analysis.evaluate.evaluate", made_up)
    monkeypatch.setattr(search, "Walk", Nowhere)
    monkeypatch.setattr(search, "refused_by", lambda _: ())


def test_json_names_what_was_found_for_each_aim_and_the_front(bellows: Bellows) -> None:
    status, out, err = bellows(*ASKED, "--json")
    content = json.loads(out)
    assert status == 0 and content["design"] == "prototype_2"
    assert [each["printable"] for each in content["found"]] == [True, True]
    assert content["paper"]["bending_angle_percent"] == pytest.approx(11.9, abs=0.05)
    assert [each["how"] for each in content["trials"]].count("spread") == 6
    assert len(content["front"]) == 1  # all are stressed alike, and the deepest bends most
    assert "rectangular, outside, " in err


def test_text_is_written_and_drawn_too(bellows: Bellows, tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    output, plot = tmp_path / "found.json", tmp_path / "found.png"
    status, out, _ = bellows(*ASKED, "--output", str(output), "--plot", str(plot))
    assert status == 0 and "nearest to the paper's:" in out and "; printable" in out
    assert json.loads(output.read_text("utf-8"))["design"] == "prototype_2"
    assert plot.read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (("--points", "0"), "points is 0 but must lie between 1 and 200"),
        (("--output", "found.txt"), "must end in .json"),
        (("no_such_design",), "no_such_design"),
    ],
)
def test_bad_input_is_refused_in_one_sentence_before_the_work(
    arguments: tuple[str, ...], sentence: str, bellows: Bellows, monkeypatch: pytest.MonkeyPatch
) -> None:
    def forbidden(*_: object, **__: object) -> None:
        raise AssertionError

    monkeypatch.setattr("bellows_design.analysis.evaluate.evaluate", forbidden)
    status, out, err = bellows(*ASKED, *arguments)
    assert status == 2 and out == "" and sentence in err


def test_a_design_that_is_not_solved_is_refused(
    bellows: Bellows, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(
        "bellows_design.analysis.evaluate.evaluate",
        lambda design, *_, **__: FakeEvaluation(design=design, converged=False, message="halfway"),
    )
    status, _, err = bellows(*ASKED)
    assert status == 2 and "prototype_2 without indent: halfway" in err
