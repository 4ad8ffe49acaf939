"""Running a program so that it does the same each time.

PrusaSlicer draws random seams from a generator without a seed, in the order in which its threads
come by, and its walls depend on the order of addresses in memory. Those change from run to run, and
with the environment, which lies in memory too. On one processor, with fixed addresses and always
the same environment it writes the same G-code again; nothing less does (PrusaSlicer 2.5, the
shipped finger).
"""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

from printers.errors import PrintersError
from printers.slicing.running import run

SECONDS_TO_TRY = 60.0
"""For a program that does nothing."""

ENVIRONMENT = {"PATH": "/usr/local/bin:/usr/bin:/bin", "LC_ALL": "C.UTF-8", "HOME": "/"}


@dataclass(frozen=True)
class Steadiness:
    """How a command is run.

    Attributes:
        prefix: What stands before it; empty if it cannot be run steadily.
        environment: Its environment; None for this program's.
    """

    prefix: tuple[str, ...] = ()
    environment: Mapping[str, str] | None = None


UNSTEADY = Steadiness()
"""As any program is run."""


def steadiness(folder: Path) -> Steadiness:
    """What this system allows.

    It takes `taskset` and `setarch` of util-linux, and a system that lets addresses be fixed:
    containers may not.
    """
    taskset, setarch, nothing = (shutil.which(name) for name in ("taskset", "setarch", "true"))
    affinity: Callable[[int], set[int]] | None = getattr(os, "sched_getaffinity", None)
    if not (taskset and setarch and nothing and affinity):
        return UNSTEADY
    processors = sorted(affinity(0))
    one = processors[os.getpid() % len(processors)]  # programs side by side take different ones
    prefix = (taskset, "--cpu-list", str(one), setarch, "--addr-no-randomize")
    try:
        works = run([*prefix, nothing], folder, SECONDS_TO_TRY, ENVIRONMENT).status == 0
    except PrintersError:
        works = False
    return Steadiness(prefix, ENVIRONMENT) if works else UNSTEADY
