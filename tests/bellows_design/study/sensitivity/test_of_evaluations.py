"""Tolerances of Prototype 2 by derivatives, against evaluations."""

from __future__ import annotations

import pytest

from bellows_design.design.shipped import load_design
from bellows_design.design.variation import counted
from bellows_design.evaluation import evaluate
from bellows_design.neighbours.sensitivities import ANGLE, STRESS, VOLUME
from bellows_design.study.sensitivity.causes import Tolerances
from bellows_design.study.sensitivity.study import Plan, Study, studied


@pytest.fixture(scope="module")
def study() -> Study:
    design = load_design("prototype_2")
    evaluation = evaluate(counted(design), keep=True)
    return studied(design, evaluation, Plan(sobol=False, tolerances=Tolerances(0.02, 4.0)))


@pytest.mark.slow
def test_small_tolerances_by_derivatives_agree_with_evaluated_neighbours(study: Study):
    checked = [each for each in study.tolerated.contributions if each.check is not None]
    assert {each.cause.source for each in checked} == {"print", "material"}
    for each in checked:
        # Angles are curved: 2 % of an elasticity of about one. The highest stress also jumps from
        # node to node, by more than a small change of it.
        assert each.check.nonlinearity_percent[ANGLE] < 5
        size = abs(each.changes[STRESS]) / study.tolerated.values[STRESS]
        assert size < 0.005 or each.check.nonlinearity_percent[STRESS] < 25


@pytest.mark.slow
def test_elasticities_of_all_lengths_add_up_as_similar_bodies_demand(study: Study):
    for response, power in ((ANGLE, 0), (STRESS, 0), (VOLUME, 3)):
        lengths = [
            each.elasticities[response]
            for each in study.sensitivities.parameters
            if each.unit == "mm"
        ]
        # What the ends add is kept, so that it does not scale.
        assert sum(lengths) == pytest.approx(power, abs=0.1)


@pytest.mark.slow
def test_the_bubbles_that_a_longer_design_would_have_are_named(study: Study):
    assert any(change.bubbles != 9 for change in study.sensitivities.count_changes)
    assert study.evaluation.design.bellows.number_of_bubbles == 9
