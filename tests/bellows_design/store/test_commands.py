"""What the commands say of kept results, and that an approval is the same with them."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
import real_command
from kept import LOW_BUBBLES

from bellows_design.analysis.evaluation import Evaluation
from solver.compilation import njit

Bellows = Callable[..., tuple[int, str, str]]
SMALL = ("prototype_1", *(word for setting in LOW_BUBBLES for word in ("--set", setting)))


@pytest.fixture
def computed(monkeypatch: pytest.MonkeyPatch, evaluation: Evaluation) -> list[str]:
    """The designs that were computed."""
    names: list[str] = []

    def evaluate(design: Any, *_: Any, **__: Any) -> Evaluation:
        names.append(design.name)
        return evaluation

    monkeypatch.setattr("bellows_design.analysis.evaluate.evaluate", evaluate)
    return names


def test_the_second_evaluation_is_the_first_one(bellows: Bellows, computed: list[str]) -> None:
    (status, first, err), again = (bellows("evaluate", *SMALL, "--json") for _ in range(2))
    assert (status, again[0], len(computed)) == (0, 0, 1)
    fresh, kept = json.loads(first), json.loads(again[1])
    assert fresh.pop("from_cache") is None and "--no-cache" not in err
    time = kept.pop("from_cache")
    assert kept == fresh
    assert f"computed on {time} and kept; --no-cache computes it anew" in again[2]


def test_no_cache_neither_looks_nor_keeps(
    bellows: Bellows, computed: list[str], own_cache: Path
) -> None:
    assert bellows("evaluate", *SMALL, "--no-cache")[0] == 0
    assert not own_cache.exists()
    bellows("evaluate", *SMALL)
    status, out, _ = bellows("evaluate", *SMALL, "--no-cache", "--json")
    assert status == 0 and json.loads(out)["from_cache"] is None
    assert len(computed) == 3


def test_a_cache_that_cannot_be_written_is_a_note_on_stderr(
    bellows: Bellows, computed: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("BELLOWS_CACHE", "/dev/null")
    status, out, err = bellows("evaluate", *SMALL, "--json")
    assert status == 0 and json.loads(out)["from_cache"] is None
    assert "the result is not kept: " in err and "/dev/null" in err


def test_without_a_home_folder_there_is_an_answer_but_no_cache(
    bellows: Bellows, computed: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("BELLOWS_CACHE", "~nobody-of-this-name")
    status, out, err = bellows("evaluate", *SMALL, "--json")
    assert status == 0 and json.loads(out)["from_cache"] is None
    assert "the result is not kept: " in err
    status, _, err = bellows("cache")
    assert status == 2 and err.count("home folder is not known") == 1 and "internal" not in err


def test_in_a_deleted_folder_the_cache_is_one_sentence(tmp_path: Path) -> None:
    """MKL, which says what results are usable, would end the process."""
    gone = tmp_path / "gone"
    gone.mkdir()
    ended = real_command.bellows("cache", limits=f"rmdir {gone};", folder=gone)
    assert ended.status == 2 and ended.err.count("\n") == 1
    assert "the working folder was deleted" in ended.err


def test_paraview_s_file_is_written_from_what_is_kept(
    bellows: Bellows, computed: list[str], tmp_path: Path
) -> None:
    bellows("evaluate", *SMALL, "--vtu", str(tmp_path / "fresh.vtu"))
    bellows("evaluate", *SMALL, "--vtu", str(tmp_path / "kept.vtu"))
    assert len(computed) == 1
    assert (tmp_path / "fresh.vtu").read_bytes() == (tmp_path / "kept.vtu").read_bytes()


def test_the_cache_says_what_it_holds_and_is_cleared(
    bellows: Bellows, computed: list[str], own_cache: Path
) -> None:
    empty = json.loads(bellows("cache", "--json")[1])
    assert (empty["results"], empty["oldest"], empty["cleared"]) == (0, None, False)
    bellows("evaluate", *SMALL)
    held = json.loads(bellows("cache", "--json")[1])
    assert (held["folder"], held["results"], held["usable"]) == (str(own_cache), 1, 1)
    assert 0 < held["size_mib"] < held["limit_mib"] and held["oldest"] == held["newest"]
    status, out, _ = bellows("cache", "--clear")
    assert status == 0 and str(own_cache) in out and "removed" in out
    assert json.loads(bellows("cache", "--json")[1])["results"] == 0
    assert "–" in bellows("cache")[1]


def test_what_cannot_be_removed_is_said(
    bellows: Bellows, computed: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(*_: object, **__: object) -> None:
        raise PermissionError(13, "Permission denied")

    bellows("evaluate", *SMALL)
    with monkeypatch.context() as read_only:
        read_only.setattr(Path, "unlink", refuse)
        status, out, _ = bellows("cache", "--clear", "--json")
        assert status == 2 and json.loads(out)["cleared"] is False
        assert "1 could not be removed" in bellows("cache", "--clear")[1]
    status, out, _ = bellows("cache", "--clear", "--json")
    assert status == 0 and json.loads(out)["cleared"] is True


@pytest.mark.slow
def test_an_approval_is_the_same_from_a_kept_evaluation(bellows: Bellows, tmp_path: Path) -> None:
    design = ("finger", "--set", "length=18", "--set", "number_of_bubbles=2")
    answers = []
    for folder in ("first", "second"):
        status, out, _ = bellows("run", *design, "--output", str(tmp_path / folder), "--json")
        assert status == 0
        answers.append(json.loads(out))
    assert answers[0]["from_cache"] is None and answers[1]["from_cache"]
    assert answers[0]["evaluation"] == answers[1]["evaluation"]
    manifests = [
        next((tmp_path / folder).rglob("manifest.json")).read_bytes()
        for folder in ("first", "second")
    ]
    assert manifests[0] == manifests[1]
    assert b"from_cache" not in manifests[1]


def test_the_first_run_says_that_it_compiles_and_how_long_that_takes(
    bellows: Bellows, monkeypatch: pytest.MonkeyPatch, evaluation: Evaluation
) -> None:
    """What is compiled here only calls itself a function of the solver."""

    def kernel(x: float) -> float:
        return 2 * x

    def evaluate(*_: Any, **__: Any) -> Evaluation:
        njit()(kernel)(1.0)
        return evaluation

    kernel.__module__ = "solver.somewhere"
    monkeypatch.setattr("bellows_design.analysis.evaluate.evaluate", evaluate)
    status, out, err = bellows("evaluate", *SMALL, "--no-cache", "--json")
    assert status == 0 and json.loads(out)
    assert err.count("compiling the solver, which may take half a minute, each time") == 1
