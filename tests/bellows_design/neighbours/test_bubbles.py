"""The same bubbles, more or fewer of them."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from bellows_design.design.overrides import with_overrides
from bellows_design.design.shipped import load_design, shipped_designs
from bellows_design.evaluation import Evaluation, Neighbourhood
from bellows_design.neighbours.bubbles import counts_alike, of_count, with_bubbles
from bellows_design.neighbours.distance import distance

Coarse = Callable[[str], Evaluation]


@pytest.mark.parametrize("name", shipped_designs())
@pytest.mark.parametrize("count", [3, 5, 12])
def test_another_count_keeps_bubbles_root_and_tip(name: str, count: int) -> None:
    design = load_design(name)
    other = of_count(design, count)
    before, after = design.bellows, other.bellows
    assert after.bubble_count == count and distance(design, other) == 0
    assert after.root_length == pytest.approx(before.root_length)
    tips = [each.length - each.root_length - each.train_length for each in (before, after)]
    assert tips[1] == pytest.approx(tips[0])
    assert after.bubble_size == before.bubble_size and after.pitch == before.pitch


def test_the_same_count_is_the_same_design() -> None:
    design = load_design("finger")
    assert of_count(design, design.bellows.bubble_count) is design


def test_one_or_two_bubbles_have_no_cell() -> None:
    design = load_design("finger")
    assert counts_alike(design, 3) and not counts_alike(design, 2)


@pytest.mark.thorough
def test_each_bubble_more_turns_as_much_and_holds_as_much(coarse: Coarse) -> None:
    anchor = coarse("finger")
    found = Neighbourhood(anchor).continued(anchor.design)
    count = anchor.design.bellows.bubble_count
    states = [with_bubbles(found, of_count(anchor.design, n)) for n in range(count, count + 3)]
    for value in ("bending_angle_deg", "cavity_volume_mm3"):
        first, second, third = (getattr(state, value) for state in states)
        assert third - second == pytest.approx(second - first) and second > first
    assert states[0].bending_angle_deg == pytest.approx(found.bending_angle_deg)
    assert states[2].max_von_mises_mpa == found.max_von_mises_mpa
    assert states[2].design.bellows.bubble_count == count + 2


@pytest.mark.slow
def test_two_bubbles_more_turn_as_far_as_that_actuator_by_itself(coarse: Coarse) -> None:
    anchor = coarse("finger")
    count = anchor.design.bellows.bubble_count + 2
    longer = of_count(anchor.design, count)
    found = with_bubbles(Neighbourhood(anchor).continued(anchor.design), longer)
    itself = coarse_of(anchor, count)
    assert found.bending_angle_deg == pytest.approx(itself.bending_angle_deg, rel=1e-3)
    assert found.cavity_volume_mm3 == pytest.approx(itself.cavity_volume_mm3, rel=1e-3)


def coarse_of(anchor: Evaluation, count: int) -> Evaluation:
    """The actuator with so many bubbles, on meshes as coarse as the anchor's."""
    from bellows_design.evaluation import evaluation_of, started

    longer = of_count(anchor.design, count)
    settings = [f"length={longer.bellows.length!r}", f"number_of_bubbles={count}"]
    design = with_overrides(anchor.design, settings)
    return evaluation_of(started(design, anchor.model, ""))
