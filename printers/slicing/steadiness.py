"""Running a program so that it does the same each time.

PrusaSlicer draws random seams from a generator without a seed, in the order in which its threads
come by, and its walls depend on the order of addresses in memory, which Linux changes from run to
run. On one processor and with fixed addresses it writes the same G-code again; either alone does
not do (PrusaSlicer 2.5, the shipped finger).
"""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable
from pathlib import Path

from printers.errors import PrintersError
from printers.slicing.running import run

SECONDS_TO_TRY = 60.0
"""For a program that does nothing."""


def steadily(folder: Path) -> tuple[str, ...]:
    """What stands before a command so that it is run steadily; nothing where that cannot be.

    It takes `taskset` and `setarch` of util-linux, and a system that lets addresses be fixed:
    containers may not.
    """
    taskset, setarch, nothing = (shutil.which(name) for name in ("taskset", "setarch", "true"))
    affinity: Callable[[int], set[int]] | None = getattr(os, "sched_getaffinity", None)
    if not (taskset and setarch and nothing and affinity):
        return ()
    processors = sorted(affinity(0))
    one = processors[os.getpid() % len(processors)]  # programs side by side take different ones
    prefix = (taskset, "--cpu-list", str(one), setarch, "--addr-no-randomize")
    try:
        works = run([*prefix, nothing], folder, SECONDS_TO_TRY).status == 0
    except PrintersError:
        works = False
    return prefix if works else ()
