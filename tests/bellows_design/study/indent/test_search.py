"""The search, with made-up evaluations; and a walk on a coarse mesh."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest
from fakes import FakeContact, FakeEstimate, FakeEvaluation

from bellows_design.analysis.models import choose
from bellows_design.design.design import Design
from bellows_design.design.shipped import load_design
from bellows_design.errors import DesignError
from bellows_design.evaluation import evaluation_of, started
from bellows_design.neighbours.sensitivities import Sensitivities, sensitivities
from bellows_design.study.changes import Changes
from bellows_design.study.indent import search, walk
from bellows_design.study.indent.aims import LEAST_STRESS, as_in_the_paper, like
from bellows_design.study.indent.kinds import KINDS, Kind
from bellows_design.study.indent.search import IndentStudy, searched
from bellows_design.study.indent.trial import Trial, front
from bellows_design.study.indent.walk import Walk, walk_bounds
from solver.errors import MeshingError, SolverError

BASE = load_design("prototype_2")


def made_up(design: Design) -> FakeEvaluation:
    """Deeper bends more; the stress is least at a width of 2 mm, and rises with the depth."""
    indent = design.indent
    angle, stress = 400.0, 4.0
    if indent is not None:
        angle += 100 * indent.depth
        stress += 0.2 * (indent.width - 2.0) ** 2 + indent.depth - 0.5
    return FakeEvaluation(design=design, bending_angle_deg=angle, max_von_mises_mpa=stress)


class Shallower:
    """A walk that halves the depth."""

    def __init__(self, anchor: Any, *_: Any) -> None:
        self.design = anchor.design

    def best(self, _: Any) -> Design:
        indent = self.design.indent
        depth = max(0.1, indent.depth / 2)
        half = indent.model_copy(update={"depth": depth, "fillet": min(depth, indent.fillet)})
        return self.design.model_copy(update={"indent": half})


@pytest.fixture
def study(monkeypatch: pytest.MonkeyPatch) -> IndentStudy:
    monkeypatch.setattr(search, "Walk", Shallower)
    monkeypatch.setattr(search, "refused_by", lambda _: ("minimum_lines",))
    return searched(load_design("prototype_2_indent"), made_up, points=5)


def test_every_kind_is_tried_at_so_many_points(study: IndentStudy) -> None:
    spread = [trial.indent for trial in study.trials if trial.how == "spread"]
    kinds = [Kind(indent.side, indent.shape) for indent in spread if indent is not None]
    assert {kind: kinds.count(kind) for kind in KINDS} == dict.fromkeys(KINDS, 5)
    assert study.plain.changes == Changes(0, 0) and study.plain.indent is None


def test_what_is_found_for_an_aim_is_no_worse_than_any_point_of_the_spread(
    study: IndentStudy,
) -> None:
    nearest, least = study.found
    spread = [nearest.aim.value(trial.changes) for trial in study.trials if trial.how == "spread"]
    assert nearest.aim.value(nearest.trial.changes) <= min(spread)
    assert least.trial.indent is not None
    assert least.trial.indent.remaining_wall(BASE.bellows) >= 0.8 - 1e-9
    assert least.to_dict()["printable"] is False


def test_designs_that_are_not_solved_are_no_trials(monkeypatch: pytest.MonkeyPatch) -> None:
    def never(design: Design) -> FakeEvaluation:
        return FakeEvaluation(design=design, converged=design.indent is None, message="halfway")

    study = searched(BASE, never, points=2)
    assert study.trials == study.found == () and study.front == (study.plain,)


VOID = FakeContact(detected=True, where=("walls",))


def test_results_that_do_not_hold_are_no_trials_and_do_not_end_the_search(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def deep_ones_are_void(design: Design) -> FakeEvaluation:
        found = made_up(design)
        void = design.indent is not None and design.indent.depth > 0.3
        return replace(found, contact=VOID) if void else found

    monkeypatch.setattr(search, "Walk", Shallower)
    monkeypatch.setattr(search, "refused_by", lambda _: ())
    found = searched(BASE, deep_ones_are_void, points=5)
    depths = [trial.indent.depth for trial in found.trials if trial.indent is not None]
    assert depths and max(depths) <= 0.3 and len(found.found) == 2


def test_a_design_without_indent_that_is_void_is_refused() -> None:
    with pytest.raises(DesignError, match="without indent: walls touch"):
        searched(BASE, lambda design: replace(made_up(design), contact=VOID), points=1)


@pytest.mark.parametrize("error", [DesignError, SolverError, MeshingError])
def test_a_walk_or_a_trial_that_fails_leaves_what_is_known(
    monkeypatch: pytest.MonkeyPatch, error: type[Exception]
) -> None:
    class Nowhere:
        def __init__(self, *_: Any) -> None:
            raise error("no neighbour can start there.")

    def wide_ones_fail(design: Design) -> FakeEvaluation:
        if design.indent is not None and design.indent.width > 2:
            raise error("no mesh.")
        return made_up(design)

    monkeypatch.setattr(search, "Walk", Nowhere)
    monkeypatch.setattr(search, "refused_by", lambda _: ())
    found = searched(BASE, wide_ones_fail, points=5)
    assert len(found.found) == 2 and len(found.trials) > 2


@pytest.mark.parametrize("points", [0, 201])
def test_points_out_of_bounds_are_refused_before_anything_is_computed(points: int) -> None:
    def forbidden(_: Design) -> FakeEvaluation:
        raise AssertionError

    with pytest.raises(DesignError, match=f"points is {points} but must lie between 1 and 200"):
        searched(BASE, forbidden, points=points)


def trial(angle: float, stress: float) -> Trial:
    return Trial(None, "spread", 1.0, 1.0, FakeEstimate(), Changes(angle, stress))  # type: ignore[arg-type]


def test_the_front_holds_what_no_other_betters() -> None:
    best = [trial(-1, -5), trial(2, -4), trial(8, 3)]
    worse = [trial(-2, -4), trial(2, -3), trial(7, 3), trial(8, 4)]
    assert list(front([*worse, *best])) == best


@pytest.mark.slow
@pytest.mark.parametrize("aim", [like(as_in_the_paper()), LEAST_STRESS], ids=["paper", "stress"])
def test_a_walk_comes_nearer_to_its_aim_within_its_bounds(aim: Any) -> None:
    design = load_design("prototype_2_indent")
    assert design.indent is not None
    anchor = evaluation_of(started(design, *choose(design)))
    plain = replace(anchor, bending_angle_deg=445.0, max_von_mises_mpa=anchor.max_von_mises_mpa)
    told: list[Trial] = []
    bounds = walk_bounds(design, Kind("outside", "rectangular"), deepest=0.42)
    end = Walk(anchor, plain, aim, told.append).best(bounds)
    first, best = told[0].changes, min(aim.value(each.changes) for each in told)
    assert end.indent is not None and end.indent.depth <= 0.42 and len(told) > 1
    assert best < aim.value(first)


@pytest.mark.slow
def test_the_slopes_of_a_walk_are_those_of_its_steps(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of the angle, which does not jump from node to node; against central differences."""
    design = load_design("prototype_2_indent")
    anchor = evaluation_of(started(design, *choose(design)))
    seen: list[Sensitivities] = []

    def recorded(found: Any) -> Sensitivities:
        seen.append(sensitivities(found))
        return seen[-1]

    monkeypatch.setattr(walk, "sensitivities", recorded)
    aim = replace(LEAST_STRESS, value=lambda c: c.bending_angle_percent, slope=lambda _: (1.0, 0.0))
    own = Walk(anchor, anchor, aim, lambda _: None)
    count = len(own._start)
    _, slope = own._judged(own._at([1.0] * count))
    for place in range(count):
        scaled = [[1.0 + sign * 0.01 * (i == place) for i in range(count)] for sign in (1, -1)]
        ahead, behind = (own._judged(own._at(each))[0] for each in scaled)
        assert slope[place] == pytest.approx((ahead - behind) / 0.02, abs=0.3)  # percent
