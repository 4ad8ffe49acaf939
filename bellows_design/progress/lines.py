"""Progress as plain lines: for a log or a pipe, at most one every two seconds within a stage."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field

PAUSE = 2.0
"""s. Least time between two lines within a stage."""

WORTH_NAMING = 0.1
"""Fraction of a budget from which on it is named."""


@dataclass
class ProgressLines:
    """Progress as lines of text, given to ``write``; seconds are counted by ``clock``."""

    write: Callable[[str], None]
    pause: float = PAUSE
    clock: Callable[[], float] = time.monotonic
    _start: float = field(init=False)
    _written: float = field(init=False, default=-1e9)
    _stage: str = field(init=False, default="")

    def __post_init__(self) -> None:
        self._start = self.clock()

    def stage(self, name: str) -> None:
        """Write which stage begins."""
        self._stage = name
        self._write(name)

    def load(self, fraction: float, angle: float, spent: float = 0.0) -> None:
        """Write how far the load has come, but not more often than every ``pause`` seconds."""
        if self.clock() - self._written >= self.pause:
            self._write(f"{self._stage}: {load_text(fraction, angle, spent)}")

    def note(self, text: str) -> None:
        """Write a line that stays."""
        self.write(f"[{self.clock() - self._start:6.1f} s] {text}")

    def _write(self, text: str) -> None:
        self._written = self.clock()
        self.write(f"[{self._written - self._start:6.1f} s] {text}")


def load_text(fraction: float, angle: float, spent: float) -> str:
    """How far a load has come, a fraction; ``angle`` in degrees, NaN where there is none."""
    turned = f", bent {angle:.0f}°" if angle == angle else ""
    budget = f", {100 * spent:.0f} % of its budget spent" if spent >= WORTH_NAMING else ""
    return f"{100 * fraction:.0f} % of the load{turned}{budget}"
