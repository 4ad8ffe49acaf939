"""Evaluations that start from a neighbour: the same equilibria, and when there is none."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from bellows_design.analysis.error_estimate import ErrorEstimate
from bellows_design.analysis.models import choose
from bellows_design.analysis.wall_contact import WallContact
from bellows_design.design.design import Design
from bellows_design.design.overrides import with_overrides
from bellows_design.design.variation import geometric_parameters, varied
from bellows_design.errors import DesignError
from bellows_design.evaluation import (
    Evaluation,
    Neighbourhood,
    Pool,
    evaluate,
    evaluation_of,
    started,
)
from bellows_design.morphing.morpher import Morpher
from bellows_design.neighbours.carried import REACH
from bellows_design.neighbours.sensitivities import sensitivities
from bellows_design.progress import Progress
from solver import SolverOptions, solve

Coarse = Callable[[str], Evaluation]
EXACT = SolverOptions(tolerance=1e-9)


@pytest.fixture(scope="module")
def anchor(coarse: Coarse) -> Evaluation:
    return coarse("finger")


@pytest.fixture(scope="module")
def session(anchor: Evaluation) -> Neighbourhood:
    return Neighbourhood(anchor)


def near(anchor: Evaluation, seed: int, share: float = 0.05) -> Design:
    """A design whose lengths all differ from the anchor's by up to ``share`` at random."""
    generator = np.random.default_rng(seed)
    values = {k: v for k, v in geometric_parameters(anchor.design).items() if k not in ENDS}
    changes = {k: v * (1 + generator.uniform(-share, share)) for k, v in values.items()}
    return varied(anchor.design, changes)


ENDS = ("length", "offset")


def walked(anchor: Evaluation, design: Design) -> float:
    """Rotation (°) of the cell of ``design`` on the anchor's moved mesh, loaded from zero."""
    finest = anchor.computation.finest.problem.mesh
    mesh = Morpher.of(anchor.design, anchor.model.name, finest).mesh_of(design)
    return solve(anchor.model.problem(design, mesh), design.load.pressure, EXACT).rotation


def test_the_design_itself_is_found_again(anchor: Evaluation, session: Neighbourhood) -> None:
    found = session.evaluate(anchor.design)
    assert not found.fallback and found.distance == 0
    assert found.bending_angle_deg == pytest.approx(anchor.bending_angle_deg, rel=1e-4)
    assert found.max_von_mises_mpa == pytest.approx(anchor.max_von_mises_mpa, rel=1e-3)
    assert found.cavity_volume_mm3 == pytest.approx(anchor.cavity_volume_mm3, rel=1e-4)


def test_an_error_that_is_not_known_stays_unknown(session: Neighbourhood) -> None:
    """After one mesh there is nothing to estimate from."""
    assert session.anchor.error_estimate == ErrorEstimate(None, None)
    assert session.evaluate(session.anchor.design).error_estimate == ErrorEstimate(None, None)


def test_strain_and_place_of_ends_that_are_stressed_more_are_carried_along(
    anchor: Evaluation,
) -> None:
    peak = replace(anchor.computation.peaks[0], value=2 * anchor.computation.peaks[0].value)
    ended = evaluation_of(replace(anchor.computation, ends_peak=peak))
    found = Neighbourhood(ended).evaluate(anchor.design)
    assert found.max_von_mises_mpa == pytest.approx(ended.max_von_mises_mpa, rel=1e-3)
    assert found.max_von_mises_position_mm == ended.max_von_mises_position_mm
    assert found.strain.highest == pytest.approx(ended.strain.highest, rel=1e-3)
    assert found.strain.lowest == pytest.approx(ended.strain.lowest, rel=1e-3)


@pytest.mark.parametrize("seed", range(2))
@pytest.mark.thorough
def test_a_neighbour_lies_on_the_branch_that_the_load_leads_to(
    anchor: Evaluation, session: Neighbourhood, seed: int
) -> None:
    design = near(anchor, seed)
    found = session.evaluate(design)
    assert not found.fallback and found.stable in (True, None)
    assert found.solution.rotation == pytest.approx(walked(anchor, design), rel=1e-4)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["prototype_1", "prototype_2", "finger"])
def test_twenty_neighbours_lie_on_the_branch_that_the_load_leads_to(
    coarse: Coarse, name: str
) -> None:
    anchor = coarse(name)
    session = Neighbourhood(anchor)
    designs = [near(anchor, seed) for seed in range(20)]
    found = [session.evaluate(design) for design in designs]
    reached = [(d, f) for d, f in zip(designs, found, strict=True) if not f.fallback]
    assert len(reached) >= 15
    for design, each in reached:
        assert each.solution.rotation == pytest.approx(walked(anchor, design), rel=1e-4)


def test_another_number_of_bubbles_is_evaluated_by_itself(
    anchor: Evaluation, session: Neighbourhood, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: list[Design] = []

    def ordinary(design: Design, *_: object, **__: object) -> Evaluation:
        asked.append(design)
        return anchor

    monkeypatch.setattr("bellows_design.neighbours.neighbourhood.evaluate", ordinary)
    for change, reason in (
        ("number_of_bubbles=7", "other faces, bubbles: 7 instead of 8"),
        ("indent=none", "other faces, indent: none instead of outside rectangular"),
        ("material=ninjaflex_yeoh", "another law"),
        ("material=dragon_skin_30", "another law"),
        (f"load.pressure={0.1 * (1 - 2 * REACH):g}", "too far away"),
    ):
        design = with_overrides(anchor.design, [change])
        found = session.evaluate(design)
        assert reason in found.fallback
        assert asked[-1] == design and found.neighbourhood is None


def test_other_pressure_and_material_are_neighbours(
    anchor: Evaluation, session: Neighbourhood
) -> None:
    softer = with_overrides(anchor.design, ["material.mu=[0.19, 3.2]", "load.pressure=0.104"])
    found = session.evaluate(softer)
    assert not found.fallback and found.pressure_mpa == 0.104
    assert found.bending_angle_deg > anchor.bending_angle_deg


def test_a_step_that_fails_is_taken_in_halves(
    anchor: Evaluation, monkeypatch: pytest.MonkeyPatch
) -> None:
    session = Neighbourhood(anchor)
    step, taken = Neighbourhood._step, []

    def short_steps_only(
        self: Neighbourhood, design: Design, start: object, progress: Progress
    ) -> object:
        from bellows_design.neighbours.distance import distance
        from bellows_design.neighbours.neighbourhood import NotReached

        if distance(start.design, design) > 0.015:  # type: ignore[attr-defined]
            raise NotReached("too long a step")
        taken.append(design)
        return step(self, design, start, progress)  # type: ignore[arg-type]

    monkeypatch.setattr(Neighbourhood, "_step", short_steps_only)
    design = varied(anchor.design, {"bubble_width": 20.5})
    found = session.evaluate(design)
    assert not found.fallback
    assert found.steps == len(taken) == 2
    assert taken[-1] == design
    direct = Neighbourhood(anchor)
    monkeypatch.undo()
    assert found.bending_angle_deg == pytest.approx(
        direct.evaluate(design).bending_angle_deg, rel=1e-4
    )


def test_evaluate_takes_an_evaluation_a_neighbour_a_session_or_a_pool(
    anchor: Evaluation, session: Neighbourhood
) -> None:
    design = varied(anchor.design, {"bubble_height": 20.2})
    first = evaluate(design, near=anchor)
    pool = Pool()
    pool.add(anchor)
    others = [evaluate(design, near=each) for each in (first, session, pool)]
    for other in others:
        assert not other.fallback
        assert other.bending_angle_deg == pytest.approx(first.bending_angle_deg, rel=1e-4)
    assert others[0].neighbourhood is first.neighbourhood


def test_near_goes_with_no_other_choice_of_model_or_accuracy(anchor: Evaluation) -> None:
    for other in ({"model": "half"}, {"accuracy_percent": 1.0}, {"pressures": [0.05]}):
        with pytest.raises(DesignError, match="near: a neighbour has the model"):
            evaluate(anchor.design, near=anchor, **other)  # type: ignore[call-overload]


@pytest.mark.slow
def test_pool_starts_from_the_nearest_and_forgets_the_least_used(
    coarse: Coarse, anchor: Evaluation
) -> None:
    pool = Pool(most=2)
    for name in ("prototype_1", "finger", "prototype_2"):
        pool.add(coarse(name))
    found = pool.evaluate(varied(anchor.design, {"bubble_width": 20.1}))
    assert found.anchor is anchor and not found.fallback
    assert [each.anchor.design.name for each in pool._neighbourhoods] == ["prototype_2", "finger"]


@pytest.mark.slow
def test_pool_asks_only_neighbours_with_the_same_faces(coarse: Coarse, anchor: Evaluation) -> None:
    """Though one with other faces is as near in numbers, or nearer."""
    other = with_overrides(anchor.design, ["number_of_bubbles=7", "bubble_width=20.1"])
    seven = evaluation_of(started(other, *choose(other)))
    pool = Pool()
    pool.add(anchor)
    pool.add(seven)
    for start in (seven, anchor, seven):
        design = varied(start.design, {"bubble_width": 20.05})
        found = pool.evaluate(design)
        assert not found.fallback and found.anchor is start


def test_what_has_no_start_says_why(anchor: Evaluation) -> None:
    broken = replace(anchor, converged=False, message="reached 0.05 of 0.1 MPa.")
    touching = replace(anchor, contact=WallContact(True, 1.0, False, where=("inner walls",)))
    for evaluation, why in (
        (broken, "reached 0.05 of 0.1 MPa"),
        (touching, "inner walls touch, which its model does not keep apart"),
    ):
        with pytest.raises(DesignError, match=rf"no start for a neighbour: {why}\.$"):
            evaluate(anchor.design, near=evaluation)
        with pytest.raises(DesignError, match=rf"sensitivities: .* {why}\.$"):
            sensitivities(evaluation)


@pytest.mark.thorough
def test_estimated_errors_grow_with_the_distance(
    coarse: Coarse,
) -> None:
    anchor = coarse("prototype_2")
    session = Neighbourhood(replace(anchor, error_estimate=ErrorEstimate(1.0, 5.0)))
    found = [
        session.evaluate(varied(anchor.design, {"bubble_width": width})).error_estimate
        for width in (20.0, 20.4, 20.8)
    ]
    assert found[0].bending_angle_percent == pytest.approx(1.0, rel=1e-3)
    angles = [each.bending_angle_percent for each in found]
    stresses = [each.max_von_mises_percent for each in found]
    assert angles == sorted(angles) and angles[-1] > angles[0]
    assert stresses == sorted(stresses) and stresses[-1] > stresses[0]
