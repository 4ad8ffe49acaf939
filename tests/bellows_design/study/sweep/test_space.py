"""What is varied, written as a user does, and the designs at points of it."""

from __future__ import annotations

import pytest

from bellows_design.design.overrides import with_overrides
from bellows_design.design.shipped import load_design
from bellows_design.errors import DesignError
from bellows_design.study.sweep.space import Axis, axes, design_at

FINGER = load_design("finger")


def test_a_range_is_read_with_and_without_a_number():
    assert axes(["bubble_width=16:20", " tendon_width = 5:6:3"], FINGER) == (
        Axis("bubble_width", 16.0, 20.0),
        Axis("tendon_width", 5.0, 6.0, 3),
    )


def test_an_axis_is_written_as_it_is_read():
    for text in ("bubble_width=16:20", "indent.depth=0.1:0.30000000000000004:3"):
        (axis,) = axes([text], FINGER)
        assert axes([str(axis)], FINGER) == (axis,)


@pytest.mark.parametrize(
    ("texts", "sentence"),
    [
        ([], "nothing is varied"),
        (["bubble_with=16:20"], "did you mean bubble_width"),
        (["colour=1:2"], "unknown parameter “colour”"),
        (["bubble_width"], "must have the form"),
        (["bubble_width=16"], "must have the form"),
        (["bubble_width=16:20:5:7"], "must have the form"),
        (["bubble_width=20:16"], "from 20 to 16"),
        (["bubble_width=16:16"], "from less to more"),
        (["bubble_width=16:wide"], "“wide” is no finite number"),
        (["bubble_width=nan:20"], "“nan” is no finite number"),
        (["bubble_width=16:inf"], "“inf” is no finite number"),
        (["load.pressure=-1.7e308:1.7e308"], "must lie within ±1e\\+09"),
        (["bubble_width=16:20:0"], "2 to 10000"),
        (["bubble_width=16:20:1"], "2 to 10000"),
        (["bubble_width=16:20:-3"], "2 to 10000"),
        (["bubble_width=16:20:9999999999"], "2 to 10000"),
        (["bubble_width=16:20", "bubble_width=17:19"], "varied twice"),
        (["inner_fillet=0.5:1", "inner_fillet%=10:90"], "varied twice"),
        (["inner_fillet%=10:110"], "within 0 and 100 %"),
    ],
)
def test_what_is_no_range_of_a_parameter_is_refused_in_a_sentence(texts, sentence):
    with pytest.raises(DesignError, match=sentence) as refused:
        axes(texts, FINGER)
    assert len(str(refused.value).splitlines()) == 1


def test_a_design_has_the_values_of_its_point():
    design = design_at(FINGER, {"bubble_width": 19.0, "indent.depth": 0.3, "load.pressure": 0.05})
    assert (design.bellows.bubble_width, design.indent.depth) == (19.0, 0.3)
    assert design.load.pressure == 0.05


@pytest.mark.parametrize("radius", [0.0, 0.8, 1.0])
def test_a_fillet_is_varied_whether_it_is_none_or_a_full_round(radius):
    """Chambers are 2 mm long: 1 mm is a full round."""
    base = with_overrides(FINGER, ["outer_fillet=1", f"inner_fillet={radius}"])
    (axis,) = axes(["inner_fillet=0:0.6:3"], base)
    for value in (axis.low, 0.3, axis.high):
        assert design_at(base, {axis.name: value}).bellows.inner_fillet == value


def test_a_fillet_in_percent_is_that_share_of_what_its_edges_allow():
    values = {"chamber_length": 1.6, "inner_fillet%": 50.0, "outer_fillet%": 100.0}
    bellows = design_at(FINGER, values).bellows
    assert bellows.inner_fillet == pytest.approx(0.4)
    assert bellows.outer_fillet == pytest.approx(min(bellows.bubble_size) / 2)


def test_a_fillet_in_percent_goes_with_lengths_that_the_design_s_own_would_not_fit():
    bellows = design_at(FINGER, {"chamber_length": 1.2, "inner_fillet%": 80.0}).bellows
    assert bellows.inner_fillet == pytest.approx(0.48) and FINGER.bellows.inner_fillet > 0.6


def test_what_can_be_no_design_is_refused():
    with pytest.raises(DesignError):
        design_at(FINGER, {"tendon_width": 100.0})
