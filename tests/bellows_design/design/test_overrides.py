"""Changing single values."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from bellows_design.design.overrides import known_keys, renamed_if_changed, with_overrides
from bellows_design.design.shipped import load_design
from bellows_design.errors import DesignError

PROTOTYPE = load_design("prototype_1")
INDENTED = load_design("prototype_2_indent")


def test_a_plain_key_belongs_to_the_bellows() -> None:
    changed = with_overrides(PROTOTYPE, ["bubble_thickness=1.2"])
    assert changed.bellows.bubble_thickness == 1.2
    assert changed == with_overrides(PROTOTYPE, ["bellows.bubble_thickness = 1.2"])


def test_a_dotted_key_reaches_into_a_table() -> None:
    changed = with_overrides(INDENTED, ["indent.depth=0.3", "load.pressure=0.05"])
    assert changed.indent is not None
    assert (changed.indent.depth, changed.load.pressure) == (0.3, 0.05)


def test_dotted_keys_together_make_a_table_that_was_absent() -> None:
    changed = with_overrides(PROTOTYPE, ["indent.depth=0.4", "indent.width=2.4"])
    assert changed.indent is not None and changed.indent.width == 2.4


def test_none_takes_a_table_or_a_number_away() -> None:
    assert with_overrides(INDENTED, ["indent=none"]).indent is None
    forced = with_overrides(PROTOTYPE, ["number_of_bubbles=6"])
    assert forced.bellows.bubble_count == 6
    assert with_overrides(forced, ["number_of_bubbles=none"]).bellows.bubble_count == 7


def test_text_needs_no_quotes_and_a_library_material_is_named() -> None:
    changed = with_overrides(PROTOTYPE, ["name=mine", "material=ninjaflex", "description=a = b c"])
    assert (changed.name, changed.description) == ("mine", "a = b c")
    assert changed.material == PROTOTYPE.material


def test_the_last_of_two_values_counts() -> None:
    changed = with_overrides(PROTOTYPE, ["bubble_width=18", "bubble_width=16"])
    assert changed.bellows.bubble_width == 16


def test_no_change_is_the_same_design() -> None:
    assert with_overrides(PROTOTYPE, []) == PROTOTYPE
    assert renamed_if_changed(with_overrides(PROTOTYPE, ["offset=5"]), PROTOTYPE) == PROTOTYPE


def test_a_changed_design_gets_a_name_of_its_own_unless_it_has_one() -> None:
    changed = with_overrides(PROTOTYPE, ["bubble_width=16"])
    assert renamed_if_changed(changed, PROTOTYPE).name == f"prototype_1-{changed.digest[:8]}"
    named = with_overrides(PROTOTYPE, ["bubble_width=16", "name=narrow"])
    assert renamed_if_changed(named, PROTOTYPE).name == "narrow"


@pytest.mark.parametrize(
    ("assignment", "words"),
    [
        ("bubble_tickness=1", "did you mean bubble_thickness"),
        ("pressure=0.1", "did you mean load.pressure"),
        ("nonsense=1", "known are bubble_width"),
        ("bubble_width", "form key=value"),
        ("=1", "unknown key"),
        ("bellows=1", "unknown key"),
        ("bubble_width.x=1", "unknown key"),
        ("__class__=1", "unknown key"),
        ("name=../x", "name is “../x”"),
        ("name='../x'", "name is “../x”"),
        ("printer=../x", "printer is “../x”"),
        ("bubble_width=__import__('os')", "cannot be set"),
        ("bubble_width=1\ntendon_width=2", "cannot be set"),
        ("bubble_width=" + "[" * 5000, "cannot be set"),
        ("bubble_width=nan", "finite"),
        ("number_of_bubbles=3.5", "whole number"),
        ("port=none", "must be a table"),
        ("indent.depth=0.4", "indent.width is missing"),
    ],
)
def test_a_wrong_assignment_is_refused_in_one_sentence(assignment: str, words: str) -> None:
    with pytest.raises(DesignError) as caught:
        with_overrides(PROTOTYPE, [assignment])
    assert words in str(caught.value) and "\n" not in str(caught.value)


@given(key=st.sampled_from(known_keys()) | st.text(max_size=12), value=st.text(max_size=30))
def test_any_assignment_gives_a_design_or_sentences(key: str, value: str) -> None:
    try:
        changed = with_overrides(INDENTED, [f"{key}={value}"])
    except DesignError as error:
        assert error.sentences
    else:
        assert changed.name and "/" not in changed.name


@given(value=st.floats(), key=st.sampled_from(known_keys()))
def test_any_number_gives_a_design_or_sentences(key: str, value: float) -> None:
    try:
        with_overrides(INDENTED, [f"{key}={value!r}"])
    except DesignError as error:
        assert error.sentences
