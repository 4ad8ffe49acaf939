"""What an optimization looks at: counts, and the continuous variables of each."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from power_law import answered

from bellows_design.batch.question import Question
from bellows_design.design.shipped import load_design
from bellows_design.errors import DesignError
from bellows_design.study.optimize.space.choices import Bounds, Choice, choices, room
from bellows_design.study.optimize.space.variables import Variables
from bellows_design.study.optimize.stages import beside, nearest_choice

FINGER = load_design("finger")
ALL = choices(FINGER, Bounds())
TEN = Choice(10, 3, 3, 4)


def some(variables: Variables, shares: list[float]) -> np.ndarray:
    """Values at shares of the variables' ranges, shortened until the bubbles fit."""
    share = np.array(shares[: len(variables.names)])
    return variables.within_room(variables.lower + share * (variables.upper - variables.lower))


def test_every_choice_has_whole_lines_and_bubbles_that_fit():
    profile = FINGER.profile()
    assert len(ALL) > 50
    for choice in ALL:
        variables = Variables(FINGER, choice)
        least = choice.bubbles * (2 * variables.bubble_wall) + variables.train_gradient @ (
            variables.lower
        )
        assert least <= room(FINGER) + 1e-9
        assert min(choice.bubble_lines, choice.tendon_lines) >= profile.minimum_lines


@settings(deadline=None, max_examples=60)
@given(
    st.sampled_from(ALL),
    st.lists(st.floats(0, 1), min_size=8, max_size=8),
)
def test_designs_have_walls_of_whole_lines_that_go_around_corners_as_thick(choice, shares):
    variables = Variables(FINGER, choice)
    values = variables.rounded(some(variables, shares))
    if variables.exists(values):
        return
    design, profile = variables.design(values), FINGER.profile()
    p = design.bellows
    for wall in (p.bubble_thickness, p.tendon_thickness):
        assert wall / profile.line_width == pytest.approx(round(wall / profile.line_width))
    assert p.outer_fillet == pytest.approx(p.inner_fillet + p.bubble_thickness)
    assert p.bubble_count == choice.bubbles
    assert p.root_length == pytest.approx(p.offset)
    assert min(p.channel_width, p.channel_height) >= 2 * profile.line_width - 1e-9
    assert p.bubble_distance >= profile.minimum_gap - 1e-9
    assert max(p.bubble_width, p.bubble_height) <= 20 + 1e-9
    if design.indent is not None:
        assert design.indent.remaining_wall(p) >= profile.minimum_floor - 1e-9


@settings(deadline=None, max_examples=40)
@given(st.sampled_from(ALL), st.lists(st.floats(0, 1), min_size=8, max_size=8))
def test_values_of_a_design_make_the_same_design(choice, shares):
    variables = Variables(FINGER, choice)
    values = variables.rounded(some(variables, shares))
    if variables.exists(values):
        return
    again = variables.values(variables.design(values))
    # Rounding may leave the bounds by a micrometre, which reading the design back does not.
    assert again == pytest.approx(values, abs=2e-3)


def test_rounding_never_makes_the_bubbles_too_long():
    variables = Variables(FINGER, TEN)
    rng = np.random.default_rng(1)
    for _ in range(200):
        values = variables.rounded(some(variables, list(rng.random(8))))
        assert variables.train_excess(values) <= 1e-6
        assert np.all(values >= variables.lower - 1e-3)


@pytest.mark.parametrize("full_round", [False, True])
@pytest.mark.parametrize("response", ["bending_angle_deg", "max_von_mises_mpa"])
def test_derivatives_by_variables_match_differences(full_round, response):
    variables = Variables(FINGER, Choice(9, 3, 3, 4, full_round))
    values = variables.values(FINGER)
    answer = answered(Question(variables.design(values), derivatives=True))
    slope = variables.gradient(values, answer.derivatives[response])
    for index in range(len(values)):
        step = 1e-4 * values[index]
        if full_round and variables.names[index] == "chamber_length":
            step = 1e-3 * values[index]
        ahead, behind = (
            getattr(answered(Question(variables.design(moved))), response)
            for moved in (values + step * np.eye(len(values))[index],
                          values - step * np.eye(len(values))[index])
        )  # fmt: skip
        assert (ahead - behind) / (2 * step) == pytest.approx(slope[index], rel=1e-3, abs=1e-6)


def test_choices_beside_one_differ_in_one_count():
    found = beside(TEN, ALL)
    assert Choice(11, 3, 3, 4) in found
    assert Choice(10, 3, 4, 4) in found
    assert Choice(10, 3, 3, 0) in found
    assert Choice(10, 3, 3, 4, True) in found
    assert Choice(11, 3, 4, 4) not in found
    assert TEN not in found


def test_the_choice_nearest_to_a_design_of_whole_lines_is_its_own():
    assert nearest_choice(FINGER, ALL) == Choice(8, 3, 4, 4, True)


def test_bounds_narrow_the_choices():
    bounds = Bounds(lines=(3,), bubbles=(9, 10), indents=False)
    found = choices(FINGER, bounds)
    assert {(each.bubbles, each.bubble_lines, each.tendon_lines) for each in found} == {
        (9, 3, 3),
        (10, 3, 3),
    }
    assert not any(each.indent_layers for each in found)


def test_values_that_make_no_design_are_said_to():
    variables = Variables(FINGER, TEN)
    values = variables.values(FINGER)
    values[0] = 6.0
    assert "do not fit" in variables.exists(values)
    values[0] = 0.01
    assert variables.exists(values)
    with pytest.raises(DesignError):
        variables.design(values)
