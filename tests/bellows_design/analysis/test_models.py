"""Which body stands for an actuator, and the short actuator that stands for its ends."""

from __future__ import annotations

import pytest

from bellows_design.analysis.models import (
    FULL,
    HALF,
    LEAST_LENGTH,
    MODELS,
    UNIT_CELL,
    AnalysisModel,
    choose,
    sharp_edge_radius,
    shortened,
)
from bellows_design.design.bellows_parameters import BellowsParameters
from bellows_design.design.design import Design
from bellows_design.design.overrides import with_overrides
from bellows_design.design.shipped import load_design, shipped_designs
from bellows_design.study.paper import TABLE_4


def of_bubbles(count: int) -> Design:
    return with_overrides(load_design("prototype_1"), [f"number_of_bubbles={count}", "length=60"])


@pytest.mark.parametrize(
    ("count", "model"), [(1, HALF), (2, HALF), (3, UNIT_CELL), (4, UNIT_CELL), (8, UNIT_CELL)]
)
def test_a_cell_answers_from_three_bubbles_on_and_half_an_actuator_below(
    count: int, model: AnalysisModel
) -> None:
    chosen, reason = choose(of_bubbles(count))
    assert chosen is model
    assert reason.startswith(f"{count} bubble{'s' if count > 1 else ''} ")
    assert choose(of_bubbles(count), "auto") == (chosen, reason)


@pytest.mark.parametrize("count", [1, 8])
@pytest.mark.parametrize(("name", "model"), MODELS.items())
def test_a_model_that_is_asked_for_is_taken(count: int, name: str, model: AnalysisModel) -> None:
    assert choose(of_bubbles(count), name) == (model, "as asked for")
    assert model.name == name


@pytest.mark.parametrize("name", ["quarter", "", "Half", "unit_cell"])
def test_an_unknown_model_is_refused_with_the_known_ones(name: str) -> None:
    with pytest.raises(ValueError, match="must be one of auto, unit-cell, half, full") as refusal:
        choose(of_bubbles(1), name)
    assert repr(name) in str(refusal.value)


def test_shares_make_up_a_bubble_or_the_whole() -> None:
    """Half of a bubble's length times half of its width; half of the width; all."""
    assert (UNIT_CELL.share, HALF.share, FULL.share) == (4, 2, 1)


DESIGNS = {
    **{result.label: result.build() for result in TABLE_4},
    **{name: load_design(name) for name in shipped_designs()},
    "offset given up for bubbles": of_bubbles(8),
}


@pytest.mark.parametrize("name", DESIGNS)
def test_the_short_actuator_has_one_bubble_between_the_same_ends(name: str) -> None:
    design = DESIGNS[name]
    bellows, short = design.bellows, shortened(design).bellows
    assert short.bubble_count == 1
    assert short.root_length == pytest.approx(bellows.root_length, abs=1e-12)
    assert (short.bubble_size, short.pitch) == (bellows.bubble_size, bellows.pitch)
    length = bellows.length - (bellows.bubble_count - 1) * bellows.pitch
    assert short.length == pytest.approx(max(length, LEAST_LENGTH), abs=1e-9)
    longer = max(LEAST_LENGTH - length, 0)  # the least an actuator may be: a longer tip goes along
    assert tip(short) == pytest.approx(tip(bellows) + longer, abs=1e-9)


def tip(bellows: BellowsParameters) -> float:
    """Length behind the last bubble, mm."""
    return bellows.length - bellows.root_length - bellows.train_length


@pytest.mark.parametrize("name", ["prototype_1", "finger"])
def test_the_short_actuator_keeps_all_else(name: str) -> None:
    design = load_design(name)
    short = shortened(design)
    assert short.model_copy(update={"bellows": design.bellows}) == design
    kept = {"length", "number_of_bubbles", "offset"}
    assert short.bellows.model_dump(exclude=kept) == design.bellows.model_dump(exclude=kept)


def test_a_bubble_too_short_for_an_actuator_gets_a_longer_tip() -> None:
    changes = ["chamber_length=0.4", "inner_fillet=0.2", "outer_fillet=0.5", "offset=1.5"]
    design = with_overrides(load_design("prototype_1"), [*changes, "number_of_bubbles=3"])
    tight = with_overrides(design, [f"length={1.5 + design.bellows.train_length}"])
    short = shortened(tight)
    assert short.bellows.length == 10
    assert short.bellows.root_length == 1.5


def test_stress_is_not_read_nearer_to_sharp_edges_than_a_quarter_of_the_wall() -> None:
    assert sharp_edge_radius(load_design("prototype_1")) == 1.5 / 4
    thin = with_overrides(load_design("prototype_1"), ["tendon_thickness=0.8"])
    assert sharp_edge_radius(thin) == pytest.approx(0.2)
    thick = with_overrides(load_design("prototype_1"), ["bubble_thickness=2", "outer_fillet=2"])
    thick = with_overrides(thick, ["tendon_thickness=1.9", "length=80"])
    assert sharp_edge_radius(thick) == pytest.approx(0.4)  # no more than a line of the nozzle
