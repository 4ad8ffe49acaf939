"""Telling the user what a long run is doing: the stage, the load reached, the angle so far.

Goes to stderr, so that stdout stays free for results. On a terminal one line is kept up to date;
elsewhere (a log, a pipe) a line is printed for each stage and at most every two seconds within it.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Protocol, TextIO

QUIET_SECONDS = 2.0
"""s. No stage shorter than this needs a word, and none longer goes without one."""


class Progress(Protocol):
    """Listens to a run."""

    def stage(self, name: str) -> None:
        """A stage begins: geometry, check, mesh, solve, export."""

    def load(self, fraction: float, angle: float) -> None:
        """The solver stands at ``fraction`` of the load with the tip turned by ``angle`` (°)."""


@dataclass(frozen=True)
class Silence:
    """Progress nobody listens to."""

    def stage(self, name: str) -> None:
        """Ignored."""

    def load(self, fraction: float, angle: float) -> None:
        """Ignored."""


SILENCE: Progress = Silence()
"""The default where a run takes a ``Progress``."""


@dataclass
class Narrator:
    """Progress as lines of text, given to ``say``; seconds are counted by ``clock``."""

    say: Callable[[str], None]
    pause: float = QUIET_SECONDS
    clock: Callable[[], float] = time.monotonic
    _start: float = field(init=False)
    _spoken: float = field(init=False, default=-1e9)
    _stage: str = field(init=False, default="")

    def __post_init__(self) -> None:
        self._start = self.clock()

    def stage(self, name: str) -> None:
        """Say which stage begins."""
        self._stage = name
        self._tell(name)

    def load(self, fraction: float, angle: float) -> None:
        """Say how far the load has come, but not more often than every ``pause`` seconds."""
        if self.clock() - self._spoken >= self.pause:
            turned = f", bent {angle:.0f}°" if angle == angle else ""
            self._tell(f"{self._stage}: {100 * fraction:.0f} % of the load{turned}")

    def _tell(self, text: str) -> None:
        self._spoken = self.clock()
        self.say(f"[{self._spoken - self._start:6.1f} s] {text}")


@contextmanager
def on_stderr(stream: TextIO | None = None) -> Iterator[Progress]:
    """Progress on stderr: one live line on a terminal, plain lines elsewhere."""
    stream = stream or sys.stderr
    if stream.isatty():
        from rich.console import Console

        with Console(file=stream).status("") as status:
            yield Narrator(lambda text: status.update(text.replace("[", r"\[")), pause=0.1)
    else:
        yield Narrator(lambda text: print(text, file=stream, flush=True))
