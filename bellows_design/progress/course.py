"""The course that a run takes: its stages with their seconds, as an earlier run of its kind had."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

_SIZE = re.compile(r"^(?P<what>.*?),? (?P<size>\d+) tetrahedra$")
_COUNT = re.compile(r"^(?P<before>\D*)(?P<number>\d+(?:\.\d+)?) of (?P<all>\d+(?:\.\d+)?)\b")
_NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e-?\d+)?")

GROWTH = 1.3
"""Power of the number of tetrahedra with which the time of a solve grows, about."""

MOST_STAGES = 500
"""Of a course that is kept."""


@dataclass(frozen=True)
class Stage:
    """A stage as it is known by its ``key``, s; ``size``: tetrahedra, 0 where it has none."""

    key: str
    seconds: float
    size: int = 0

    def expected(self, size: int) -> float:
        """The seconds that it takes with so many tetrahedra."""
        if not (self.size and size):
            return self.seconds
        return float(self.seconds * (size / self.size) ** GROWTH)


Course = tuple[Stage, ...]


@dataclass(frozen=True)
class Count:
    """How far something that is counted has come, of ``all``; ``done`` may be between two."""

    done: float
    all: float


def key_of(name: str) -> tuple[str, int]:
    """What a stage is known by in every run, and its size: the same stage has other numbers.

    Numbers of meshes count: ``mesh 2`` is not ``mesh 3``, nor ``solve 2`` ``solve 3``.
    """
    sized = _SIZE.match(name)
    if sized is not None:
        return sized["what"], int(sized["size"])
    return (name, 0) if name.startswith(("mesh ", "solve ")) else (_NUMBER.sub("#", name), 0)


def count_in(text: str) -> Count | None:
    """The count in a text: ``40 of 200 designs`` are done, with ``sample 3 of 20`` two are."""
    found = _COUNT.match(text)
    if found is None or not float(found["all"]) > 0:
        return None
    begun = 1.0 if found["before"].strip() else 0.0
    return Count(max(0.0, float(found["number"]) - begun), float(found["all"]))


def plain(course: Iterable[Stage]) -> list[list[Any]]:
    """A course as plain values, to be kept."""
    return [[each.key, round(each.seconds, 3), each.size] for each in course][:MOST_STAGES]


def course_of(content: Any) -> Course:
    """The course that ``plain`` wrote; an empty one of anything else."""
    try:
        stages = [Stage(str(key), float(seconds), int(size)) for key, seconds, size in content]
    except (TypeError, ValueError):
        return ()
    return tuple(stages) if all(0 <= each.seconds < 1e6 for each in stages) else ()


def nearest(courses: Sequence[Course], keys: Sequence[str]) -> Course:
    """Of several courses the one that begins most like ``keys``, the first of equals."""
    return max(courses, key=lambda course: _alike(course, keys), default=())


def _alike(course: Course, keys: Sequence[str]) -> int:
    """How many of the keys follow each other in the course."""
    place, found = 0, 0
    for key in keys:
        later = [i for i in range(place, len(course)) if course[i].key == key]
        if later:
            place, found = later[0] + 1, found + 1
        else:
            found -= 1
    return found
