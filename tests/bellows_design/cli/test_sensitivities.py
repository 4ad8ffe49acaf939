"""What ``bellows evaluate --sensitivities`` says, and that it never costs the evaluation."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import pytest
from fakes import FakeEvaluation

from bellows_design import load_design
from bellows_design.design.variation import parameters
from bellows_design.neighbours.sensitivities import RESPONSES, Sensitivities, Sensitivity, _unit
from solver.errors import SolverError

Bellows = Callable[..., tuple[int, str, str]]
ASKED = ("evaluate", "prototype_1", "--no-cache", "--sensitivities")


@pytest.fixture
def evaluated(monkeypatch: pytest.MonkeyPatch) -> Callable[..., None]:
    """Call it with what a fake evaluation shall have instead of the usual."""

    def install(**changes: Any) -> None:
        found = replace(FakeEvaluation(), **changes)
        monkeypatch.setattr("bellows_design.analysis.evaluate.evaluate", lambda *_, **__: found)

    return install


def made_up(_: object) -> Sensitivities:
    """Of Prototype 1: all parameters, with numbers as long as they get."""
    design = load_design("prototype_1")
    longest = dict.fromkeys(RESPONSES, -1.2345e-05)
    rows = [Sensitivity(n, v, _unit(n), longest, longest) for n, v in parameters(design).items()]
    return Sensitivities(design, longest, tuple(rows), {}, (), (), 1.0, 0.06, 0.0, (), 1.0)


def test_every_name_and_number_shows_in_full_on_eighty_columns(
    bellows: Bellows, evaluated: Callable[..., None], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("COLUMNS", "80")
    monkeypatch.setattr("bellows_design.neighbours.sensitivities.sensitivities", made_up)
    evaluated()
    status, out, _ = bellows(*ASKED)
    assert status == 0 and "…" not in out.partition("sensitivities")[2]
    for name in parameters(load_design("prototype_1")):
        assert out.count(f" {name} ") == 2  # its elasticities, and its derivatives
    assert out.count("-1.234e-05") == 3 * len(parameters(load_design("prototype_1")))


@pytest.mark.parametrize("as_json", [False, True])
def test_a_state_without_sensitivities_is_an_evaluation_all_the_same(
    as_json: bool, bellows: Bellows, evaluated: Callable[..., None], monkeypatch: pytest.MonkeyPatch
) -> None:
    def singular(_: object) -> Sensitivities:
        raise SolverError("the state is at a limit point.")

    monkeypatch.setattr("bellows_design.neighbours.sensitivities.sensitivities", singular)
    for expected, why, changes in (
        (0, "the state is at a limit point.", {}),
        (3, "the pressure was not reached", {"converged": False}),
    ):
        evaluated(**changes)
        status, out, _ = bellows(*ASKED, *(["--json"] if as_json else []))
        assert status == expected
        if as_json:
            answer = json.loads(out)
            assert answer["sensitivities"] is None and answer["bending_angle_deg"]
        else:
            assert "bending angle" in out and f"no sensitivities: {why}" in out
