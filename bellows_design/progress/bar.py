"""One line of a terminal that is kept up to date: what is done, a bar, the time left."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING, TextIO

from bellows_design.progress.estimate import Estimate
from bellows_design.progress.lines import load_text

if TYPE_CHECKING:
    from rich.console import Console
    from rich.text import Text

BAR, LEAST_BAR = 20, 50
"""Columns of the bar, and of the terminal that has room for one."""

FULL, EMPTY = "━", "─"


@dataclass
class ProgressBar:
    """Progress on one line; ``estimate`` knows how much is left. Notes stay above it."""

    console: Console
    estimate: Estimate
    _stage: str = ""
    _load: str = ""

    def stage(self, name: str) -> None:
        """Show which stage begins."""
        self.estimate.stage(name)
        self._stage, self._load = name, ""

    def load(self, fraction: float, angle: float, spent: float = 0.0) -> None:
        """Show how far the load has come."""
        self.estimate.load(fraction)
        self._load = f": {load_text(fraction, angle, spent)}"

    def note(self, text: str) -> None:
        """Write a line that stays."""
        self.estimate.note(text)
        line = f"[{self.estimate.elapsed:6.1f} s] {text}"
        self.console.print(line, markup=False, highlight=False, soft_wrap=True)

    def __rich__(self) -> Text:
        """The line, as wide as the terminal."""
        from rich.text import Text

        width = self.console.width - 1  # the last column makes some terminals wrap
        right = self._right(width)
        room = max(width - len(right) - 2, 8)
        what = f"{self._stage}{self._load}"
        shown = what if len(what) <= room else what[: room - 1] + "…"
        return Text(f"{shown:{room}}  {right}"[:width], no_wrap=True, overflow="crop")

    def _right(self, width: int) -> str:
        """Bar, percent and time, as far as they are known and have room."""
        done, left = self.estimate.done(), self.estimate.left()
        spent = duration(self.estimate.elapsed)
        if done is None or left is None:
            return spent
        said = f"{100 * done:3.0f} %, about {duration(left)} left"
        if width < LEAST_BAR:
            return f"{100 * done:.0f} %, {duration(left)} left"
        full = round(BAR * done)
        return f"{FULL * full}{EMPTY * (BAR - full)} {said}"


def duration(seconds: float) -> str:
    """In words: ``4 s``, ``40 s``, ``12 min``, ``3 h 20 min``; coarser the longer."""
    if seconds < 10:
        return f"{max(seconds, 1):.0f} s"
    if seconds < 95:
        return f"{5 * round(seconds / 5)} s"
    minutes = round(seconds / 60)
    hours, rest = divmod(minutes, 60)
    return f"{minutes} min" if minutes < 100 else f"{hours} h {rest} min"


@contextmanager
def bar_on(stream: TextIO, estimate: Estimate) -> Iterator[ProgressBar]:
    """A bar on the terminal for the length of the block; then its line is empty again."""
    from rich.console import Console
    from rich.live import Live

    console = Console(file=stream, highlight=False)
    bar = ProgressBar(console, estimate)
    with _restored(console), Live(bar, console=console, refresh_per_second=8, transient=True):
        yield bar


_live_consoles: list[Console] = []
"""Terminals whose cursor is hidden: to be shown again where a process ends at once."""


@contextmanager
def _restored(console: Console) -> Iterator[None]:
    _live_consoles.append(console)
    try:
        yield
    finally:
        _live_consoles.remove(console)


def leave_terminal() -> None:
    """Clear the line and show the cursor: the process ends before its bar does."""
    for console in _live_consoles:
        console.file.write("\r\x1b[2K\x1b[?25h")
        console.file.flush()
