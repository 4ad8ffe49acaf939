"""A sealed file tells by itself whether it is as it was written."""

from __future__ import annotations

import json

from hypothesis import given
from hypothesis import strategies as st

from bellows_design.export.seal import OPEN, seal_holds, sealed

PLAIN = st.recursive(
    st.none() | st.booleans() | st.integers() | st.text(max_size=8),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=5), inner),
    max_leaves=10,
)
CONTENTS = st.dictionaries(st.text(max_size=8).filter(lambda key: key != "sha256"), PLAIN)


@given(CONTENTS)
def test_whatever_is_sealed_is_json_whose_seal_holds(content: dict[str, object]) -> None:
    found = sealed(content)
    assert seal_holds(found) and set(json.loads(found)) == {*content, "sha256"}


@given(CONTENTS, st.data())
def test_any_flipped_bit_breaks_the_seal(content: dict[str, object], data: st.DataObject) -> None:
    found = bytearray(sealed(content))
    place = data.draw(st.integers(0, len(found) - 1))
    found[place] ^= 1 << data.draw(st.integers(0, 7))
    assert not seal_holds(bytes(found))


def test_lengthening_or_cutting_breaks_the_seal() -> None:
    found = sealed({"a": 1})
    assert not seal_holds(found + b"\n") and not seal_holds(found[:-1]) and not seal_holds(b"")
    assert not seal_holds(b" " + found)


def test_the_open_form_is_no_seal() -> None:
    found = sealed({"a": 1})
    digits = json.loads(found)["sha256"]
    assert not seal_holds(found.replace(digits.encode(), OPEN.encode()))
