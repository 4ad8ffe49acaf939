"""What a long run is doing, told on stderr, so that stdout stays free for results.

On a terminal one line with a bar and the time left is kept up to date; elsewhere (a log, a pipe) a
line is printed for each stage and at most every two seconds within it.
"""

from __future__ import annotations

from bellows_design.progress.listener import SILENCE, Progress, Silence
from bellows_design.progress.shown import on_stderr, shown_as

__all__ = ["SILENCE", "Progress", "Silence", "on_stderr", "shown_as"]
