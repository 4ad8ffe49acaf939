"""What an evaluation may take of the machine, and what that machine has."""

from __future__ import annotations

import math
import os
import sys
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

from bellows_design.errors import DesignError

GIB = 2**30

SHARE, MOST, FALLBACK = 0.75, 4.0, 4.0
"""By default an evaluation may take that share of the machine's memory, at most so many GiB (for
110 000 tetrahedra, minutes for each mesh), and so many where the memory is unknown."""

LEAST_MEMORY = 0.8
"""GiB. The libraries alone take nearly as much."""

MESH_SECONDS, LONGEST = 120.0, 86_400.0
"""s. Default and bound of the time limit of one mesh; the largest meshes took half of that."""

CONTROL_GROUPS = (
    Path("/sys/fs/cgroup/memory.max"),
    Path("/sys/fs/cgroup/memory/memory.limit_in_bytes"),
)
"""Where Linux tells a container how much of the machine it may have."""


def default_memory() -> float:
    """Memory that an evaluation may take if nobody says otherwise, GiB."""
    there = machine_memory()
    return FALLBACK if there is None else max(LEAST_MEMORY, min(MOST, SHARE * there))


@dataclass(frozen=True)
class Budget:
    """Limits of an evaluation: ``memory`` in GiB, and ``mesh_seconds`` for each of its meshes.

    Raises ``DesignError`` if one is out of bounds.
    """

    memory: float = field(default_factory=default_memory)
    mesh_seconds: float = MESH_SECONDS

    def __post_init__(self) -> None:
        if not (math.isfinite(self.memory) and self.memory >= LEAST_MEMORY):
            raise DesignError(
                f"memory is {self.memory:g} GiB but must be finite and at least {LEAST_MEMORY:g} "
                "GiB."
            )
        if not 0 < self.mesh_seconds <= LONGEST:
            raise DesignError(
                f"mesh_seconds is {self.mesh_seconds:g} s but must lie above 0 and not above "
                f"{LONGEST:g} s."
            )


@cache
def machine_memory() -> float | None:
    """Memory of this machine, or of the container this runs in, GiB; None where unknown."""
    physical = _windows_memory() if sys.platform == "win32" else _posix_memory()
    known = [amount for amount in (physical, *map(_limit_in, CONTROL_GROUPS)) if amount]
    return min(known, default=None)


def _posix_memory() -> float | None:
    try:
        return os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") / GIB
    except (AttributeError, ValueError, OSError):
        return None


def _windows_memory() -> float | None:
    import ctypes

    kib = ctypes.c_ulonglong()
    windll = getattr(ctypes, "windll", None)
    if windll is None or not windll.kernel32.GetPhysicallyInstalledSystemMemory(ctypes.byref(kib)):
        return None
    return kib.value * 1024 / GIB


def _limit_in(file: Path) -> float | None:
    """The limit that a file of a control group states, GiB; None without one."""
    try:
        return int(file.read_text("ascii")) / GIB
    except (OSError, ValueError):  # ValueError: "max"
        return None


DEFAULT = Budget()
