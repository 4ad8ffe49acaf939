"""Whatever stands in a printer profile, it loads or is refused in one line, and soon."""

from __future__ import annotations

import os
import random
import time
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import printers
from printers import PrinterProfile, load_profile
from printers.profile import LARGEST_FILE

FUZZ = settings(
    derandomize=True,
    deadline=None,
    max_examples=100,
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
)
SECONDS = 5.0
"""Of computing, for one profile; a hang takes minutes."""

LONGEST_LINE = 1000
BASE = (Path(printers.__file__).parent / "profiles" / "prusa_i3.toml").read_bytes()
BAD_VALUES = [
    *(b"1e999", b"-1e999", b"nan", b"-inf", b"-0.0", b"0x" + b"f" * 5000, b"1" * 5000, b"1" * 400),
    *(b"true", b'""', b"[]", b"[[[[1]]]]", b"{}", b"{a = {a = 1}}", b"1979-05-27", b"'", b'"""'),
    *(b"[" * 10_000, b"[" * 50 + b"]" * 50, b"'" + b"x" * 90_000 + b"'", b"'\\n'", b"\0", b""),
    *(b"[0x" + b"f" * 5000 + b"]", b"[250.0, 210.0, nan]", b"[250.0, 210.0, 1e999]", b"3.5"),
]


def refused_in_one_line(load: Callable[[], object]) -> bool:
    """True if ``load`` refused as documented; any error but ``ValueError`` goes through."""
    start = time.process_time()
    try:
        load()
    except ValueError as error:
        assert 0 < len(str(error)) < LONGEST_LINE
        assert len(str(error).splitlines()) == 1
        return True
    finally:
        assert time.process_time() - start < SECONDS
    return False


def saved(folder: Path, content: bytes) -> Path:
    path = folder / "fuzzed.toml"
    path.write_bytes(content)
    return path


def mutated(content: bytes, chance: random.Random) -> bytes:
    """``content`` cut short, with flipped bits, bad values or bytes, or in another encoding."""
    at = chance.randrange(len(content) + 1)
    damage = chance.randrange(5)
    if damage == 0:
        return content[:at]
    if damage == 1:
        return content[:at] + chance.choice([b"\0", b"\xff", b"\xef\xbb\xbf", b"\r", b'"', b"["])
    if damage == 2:
        encoding = chance.choice(["utf-16", "utf-32", "utf-8-sig", "cp1250"])
        return content.decode("utf-8").encode(encoding, "replace")
    lines = content.split(b"\n")
    line = chance.randrange(len(lines))
    if damage == 3:
        lines[line] = lines[line].partition(b"=")[0] + b"= " + chance.choice(BAD_VALUES)
    else:
        lines.insert(line, chance.choice(lines))
    return b"\n".join(lines)


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
    refused_in_one_line(lambda: PrinterProfile(**table))
