"""Threads that a solve takes, where two solves run side by side."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numba as numba_without_types

from solver.linear.pardiso import threads_of_mkl

numba: Any = numba_without_types

SAFE_LAYERS = ("omp", "tbb")
"""numba's ways to run loops in parallel that several threads of a program may use at once."""


def may_run_side_by_side() -> bool:
    """Whether two solves in two threads are safe, and have a processor each."""
    return numba.get_num_threads() > 1 and numba.threading_layer() in SAFE_LAYERS


@contextmanager
def one_thread() -> Iterator[None]:
    """Within the block, what the calling thread solves takes one processor; the bits are the same.

    Threads of a parallel loop that wait for each other would take those of the other solve.
    """
    usual = numba.get_num_threads()
    numba.set_num_threads(1)
    try:
        with threads_of_mkl(1):
            yield
    finally:
        numba.set_num_threads(usual)
