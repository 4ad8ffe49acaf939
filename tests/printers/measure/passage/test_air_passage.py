"""The narrowest passage of a cavity's air, against channels of known width."""

from __future__ import annotations

import numpy as np
import pytest
from broken_parts import BELLOWS_PORT, blocked_channel
from manifold3d import Manifold
from small_solids import arrays, block, bore

from printers import Opening, PrintedModel, PrinterProfile
from printers.measure.part import MeasuredPart
from printers.measure.passage.air_passage import AirPassage
from printers.measure.passage.watershed import FIRST, SECOND, pass_between, passes

PORT = Opening("port", (0.0, 5.0, 5.0), (-1.0, 0.0, 0.0), 1.5)


def two_chambers(joint: Manifold) -> Manifold:
    """Chambers of 8 × 7.6 × 7.6 mm, 2 mm apart, joined by the `joint` alone."""
    body = block((20.4, 10.0, 10.0), (0, 0, 0))
    cavities = [block((8.0, 7.6, 7.6), (x, 1.2, 1.2)) for x in (1.2, 11.2)]
    return body - cavities[0] - cavities[1] - joint - bore(1.5, (-1.0, 5.0, 5.0), 3.0)


def passage(solid: Manifold, port: Opening, profile: PrinterProfile) -> AirPassage:
    found = MeasuredPart(PrintedModel(*arrays(solid), openings=(port,)), profile).passage
    assert found is not None
    return found


@pytest.mark.parametrize("width", [0.1, 0.2, 0.35, 0.5])
@pytest.mark.parametrize("offset", [0.0, 0.11])
def test_a_narrow_joint_is_measured_at_its_place(
    width: float, offset: float, prusa: PrinterProfile
) -> None:
    at = (5.0 + offset, 4.0 - offset)
    found = passage(two_chambers(bore(width / 2, (9.0, *at), 2.5)), PORT, prusa)
    assert found.width == pytest.approx(width, abs=found.uncertainty)
    assert found.uncertainty < 0.03
    assert 8.9 <= found.place[0] <= 11.5 and np.allclose(found.place[1:], at, atol=0.2)


@pytest.mark.parametrize("width", [0.8, 1.4])
def test_a_wide_joint_is_told_within_what_the_result_states(
    width: float, prusa: PrinterProfile
) -> None:
    found = passage(two_chambers(bore(width / 2, (9.0, 5.0, 4.0), 2.5)), PORT, prusa)
    assert found.width == pytest.approx(width, abs=found.uncertainty)


def test_the_wider_of_two_joints_counts(prusa: PrinterProfile) -> None:
    both = bore(0.1, (9.0, 3.0, 3.0), 2.5) + bore(0.25, (9.0, 7.0, 7.0), 2.5)
    found = passage(two_chambers(both), PORT, prusa)
    assert found.width == pytest.approx(0.5, abs=found.uncertainty)
    assert np.allclose(found.place[1:], 7.0, atol=0.2)


def test_two_joints_of_one_width_in_a_row_give_that_width(prusa: PrinterProfile) -> None:
    part = blocked_channel(0.3)
    model = PrintedModel(part.vertices, part.triangles, openings=(BELLOWS_PORT,))
    found = MeasuredPart(model, prusa).passage
    assert found is not None and found.width == pytest.approx(0.3, abs=found.uncertainty)


def hills() -> np.ndarray:
    """Three hills in a row; the saddles between them lie at 3 and 2."""
    return np.array([5.0, 6.0, 5.0, 3.0, 5.0, 7.0, 5.0, 2.0, 5.0, 6.0, 5.0])[:, None, None]


def test_the_passes_between_hills_are_their_saddles() -> None:
    found = passes(hills(), np.zeros((11, 1, 1), dtype=int), 2, 0.0)
    assert found.tolist() == [3, 7]
    assert passes(hills(), np.zeros((11, 1, 1), dtype=int), 4, 0.0).tolist() == []


def test_the_pass_between_two_marks_is_the_lowest_on_the_best_way() -> None:
    marks = np.zeros((11, 1, 1), dtype=int)
    marks[1], marks[9] = FIRST, SECOND
    assert pass_between(hills(), marks, 0.0) == 7
    assert pass_between(hills(), marks, 2.5) is None
