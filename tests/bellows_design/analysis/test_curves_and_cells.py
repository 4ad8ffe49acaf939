"""Evaluation with the unit cell, with the whole actuator, and at several pressures."""

from __future__ import annotations

import json
from dataclasses import replace
from itertools import pairwise

import pytest

from bellows_design import load_design, with_overrides
from bellows_design.analysis import evaluate as evaluating
from bellows_design.analysis.computation import Computation
from bellows_design.analysis.error_estimate import ErrorEstimate, least_estimate
from bellows_design.analysis.evaluate import evaluate, evaluation_of
from bellows_design.analysis.evaluation import Evaluation
from bellows_design.analysis.models import FULL, HALF, UNIT_CELL
from bellows_design.analysis.whole_actuator import Reading
from bellows_design.design.design import Design
from solver import Peak

pytestmark = pytest.mark.thorough

PRESSURES = (0.05, 0.02)
CHEAP = (
    "bubble_width=14", "bubble_height=12", "tendon_width=8", "number_of_bubbles=3", "length=26",
    "load.pressure=0.05",
)  # fmt: skip


def cheap(*settings: str) -> Design:
    """Prototype 1 with three low bubbles, under half of the pressure."""
    return with_overrides(load_design("prototype_1"), [*CHEAP, *settings])


@pytest.fixture(scope="module")
def cell() -> Evaluation:
    return evaluate(cheap(), pressures=PRESSURES)


@pytest.fixture(scope="module")
def half() -> Evaluation:
    return evaluate(cheap(), "half", pressures=PRESSURES)


def own_reading(evaluation: Evaluation) -> Reading:
    return Reading(
        evaluation.pressure_mpa,
        evaluation.bending_angle_deg,
        evaluation.max_von_mises_mpa,
        evaluation.cavity_volume_mm3,
    )


def test_three_bubbles_are_answered_for_by_one_and_by_their_ends(cell: Evaluation) -> None:
    assert cell.model is UNIT_CELL and cell.converged
    solutions, ends = cell.computation.solutions, cell.computation.ends
    assert len(solutions) == UNIT_CELL.levels
    assert ends is not None and ends.converged
    for coarse, fine in pairwise(solutions):
        assert len(fine.problem.mesh.tets) > 1.3 * len(coarse.problem.mesh.tets)
    assert all(solution.refused_steps == 0 for solution in solutions)


def test_three_bubbles_bend_as_three_cells_but_for_the_ends(cell: Evaluation) -> None:
    finest = cell.computation.finest
    alike = 3 * 2 * finest.rotation
    assert cell.bending_angle_deg == pytest.approx(alike, rel=0.25)
    assert cell.bending_angle_deg != alike
    more = with_overrides(cheap(), ["number_of_bubbles=4", "length=32.5"])
    # the same cell and the same ends: one more bubble is two more cells
    longer = evaluation_of(replace(cell.computation, design=more, pressures=()))
    added = longer.bending_angle_deg - cell.bending_angle_deg
    assert added == pytest.approx(2 * finest.rotation, rel=1e-12)
    grown = longer.cavity_volume_mm3 - cell.cavity_volume_mm3
    assert grown == pytest.approx(4 * finest.path[-1].volume, rel=1e-9)


@pytest.mark.parametrize("which", ["cell", pytest.param("half", marks=pytest.mark.slow)])
def test_curve_ascends_to_the_evaluations_own_values(
    which: str, request: pytest.FixtureRequest
) -> None:
    evaluation: Evaluation = request.getfixturevalue(which)
    low, high = evaluation.curve
    assert (low.pressure_mpa, high.pressure_mpa) == pytest.approx((0.02, 0.05), abs=1e-15)
    assert 0 < low.bending_angle_deg < high.bending_angle_deg
    assert 0 < low.max_von_mises_mpa < high.max_von_mises_mpa
    assert 0 < low.cavity_volume_mm3 < high.cavity_volume_mm3
    assert high == own_reading(evaluation)


def test_curve_is_whole_where_the_budget_ends_the_refinement_half_way(cell: Evaluation) -> None:
    """The mesh between goes straight to the load: what lies before is of the coarsest one."""
    fewer = evaluation_of(replace(cell.computation, solved=cell.computation.solved[:2]))
    coarsest = evaluation_of(replace(cell.computation, solved=cell.computation.solved[:1]))
    low, high = fewer.curve
    assert low == coarsest.curve[0] and high == own_reading(fewer)
    assert low.max_von_mises_mpa < high.max_von_mises_mpa != coarsest.curve[1].max_von_mises_mpa


def test_path_ascends_from_zero_to_the_evaluations_own_values(cell: Evaluation) -> None:
    path = cell.to_dict()["path"]
    for key in ("pressure_mpa", "bending_angle_deg", "max_von_mises_mpa", "cavity_volume_mm3"):
        values = [point[key] for point in path]
        assert all(before < after for before, after in pairwise(values)), key
    assert path[0]["bending_angle_deg"] == 0
    assert Reading(**path[-1]) == own_reading(cell)


def test_json_says_which_model_and_why_and_holds_the_curve(cell: Evaluation) -> None:
    content = json.loads(json.dumps(cell.to_dict(), allow_nan=False))
    assert content["model"] == "unit-cell"
    assert content["model_reason"].startswith("3 bubbles deform alike")
    keys = {"pressure_mpa", "bending_angle_deg", "max_von_mises_mpa", "cavity_volume_mm3"}
    assert all(set(reading) == keys for reading in content["curve"]) and len(content["curve"]) == 2
    last = content["curve"][-1]
    assert {key: content[key] for key in keys} == pytest.approx(last)
    assert len(content["meshes"]) == 3
    assert {key: content["meshes"][-1][key] for key in keys} == pytest.approx(last)
    for key in ("elements", "nodes", "unknowns"):
        assert content["meshes"][-1][key] == content["mesh"][key]
    assert content["mesh"]["unknowns"] < 3 * content["mesh"]["nodes"] * 1.2
    assert content["contact"]["detected"] is False
    assert 0 < content["contact"]["min_gap_mm"] < cell.design.bellows.bubble_distance


def test_peak_is_placed_in_the_middle_bubble(cell: Evaluation) -> None:
    x, y, z = cell.max_von_mises_position_mm
    middle = cell.design.bellows.bubble_middles[1]
    assert middle <= x <= middle + cell.design.bellows.pitch / 2
    assert y >= 0 and 0 <= z <= cell.design.bellows.bubble_height


@pytest.mark.parametrize("ratio", [0.5, 1.0, 1.14])
def test_ends_that_are_stressed_less_change_nothing(cell: Evaluation, ratio: float) -> None:
    """Nor a little more: so much the coarse meshes differ by chance."""
    same = evaluation_of(with_ends_stressed(cell, ratio))
    assert own_reading(same) == own_reading(cell) and same.error_estimate == cell.error_estimate


def test_ends_that_are_stressed_more_decide_the_highest_stress(cell: Evaluation) -> None:
    """A wide tendon may load the first and the last bubble half as much again as the others."""
    found = evaluation_of(with_ends_stressed(cell, 1.5))
    assert found.max_von_mises_mpa == pytest.approx(1.5 * cell.max_von_mises_mpa)
    assert found.path[-1].max_von_mises_mpa == found.max_von_mises_mpa
    assert found.bending_angle_deg == cell.bending_angle_deg
    usual, now = (of.error_estimate.max_von_mises_percent for of in (cell, found))
    assert usual is not None and now == pytest.approx(usual + 15)
    first, last = (cell.design.bellows.bubble_middles[place] for place in (0, -1))
    assert found.max_von_mises_position_mm[0] == pytest.approx(first - 1.0)
    behind = evaluation_of(with_ends_stressed(cell, 1.5, offset=1.0))
    assert behind.max_von_mises_position_mm[0] == pytest.approx(last + 1.0)
    assert found.strain.highest >= cell.strain.highest


def test_no_mesh_is_made_for_an_accuracy_that_the_ends_rule_out(cell: Evaluation) -> None:
    """Three bubbles: the ends alone leave 2 % of the angle open."""
    least = least_estimate(cell.computation)
    angle, stress = least.bending_angle_percent, least.max_von_mises_percent
    assert angle is not None and stress is not None
    estimate = cell.error_estimate
    assert estimate.bending_angle_percent is not None
    assert 2.4 < angle <= estimate.bending_angle_percent and stress == pytest.approx(2.0)
    near = ErrorEstimate(1.2 * angle, 1.2 * stress)
    far = ErrorEstimate(1.3 * angle, 1.2 * stress)
    with pytest.MonkeyPatch.context() as patch:
        for shown, enough in ((near, True), (far, False)):
            patch.setattr(evaluating, "error_estimate", lambda _, shown=shown: shown)
            assert evaluating._enough(cell.computation, 0.01) is enough
        assert evaluating._enough(cell.computation, 10.0)


def with_ends_stressed(cell: Evaluation, ratio: float, offset: float = -1.0) -> Computation:
    """The computation with a peak in the ends, so far (mm) from their bubble's middle."""
    computation = cell.computation
    place = (cell.design.bellows.bubble_middles[0] + offset, 0.0, 1.0)
    peak = Peak(ratio * computation.peaks[0].value, 0, place, 0.0)
    return replace(computation, ends_peak=peak)


def test_without_pressures_there_is_no_curve(cell: Evaluation) -> None:
    assert evaluation_of(replace(cell.computation, pressures=())).curve == ()


@pytest.mark.parametrize("pressure", [0.0, -0.01, 0.0501, float("nan")])
def test_a_pressure_above_the_designs_or_below_zero_is_refused(pressure: float) -> None:
    with pytest.raises(
        ValueError, match=r"must lie between 0, excluded, and the design's 0\.05 MPa"
    ):
        evaluate(cheap(), pressures=(0.02, pressure))


def agree(one: Evaluation, other: Evaluation, value: str, percent: str) -> None:
    """Within twice the estimated errors: what an estimate is held to."""
    errors = [getattr(of.error_estimate, percent) for of in (one, other)]
    values = [getattr(of, value) for of in (one, other)]
    assert all(error is not None for error in errors)
    allowed = sum(error / 100 * own for error, own in zip(errors, values, strict=True))
    assert abs(values[0] - values[1]) <= 2 * allowed, (values, errors)


@pytest.mark.slow
def test_cell_and_half_agree_within_their_estimated_errors(
    cell: Evaluation, half: Evaluation
) -> None:
    assert half.model is HALF and half.reason == "as asked for"
    agree(cell, half, "bending_angle_deg", "bending_angle_percent")
    agree(cell, half, "max_von_mises_mpa", "max_von_mises_percent")
    assert cell.cavity_volume_mm3 == pytest.approx(half.cavity_volume_mm3, rel=0.02)


@pytest.mark.slow
def test_the_whole_actuator_agrees_with_its_half() -> None:
    single = cheap("number_of_bubbles=1", "length=12")
    whole, half = evaluate(single, "full"), evaluate(single, "half")
    assert whole.model is FULL and half.model is HALF
    agree(whole, half, "bending_angle_deg", "bending_angle_percent")
    agree(whole, half, "max_von_mises_mpa", "max_von_mises_percent")
    assert whole.bending_angle_deg == pytest.approx(half.bending_angle_deg, rel=0.03)
    assert whole.cavity_volume_mm3 == pytest.approx(half.cavity_volume_mm3, rel=2e-3)
    sizes = [of.meshes[0].size.elements for of in (whole, half)]
    assert sizes[0] == pytest.approx(2 * sizes[1], rel=0.2)
