"""Settings of the environment that would stop a command for no good reason, put right.

Nothing here is a user's wish about a result: widths of a terminal at which nothing can be read,
warnings as errors, threads of a name that does not exist, and a stack too small for the CAD kernel.
"""

from __future__ import annotations

import os
import warnings

from bellows_design.errors import DesignError
from solver.meshing.limits import allow_stack

WIDTHS = ("COLUMNS", "LINES", "TERMINAL_WIDTH")
SMALLEST_WIDTH, LARGEST_WIDTH = 20, 10_000

THREADING_LAYERS = {"default", "safe", "threadsafe", "forksafe", "tbb", "omp", "workqueue"}
"""What numba knows."""


def use_plain_environment() -> None:
    """Ignore widths that are none, warnings as errors, and the like; allow a usual stack."""
    for name in WIDTHS:
        if name in os.environ and not _is_width(os.environ[name]):
            del os.environ[name]
    if os.environ.get("NUMBA_THREADING_LAYER", "default") not in THREADING_LAYERS:
        del os.environ["NUMBA_THREADING_LAYER"]
    if any(action == "error" for action, *_ in warnings.filters):
        os.environ.pop("PYTHONWARNINGS", None)
        warnings.resetwarnings()
        warnings.simplefilter("ignore")
    allow_stack()


def require_working_folder() -> None:
    """Raise ``DesignError`` if the working folder was deleted: MKL ends the process then."""
    try:
        os.getcwd()
    except FileNotFoundError:
        raise DesignError(
            "the working folder was deleted; change to another one, and try again."
        ) from None


def _is_width(text: str) -> bool:
    return text.isascii() and text.isdigit() and SMALLEST_WIDTH <= int(text[:9]) <= LARGEST_WIDTH
