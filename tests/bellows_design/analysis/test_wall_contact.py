"""Contact is found where walls are pushed together, and nowhere else; cells hold them apart."""

from __future__ import annotations

from dataclasses import asdict, replace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from bellows_design.analysis import mesh_sequence
from bellows_design.analysis.cell_chain import chain
from bellows_design.analysis.evaluate import evaluate, loaded_state
from bellows_design.analysis.mesh_plan import first_plan
from bellows_design.analysis.mesh_sequence import started
from bellows_design.analysis.models import FREE_CELL, HALF, UNIT_CELL, shortened
from bellows_design.analysis.wall_contact import (
    FREE_ENDS,
    INSIDE,
    ITSELF,
    NEIGHBOURS,
    OUTER,
    OVERLAP,
    UNMODELLED,
    OuterGaps,
    WallContact,
    _outer_gaps,
    _overlaps_itself,
    contact_in_cell,
    contact_of,
    touch_guard,
)
from bellows_design.design.bellows_parameters import BellowsParameters
from bellows_design.design.design import Design
from bellows_design.design.overrides import with_overrides
from bellows_design.design.shipped import load_design
from bellows_design.geometry.bubble_walls import BACK, FRONT, facing_walls, wall_name
from solver import Problem, Solution, SolverOptions, contact_forces, solve
from solver.assembly.state import State

Array = NDArray[np.float64]
BELLOWS = BellowsParameters.model_validate(
    {**load_design("prototype_1").bellows.model_dump(), "length": 26, "number_of_bubbles": 3}
)
GAP = BELLOWS.bubble_distance
LONG = load_design("prototype_1")


@pytest.fixture(scope="module")
def problem() -> Problem:
    design = Design(name="short", bellows=BELLOWS)
    return HALF.problem(design, first_plan(HALF.solid(design), design).made())


def contact(problem: Problem, displacement: Array) -> WallContact:
    return contact_of(BELLOWS, problem.mesh, displacement)


def compressed(problem: Problem, shift: float) -> Array:
    """Every bubble moved rigidly towards the root, by ``shift`` more than the one before it."""
    x = problem.mesh.nodes[:, 0]
    start = BELLOWS.bubble_middles[0] + BELLOWS.bubble_length / 2
    period = (x - start) / BELLOWS.pitch
    ramp = np.clip((period - np.floor(period)) * BELLOWS.pitch / GAP, 0, 1)
    steps = np.clip(np.floor(period) + ramp, 0, BELLOWS.bubble_count - 1)
    return np.column_stack([-shift * steps, np.zeros((len(x), 2))])


def rolled(problem: Problem, turns: float) -> Array:
    """The actuator bent to a circle about y by so many turns, bubbles outside."""
    x, y, z = problem.mesh.nodes.T
    radius = BELLOWS.length / (2 * np.pi * turns)
    angle = x / radius
    bent = np.column_stack([(radius + z) * np.sin(angle), y, (radius + z) * np.cos(angle) - radius])
    return bent - problem.mesh.nodes


def test_at_rest_the_narrowest_air_is_the_bubble_distance(problem: Problem) -> None:
    found = contact(problem, np.zeros_like(problem.mesh.nodes))
    assert not found.detected and not found.overlaps_itself
    assert found.min_gap_mm == pytest.approx(GAP, abs=1e-6)


@pytest.mark.parametrize("shift", [-1.0, 0.4, 1.49])
def test_bubbles_moved_together_are_nearer_by_that_much(problem: Problem, shift: float) -> None:
    found = contact(problem, compressed(problem, shift))
    assert not found.detected and not found.overlaps_itself
    assert found.min_gap_mm == pytest.approx(GAP - shift, abs=1e-6)


@pytest.mark.parametrize("shift", [1.51, 1.8, 2.5])
def test_bubbles_moved_into_each_other_touch(problem: Problem, shift: float) -> None:
    found = contact(problem, compressed(problem, shift))
    assert found.detected
    assert found.min_gap_mm is not None and found.min_gap_mm < 0


def test_a_bend_away_from_the_bubbles_opens_their_gaps(problem: Problem) -> None:
    found = contact(problem, rolled(problem, 0.5))
    assert not found.detected and not found.overlaps_itself
    assert found.min_gap_mm is not None and found.min_gap_mm > GAP


@pytest.mark.parametrize("turns", [0.6, 0.7, 0.8, 0.9])  # 0.8: root rays meet the tip's face
def test_a_tip_that_faces_the_root_across_the_air_overlaps_nothing(
    problem: Problem, turns: float
) -> None:
    found = contact(problem, rolled(problem, turns))
    assert not found.overlaps_itself and not found.detected


def test_past_a_full_turn_distant_parts_overlap_and_neighbours_do_not(problem: Problem) -> None:
    found = contact(problem, rolled(problem, 1.2))
    assert found.overlaps_itself
    assert not found.detected


@pytest.fixture(scope="module")
def straight_cell() -> Solution:
    problem = UNIT_CELL.problem(LONG, first_plan(UNIT_CELL.solid(LONG), LONG).made())
    return solve(problem)


def bent(cell: Solution, turns: float) -> Solution:
    """A cell bent to an arc about y, bubbles outside, of which the chain makes so many turns."""
    tilt, end = np.pi * turns / LONG.bellows.bubble_count, LONG.bellows.pitch / 2
    x, y, z = cell.problem.mesh.nodes.T
    radius = end / tilt
    moved = np.column_stack(
        [
            (radius + z) * np.sin(x / radius),
            y,
            (radius + z) * np.cos(x / radius) - radius,
        ]
    )
    plane = (tilt, radius * np.tan(tilt) - end)
    return replace(cell, displacement=moved - cell.problem.mesh.nodes, plane=plane)


@pytest.mark.parametrize("turns", [-0.3, 0.3, 0.7])
def test_a_chain_that_makes_no_full_turn_is_not_searched_for_overlaps_and_has_none(
    straight_cell: Solution, turns: float
) -> None:
    cell = bent(straight_cell, turns)
    assert not _overlaps_itself(LONG.bellows, cell)
    assert not _outer_gaps(LONG.bellows, *chain(LONG.bellows, cell)).overlap


def test_a_chain_of_more_than_a_full_turn_overlaps(straight_cell: Solution) -> None:
    assert _overlaps_itself(LONG.bellows, bent(straight_cell, 1.2))


def test_walls_that_touch_in_a_half_model_are_told_not_modelled(problem: Problem) -> None:
    apart, through = (
        contact(problem, compressed(problem, 0)),
        contact(problem, compressed(problem, 2)),
    )
    assert (apart.where, apart.modelled, apart.note) == ((), False, "")
    assert NEIGHBOURS in through.where and not through.modelled and through.note == UNMODELLED
    assert contact(problem, rolled(problem, 1.2)).where == (ITSELF,)


def flattened(problem: Problem, share: float) -> Array:
    """Every bubble squeezed along x to so much of its length, the tendon between them stretched."""
    x = problem.mesh.nodes[:, 0]
    middles = np.array(BELLOWS.bubble_middles)
    nearest = middles[abs(x[:, None] - middles).argmin(axis=1)]
    half = BELLOWS.chamber_length / 2
    moved = (share - 1) * np.clip(x - nearest, -half, half)
    return np.column_stack([moved, np.zeros((len(x), 2))])


def test_the_inner_gap_narrows_with_the_chamber(problem: Problem) -> None:
    """Up to the chamber's length; less in its fillets."""
    shares = np.array([1.0, 0.5, 0.2])
    found = [contact(problem, flattened(problem, share)) for share in shares]
    gaps = np.array([each.inner_gap_mm for each in found])
    assert not any(each.detected for each in found)
    assert (gaps > 0).all() and (np.diff(gaps) < 0).all()
    assert (gaps <= shares * BELLOWS.chamber_length + 1e-6).all()
    assert gaps[0] > 0.85 * BELLOWS.chamber_length


def test_inner_walls_that_pass_through_each_other_are_found(problem: Problem) -> None:
    found = contact(problem, flattened(problem, -0.3))
    assert found.inner_gap_mm is not None and found.inner_gap_mm < -0.2
    assert found.detected and INSIDE in found.where


def test_inner_walls_that_meet_across_the_middle_are_found(problem: Problem) -> None:
    """Their mirror image is not in the mesh of a half."""
    x, y, _ = problem.mesh.nodes.T
    pushed = np.column_stack([0 * x, -0.99 * y - 0.1, 0 * x])
    found = contact(problem, pushed)
    wall = -0.1 + 0.01 * BELLOWS.chamber_size[1] / 2
    assert found.inner_gap_mm is not None and found.inner_gap_mm <= 2 * wall + 1e-6
    assert INSIDE in found.where


def test_an_undeformed_cell_reports_the_gaps_it_was_drawn_with() -> None:
    design = load_design("prototype_1")
    cell = solved(design, 0.0)
    found = contact_in_cell(design.bellows, cell)
    assert found.min_gap_mm == pytest.approx(design.bellows.bubble_distance, abs=1e-6)
    length = design.bellows.chamber_length
    assert found.inner_gap_mm is not None and 0.85 * length < found.inner_gap_mm <= length
    assert not found.detected and found.modelled and found.where == () and found.note == ""


def solved(design: Design, pressure: float, contacts: bool = True) -> Solution:
    """The unit cell on its coarsest mesh, with its walls' contact or without."""
    problem = UNIT_CELL.problem(design, first_plan(UNIT_CELL.solid(design), design).made())
    kept = problem if contacts else replace(problem, contacts=())
    return solve(kept, pressure, SolverOptions(tolerance=1e-4))


def test_a_prototype_under_its_pressure_touches_nothing_and_feels_no_contact() -> None:
    design = load_design("prototype_1")
    having, without = (solved(design, 0.1, contacts) for contacts in (True, False))
    assert np.array_equal(having.displacement, without.displacement)
    assert not contact_in_cell(design.bellows, having).detected


CROWDED = [
    "bubble_distance=0.4", "bubble_thickness=1", "bubble_width=30", "bubble_height=20",
    "tendon_width=30", "tendon_height=10", "tendon_thickness=3", "outer_fillet=1", "length=60",
    "number_of_bubbles=4",
]  # fmt: skip
"""Thin wide bubbles close together on a stiff tendon: they bulge faster than they fan out."""


@pytest.mark.slow
def test_bubbles_that_bulge_into_each_other_push_the_actuator_further_round() -> None:
    design = with_overrides(load_design("prototype_1"), CROWDED)
    held, bare = (solved(design, 0.03, contacts) for contacts in (True, False))
    assert held.converged and bare.converged
    through = contact_of(design.bellows, *chain(design.bellows, bare))
    assert through.min_gap_mm is not None and through.min_gap_mm < -0.5
    found = contact_in_cell(design.bellows, held)
    assert found.detected and found.modelled and found.where == (NEIGHBOURS,)
    assert found.min_gap_mm is not None
    assert -0.02 * design.bellows.bubble_thickness < found.min_gap_mm < 0
    assert held.path[-1].rotation > 1.1 * bare.path[-1].rotation


CLOSE = [
    "bubble_distance=0.5", "bubble_thickness=1.2", "bubble_width=20", "bubble_height=16",
    "tendon_width=20", "tendon_height=8", "tendon_thickness=2.5", "outer_fillet=1", "length=40",
    "number_of_bubbles=3", "chamber_length=2",
]  # fmt: skip
"""Three wide bubbles that touch at 0.1 MPa."""


@pytest.mark.slow
def test_a_half_of_close_bubbles_keeps_them_apart() -> None:
    design = with_overrides(load_design("prototype_1"), CLOSE)
    problem = HALF.problem(design, first_plan(HALF.solid(design), design).made())
    bare = replace(problem, contacts=())
    held, free = (solve(each, 0.1, SolverOptions(tolerance=1e-4)) for each in (problem, bare))
    through = contact_of(design.bellows, problem.mesh, free.displacement, bare)
    assert through.void and through.note == UNMODELLED and through.min_gap_mm is not None
    assert through.min_gap_mm < -0.05
    found = contact_of(design.bellows, problem.mesh, held.displacement, problem)
    assert held.converged and found.modelled and not found.void and found.note == ""
    assert found.where == (NEIGHBOURS,) and found.min_gap_mm is not None
    assert -0.02 * design.bellows.bubble_thickness < found.min_gap_mm < 0
    pushed = [each.force[0] for each in contact_forces(held)[1:]]  # fronts, towards the root
    assert min(pushed) < 0 and max(pushed) <= 0


def test_walls_of_bubbles_are_their_outsides_and_share_no_node(problem: Problem) -> None:
    mesh, count = problem.mesh, BELLOWS.bubble_count
    names = [wall_name(bubble, side) for bubble in range(1, count + 1) for side in (BACK, FRONT)]
    walls = [mesh.surface_nodes(name) for name in names]
    for name, nodes in zip(names, walls, strict=True):
        middle = BELLOWS.bubble_middles[int(name.split("_")[1]) - 1]
        offset = mesh.nodes[nodes, 0] - middle
        assert abs(offset).max() == pytest.approx(BELLOWS.bubble_length / 2, abs=1e-6)
    for (front, back), gap in zip(facing_walls(BELLOWS), range(count - 1), strict=True):
        one, other = mesh.surface_nodes(front), mesh.surface_nodes(back)
        assert not len(np.intersect1d(one, other))
        apart = mesh.nodes[other, 0].min() - mesh.nodes[one, 0].max()
        assert apart == pytest.approx(GAP, abs=1e-6), gap


def sheared(problem: Problem, shift: float) -> Array:
    """Every bubble sheared rootwards above the tendon: the top by ``shift`` more than the last."""
    x, _, z = problem.mesh.nodes.T
    height = BELLOWS.tendon_height
    share = np.clip((z - height) / (z.max() - height), 0, 1)
    number = np.rint((x - BELLOWS.bubble_middles[0]) / BELLOWS.pitch)
    steps = number.clip(0, BELLOWS.bubble_count - 1)
    return np.column_stack([-shift * steps * share, 0 * x, 0 * x])


TOUCHING = {"hardly": (1.68, True), "deep for contact": (1.7, False), "through it": (2.0, False)}


@pytest.mark.parametrize("how", TOUCHING)
def test_neighbours_are_kept_apart_as_long_as_contact_lets_them_in_by_little(
    problem: Problem, how: str
) -> None:
    shift, kept = TOUCHING[how]
    found = contact_of(BELLOWS, problem.mesh, sheared(problem, shift), problem)
    assert found.where == (NEIGHBOURS,) and found.min_gap_mm is not None
    assert found.min_gap_mm < 0
    assert found.modelled == kept and found.void != kept
    refused = touch_guard(BELLOWS, problem)(
        replace(State.zero(problem), displacement=sheared(problem, shift))
    )
    assert bool(refused) != kept


def test_neighbours_too_deep_for_contact_to_see_are_not_kept_apart() -> None:
    """Beyond its reach a contact has no gap; facets tell."""
    for facets, kept in ((-0.1, (NEIGHBOURS,)), (-0.2, ())):
        found = OuterGaps({NEIGHBOURS: facets, OUTER: None}, False).keeping(np.inf, 0.0075)
        assert found.kept == kept and found.narrowest == facets


def test_neighbours_apart_are_modelled(problem: Problem) -> None:
    found = contact_of(BELLOWS, problem.mesh, compressed(problem, 0), problem)
    assert (found.where, found.modelled, found.note) == ((), True, "")


@pytest.mark.slow
@pytest.mark.parametrize("name", ["prototype_1", "finger"])
def test_a_vacuum_closes_gaps_and_chambers_and_no_further(name: str) -> None:
    design = load_design(name)
    held, bare = (solved(design, -0.05, contacts) for contacts in (True, False))
    found, wall = contact_in_cell(design.bellows, held), design.bellows.bubble_thickness
    assert held.converged and found.modelled and found.note == FREE_ENDS
    assert found.where == (NEIGHBOURS, INSIDE)
    for gap in (found.min_gap_mm, found.inner_gap_mm):
        assert gap is not None and -0.02 * wall < gap < 0
    assert 0 > held.path[-1].rotation > 0.25 * bare.path[-1].rotation
    assert bare.path[-1].volume < 0.6 * held.path[-1].volume < 0.6 * held.path[0].volume


@pytest.mark.slow
def test_a_vacuum_goes_from_the_design_to_a_result() -> None:
    design = with_overrides(load_design("prototype_1"), ["load.pressure=-0.04"])
    evaluation = evaluate(design, pressures=(-0.002, -0.02, -0.04))
    assert evaluation.converged and evaluation.pressure_mpa == -0.04
    curve = evaluation.curve
    assert [reading.pressure_mpa for reading in curve] == pytest.approx([-0.002, -0.02, -0.04])
    angles, volumes = ([getattr(reading, key) for reading in curve] for key in KEYS)
    assert 0 > angles[0] > angles[1] > angles[2] > -70
    assert volumes[0] > volumes[1] > volumes[2] > 0
    content = evaluation.to_dict()
    assert content["contact"] == asdict(evaluation.contact)
    assert content["path"][0]["pressure_mpa"] == 0
    assert str(content["path"][0]["pressure_mpa"]) == "0.0"  # not -0.0


KEYS = ("bending_angle_deg", "cavity_volume_mm3")


def test_before_walls_touch_two_free_half_bubbles_turn_like_the_short_actuator() -> None:
    """What stands for the ends in a vacuum, where a short actuator would run through itself."""
    design = load_design("prototype_1")
    short = shortened(design)
    ends = HALF.problem(short, first_plan(HALF.solid(short), short).made())
    free = FREE_CELL.problem(design, first_plan(UNIT_CELL.solid(design), design).made())
    of_short, of_free = (solve(each, -0.01).path[-1].rotation for each in (ends, free))
    assert 2 * of_free == pytest.approx(of_short, rel=0.12)


ONE_BUBBLE = [
    "number_of_bubbles=1", "length=13", "bubble_thickness=1.2", "tendon_thickness=1.2",
    "outer_fillet=1.2", "inner_fillet=0.4",
]  # fmt: skip


@pytest.mark.slow
def test_a_half_under_vacuum_ends_at_the_first_touch_of_its_walls() -> None:
    """A single bubble has no neighbour; beyond the touch its walls would pass each other."""
    design = with_overrides(load_design("prototype_1"), [*ONE_BUBBLE, "load.pressure=-0.09"])
    computation = started(design, HALF, "")
    found = loaded_state(computation)
    touch = found.touch_pressure_mpa
    assert not found.converged and touch is not None and -0.09 < touch < 0
    assert found.message.endswith("inner walls touch, and this model does not keep them apart.")
    assert not found.contact.detected and found.contact.inner_gap_mm is not None
    assert found.contact.inner_gap_mm < 0.05 * design.bellows.chamber_length
    gentle = with_overrides(design, [f"load.pressure={0.98 * touch:.6f}"])
    assert started(gentle, HALF, "").converged
    beyond = with_overrides(design, [f"load.pressure={1.05 * touch:.6f}"])
    problem = HALF.problem(design, computation.finest.problem.mesh)
    crossed = solve(problem, beyond.load.pressure, SolverOptions(tolerance=1e-4))
    assert contact_of(design.bellows, problem.mesh, crossed.displacement).void


def test_a_single_bubble_that_leans_onto_its_tendon_touches_no_neighbour() -> None:
    design = shortened(Design(name="one", bellows=BELLOWS))
    bellows = design.bellows
    mesh = first_plan(HALF.solid(design), design).made()
    front = bellows.bubble_middles[0] + bellows.bubble_length / 2
    x, _, z = mesh.nodes.T
    raised = np.clip(z - bellows.tendon_height, 0, None)
    sheared = np.column_stack([0.3 * raised * (x > front - 1.0), 0 * x, -1.1 * raised])
    found = contact_of(bellows, mesh, sheared)
    assert NEIGHBOURS not in found.where and OUTER in found.where


def test_distant_parts_that_overlap_are_a_warning_and_void_nothing(problem: Problem) -> None:
    found = contact(problem, rolled(problem, 1.2))
    assert not found.void and found.warnings == (f"{OVERLAP}.",)
    through = contact(problem, compressed(problem, 2))
    assert through.void and through.warnings[0] == f"{UNMODELLED}."


@pytest.mark.slow
def test_the_ends_of_a_cell_whose_inner_walls_touch_only_there_are_half_bubbles(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """The short actuator stops at the touch; the cell without a neighbour goes on."""
    design = with_overrides(load_design("prototype_1"), ["number_of_bubbles=4", "length=40"])
    plain = started(design, UNIT_CELL, "")
    assert plain.ends is not None and plain.ends.problem.moving_plane is None
    usual = mesh_sequence._short_actuator

    def touching(*given: Any) -> mesh_sequence.Ends:
        found = usual(*given)
        return replace(found, solution=replace(found.solution, converged=False, stopped_by="guard"))

    monkeypatch.setattr(mesh_sequence, "_short_actuator", touching)
    monkeypatch.setattr(mesh_sequence, "_stopped_inside", lambda _: True)
    freed = started(design, UNIT_CELL, "")
    assert freed.converged and freed.ends is not None
    assert freed.ends.problem.moving_plane is not None
