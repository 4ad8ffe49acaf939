"""What a mesh will take is known before it is made, and refused where it is too much."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from fakes import FakeEvaluation

from bellows_design import budget
from bellows_design.analysis.evaluate import evaluate
from bellows_design.analysis.mesh_plan import first_plan
from bellows_design.analysis.models import FULL, HALF, UNIT_CELL, AnalysisModel
from bellows_design.budget import DEFAULT, LEAST_MEMORY, Budget, default_memory
from bellows_design.design.design import Design
from bellows_design.design.overrides import with_overrides
from bellows_design.design.shipped import load_design, shipped_designs
from bellows_design.errors import DesignError
from bellows_design.geometry.named_solids import NamedSolid

HONEST = 1.5
"""Estimated and actual numbers of elements differ by no larger a factor."""

THIN_AND_WIDE = (
    "bubble_thickness=0.4", "tendon_thickness=0.4", "outer_fillet=0.6", "bubble_width=40",
    "bubble_height=40", "length=60", "number_of_bubbles=2", "chamber_length=4",
)  # fmt: skip
EXTREMES = {
    "thin and wide": THIN_AND_WIDE,
    "thin tendon": ("tendon_thickness=0.5",),
    "thick tendon": (
        *("bubble_thickness=0.6", "tendon_thickness=3", "outer_fillet=0.8", "tendon_height=10"),
        *("bubble_width=40", "bubble_height=40", "length=60"),
    ),
    "tiny fillets": ("inner_fillet=0.06", "outer_fillet=0.06"),
    "no fillets": ("inner_fillet=0", "outer_fillet=0"),
    "full rounds": ("inner_fillet=1", "outer_fillet=2.5"),
    "narrow": ("bubble_width=12", "bubble_height=10", "tendon_width=8"),
    "wide": ("bubble_width=60", "bubble_height=50", "tendon_width=40", "chamber_length=10"),
}


def extreme(name: str) -> Design:
    return with_overrides(load_design("prototype_1"), [*EXTREMES[name], "length=90"])


def estimate_over_actual(design: Design, model: AnalysisModel) -> float:
    plan = first_plan(model.solid(design), design)
    return plan.elements / len(plan.made(Budget(memory=100)).tets)


@pytest.mark.parametrize("name", shipped_designs())
def test_the_estimate_of_a_shipped_cell_is_honest(name: str) -> None:
    assert 1 / HONEST < estimate_over_actual(load_design(name), UNIT_CELL) < HONEST


@pytest.mark.slow
@pytest.mark.parametrize("name", shipped_designs())
def test_the_estimate_of_a_shipped_half_is_honest(name: str) -> None:
    assert 1 / HONEST < estimate_over_actual(load_design(name), HALF) < HONEST


@pytest.mark.slow
@pytest.mark.parametrize("name", EXTREMES)
def test_the_estimate_of_an_extreme_cell_is_honest(name: str) -> None:
    assert 1 / HONEST < estimate_over_actual(extreme(name), UNIT_CELL) < HONEST


def test_a_mesh_too_large_for_the_memory_is_refused_before_it_is_made(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(NamedSolid, "meshed", None)
    thin = with_overrides(load_design("prototype_1"), THIN_AND_WIDE)
    with pytest.raises(DesignError) as error:
        evaluate(thin, FULL.name, budget=Budget(memory=2.0))
    (sentence,) = error.value.sentences
    for words in ("0 000 tetrahedra", "GiB, above the limit of 2 GiB", "--memory", "thicker"):
        assert words in sentence


def test_more_elements_take_more_memory_and_thinner_walls_more_elements() -> None:
    plans = [
        first_plan(UNIT_CELL.solid(design), design)
        for design in (load_design("prototype_1"), extreme("thin tendon"), extreme("thin and wide"))
    ]
    assert plans[0].elements < plans[1].elements < plans[2].elements
    assert plans[0].memory < LEAST_MEMORY and plans[0].memory < plans[1].memory < plans[2].memory


@pytest.mark.parametrize(
    ("fields", "sentence"),
    [
        ({"memory": 0.5}, "memory is 0.5 GiB but must be finite and at least 0.8 GiB."),
        ({"memory": float("nan")}, "memory is nan GiB"),
        ({"memory": float("inf")}, "memory is inf GiB"),
        ({"mesh_seconds": 0.0}, "mesh_seconds is 0 s but must lie above 0 and not above 86400 s."),
        ({"mesh_seconds": float("nan")}, "mesh_seconds is nan s"),
    ],
)
def test_limits_that_are_none_are_refused(fields: dict[str, float], sentence: str) -> None:
    with pytest.raises(DesignError) as error:
        Budget(**fields)
    assert str(error.value).startswith(sentence)


@pytest.mark.parametrize(
    ("machine", "usual"), [(2.0, 1.5), (4.0, 3.0), (64.0, 4.0), (None, 4.0), (0.5, LEAST_MEMORY)]
)
def test_the_usual_memory_is_a_share_of_the_machines(
    machine: float | None, usual: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(budget, "memory_gib", lambda: machine)
    assert default_memory() == usual == Budget().memory


@pytest.mark.parametrize("command", ["evaluate", "run"])
def test_the_command_passes_the_limits_on(
    command: str,
    bellows: Callable[..., tuple[int, str, str]],
    stub_stages: Callable[..., None],
    monkeypatch: pytest.MonkeyPatch,
    tmp_path: Path,
) -> None:
    asked: list[Budget] = []

    def evaluating(*_: Any, budget: Budget, **__: Any) -> FakeEvaluation:
        asked.append(budget)
        return FakeEvaluation()

    stub_stages(FakeEvaluation())
    monkeypatch.setattr("bellows_design.analysis.evaluate.evaluate", evaluating)
    monkeypatch.chdir(tmp_path)
    bellows(command, "prototype_1", "--memory", "2.5", "--mesh-seconds", "30")
    bellows(command, "prototype_1", "--mesh-seconds", "30")
    assert asked == [Budget(2.5, 30.0), Budget(DEFAULT.memory, 30.0)]


def test_a_mesh_that_takes_too_long_ends_the_command_with_status_3(
    bellows: Callable[..., tuple[int, str, str]],
) -> None:
    status, out, err = bellows("evaluate", "prototype_1", "--mesh-seconds", "0.001", "--json")
    assert status == 3 and "Traceback" not in err
    assert "did not mesh the solid within 0.001 s and was stopped" in json.loads(out)["error"]
