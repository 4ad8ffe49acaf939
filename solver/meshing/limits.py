"""Limits of a process that end Gmsh, whatever the solid: memory and the stack."""

from __future__ import annotations

import sys

ENOUGH_STACK = 8 * 2**20
"""Bytes, the usual limit. Gmsh crashes on ordinary solids at 256 KiB."""

WANT_OF_MEMORY = ("bad_alloc", "MemoryError", "Cannot allocate memory", "failed to map segment")
"""What C++, Python and the loader say where they get none."""


def allow_stack(size: int = ENOUGH_STACK) -> None:
    """Let this process's stack grow to ``size`` bytes, as far as its hard limit allows."""
    if sys.platform == "win32":
        return
    import resource

    soft, hard = resource.getrlimit(resource.RLIMIT_STACK)
    wanted = size if hard == resource.RLIM_INFINITY else min(size, hard)
    if soft != resource.RLIM_INFINITY and soft < wanted:
        resource.setrlimit(resource.RLIMIT_STACK, (wanted, hard))


def cause_of_end(how: str) -> str | None:
    """Why the mesher ended if not because of the solid: one sentence without its full stop.

    ``how`` is the name of a signal, or an exit status and the last line of its errors.
    """
    if how == "SIGKILL" or any(words in how for words in WANT_OF_MEMORY):
        return (
            f"Gmsh was stopped for want of memory ({how}), or by another program; leave it more "
            "memory, or allow a smaller mesh"
        )
    stack = _hard_limit_of_stack()
    if how in ("SIGSEGV", "SIGBUS") and stack < ENOUGH_STACK:
        return (
            f"Gmsh crashed where the stack is limited to {stack // 1024} KiB (ulimit -s); "
            f"allow it {ENOUGH_STACK // 1024}"
        )
    return None


def _hard_limit_of_stack() -> float:
    if sys.platform == "win32":
        return ENOUGH_STACK
    import resource

    _, hard = resource.getrlimit(resource.RLIMIT_STACK)
    return float("inf") if hard == resource.RLIM_INFINITY else hard
