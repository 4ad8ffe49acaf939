"""Derivatives by all numbers of a design: against differences, and by dimensional analysis."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import pytest

from bellows_design.analysis.computation import SolvedMesh
from bellows_design.analysis.models import UNIT_CELL, choose
from bellows_design.design.design import Design
from bellows_design.design.overrides import with_overrides
from bellows_design.design.shipped import load_design
from bellows_design.design.variation import geometric_parameters, parameters, varied
from bellows_design.evaluation import Evaluation, Neighbourhood, evaluation_of, started
from bellows_design.morphing.morpher import Morpher
from bellows_design.neighbours.jumps import count_changes
from bellows_design.neighbours.sensitivities import (
    ANGLE,
    STRESS,
    VOLUME,
    Sensitivities,
    sensitivities,
)
from solver import Solution, SolverOptions, neighbouring, peak_von_mises
from solver.sensitivity.gradients import gradients

pytestmark = pytest.mark.thorough

Coarse = Callable[[str], Evaluation]
EXACT = SolverOptions(tolerance=1e-11, reuse=0)
STEP = 2e-3
"""Relative half of a difference; its error is of the order of its square."""


@pytest.fixture(scope="module")
def anchor(coarse: Coarse) -> Evaluation:
    return coarse("finger")


@pytest.fixture(scope="module")
def found(anchor: Evaluation) -> Sensitivities:
    return sensitivities(anchor)


def solved(anchor: Evaluation, morpher: Morpher, design: Design) -> Solution:
    """The cell of a design on the moved mesh."""
    problem = UNIT_CELL.problem(design, morpher.mesh_of(design))
    near = anchor.computation.finest
    solution = neighbouring(problem, design.load.pressure, near, options=EXACT).solution
    assert solution is not None
    return solution


def exact(anchor: Evaluation) -> Evaluation:
    """An evaluation with its cell solved to a small tolerance."""
    near = anchor.computation.finest
    solution = neighbouring(near.problem, near.pressure, near, options=EXACT).solution
    assert solution is not None
    solved = SolvedMesh(solution, peak_von_mises(solution))
    return evaluation_of(replace(anchor.computation, solved=(solved,)))


def responses(solution: Solution, count: int) -> dict[str, float]:
    """Those of the cells, as ``sensitivities`` names them."""
    smooth = gradients(solution, responses=("peak_stress",)).smooth_peak.value
    point = solution.path[-1]
    return {ANGLE: 2 * count * point.rotation, VOLUME: 4 * count * point.volume, STRESS: smooth}


@pytest.mark.slow
@pytest.mark.parametrize("name", ["prototype_2", "finger"])
def test_derivatives_match_central_differences_on_moved_meshes(coarse: Coarse, name: str) -> None:
    anchor = exact(coarse(name))
    found = sensitivities(anchor)
    finest = anchor.computation.finest.problem.mesh
    morpher = Morpher.of(anchor.design, "unit-cell", finest)
    count = anchor.design.bellows.bubble_count
    largest = {
        key: max(abs(row.elasticities[key] or 0) for row in found.parameters)
        for key in (ANGLE, VOLUME, STRESS)
    }
    for parameter, value in parameters(anchor.design).items():
        ahead, behind = (
            responses(
                solved(anchor, morpher, varied(anchor.design, {parameter: value * (1 + sign)})),
                count,
            )
            for sign in (STEP, -STEP)
        )
        row = found.of(parameter)
        for key, tolerance in ((ANGLE, 1e-4), (VOLUME, 1e-4), (STRESS, 1e-3)):
            difference = (ahead[key] - behind[key]) / (2 * STEP * value)
            bound = 1e-5 * largest[key] * abs(found.responses[key] / value)
            assert row.derivatives[key] == pytest.approx(difference, rel=tolerance, abs=bound), (
                parameter,
                key,
            )


@pytest.mark.slow
def test_derivatives_in_contact_match_central_differences() -> None:
    """In a vacuum walls touch, where the state must be settled before it has derivatives."""
    design = with_overrides(load_design("prototype_1"), ["load.pressure=-0.03"])
    anchor = evaluation_of(started(design, *choose(design)))
    assert anchor.contact.detected
    assert not anchor.contact.void
    found = sensitivities(anchor)
    morpher = Morpher.of(design, "unit-cell", anchor.computation.finest.problem.mesh)
    for parameter in ("load.pressure", "bubble_height", "chamber_length"):
        value = parameters(design)[parameter]
        ahead, behind = (
            responses(
                solved(anchor, morpher, varied(design, {parameter: value * (1 + sign)})),
                design.bellows.bubble_count,
            )
            for sign in (STEP, -STEP)
        )
        for key in (ANGLE, VOLUME, STRESS):
            difference = (ahead[key] - behind[key]) / (2 * STEP * value)
            slope = found.of(parameter).derivatives[key]
            assert slope == pytest.approx(difference, rel=1e-3), (parameter, key)


def test_scaling_all_lengths_keeps_angle_and_stress(
    anchor: Evaluation, found: Sensitivities
) -> None:
    """Up to the error of the coarse mesh, whose nodes slide along the faces as these grow."""
    for key, power, share in ((ANGLE, 0, 0.01), (STRESS, 0, 0.03), (VOLUME, 3, 0.01)):
        total = sum(
            found.of(name).derivatives[key] * value
            for name, value in geometric_parameters(anchor.design).items()
        )
        cells = _of_cells(anchor, found, key)
        assert total == pytest.approx(power * cells, abs=share * abs(cells))


def test_scaling_pressure_and_moduli_together_scales_the_stress_alone(
    anchor: Evaluation, found: Sensitivities
) -> None:
    moduli = [name for name in parameters(anchor.design) if ".mu[" in name]
    for key, power in ((ANGLE, 0), (VOLUME, 0), (STRESS, 1)):
        rows = [found.of(name) for name in (*moduli, "load.pressure")]
        total = sum(row.derivatives[key] * row.value for row in rows)
        cells = _of_cells(anchor, found, key)
        assert total == pytest.approx(power * cells, abs=2e-3 * abs(cells))


def _of_cells(anchor: Evaluation, found: Sensitivities, key: str) -> float:
    """A response without what the ends add."""
    count, point = anchor.design.bellows.bubble_count, anchor.computation.finest.path[-1]
    cells = {ANGLE: 2 * count * point.rotation, VOLUME: 4 * count * point.volume}
    return cells.get(key, found.responses[key])


def test_full_rounds_are_led_along_and_no_parameters(found: Sensitivities) -> None:
    assert found.led_along["inner_fillet"] == ("chamber_length",)
    assert "inner_fillet" not in {row.parameter for row in found.parameters}


def test_smooth_peak_is_stated_beside_the_peak(anchor: Evaluation, found: Sensitivities) -> None:
    assert 1 <= found.smooth_peak_ratio < 1.1
    assert found.responses[STRESS] == pytest.approx(
        found.smooth_peak_ratio * anchor.max_von_mises_mpa, rel=1e-9
    )


def test_derivatives_at_a_neighbour_are_those_of_its_own_state(anchor: Evaluation) -> None:
    session = Neighbourhood(anchor)
    design = varied(anchor.design, {"bubble_width": 20.4})
    there = session.evaluate(design)
    slope = sensitivities(there).of("bubble_width").derivatives[ANGLE]
    ahead, behind = (
        session.evaluate(varied(design, {"bubble_width": 20.4 + step})).bending_angle_deg
        for step in (0.05, -0.05)
    )
    assert slope == pytest.approx((ahead - behind) / 0.1, rel=5e-3)


def test_the_number_of_bubbles_changes_where_it_is_said_to() -> None:
    design = load_design("prototype_2")
    changes = count_changes(design)
    assert {change.parameter for change in changes} >= {"length", "chamber_length"}
    for change in changes:
        value = getattr(design.bellows, change.parameter)
        before = change.value + 1e-6 * (value - change.value)
        counts = [
            type(design.bellows)
            .model_construct(**design.bellows.model_dump() | {change.parameter: each})
            .bubble_count
            for each in (before, change.value)
        ]
        assert counts == [design.bellows.bubble_count, change.bubbles]


def test_a_stated_number_of_bubbles_does_not_change() -> None:
    design = with_overrides(load_design("prototype_2"), ["number_of_bubbles=9"])
    assert count_changes(design) == ()


@pytest.mark.slow
def test_a_material_at_a_bound_of_stability_has_derivatives() -> None:
    """A Yeoh material without its second term; no design has a negative one for all strains."""
    table = load_design("finger").model_dump()
    table["material"] = {"model": "yeoh", "c10": 1.7, "c20": 0.0, "yield_strength": 5.0}
    design = Design.of(table)
    found = sensitivities(evaluation_of(started(design, *choose(design))))
    stiffer = found.of("material.higher[0]").derivatives
    assert stiffer[ANGLE] < 0
    assert stiffer[VOLUME] < 0
