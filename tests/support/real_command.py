"""The real command as a process, in surroundings that a shell makes."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parents[2]
ITS_OWN = ("BELLOWS_CACHE", "COLUMNS", "HOME", "NUMBA_CACHE_DIR", "PATH", "TMPDIR", "VIRTUAL_ENV")
"""Variables that a test passes on; all others might disturb it."""


@dataclass(frozen=True)
class Ended:
    """What a command wrote, and its exit status as a shell knows it."""

    status: int
    out: str
    err: str


def bellows(
    *arguments: str | bytes,
    redirected: str = "",
    limits: str = "",
    variables: Mapping[str, str] | None = None,
    folder: Path | None = None,
    seconds: float = 120.0,
) -> Ended:
    """Run ``bellows`` with ``arguments``.

    ``redirected`` (``>/dev/full``) and ``limits`` (``ulimit -f 100;``) are the shell's words.
    """
    words = [os.fsencode(word) for word in arguments]
    script = f'{limits} exec "$0" -m bellows_design "$@" {redirected}'
    usual = {name: os.environ[name] for name in ITS_OWN if name in os.environ}
    done = subprocess.run(
        [b"bash", b"-c", script.encode(), os.fsencode(sys.executable), *words],
        cwd=folder or ROOT,
        env={**usual, "PYTHONPATH": str(ROOT), **(variables or {})},
        capture_output=True,
        timeout=seconds,
    )
    status = done.returncode if done.returncode >= 0 else 128 - done.returncode
    out, err = (text.decode("utf-8", "replace") for text in (done.stdout, done.stderr))
    return Ended(status, out, err)
