"""What paths may lose at their ends: beside each other or not."""

from __future__ import annotations

import numpy as np
import pytest
from bead_boxes import WIDTH, Box, beads_of, joined_beads, with_seam

from printers.leak_test.seams import LOSSES, seam_tolerance, shortened

LINE = 0.4


def test_a_path_loses_the_same_at_both_ends() -> None:
    points = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 0.3], [2.0, 0.3]])
    one, other = beads_of(points, 0.2, 0.2, 0), beads_of(points[:2], 0.2, 0.2, 1)
    cut = shortened(joined_beads([one, other]), 0.2)
    assert np.allclose(cut.start, [[0.2, 0], [1, 0], [1, 0.3], [0.2, 0]])
    assert np.allclose(cut.end, [[1, 0], [1, 0.3], [1.8, 0.3], [0.8, 0]])


def test_beads_shorter_than_the_loss_go_and_the_next_ones_are_cut() -> None:
    points = np.array([[0.0, 0.0], [0.1, 0.0], [1.0, 0.0]])
    cut = shortened(beads_of(points, 0.2, 0.2, 0), 0.3)
    assert np.allclose(np.concatenate([cut.start, cut.end]), [[0.3, 0.0], [0.7, 0.0]])
    assert len(shortened(beads_of(points, 0.2, 0.2, 0), 0.6)) == 0


def test_seams_beside_each_other_open_when_the_loss_is_half_a_bead() -> None:
    """Ends that lost d each leave 2 d between them, closed by their round ends up to d = w / 2."""
    box = Box(wall=with_seam(lambda number: 0.0))
    found = seam_tolerance(box.beads, [box.opening], LINE)
    below = max(loss for loss in LOSSES if loss < WIDTH / 2)
    assert found.holds == below
    assert found.leaks_at == min(loss for loss in LOSSES if loss > WIDTH / 2)
    assert dict(found.tried)[0.3] == pytest.approx(0.6 / WIDTH, abs=0.05)


def test_seams_apart_from_each_other_hold_better() -> None:
    beside, apart = (
        Box(wall=with_seam(lambda number, turn=turn: turn * number)) for turn in (0.0, 90.0)
    )
    together, alone = (
        dict(seam_tolerance(box.beads, [box.opening], LINE).tried)[0.3] for box in (beside, apart)
    )
    assert alone < together - 0.3
