"""A finger with a pad at its tip: the pad goes along with the tip and hardly changes the angle."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from bellows_design.analysis.computation import Computation
from bellows_design.analysis.error_estimate import ENDS_ERROR, REACH_ERROR
from bellows_design.analysis.evaluate import evaluate
from bellows_design.analysis.mesh_sequence import started
from bellows_design.analysis.models import FULL, HALF, shortened
from bellows_design.design import Design, load_design, with_overrides

PAD = ("fingertip.length=8", "fingertip.width=14", "fingertip.thickness=3")
FINGER = with_overrides(load_design("finger"), ["load.pressure=0.05"])
PADDED = with_overrides(FINGER, PAD)


@cache
def half(design: Design) -> Computation:
    """The short actuator that stands for the ends, on its coarsest mesh."""
    return started(shortened(design), HALF, "")


@pytest.mark.thorough
def test_the_short_actuator_and_the_axis_of_all_models_keep_the_fingertip() -> None:
    short = shortened(PADDED)
    assert short.fingertip == PADDED.fingertip
    mesh = half(PADDED).finest.problem.mesh
    assert mesh.nodes[:, 0].max() == pytest.approx(short.finger_length)
    for model in (HALF, FULL):
        axis = model.problem(short, mesh).axis
        assert axis is not None and axis.stations[-1] == short.finger_length


def test_the_rotation_is_that_of_the_fingertips_end() -> None:
    solution = half(PADDED).finest
    nodes = np.unique(solution.problem.mesh.surfaces["tip"])
    moved = (solution.problem.mesh.nodes + solution.displacement)[nodes]
    _, _, axes = np.linalg.svd(moved - moved.mean(axis=0))
    angle = np.degrees(np.arctan2(abs(axes[2, 2]), abs(axes[2, 0])))
    assert solution.path[-1].rotation == pytest.approx(angle, rel=0.01)


def test_a_fingertip_moves_like_a_rigid_body() -> None:
    """It carries no load: what is left after the best rigid motion is small against its length."""
    solution = half(PADDED).finest
    mesh = solution.problem.mesh
    pad = mesh.nodes[:, 0] > shortened(PADDED).bellows.length + 1
    before, after = (x - x.mean(axis=0) for x in (mesh.nodes[pad], moved_nodes(solution)[pad]))
    u, _, v = np.linalg.svd(before.T @ after)
    turned = before @ u @ np.diag([1, 1, np.linalg.det(u @ v)]) @ v
    assert np.abs(after - turned).max() < 0.005 * 8
    assert np.abs(after - before).max() > 100 * np.abs(after - turned).max()


def moved_nodes(solution: object) -> np.ndarray:
    return np.asarray(solution.problem.mesh.nodes + solution.displacement)  # type: ignore[attr-defined]


def test_a_fingertip_changes_the_angle_by_less_than_the_ends_are_uncertain() -> None:
    bare, padded = (half(design).finest.path[-1].rotation for design in (FINGER, PADDED))
    uncertain = REACH_ERROR * bare
    assert 0 < abs(padded - bare) < uncertain


@pytest.mark.slow
def test_the_whole_finger_with_a_fingertip_bends_as_far_within_the_estimate_of_the_ends() -> None:
    """By 0.9 of 413 degrees at 0.1 MPa, with a pad of 12 x 16 x 3 mm; the ends may miss by 4."""
    pad = ("fingertip.length=12", "fingertip.width=16", "fingertip.thickness=3", "fingertip.ribs=5")
    bare, padded = (
        evaluate(with_overrides(load_design("finger"), changes)) for changes in ((), pad)
    )
    cell = abs(2 * bare.computation.finest.path[-1].rotation)
    added = bare.bending_angle_deg - bare.design.bellows.bubble_count * cell
    uncertain = ENDS_ERROR * abs(added) + REACH_ERROR * cell
    assert bare.converged and padded.converged
    assert abs(padded.bending_angle_deg - bare.bending_angle_deg) < uncertain
    assert padded.max_von_mises_mpa == pytest.approx(bare.max_von_mises_mpa, rel=1e-3)


@pytest.mark.slow
@pytest.mark.parametrize("model", ["half", "full"])
def test_an_actuator_with_a_fingertip_is_evaluated_as_a_whole(model: str) -> None:
    found = evaluate(shortened(PADDED), model)
    assert found.converged and found.error_estimate.bending_angle_percent is not None
    coarse = half(PADDED).finest.path[-1].rotation
    assert found.bending_angle_deg == pytest.approx(coarse, rel=0.05)
    x, _, _ = found.max_von_mises_position_mm
    assert x < PADDED.bellows.length
