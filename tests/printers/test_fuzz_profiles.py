"""Whatever stands in a printer profile, it loads or is refused in one line, and soon."""

from __future__ import annotations

import os
import random
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from damage import BAD_VALUES, FUZZ, mutated, saved, soon
from hypothesis import given
from hypothesis import strategies as st

import printers
from printers import PrintersError, load_profile, profile_from_table
from printers.library.reading import LARGEST_FILE

LONGEST_LINE = 1000
BASE = (Path(printers.__file__).parent / "profiles" / "prusa_i3.toml").read_bytes()
LISTS = ("[250.0, 210.0, nan]", "[250.0, 210.0, 1e999]", "3.5")
BAD = tuple(value.encode("utf-8", "surrogatepass") for value in (*BAD_VALUES, *LISTS))


def refused_in_one_line(load: Callable[[], object]) -> bool:
    """True if ``load`` refused as documented; any error but ``PrintersError`` goes through."""
    with soon():
        try:
            load()
        except PrintersError as error:
            assert 0 < len(str(error)) < LONGEST_LINE
            assert len(str(error).splitlines()) == 1
            return True
    return False


def test_a_damaged_profile_loads_or_is_refused_in_one_line(tmp_path: Path) -> None:
    chance = random.Random("profiles")
    refused = 0
    for _ in range(400):
        path = saved(tmp_path, mutated(BASE, chance))
        refused += refused_in_one_line(lambda path=path: load_profile(path))  # type: ignore[misc]
    assert refused > 100


def test_a_profile_with_any_bit_flipped_loads_or_is_refused(tmp_path: Path) -> None:
    chance = random.Random("bits")
    for _ in range(200):
        flipped = bytearray(BASE)
        flipped[chance.randrange(len(BASE))] ^= 1 << chance.randrange(8)
        path = saved(tmp_path, bytes(flipped))
        refused_in_one_line(lambda path=path: load_profile(path))  # type: ignore[misc]


@pytest.mark.parametrize(
    "content",
    [
        pytest.param(b"self = 1\n" + BASE, id="a key that Python uses itself"),
        pytest.param(BASE + b"self = 1\n", id="such a key in a table"),
        pytest.param(b"".join(b"k%d = 1\n" % i for i in range(100_000)), id="100 000 keys"),
        pytest.param(b"a." * 400_000 + b"a = 1\n", id="a key of 400 000 parts"),
        pytest.param(b"[" + b"a." * 400_000 + b"a]\n", id="a table of 400 000 parts"),
        pytest.param(b"x = " + b"[" * 900_000, id="nested arrays"),
        pytest.param(b"x = " + b"{a=" * 200_000, id="nested tables"),
        pytest.param(b"k" * 900_000 + b" = 1\n" + BASE, id="a key of a million letters"),
        pytest.param(b'"a\\nb" = 1\n' + BASE, id="a key of two lines"),
        pytest.param(b"#" * (LARGEST_FILE + 1), id="too large"),
        pytest.param(b"\xef\xbb\xbf" * 2 + BASE, id="two byte order marks"),
        pytest.param(BASE + b"\0", id="a null byte"),
        pytest.param(BASE + BASE, id="everything twice"),
        pytest.param(b"", id="nothing"),
    ],
)
def test_a_profile_made_to_harm_is_refused_soon(tmp_path: Path, content: bytes) -> None:
    path = saved(tmp_path, content)
    assert refused_in_one_line(lambda: load_profile(path))


def test_a_byte_order_mark_is_no_part_of_a_profile(tmp_path: Path) -> None:
    assert load_profile(saved(tmp_path, b"\xef\xbb\xbf" + BASE)) == load_profile("prusa_i3")


def test_a_pipe_in_the_place_of_a_profile_is_not_waited_for(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe.toml")
    assert refused_in_one_line(lambda: load_profile(tmp_path / "pipe.toml"))


@pytest.mark.parametrize(
    "name",
    ["../x.toml", "/etc", "con", "", ".", "a\0b.toml", "a\nb", "x" * 5000, "x" * 5000 + ".toml"],
)
def test_a_name_of_no_profile_is_refused_in_one_line(name: str) -> None:
    assert refused_in_one_line(lambda: load_profile(name))


@FUZZ
@given(name=st.text(max_size=60), ending=st.sampled_from(["", ".toml"]))
def test_any_text_is_refused_as_the_name_of_a_profile(name: str, ending: str) -> None:
    assert refused_in_one_line(lambda: load_profile(name + ending))


@FUZZ
@given(content=st.binary(max_size=300))
def test_any_bytes_are_refused_as_a_profile(tmp_path: Path, content: bytes) -> None:
    path = saved(tmp_path, content)
    assert refused_in_one_line(lambda: load_profile(path))


SCALARS = st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=9) | st.dates()
VALUES = st.recursive(
    SCALARS, lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=5), inner)
)


@FUZZ
@given(data=st.data())
def test_any_table_is_a_profile_or_refused_in_one_line(data: st.DataObject) -> None:
    table: dict[str, Any] = tomllib.loads(BASE.decode("utf-8"))
    for _ in range(data.draw(st.integers(1, 3))):
        slicer = table.get("slicer")
        target = data.draw(st.sampled_from([table, slicer if isinstance(slicer, dict) else table]))
        key = data.draw(st.sampled_from([*target, "self"]) | st.text(max_size=8))
        target[key] = data.draw(VALUES)
    refused_in_one_line(lambda: profile_from_table(table))
