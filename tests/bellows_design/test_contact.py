"""Contact is found where bubbles are pushed together, and nowhere else."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from bellows_design.analysis import first_mesh
from bellows_design.contact import Contact, contact_of
from bellows_design.design import Design, load_design
from bellows_design.models import HALF
from bellows_design.parameters import BellowsParameters
from solver import Problem

Array = NDArray[np.float64]
BELLOWS = BellowsParameters.model_validate(
    {**load_design("prototype_1").bellows.model_dump(), "length": 26, "number_of_bubbles": 3}
)
GAP = BELLOWS.bubble_distance


@pytest.fixture(scope="module")
def problem() -> Problem:
    design = Design(name="short", bellows=BELLOWS)
    return HALF.problem(design, first_mesh(HALF.solid(design), design))


def contact(problem: Problem, displacement: Array) -> Contact:
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
