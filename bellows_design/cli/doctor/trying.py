"""Probes, each in a process of its own with a time limit, some beside each other."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from typing import Any

LATE = "no answer within"
"""Begins why a probe was ended: it may work all the same."""

SECONDS = 20.0
"""s. After that a probe is ended: on an idle machine each takes less than three."""


@dataclass(frozen=True)
class Tried:
    """What a probe said, by module; ``broken`` is why it ended before its end, by module."""

    said: Mapping[str, dict[str, Any]] = field(default_factory=dict)
    broken: Mapping[str, str] = field(default_factory=dict)


def tried(names: Sequence[str], seconds: float = SECONDS) -> dict[str, Tried]:
    """Every probe of these names, as many at a time as there are processors."""
    workers = min(len(names), max(2, os.cpu_count() or 2))
    with ThreadPoolExecutor(workers) as pool:
        found = pool.map(lambda name: _tried(name, seconds), names)
        return dict(zip(names, found, strict=True))


def _tried(name: str, seconds: float) -> Tried:
    command = [sys.executable, "-m", "bellows_design.cli.doctor.probes", name]
    settings = {**os.environ, "PYTHONWARNINGS": "ignore"}
    try:
        done = subprocess.run(
            command, capture_output=True, timeout=seconds, env=settings, stdin=subprocess.DEVNULL
        )
        output, why = done.stdout, _why(done.returncode)
    except subprocess.TimeoutExpired as error:
        output, why = error.stdout or b"", f"{LATE} {seconds:g} s"
    except OSError as error:
        return Tried(broken={name: f"no process could be started: {error.strerror}"})
    return _read(name, output, why)


def _why(status: int) -> str:
    if status < 0:
        return f"it ended by signal {-status}"
    return f"it ended with status {status}" if status else ""


def _read(name: str, output: bytes, why: str) -> Tried:
    """What stands on the lines; what began and did not end is broken."""
    said: dict[str, dict[str, Any]] = {}
    begun = name
    for line in output.splitlines():
        try:
            content = json.loads(line)
        except ValueError:
            continue
        begun = content.get("begins", begun)
        if "module" in content:
            said[content["module"]] = content
    missing = begun not in said and (why or not said)
    return Tried(said, {begun: why or "it said nothing"} if missing else {})
