"""Damaged files and bad values for tests of whatever reads them."""

from __future__ import annotations

import random
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from hypothesis import HealthCheck, settings

FUZZ = settings(
    derandomize=True,
    deadline=None,
    max_examples=100,
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
)
SECONDS = 5.0
"""Of computing, for one input; a hang takes minutes."""

BAD_VALUES = [
    *("1e999", "-1e999", "nan", "-inf", "1e-999", "-0.0", "0x" + "f" * 5000, "1" * 5000, "1" * 400),
    *(
        "true",
        '""',
        '"\\u0000"',
        "[]",
        "[[[[1]]]]",
        "{}",
        "{a = {a = 1}}",
        "1979-05-27",
        "07:32:00",
    ),
    *("[" * 10_000, "[" * 50 + "]" * 50, "{" + "a." * 60_000 + "a = 1}", "'" + "x" * 90_000 + "'"),
    *(
        "[0x" + "f" * 5000 + "]",
        "",
        "=",
        "'",
        '"""',
        "\ud800",
        "\0",
        "none",
        "None",
        "1\nname = 'x'",
    ),
]


@contextmanager
def soon() -> Iterator[None]:
    """Fails if the block takes longer than any input should."""
    start = time.process_time()
    yield
    assert time.process_time() - start < SECONDS


def saved(folder: Path, content: bytes, name: str = "fuzzed.toml") -> Path:
    path = folder / name
    path.write_bytes(content)
    return path


def mutated(content: bytes, chance: random.Random) -> bytes:
    """``content`` with one or several of the damages that happen to files, or are done to them."""
    for _ in range(chance.randint(1, 3)):
        content = chance.choice(DAMAGES)(content, chance)
    return content


def _cut_short(content: bytes, chance: random.Random) -> bytes:
    return content[: chance.randrange(len(content) + 1)]


def _flipped(content: bytes, chance: random.Random) -> bytes:
    flipped = bytearray(content)
    for _ in range(min(len(flipped), chance.randint(1, 8))):
        flipped[chance.randrange(len(flipped))] ^= 1 << chance.randrange(8)
    return bytes(flipped)


def _line_replaced(content: bytes, chance: random.Random) -> bytes:
    lines = content.split(b"\n")
    at = chance.randrange(len(lines))
    key = lines[at].partition(b"=")[0]
    lines[at] = key + b"= " + chance.choice(BAD_VALUES).encode("utf-8", "surrogatepass")
    return b"\n".join(lines)


def _line_doubled(content: bytes, chance: random.Random) -> bytes:
    lines = content.split(b"\n")
    lines.insert(chance.randrange(len(lines)), chance.choice(lines))
    return b"\n".join(lines)


def _spliced(content: bytes, chance: random.Random) -> bytes:
    at = chance.randrange(len(content) + 1)
    pieces = (
        b"\0",
        b"\xff",
        b"\xef\xbb\xbf",
        b"\r",
        b'"',
        b"[",
        b"]]",
        b"\n[bellows]\n",
        b"\x1b[2J",
    )
    return content[:at] + chance.choice(pieces) + content[at:]


def _differently_encoded(content: bytes, chance: random.Random) -> bytes:
    text = content.decode("utf-8", "replace")
    return text.encode(chance.choice(["utf-16", "utf-32", "utf-8-sig", "cp1250"]), "replace")


DAMAGES: tuple[Callable[[bytes, random.Random], bytes], ...] = (
    _cut_short,
    _flipped,
    _line_replaced,
    _line_doubled,
    _spliced,
    _differently_encoded,
)
