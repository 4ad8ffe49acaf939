"""Where progress is shown, and how: a bar on a terminal, lines elsewhere, or nothing."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from typing import TextIO

from bellows_design.progress.course import Course
from bellows_design.progress.estimate import Estimate
from bellows_design.progress.lines import ProgressLines
from bellows_design.progress.listener import SILENCE, Progress


@dataclass(frozen=True)
class Shown:
    """How progress is shown: not at all if ``quiet``.

    ``courses`` gives those that earlier runs took; ``learn`` is given that of a run which ended
    well. Both are asked only where time is told, on a terminal.
    """

    quiet: bool = False
    courses: Callable[[], Sequence[Course]] = tuple
    learn: Callable[[Course], None] | None = None


_shown: ContextVar[Shown] = ContextVar("shown", default=Shown())  # noqa: B039 - it is frozen


@contextmanager
def shown_as(shown: Shown) -> Iterator[None]:
    """Within the block ``on_stderr`` shows progress so."""
    token = _shown.set(shown)
    try:
        yield
    finally:
        _shown.reset(token)


@contextmanager
def on_stderr(stream: TextIO | None = None) -> Iterator[Progress]:
    """Progress on stderr: one live line on a terminal, plain lines elsewhere, or nothing."""
    how, stream = _shown.get(), stream or sys.stderr
    if how.quiet:
        yield SILENCE
    elif stream.isatty() and os.environ.get("TERM", "") != "dumb":
        from bellows_design.progress.bar import bar_on

        estimate = Estimate(how.courses())
        with bar_on(stream, estimate) as bar:
            yield bar
        estimate.close()
        if how.learn is not None and estimate.taken and not estimate.counts:
            how.learn(tuple(estimate.taken))
    else:
        yield ProgressLines(lambda text: print(text, file=stream, flush=True))
