"""Clears up after a program that was killed: ends what it ran in a folder, and removes the folder.

It runs as a program of its own, `python guardian.py FOLDER`, and reads from a pipe whose other end
is held by whoever works in the folder. The pipe ends when that program does, however it does; a
program that clears up by itself leaves nothing to do here. It uses the standard library alone, so
that it starts in a few hundredths of a second.
"""

from __future__ import annotations

import os
import shutil
import signal
import sys
import time
from contextlib import suppress
from pathlib import Path

RUNNING = "running"
"""File with the number of the program that runs in the folder, as long as it does."""

ATTEMPTS, PAUSE = 50, 0.1
"""To remove the folder, s apart: a program that is being ended may still write to it."""


def end(process: int) -> None:
    """End a program that leads its own session, and all that it started."""
    with suppress(OSError):
        if hasattr(os, "killpg"):
            os.killpg(process, signal.SIGKILL)
        else:
            os.kill(process, signal.SIGTERM)


def clear_up(folder: Path) -> None:
    """End what runs in the folder, and remove it."""
    with suppress(OSError, ValueError):
        end(int((folder / RUNNING).read_text()))
    for _ in range(ATTEMPTS):
        shutil.rmtree(folder, ignore_errors=True)
        if not folder.exists():
            return
        time.sleep(PAUSE)


if __name__ == "__main__":
    sys.stdin.buffer.read()
    clear_up(Path(sys.argv[1]))
