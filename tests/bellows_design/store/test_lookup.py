"""Nothing is computed twice, and what is found answers as what was computed."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pytest
from kept import small

from bellows_design.analysis import evaluate as analysis
from bellows_design.analysis.evaluation import Evaluation, LoadedState
from bellows_design.progress import SILENCE, Progress, Silence
from bellows_design.store import Store, evaluated

DESIGN = small()


@dataclass(frozen=True)
class Notes(Silence):
    """Progress that remembers its notes."""

    texts: list[str] = field(default_factory=list)

    def note(self, text: str) -> None:
        self.texts.append(text)


@pytest.fixture
def computed(monkeypatch: pytest.MonkeyPatch, evaluation: Evaluation) -> list[int]:
    """The number of meshes each time that something is computed."""
    calls: list[int] = []
    really_finer = analysis.finer

    def evaluate(*_: Any, **__: Any) -> Evaluation:
        calls.append(1)
        return evaluation

    def finer(found: Evaluation, why: str, progress: Progress = SILENCE) -> Evaluation | None:
        calls.append(len(found.meshes) + 1)
        return really_finer(found, why, progress)

    monkeypatch.setattr(analysis, "evaluate", evaluate)
    monkeypatch.setattr(analysis, "finer", finer)
    return calls


def until(meshes: int) -> Callable[[LoadedState], str]:
    """A question that so many meshes answer."""

    def question(state: LoadedState) -> str:
        assert isinstance(state, Evaluation)
        return "" if len(state.meshes) >= meshes else "it is asked for"

    return question


def test_the_same_question_is_computed_once(
    store: Store, computed: list[int], evaluation: Evaluation
) -> None:
    notes = Notes()
    first, again = (evaluated(DESIGN, store=store, progress=notes) for _ in range(2))
    assert computed == [1]
    assert first is evaluation and again == evaluation
    assert not first.from_cache and again.from_cache
    assert len(notes.texts) == 1 and again.from_cache in notes.texts[0]


def test_without_a_store_nothing_is_kept(
    computed: list[int], evaluation: Evaluation, own_cache: Path
) -> None:
    assert all(evaluated(DESIGN) is evaluation for _ in range(2))
    assert computed == [1, 1]
    assert not own_cache.exists()


@pytest.mark.thorough
def test_an_open_question_goes_on_from_what_is_kept(
    store: Store, computed: list[int], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(analysis, "_promising", lambda estimates: len(estimates) < 4)
    plain = evaluated(DESIGN, store=store)
    finer = evaluated(DESIGN, store=store, open_question=until(2))
    assert computed == [1, 2]
    again = evaluated(DESIGN, store=store, open_question=until(2))
    assert computed == [1, 2]
    assert again == finer and again.from_cache
    assert len(plain.meshes) == 1 and len(again.meshes) == 2
    assert evaluated(DESIGN, store=store) == plain  # the question left no trace in it


def test_a_store_that_cannot_be_written_is_a_note(
    computed: list[int], evaluation: Evaluation, tmp_path: Path
) -> None:
    (tmp_path / "file").write_text("no folder")
    notes = Notes()
    assert evaluated(DESIGN, store=Store(tmp_path / "file"), progress=notes) is evaluation
    assert len(notes.texts) == 1 and "the result is not kept: " in notes.texts[0]
