"""Evaluation of whole designs: physics, error estimates, the JSON contract."""

from __future__ import annotations

import json
from dataclasses import replace

import meshio
import numpy as np
import pytest

from bellows_design import DesignError, load_design, with_overrides
from bellows_design.analysis import mesh_sequence, wall_contact
from bellows_design.analysis.evaluate import _promising, evaluate, evaluation_of, write_vtu
from bellows_design.analysis.evaluation import Evaluation, LoadedState
from bellows_design.analysis.mesh_plan import first_plan
from bellows_design.analysis.mesh_sequence import affordable_plan, next_plan, refined
from bellows_design.analysis.models import HALF, UNIT_CELL
from bellows_design.analysis.wall_contact import WallContact
from bellows_design.budget import Budget
from bellows_design.design.design import Design
from bellows_design.study.paper import TABLE_4
from solver import solve
from solver.meshing.estimate import expected_memory

NO_CONTACT = WallContact(False, None, False)
TWO_BUBBLES = ("length=18", "offset=3", "number_of_bubbles=2")


def short(*settings: str) -> Design:
    """Prototype 1 cut down to two bubbles: the same physics in a tenth of the time."""
    return with_overrides(load_design("prototype_1"), [*TWO_BUBBLES, *settings])


@pytest.fixture(scope="module")
def evaluation() -> Evaluation:
    return evaluate(short())


def test_pressure_bends_towards_the_tendon(evaluation: Evaluation) -> None:
    finest = evaluation.computation.finest
    tip = finest.problem.mesh.surface_nodes("tip")
    assert evaluation.converged
    assert evaluation.bending_angle_deg > 30
    assert finest.displacement[tip, 2].mean() < 0


@pytest.mark.thorough
def test_half_the_bubbles_bend_in_proportion(evaluation: Evaluation) -> None:
    """Bubbles deform alike: one bubble bends about half as far as two, but for the ends."""
    single = evaluate(short("number_of_bubbles=1", "length=11.5"))
    assert single.bending_angle_deg == pytest.approx(evaluation.bending_angle_deg / 2, rel=0.15)


@pytest.mark.thorough
def test_a_finer_mesh_agrees_within_the_estimated_error(evaluation: Evaluation) -> None:
    finer = evaluation_of(refined(evaluation.computation))
    assert len(finer.meshes) == len(finer.computation.solutions) == 3
    for value, other, percent in (
        (
            evaluation.bending_angle_deg,
            finer.bending_angle_deg,
            evaluation.error_estimate.bending_angle_percent,
        ),
        (
            evaluation.max_von_mises_mpa,
            finer.max_von_mises_mpa,
            evaluation.error_estimate.max_von_mises_percent,
        ),
    ):
        assert percent is not None
        assert abs(value - other) <= percent / 100 * value


def test_grid_sequencing_saves_the_load_path_on_the_finer_mesh(evaluation: Evaluation) -> None:
    coarse, fine = evaluation.computation.solutions
    assert fine.load_steps == 1
    assert fine.newton_iterations < coarse.newton_iterations
    assert len(fine.problem.mesh.tets) > len(coarse.problem.mesh.tets)


@pytest.mark.slow
def test_cavity_grows_under_pressure_and_bubbles_fan_out(evaluation: Evaluation) -> None:
    unloaded = evaluate(short("load.pressure=0.001"))
    assert evaluation.cavity_volume_mm3 > 1.2 * unloaded.cavity_volume_mm3
    assert not evaluation.contact.detected
    assert not evaluation.contact.overlaps_itself
    gap = evaluation.contact.min_gap_mm
    assert gap is not None
    assert 0 < gap < evaluation.design.bellows.bubble_distance


def test_more_pressure_bends_further_and_stresses_more(evaluation: Evaluation) -> None:
    angles = [point.rotation for point in evaluation.computation.solutions[0].path]
    stresses = [point.max_von_mises for point in evaluation.computation.solutions[0].path]
    assert np.all(np.diff(angles) > 0)
    assert np.all(np.diff(stresses) > 0)


def test_peak_stress_lies_on_the_cavity_under_a_chamber(evaluation: Evaluation) -> None:
    """The paper: the highest stress is always in the bottom wall under a chamber."""
    x, _, z = evaluation.computation.peaks[-1].position
    bellows = evaluation.design.bellows
    from_middle = min(abs(x - middle) for middle in bellows.bubble_middles)
    assert from_middle <= bellows.chamber_length / 2 + 1e-6
    assert z < bellows.tendon_height


def test_json_contract_is_kept(evaluation: Evaluation) -> None:
    content = json.loads(json.dumps(evaluation.to_dict(), allow_nan=False))
    assert {
        "design",
        "digest",
        "model",
        "model_reason",
        "pressure_mpa",
        "converged",
        "bending_angle_deg",
        "max_von_mises_mpa",
        "max_von_mises_position_mm",
        "cavity_volume_mm3",
        "strain",
        "warnings",
        "contact",
        "error_estimate",
        "mesh",
        "solver",
        "seconds",
        "meshes",
        "path",
        "curve",
        "versions",
    } <= set(content)
    assert set(content["contact"]) >= {"detected", "min_gap_mm"}
    assert set(content["mesh"]) == {"elements", "nodes", "unknowns"}
    assert set(content["solver"]) == {
        "load_steps",
        "newton_iterations",
        "factorizations",
        "linear_solver",
    }
    assert set(content["seconds"]) == {"geometry", "mesh", "solve", "total"}
    assert content["path"][0]["bending_angle_deg"] == 0
    assert content["path"][-1]["pressure_mpa"] == pytest.approx(0.1)
    assert content["mesh"]["elements"] == len(evaluation.computation.finest.problem.mesh.tets)


def test_strains_are_those_of_the_finest_mesh_and_warn_outside_of_the_tests(
    evaluation: Evaluation,
) -> None:
    strain = evaluation.strain
    assert -0.5 < strain.lowest < -0.05 and 0.05 < strain.highest < 1.0
    assert strain.within is None and strain.instability is None and evaluation.warnings == ()
    material = evaluation.design.material.model_copy(update={"valid_strain": (-0.02, 0.02)})
    design = evaluation.design.model_copy(update={"material": material})
    narrow = evaluation_of(replace(evaluation.computation, design=design))
    assert narrow.strain.within is False
    assert narrow.to_dict()["warnings"] == list(narrow.warnings) != []


def test_vtu_holds_the_finest_solution(evaluation: Evaluation, tmp_path) -> None:
    target = tmp_path / "bent.vtu"
    write_vtu(evaluation, target)
    read = meshio.read(target)
    moved = evaluation.computation.finest.displacement
    assert np.allclose(read.point_data["displacement_mm"], moved)
    assert read.point_data["von_mises_mpa"].max() == pytest.approx(evaluation.max_von_mises_mpa)
    assert list(tmp_path.iterdir()) == [target]


@pytest.mark.slow
def test_ends_beside_the_cell_are_those_after_it(monkeypatch: pytest.MonkeyPatch) -> None:
    design = load_design("prototype_1")
    ample = Budget(seconds=3600.0)  # what ends by the clock depends on the machine
    beside = evaluate(design, budget=ample)
    monkeypatch.setattr("solver.linear.threads.may_run_side_by_side", lambda: False)
    after = evaluate(design, budget=ample)
    assert replace(beside, seconds=after.seconds, computation=after.computation) == after
    assert np.array_equal(
        beside.computation.finest.displacement, after.computation.finest.displacement
    )


@pytest.mark.slow
def test_accuracy_refines_until_the_estimate_keeps_it_or_the_memory_is_used_up() -> None:
    slim = ("bubble_width=12", "bubble_height=10", "tendon_width=8", "load.pressure=0.01")
    single = short("number_of_bubbles=1", "length=11.5", *slim)
    little = Budget(memory=0.86)
    rough = evaluate(single, accuracy_percent=100, budget=little)
    fine = evaluate(single, accuracy_percent=0.01, budget=little)  # below what is ever claimed
    assert len(rough.meshes) == 2 < len(fine.meshes)
    assert expected_memory(fine.mesh.elements) < 1.1 * little.memory * 2**30
    further = next_plan(fine.computation)
    assert affordable_plan(fine.computation) is None and not further.fits(little)
    assert further.elements > fine.mesh.elements


@pytest.mark.thorough
def test_refinement_goes_on_while_the_state_leaves_a_question_open(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(wall_contact, "contact_of", lambda *_: NO_CONTACT)
    single = short("number_of_bubbles=1", "length=11.5", "load.pressure=0.01")
    states: list[LoadedState] = []
    finer = evaluate(
        single,
        open_question=lambda state: states.append(state) or ("near" if len(states) < 2 else ""),
    )
    assert len(finer.meshes) == HALF.levels + 1
    first, last = states
    assert first.max_von_mises_mpa == finer.meshes[-2].reading.max_von_mises_mpa
    assert last is finer


@pytest.mark.parametrize(
    ("estimates", "promising"),
    [
        ([20.0], True),
        ([20.0, 12.0, 7.0], True),
        ([5.0, 6.0], True),  # one mesh may be worse by chance
        ([5.0, 6.0, 5.9], False),
        ([5.0, 4.9, 4.8], False),
        ([16.0, 8.0, 4.0, 2.0, 1.0], False),  # each mesh takes twice as long as the last
        ([None], False),
    ],
)
def test_refinement_ends_where_it_does_not_help(
    estimates: list[float | None], promising: bool
) -> None:
    assert _promising(estimates) is promising


def test_no_mesh_is_begun_that_would_exceed_the_time_left(evaluation: Evaluation) -> None:
    spent = evaluation.computation.seconds.total
    computation = replace(evaluation.computation, budget=Budget(seconds=spent + 1e-3))
    assert affordable_plan(computation) is None
    assert affordable_plan(evaluation.computation) is not None


def test_a_finer_mesh_that_takes_too_long_leaves_the_coarser_result(
    evaluation: Evaluation, monkeypatch: pytest.MonkeyPatch
) -> None:
    before = evaluation.computation
    ended = replace(before.finest, converged=False, stopped_by="budget", message="no time.")
    monkeypatch.setattr(mesh_sequence, "_solved_on", lambda *_: ended)
    after = refined(before)
    assert after.converged and after.solutions == before.solutions
    assert after.seconds.total > before.seconds.total
    alone = refined(replace(before, solved=()))  # a first mesh has nothing to fall back on
    assert not alone.converged and alone.message == "no time."


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ({"model": "quarter"}, "model = 'quarter' must be one of"),
        ({"accuracy_percent": 0.0}, "accuracy = 0 % must lie between"),
        ({"accuracy_percent": float("nan")}, "accuracy = nan % must lie between"),
    ],
)
def test_unusable_arguments_are_refused_before_any_work(arguments, sentence) -> None:
    with pytest.raises(ValueError, match=sentence):
        evaluate(short(), **arguments)


def test_a_pressure_beyond_the_bounds_is_refused() -> None:
    with pytest.raises(DesignError, match=r"load\.pressure"):
        short("load.pressure=100")


@pytest.mark.thorough
def test_an_unreachable_pressure_ends_with_the_last_good_state() -> None:
    """A wall of silicone-soft rubber bursts: the solver says how far it came, never more."""
    single = ("number_of_bubbles=1", "length=11.5")
    soft = short(*single, "material.mu=[0.2]", "material.alpha=[2.0]", "load.pressure=0.1")
    result = evaluate(soft)
    assert not result.converged
    assert "stopped at" in result.message
    assert 0 < result.pressure_mpa < 0.1
    assert result.error_estimate.bending_angle_percent is None
    assert np.isfinite(result.computation.finest.displacement).all()


@pytest.mark.thorough
def test_a_wide_thin_bubble_is_loaded_along_stable_states_only() -> None:
    """Its walls have unstable equilibria too, with three times the stress: Newton finds them."""
    wide = with_overrides(
        load_design("prototype_1"),
        [
            "bubble_width=24.65", "bubble_height=24.28", "bubble_thickness=1.23",
            "tendon_width=15.61", "tendon_height=5.92", "tendon_thickness=2.24",
            "chamber_length=2.94", "bubble_distance=2.17", "inner_fillet=0.61",
            "outer_fillet=1.44", "length=60", "load.pressure=0.05",
        ],
    )  # fmt: skip
    coarse = UNIT_CELL.problem(wide, first_plan(UNIT_CELL.solid(wide), wide).made())
    solution = solve(coarse, wide.load.pressure)
    assert solution.converged, solution.message
    assert solution.negative_pivots in (None, len(coarse.mesh.vertices))
    angles, stresses = (
        [getattr(p, of) for p in solution.path] for of in ("rotation", "max_von_mises")
    )
    assert np.all(np.diff(angles) > 0) and np.all(np.diff(stresses) > 0)
    assert stresses[-1] < 3


AGREEMENT_PERCENT = {
    "Prototype 1": 5,
    "bubble width 16": 5,
    "bubble thickness 1.2": 5,
    "tendon width 6": 8,
    "inner fillet 1": 5,
    # stands apart in every reading of the geometry: see docs/paper.md
    "bubble height 16": 12,
}


@pytest.mark.slow
@pytest.mark.parametrize("label", AGREEMENT_PERCENT)
def test_bending_angle_agrees_with_the_paper(label: str) -> None:
    case = next(row for row in TABLE_4 if row.label == label)
    angle = evaluate(case.build()).bending_angle_deg
    assert angle == pytest.approx(case.bending_angle_deg, rel=AGREEMENT_PERCENT[label] / 100)
