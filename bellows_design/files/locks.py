"""Locks on files and folders, which end with the process that holds them, however it ends.

They are advisory, and a network's file system may lack them: then nothing is locked. Folders are
locked by themselves, so that no file of ours is needed beside them.
"""

from __future__ import annotations

import errno
import os
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

POLL_SECONDS = 0.05


@contextmanager
def locked(path: Path, seconds: float = 0.0) -> Iterator[None]:
    """Within the block ``path`` is locked; waits so many seconds for others that lock it.

    Raises ``TimeoutError`` if they keep it, and ``OSError`` if ``path`` cannot be opened.
    """
    if sys.platform == "win32":
        yield
        return
    descriptor = os.open(path, os.O_RDONLY | os.O_CLOEXEC | os.O_NONBLOCK)
    try:
        _lock(descriptor, time.monotonic() + seconds)
        yield
    finally:
        os.close(descriptor)


def is_locked(path: Path) -> bool:
    """True if a process, this one too, holds a lock on ``path``."""
    if path.is_symlink():
        return False
    try:
        with locked(path):
            return False
    except TimeoutError:
        return True
    except OSError:
        return False


def _lock(descriptor: int, deadline: float) -> None:
    """Take the lock, or go without where the file system has none."""
    import fcntl

    while True:
        try:
            return fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            if time.monotonic() >= deadline:
                raise TimeoutError(errno.ETIMEDOUT, "another run is at work there") from None
            time.sleep(POLL_SECONDS)
        except OSError:
            return None
