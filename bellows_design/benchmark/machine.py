"""The machine that times are measured on."""

from __future__ import annotations

import os
import platform
import sys
from pathlib import Path
from typing import Any

from bellows_design.versions import versions

MIB, GIB = 2**20, 2**30


def machine() -> dict[str, Any]:
    """Processor, cores, memory (GiB), load average of the last minute, versions.

    What the platform does not tell is None. A load average far above 0 means that others were
    computing too, and that the times are too long.
    """
    return {
        "processor": _processor(),
        "cores": os.cpu_count(),
        "memory_gib": _memory_gib(),
        "load_average": os.getloadavg()[0] if hasattr(os, "getloadavg") else None,
        "system": f"{platform.system()} {platform.machine()}",
        "versions": versions(),
    }


def peak_memory_mib() -> float | None:
    """Largest memory this process has held so far, MiB; None where the platform does not tell."""
    try:
        import resource
    except ImportError:
        return None
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return peak / MIB if sys.platform == "darwin" else peak * 1024 / MIB


def _processor() -> str:
    """The processor's name, as well as the platform knows it."""
    try:
        lines = Path("/proc/cpuinfo").read_text("utf-8", "replace").splitlines()
    except OSError:
        lines = []
    names = (line.partition(":")[2].strip() for line in lines if line.startswith("model name"))
    return next(names, "") or platform.processor() or platform.machine()


def _memory_gib() -> float | None:
    try:
        return os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") / GIB
    except (AttributeError, ValueError, OSError):
        return None
