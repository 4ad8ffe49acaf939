"""How much of a run is done, and how long the rest takes.

A course that an earlier run took says how long each stage lasts; what is done so far says how much
faster or slower this run is. Nothing is said where nothing is known.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from bellows_design.progress.course import Count, Course, Stage, count_in, key_of, nearest

PRIOR = 0.1
"""Share of a course's seconds with which it counts against the pace of this run."""

TAIL = 0.15
"""Of the time it has taken so far, a stage that takes longer than expected will take yet."""

LEAST_COUNTED = 0.01
"""Fraction of a count from which on it tells the time."""


@dataclass
class Estimate:
    """Follows the stages of one run; seconds are counted by ``clock``."""

    courses: Sequence[Course] = ()
    clock: Callable[[], float] = time.monotonic
    taken: list[Stage] = field(default_factory=list)
    _keys: list[str] = field(default_factory=list)
    _course: Course = ()
    _place: int = -1
    _expected: float | None = None
    _size: int = 0
    _load: float = 0.0
    _count: Count | None = None
    _counted_at: float = 0.0
    _expected_before: float = 0.0
    _matched_before: float = 0.0
    _start: float = field(init=False)
    _stage_start: float = field(init=False)
    _furthest: float = 0.0

    def __post_init__(self) -> None:
        self._start = self._stage_start = self.clock()

    def stage(self, name: str) -> None:
        """A stage begins."""
        self.close()
        self._counted(name)
        key, self._size = key_of(name)
        self._keys.append(key)
        self._choose()
        later = [i for i in range(self._place + 1, len(self._course)) if self._course[i].key == key]
        self._expected = None
        if later:
            self._place = later[0]
            self._expected = self._course[self._place].expected(self._size)

    def load(self, fraction: float) -> None:
        """The stage has come so far, a fraction."""
        self._load = max(self._load, min(fraction, 1.0))

    def note(self, text: str) -> None:
        """A note may count."""
        self._counted(text)

    def close(self) -> None:
        """The stage that is going on ends here."""
        now = self.clock()
        if self._keys:
            self.taken.append(Stage(self._keys[-1], now - self._stage_start, self._size))
            if self._expected is not None:
                self._expected_before += self._expected
                self._matched_before += now - self._stage_start
        self._stage_start, self._load = now, 0.0

    @property
    def counts(self) -> bool:
        """Whether something is counted: its time depends on how much that is."""
        return self._count is not None

    @property
    def elapsed(self) -> float:
        """Seconds since the run began."""
        return self.clock() - self._start

    def left(self) -> float | None:
        """Seconds that the rest takes; None where that is not known."""
        if self._count is not None:
            return self._left_of_count(self._count)
        if self._expected is None:
            return None
        return self._left_of_stage(self._expected) + self._pace() * self._after()

    def done(self) -> float | None:
        """Fraction of the whole time that is over; it never falls. None where it is not known."""
        left = self.left()
        if left is None:
            return None
        elapsed = self.elapsed
        fraction = elapsed / (elapsed + left) if elapsed + left > 0 else 0.0
        self._furthest = max(self._furthest, fraction)
        return self._furthest

    def _counted(self, text: str) -> None:
        found = count_in(text)
        if found is not None:
            self._count, self._counted_at = found, self.elapsed

    def _choose(self) -> None:
        """The course most like what was seen so far; what was expected before stays counted."""
        chosen = nearest(self.courses, self._keys)
        if chosen is not self._course:
            self._course, self._place = chosen, -1
            for key in self._keys[:-1]:
                later = [i for i in range(self._place + 1, len(chosen)) if chosen[i].key == key]
                self._place = later[0] if later else self._place

    def _after(self) -> float:
        """Seconds of the course after the present stage."""
        return sum(each.seconds for each in self._course[self._place + 1 :])

    def _pace(self) -> float:
        """Seconds of this run for one of the course."""
        prior = PRIOR * sum(each.seconds for each in self._course)
        known = self._expected_before + prior
        return (self._matched_before + prior) / known if known > 0 else 1.0

    def _left_of_stage(self, expected: float) -> float:
        spent = self.clock() - self._stage_start
        by_time = max(self._pace() * expected - spent, TAIL * spent)
        if not 0 < self._load < 1:
            return by_time
        by_load = spent * (1 - self._load) / self._load
        return (1 - self._load) * by_time + self._load * by_load

    def _left_of_count(self, count: Count) -> float | None:
        fraction = count.done / count.all
        if fraction < LEAST_COUNTED:
            return None
        each, after = self._counted_at / count.done, count.all - count.done
        since = self.elapsed - self._counted_at
        return max(each * after - since, each * (after - 1), 0.0)
