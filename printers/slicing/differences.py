"""Settings that a slicer dropped or changed: it says what it used, at the end of its G-code."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

SAME: Mapping[tuple[str, str], tuple[str | None, ...]] = {
    ("ensure_vertical_shell_thickness", "1"): ("enabled", None),
}
"""What newer versions make of a value without another meaning: PrusaSlicer 2.9 has a word for it,
and 2.7 always does it and has no key."""


@dataclass(frozen=True)
class Difference:
    """A setting, what was asked for, and what the slicer used; None if it does not know it."""

    key: str
    asked: str
    used: str | None

    def __str__(self) -> str:
        if self.used is None:
            return f"{self.key} = {self.asked} was dropped"
        return f"{self.key} = {self.asked} became {self.used}"


def differences(asked: Mapping[str, str], used: Mapping[str, str]) -> Iterator[Difference]:
    """Settings that were not used as they were asked for, in their order."""
    for key, value in asked.items():
        theirs = used.get(key)
        same = theirs is not None and _equal(value, theirs)
        if not same and theirs not in SAME.get((key, value), ()):
            yield Difference(key, value, theirs)


def _equal(asked: str, used: str) -> bool:
    """Equal as text or, number by number, as numbers of the same unit."""
    if asked == used:
        return True
    pairs = list(zip(asked.split(","), used.split(","), strict=False))
    same_count = asked.count(",") == used.count(",")
    return same_count and all(_same_number(one.strip(), other.strip()) for one, other in pairs)


def _same_number(one: str, other: str) -> bool:
    if one.endswith("%") != other.endswith("%"):
        return False
    try:
        first, second = float(one.rstrip("%")), float(other.rstrip("%"))
    except ValueError:
        return one == other
    return abs(first - second) <= 1e-6 * max(abs(first), abs(second))
