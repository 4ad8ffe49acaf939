"""How far a sweep is, how fast, and how long it will take."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from bellows_design.batch.answer import Answer
from bellows_design.progress import Progress

PAUSE, SHARE = 2.0, 0.01
"""Least time between two reports: so many seconds, and that share of what a run took so far; the
log of a night has some hundred lines."""


@dataclass
class Pace:
    """Counts answers and reports them: a counter that belongs to one run."""

    progress: Progress
    total: int
    before: int = 0
    clock: Callable[[], float] = time.monotonic
    _came: int = 0
    _failed: int = 0
    _began: float = field(init=False)
    _told: float = field(init=False)

    def __post_init__(self) -> None:
        self._began = self._told = self.clock()
        kept = f", {self.before} of them before" if self.before else ""
        self.progress.stage(f"{self.total} designs{kept}")

    def count(self, came: Sequence[Answer]) -> None:
        """More answers came."""
        self._came += len(came)
        self._failed += sum(not answer.done for answer in came)
        now = self.clock()
        last = self.before + self._came == self.total
        if last or now - self._told >= max(PAUSE, SHARE * (now - self._began)):
            self._told = now
            self.progress.stage(self._report(now - self._began))

    def _report(self, seconds: float) -> str:
        answered = self.before + self._came
        failed = f" ({self._failed} failed)" if self._failed else ""
        rate = self._came / seconds if seconds else 0.0
        left = (self.total - answered) / rate if rate else 0.0
        return (
            f"{answered} of {self.total} designs{failed}, {60 * rate:.3g} a minute, "
            f"{duration(left)} left"
        )


def duration(seconds: float) -> str:
    """In words: ``40 s``, ``12 min``, ``3 h 20 min``, ``2 d 4 h``."""
    minutes = round(seconds / 60)
    if seconds < 100:
        return f"{seconds:.0f} s"
    if minutes < 100:
        return f"{minutes} min"
    hours, minutes = divmod(minutes, 60)
    return f"{hours} h {minutes} min" if hours < 48 else f"{hours // 24} d {hours % 24} h"
