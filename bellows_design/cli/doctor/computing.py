"""What computations stand on: linear solver, compiled functions, processors, memory."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from typing import Any

from bellows_design.cli.doctor.finding import Finding, Verdict
from bellows_design.cli.doctor.libraries import how_to_mend
from bellows_design.cli.doctor.trying import LATE, Tried

GROUP = "computing"
MOST_SECONDS = 2.0
"""s, for a system of four thousand unknowns; it takes some hundredths."""

NO_LIMIT = 2.0**20
"""GiB. Control groups of version 1 state about so much where nothing is limited."""

LEAST_GIB, COMFORTABLE_GIB = 0.8, 2.0
"""Memory below which nothing is computed, and below which only coarse meshes are."""


def linear_solver(tried: Mapping[str, Tried]) -> Finding:
    """Which one is used, and its time for a small system."""
    said, why = _answer(tried, "solver", "linear solver")
    if not said.get("works"):
        return _broken("linear solver", said, why or "its solution is wrong", "scipy")
    name, seconds = str(said["solver"]), float(said["seconds"])
    shown = f"{name}, {said['unknowns']} unknowns in {1000 * seconds:.0f} ms"
    mend, verdict = _faster(name), _verdict_on(name, seconds)
    return Finding(GROUP, "linear solver", verdict, shown, mend if verdict == "warn" else "")


def _broken(name: str, said: Mapping[str, Any], why: str, package: str) -> Finding:
    """What does not work; a warning where it only did not answer in time."""
    error = " ".join(str(said.get("error") or why).split())[:200]
    if error.startswith(LATE):
        return Finding(GROUP, name, "warn", error, "the machine is busy: try again later")
    return Finding(GROUP, name, "fail", error, how_to_mend(error, package))


def _verdict_on(name: str, seconds: float) -> Verdict:
    slow = seconds > MOST_SECONDS or "superlu" in name.lower()
    return "warn" if slow else "ok"


def _faster(name: str) -> str:
    if "superlu" in name.lower():
        return "several times faster with pip install mkl (x86-64), or feral-solver"
    return "something else may be using the processors: try again when it is done"


def compiled_functions(tried: Mapping[str, Tried]) -> Finding:
    """Where they are kept, so that they are compiled once."""
    said, why = _answer(tried, "compiler", "numba")
    if not said.get("works"):
        return _broken("compiled functions", said, why or "a compiled function is wrong", "numba")
    folder = str(said["folder"])
    if said["writable"]:
        return Finding(GROUP, "compiled functions", "ok", f"kept in {folder}")
    return Finding(
        GROUP,
        "compiled functions",
        "warn",
        f"{folder or 'their folder'} cannot be written: compiled anew in every run",
        "set NUMBA_CACHE_DIR to a folder that can be written",
    )


def processors(tried: Mapping[str, Tried]) -> Finding:
    """How many there are, and how many threads are used."""
    from bellows_design.machine import processor

    count, usable = os.cpu_count() or 1, _usable()
    said, _ = _answer(tried, "compiler", "numba")
    number = said.get("threads")
    threads = f", {number} thread{'s' * (number != 1)} of numba" if number else ""
    limited = "" if usable == count else f", {usable} of them for this process"
    shown = f"{processor()}, {count} processors{limited}{threads}"
    if hasattr(os, "getloadavg") and os.getloadavg()[0] > 2 * count:
        busy = f"{shown}; load average {os.getloadavg()[0]:.1f}"
        return Finding(GROUP, "processors", "warn", busy, "other programs use them: all is slower")
    return Finding(GROUP, "processors", "ok", shown)


def _usable() -> int:
    affinity = getattr(os, "sched_getaffinity", None)
    return len(affinity(0)) if affinity is not None else os.cpu_count() or 1


def memory() -> Iterator[Finding]:
    """Of the machine, of its container, and what is free."""
    from bellows_design.machine import CONTROL_GROUPS, limit_in, memory_gib, physical_memory

    whole, usable = physical_memory(), memory_gib()
    limits = [size for size in map(limit_in, CONTROL_GROUPS) if size and size < NO_LIMIT]
    said = "unknown" if usable is None else f"{usable:.1f} GiB to use"
    if whole is not None:
        said += f" of {whole:.1f} GiB"
    if limits:
        said += f", limit of the container {min(limits):.1f} GiB"
    verdict: Verdict = "ok"
    if usable is not None and usable < COMFORTABLE_GIB:
        verdict = "fail" if usable < LEAST_GIB else "warn"
    mend = "" if verdict == "ok" else f"give it {COMFORTABLE_GIB:g} GiB or more: see ulimit -v"
    yield Finding(GROUP, "memory", verdict, said, mend)


def _answer(tried: Mapping[str, Tried], probe: str, module: str) -> tuple[dict[str, Any], str]:
    """What a probe said of a module, and why it did not."""
    found = tried.get(probe, Tried())
    return dict(found.said.get(module, {})), "; ".join(found.broken.values())
