"""What a long run is doing: the stage, the load reached, the angle so far.

It goes to stderr, so that stdout stays free for results. On a terminal one line is kept up to date;
elsewhere (a log, a pipe) a line is printed for each stage and at most every two seconds within it.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Protocol, TextIO

PAUSE = 2.0
"""s. Least time between two lines within a stage."""

WORTH_NAMING = 0.1
"""Fraction of a budget from which on it is named."""


class Progress(Protocol):
    """Receives what a run is doing."""

    def stage(self, name: str) -> None:
        """A stage begins: geometry, check, mesh, solve, export."""

    def load(self, fraction: float, angle: float, spent: float = 0.0) -> None:
        """The solver is at ``fraction`` of the load, with the tip turned by ``angle`` (degrees).

        ``spent``: fraction of the solve's budget of steps and seconds.
        """

    def note(self, text: str) -> None:
        """Something that is worth knowing afterwards, too."""


@dataclass(frozen=True)
class Silence:
    """Progress that is not reported."""

    def stage(self, name: str) -> None:
        """Ignored."""

    def load(self, fraction: float, angle: float, spent: float = 0.0) -> None:
        """Ignored."""

    def note(self, text: str) -> None:
        """Ignored."""


SILENCE: Progress = Silence()
"""The default where a run takes a ``Progress``."""


@dataclass
class ProgressLines:
    """Progress as lines of text, given to ``write``; seconds are counted by ``clock``.

    Notes go to ``write_lasting``, where ``write`` overwrites the line before.
    """

    write: Callable[[str], None]
    pause: float = PAUSE
    clock: Callable[[], float] = time.monotonic
    write_lasting: Callable[[str], None] | None = None
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
            turned = f", bent {angle:.0f}°" if angle == angle else ""
            budget = f", {100 * spent:.0f} % of its budget spent" if spent >= WORTH_NAMING else ""
            self._write(f"{self._stage}: {100 * fraction:.0f} % of the load{turned}{budget}")

    def note(self, text: str) -> None:
        """Write a line that stays."""
        (self.write_lasting or self.write)(f"[{self.clock() - self._start:6.1f} s] {text}")

    def _write(self, text: str) -> None:
        self._written = self.clock()
        self.write(f"[{self._written - self._start:6.1f} s] {text}")


@contextmanager
def on_stderr(stream: TextIO | None = None) -> Iterator[Progress]:
    """Progress on stderr: one live line on a terminal, plain lines elsewhere."""
    stream = stream or sys.stderr
    if stream.isatty():
        from rich.console import Console

        console = Console(file=stream, highlight=False)
        with console.status("") as status:
            yield ProgressLines(
                lambda text: status.update(text.replace("[", r"\[")),
                pause=0.1,
                write_lasting=lambda text: console.print(text, markup=False, soft_wrap=True),
            )
    else:
        yield ProgressLines(lambda text: print(text, file=stream, flush=True))
