"""The machine this runs on, and how much of it a container may use.

psutil measures the machine on every platform; the memory it reports is the host's, so the limit of
a container's control group, version 1 or 2, is read besides.
"""

from __future__ import annotations

import os
import platform
import sys
from dataclasses import asdict, dataclass
from functools import cache
from pathlib import Path
from typing import Any

from bellows_design.versions import versions

MIB, GIB = 2**20, 2**30

ADDRESSES_OF_LIBRARIES = 1.4
"""GiB of address space that the libraries take without using memory."""

CONTROL_GROUPS = (
    Path("/sys/fs/cgroup/memory.max"),
    Path("/sys/fs/cgroup/memory/memory.limit_in_bytes"),
)
"""Where Linux states a container's limit of memory: control groups of version 2 and 1."""


@dataclass(frozen=True)
class Machine:
    """What times are measured on; None where the platform does not say.

    ``memory_gib`` is the container's where that is less. A ``load_average`` of the last minute far
    above 0 means that others were computing too, and that the times are too long.
    """

    processor: str
    cores: int | None
    memory_gib: float | None
    load_average: float | None
    system: str
    versions: dict[str, str]

    def to_dict(self) -> dict[str, Any]:
        """Plain values for JSON."""
        return asdict(self)


def machine() -> Machine:
    """This machine, as it is now."""
    import psutil

    return Machine(
        processor=processor(),
        cores=psutil.cpu_count(),
        memory_gib=memory_gib(),
        load_average=os.getloadavg()[0] if hasattr(os, "getloadavg") else None,
        system=f"{platform.system()} {platform.machine()}",
        versions=versions(),
    )


@cache
def memory_gib() -> float | None:
    """Memory of this machine, or of the container this runs in, GiB; None where unknown.

    Where the address space of the process is limited, what that leaves beside the libraries.
    """
    known = [size for size in (physical_memory(), *map(limit_in, CONTROL_GROUPS)) if size]
    space = address_space_gib()
    known += [] if space is None else [max(0.0, space - ADDRESSES_OF_LIBRARIES)]
    return min(known, default=None)


def address_space_gib() -> float | None:
    """Limit of this process's address space (``ulimit -v``), GiB; None without one."""
    return _limit_of_process("RLIMIT_AS")


def data_gib() -> float | None:
    """Limit of what this process may allocate (``ulimit -d``), GiB; None without one."""
    return _limit_of_process("RLIMIT_DATA")


def _limit_of_process(name: str) -> float | None:
    try:
        import resource
    except ImportError:  # Windows
        return None
    limit, _ = resource.getrlimit(getattr(resource, name))
    return None if limit == resource.RLIM_INFINITY else limit / GIB


def peak_memory_mib() -> float | None:
    """Largest memory this process has held so far, MiB; None where the platform does not say."""
    if sys.platform == "win32":
        import psutil

        return float(psutil.Process().memory_info().peak_wset / MIB)
    try:
        import resource
    except ImportError:
        return None
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return peak / MIB if sys.platform == "darwin" else peak * 1024 / MIB


def physical_memory() -> float | None:
    """Memory of this machine, GiB; None where unknown."""
    import psutil

    try:
        return float(psutil.virtual_memory().total / GIB)
    except OSError:  # a sandbox may hide /proc
        return None


def limit_in(file: Path) -> float | None:
    """The limit that a file of a control group states, GiB; None without one."""
    try:
        return int(file.read_text("ascii")) / GIB
    except (OSError, ValueError):  # ValueError: "max"
        return None


def processor() -> str:
    """The processor's name, as far as the platform states it."""
    try:
        lines = Path("/proc/cpuinfo").read_text("utf-8", "replace").splitlines()
    except OSError:
        lines = []
    names = (line.partition(":")[2].strip() for line in lines if line.startswith("model name"))
    return next(names, "") or platform.processor() or platform.machine()
