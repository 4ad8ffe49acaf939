"""What comes back from a store is what was computed, to the last bit, and goes on alike."""

from __future__ import annotations

import json
import subprocess
import sys
from dataclasses import fields
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from kept import key, small

from bellows_design.analysis.evaluate import evaluate, evaluation_of, write_vtu
from bellows_design.analysis.evaluation import Evaluation
from bellows_design.analysis.mesh_sequence import _with_free_ends, refined
from bellows_design.progress import SILENCE
from bellows_design.reports.evaluation import evaluation_table
from bellows_design.store import Store
from solver import Mesh, Solution


@pytest.fixture(scope="module")
def free(evaluation: Evaluation) -> Evaluation:
    """The same with bubbles without neighbours for its ends."""
    return evaluation_of(_with_free_ends(evaluation.computation, SILENCE))


@pytest.fixture(scope="module")
def half() -> Evaluation:
    """A single bubble, with two meshes."""
    return evaluate(small("number_of_bubbles=1", "length=18"))


@pytest.fixture(params=["evaluation", "free", pytest.param("half", marks=pytest.mark.slow)])
def original(request: pytest.FixtureRequest) -> Evaluation:
    found = request.getfixturevalue(request.param)
    assert isinstance(found, Evaluation)
    return found


def restored(store: Store, original: Evaluation) -> Evaluation:
    question = key(original.design)
    assert store.keep(question, original)
    found = store.find(question, original.design)
    assert found is not None and found is not original
    return found


def same(one: Any, other: Any) -> bool:
    """Equal to the last bit, NaN too, and of the same shape and type of numbers."""
    if isinstance(one, np.ndarray):
        return one.dtype == other.dtype and np.array_equal(one, other, equal_nan=True)
    if isinstance(one, Mesh | Solution):
        return all(
            same(getattr(one, field.name), getattr(other, field.name)) for field in fields(one)
        )
    if isinstance(one, tuple) and one and isinstance(one[0], Solution):
        return all(same(*pair) for pair in zip(one, other, strict=True))
    if hasattr(one, "items"):
        return one.keys() == other.keys() and all(same(one[name], other[name]) for name in one)
    if type(one).__name__ == "Problem":
        return all(
            same(getattr(one, field.name), getattr(other, field.name)) for field in fields(one)
        )
    return repr(one) == repr(other)


def test_the_record_is_the_same(store: Store, original: Evaluation) -> None:
    found = restored(store, original)
    assert found == original
    assert json.dumps(found.to_dict()) == json.dumps(original.to_dict())
    assert found.from_cache and not original.from_cache


def test_every_solution_is_the_same_to_the_last_bit(store: Store, original: Evaluation) -> None:
    found = restored(store, original)
    pairs = list(
        zip(found.computation.all_solutions, original.computation.all_solutions, strict=True)
    )
    assert pairs and all(same(*pair) for pair in pairs)
    assert found.computation.peaks == original.computation.peaks
    assert found.computation.ends_peak == original.computation.ends_peak


def test_solutions_at_the_stops_come_back(store: Store, evaluation: Evaluation) -> None:
    found = restored(store, evaluation)
    stops = [solution.at_stops for solution in found.computation.solutions]
    assert any(stops)
    assert all(stop.problem is found.computation.finest.problem for stop in stops[-1])


def test_the_same_follows_from_it(store: Store, original: Evaluation, tmp_path: Path) -> None:
    """All that is read of a computation, and ParaView's file."""
    found = restored(store, original)
    assert evaluation_of(found.computation) == original
    for name, each in (("kept", found), ("fresh", original)):
        write_vtu(each, tmp_path / f"{name}.vtu")
    assert (tmp_path / "kept.vtu").read_bytes() == (tmp_path / "fresh.vtu").read_bytes()
    assert len(list(evaluation_table(found))) == len(list(evaluation_table(original)))


@pytest.mark.thorough
def test_the_next_mesh_is_the_one_that_would_have_followed(
    store: Store, evaluation: Evaluation
) -> None:
    found = restored(store, evaluation)
    kept, fresh = (refined(each.computation).finest for each in (found, evaluation))
    assert np.array_equal(kept.problem.mesh.nodes, fresh.problem.mesh.nodes)
    # threads may add up in another order
    assert np.allclose(kept.displacement, fresh.displacement, rtol=0, atol=1e-9)


def test_the_solid_is_built_only_for_a_finer_mesh(store: Store, evaluation: Evaluation) -> None:
    body = restored(store, evaluation).computation.body
    assert "solid" not in vars(body)
    assert body.solid.solid.Volume() == evaluation.computation.body.solid.solid.Volume()


def test_what_restores_an_evaluation_waits_for_no_cad() -> None:
    script = (
        "import sys, bellows_design.store.records, bellows_design.store.lookup;"
        "import bellows_design.analysis.evaluate, bellows_design.reports.evaluation;"
        "assert 'cadquery' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", script], check=True, cwd=Path(__file__).parents[3])


def test_a_record_bears_the_labels_of_the_design_that_asks(
    store: Store, evaluation: Evaluation
) -> None:
    assert store.keep(key(small()), evaluation)
    other = small("name=another", "description=by another name")
    found = store.find(key(other), other)
    assert found is not None and found.to_dict()["design"] == "another"
    assert found.computation.design is found.design is other
