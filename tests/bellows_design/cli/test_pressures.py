"""Pressures as they are typed: one number, or a range with both ends."""

from __future__ import annotations

from itertools import pairwise

import pytest

from bellows_design import DesignError
from bellows_design.cli.pressures import MOST, parse_pressures


@pytest.mark.parametrize(
    ("text", "pressures"),
    [
        ("0.1", (0.1,)),
        ("1e-3", (0.001,)),
        ("0.02:0.1:0.02", (0.02, 0.04, 0.06, 0.08, 0.1)),
        ("0.05:0.05:0.01", (0.05,)),
        ("0.01:0.1:1", (0.01, 0.1)),
        ("0.1:0.3:0.1", (0.1, 0.2, 0.3)),  # 0.3 is not three times 0.1 in binary
        ("0.02:0.05:0.02", (0.02, 0.04, 0.05)),  # the end is always there
        ("-0.05", (-0.05,)),
        ("-0.02:-0.08:-0.02", (-0.02, -0.04, -0.06, -0.08)),
    ],
)
def test_a_number_or_a_range_gives_pressures_away_from_zero(
    text: str, pressures: tuple[float, ...]
) -> None:
    parsed = parse_pressures(text)
    assert parsed == pytest.approx(pressures, rel=1e-12)
    assert parsed[-1] == pressures[-1]  # exactly: the design is set to it
    assert all(abs(before) < abs(after) for before, after in pairwise(parsed))


def test_as_many_pressures_as_a_curve_needs() -> None:
    assert len(parse_pressures("0.001:0.2:0.001")) == MOST


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("a", "“a” is no number of MPa"),
        ("", "“” is no number of MPa"),
        ("nan", "“nan” is no number"),
        ("inf", "“inf” is no number"),
        ("0.1:b:0.1", "“b” is no number"),
        ("0.5bar", "0.5bar is 0.05 MPa: write 0.05, in MPa"),
        ("0.02:100 kPa:0.02", "100 kPa is 0.1 MPa: write 0.1, in MPa"),
        ("0:1:0.1", "must go away from 0 MPa"),
        ("-0.1:0.1:0.1", "must go away from 0 MPa"),
        ("0.1:0.02:0.01", "START <= STOP"),
        ("0.1:0.2:0", "STEP > 0"),
        ("0.1:0.2:-0.1", "STEP > 0"),
        ("-0.02:-0.08:0.02", "all three negative"),
        ("-0.08:-0.02:-0.02", "all three negative"),
        ("-0.02:0.08:-0.02", "all three negative"),
        ("1:2", "must be a number or START:STOP:STEP"),
        ("1:2:3:4", "must be a number or START:STOP:STEP"),
        ("0.0001:1:0.0001", "at most 200"),
        ("1e-300:1:1e-300", "at most 200"),
    ],
)
def test_anything_else_is_refused_in_one_sentence(text: str, words: str) -> None:
    with pytest.raises(DesignError) as refusal:
        parse_pressures(text)
    (sentence,) = refusal.value.sentences
    assert sentence.startswith("--pressure ") and words in sentence
    assert len(sentence) < 200


@pytest.mark.parametrize("text", ["0", "-0.1"])
def test_a_single_pressure_is_checked_with_the_design(text: str) -> None:
    """It becomes the design's own, whose bounds name value and unit."""
    assert parse_pressures(text) == (float(text),)


def test_a_step_too_small_to_count_is_refused() -> None:
    with pytest.raises(DesignError, match="at most 200"):
        parse_pressures("1e-10:1e10:1e-320")
