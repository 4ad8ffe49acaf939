"""Previews on a coarse mesh: what they take over from finer ones, and how wide their errors are."""

from __future__ import annotations

from threading import Event
from typing import Any

import pytest

from bellows_design.design.shipped import load_design
from bellows_design.evaluation import Evaluation, evaluate
from bellows_design.studio.choices.changed import changed
from bellows_design.studio.previews.coarse import coarse
from bellows_design.studio.previews.continuation import Anchors
from bellows_design.studio.previews.light import LightNeighbourhood
from bellows_design.studio.workers.reporting import Cancelled, Report

pytestmark = pytest.mark.slow

BASE = load_design("prototype_1")


def unheard(_: dict[str, Any], __: Any) -> None:
    pass


def report() -> Report:
    return Report(unheard, Event())


@pytest.fixture(scope="module")
def anchor() -> Evaluation:
    return evaluate(BASE)


@pytest.fixture(scope="module")
def light(anchor: Evaluation) -> LightNeighbourhood:
    return LightNeighbourhood(anchor)


def test_at_the_evaluated_design_the_preview_is_the_evaluation(
    light: LightNeighbourhood, anchor: Evaluation
) -> None:
    found = light.found(BASE, report())
    assert found.bending_angle_deg == pytest.approx(anchor.bending_angle_deg, rel=1e-4)
    assert found.max_von_mises_mpa == pytest.approx(anchor.max_von_mises_mpa, rel=1e-3)
    assert found.cavity_volume_mm3 == pytest.approx(anchor.cavity_volume_mm3, rel=1e-4)
    assert found.error_estimate.bending_angle_percent == pytest.approx(
        anchor.error_estimate.bending_angle_percent,
        rel=0.05,  # in percent of the coarse mesh's angle, which is a little smaller
    )


def test_errors_grow_with_the_distance(light: LightNeighbourhood) -> None:
    found = [
        light.found(changed(BASE, {"bubble_width": width}), report()).error_estimate
        for width in (20.0, 20.4, 22.0)
    ]
    angles = [each.bending_angle_percent for each in found]
    stresses = [each.max_von_mises_percent for each in found]
    assert angles == sorted(angles) and stresses == sorted(stresses)
    assert angles[2] > angles[0] + 0.2 and stresses[2] > stresses[0] + 5


def test_the_deformed_shape_has_the_bubbles_of_the_design(light: LightNeighbourhood) -> None:
    for length in (50.0, 64.0):
        design = changed(BASE, {"length": length})
        frames = light.surface(light.found(design, report()))
        assert frames.positions[0, :, 0].max() == pytest.approx(length, abs=0.1)
        assert frames.positions.shape[0] == 2 and frames.von_mises.max() > 1


def test_a_stale_preview_ends_within_its_solve_and_the_next_one_is_right(
    light: LightNeighbourhood,
) -> None:
    stale = Event()

    def becomes_stale(event: dict[str, Any], _: Any) -> None:
        if event["fraction"] is not None:
            stale.set()

    design = changed(BASE, {"bubble_width": 19.3})
    with pytest.raises(Cancelled):
        light.found(design, Report(becomes_stale, stale))
    again = light.found(design, report())
    assert again.converged
    assert again.bending_angle_deg < light.found(BASE, report()).bending_angle_deg


def test_other_faces_are_a_start_themselves_until_they_are_evaluated(anchor: Evaluation) -> None:
    anchors, full = Anchors(), changed(BASE, {"inner_fillet": 1.0})
    anchors.add(anchor, report())
    assert anchors.continued(full, report()) is None
    first = coarse(anchors, full, report())
    assert first.state.error_estimate.bending_angle_percent is not None
    assert first.state.error_estimate.max_von_mises_percent >= 35  # another mesh at the fillets
    second = anchors.continued(changed(full, {"bubble_width": 20.4}), report())
    assert second is not None and "a coarse mesh" in second.how
    again = anchors.continued(full, report())
    assert again is not None
    assert again.state.bending_angle_deg == pytest.approx(first.state.bending_angle_deg, rel=0.01)


def test_the_first_answer_of_all_states_no_error() -> None:
    found = coarse(Anchors(), BASE, report())
    assert found.state.error_estimate.bending_angle_percent is None
    assert found.state.converged and found.state.bending_angle_deg > 100
