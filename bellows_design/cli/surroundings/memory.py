"""Want of memory: recognised beforehand where a limit says so, else by the errors it causes.

Libraries written in C abort the process, or name any other cause, where they get no memory.
"""

from __future__ import annotations

import errno
import re

GEOMETRY, CHECK, EVALUATION = 1.3, 1.7, 2.2
"""Address space, GiB, without which the libraries of ``design``, of ``check``, and of all that
evaluates cannot be loaded and used. With two cores 1.2, 1.5 and 2.0 GiB were observed to suffice;
1.1, 1.3 and 1.9 GiB were not."""

EVALUATION_DATA = 0.95
"""The same of what may be allocated: 0.86 GiB were observed to suffice; with 0.6 the solver's
libraries end the process."""

_IN_WORDS = re.compile(r"failed to map segment|cannot allocate memory|out of memory", re.IGNORECASE)


def require_address_space(gib: float) -> None:
    """Raise ``MemoryError`` if this process is limited to less, or to too little to allocate."""
    from bellows_design.machine import address_space_gib, data_gib

    limit = address_space_gib()
    if limit is not None and limit < gib:
        raise MemoryError(
            f"this process is limited to {limit:.2f} GiB of address space (ulimit -v) but needs "
            f"{gib:g} GiB"
        )
    data = data_gib()
    if gib >= EVALUATION and data is not None and data < EVALUATION_DATA:
        raise MemoryError(
            f"this process is limited to {data:.2f} GiB of data (ulimit -d) but needs "
            f"{EVALUATION_DATA:g} GiB"
        )


def want_of_memory(error: BaseException) -> str | None:
    """One sentence if ``error`` comes from a want of memory; None for any other."""
    text = " ".join(str(error).split()).rstrip(".")
    if isinstance(error, MemoryError):
        return f"not enough memory: {text or 'nothing more could be allocated'}."
    if not isinstance(error, OSError | ImportError):
        return None
    if getattr(error, "errno", None) == errno.ENOMEM or _IN_WORDS.search(text):
        return f"not enough memory to load a library or start a program: {text[:200]}."
    return None
