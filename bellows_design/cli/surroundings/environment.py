"""Settings of the environment that would stop a command for no good reason, put right.

Nothing here is a user's wish about a result: widths of a terminal at which nothing can be read,
warnings as errors, threads of a name that does not exist, and a stack too small for the CAD kernel.
"""

from __future__ import annotations

import os
import sys
import warnings

WIDTHS = ("COLUMNS", "LINES", "TERMINAL_WIDTH")
SMALLEST_WIDTH, LARGEST_WIDTH = 20, 10_000

THREADING_LAYERS = {"default", "safe", "threadsafe", "forksafe", "tbb", "omp", "workqueue"}
"""What numba knows."""

STACK = 8 * 2**20
"""Bytes, the usual limit of a stack. The CAD kernel and Gmsh crash at a tenth of it."""


def use_plain_environment() -> None:
    """Ignore widths that are none, warnings as errors, and the like; allow a usual stack."""
    for name in WIDTHS:
        if name in os.environ and not _is_width(os.environ[name]):
            del os.environ[name]
    if os.environ.get("NUMBA_THREADING_LAYER", "default") not in THREADING_LAYERS:
        del os.environ["NUMBA_THREADING_LAYER"]
    if any(option.startswith("error") for option in sys.warnoptions):
        os.environ.pop("PYTHONWARNINGS", None)
        warnings.resetwarnings()
        warnings.simplefilter("ignore")
    allow_stack(STACK)


def allow_stack(size: int) -> int:
    """Raise this process's limit of the stack to ``size`` bytes, if it may; returns the limit."""
    if sys.platform == "win32":
        return size
    import resource

    soft, hard = resource.getrlimit(resource.RLIMIT_STACK)
    unlimited = resource.RLIM_INFINITY
    if soft == unlimited or soft >= size:
        return size
    wanted = size if hard == unlimited else min(size, hard)
    resource.setrlimit(resource.RLIMIT_STACK, (wanted, hard))
    return wanted


def _is_width(text: str) -> bool:
    return text.isascii() and text.isdigit() and SMALLEST_WIDTH <= int(text[:9]) <= LARGEST_WIDTH
