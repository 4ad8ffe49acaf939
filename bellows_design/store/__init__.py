"""Results that are kept, so that nothing is computed twice.

A ``Store`` keeps ordinary evaluations in files, each under a ``Key`` of all that decides its
numbers; ``evaluated`` looks there before it computes.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from solver.lazy_names import imported_when_asked_for

if TYPE_CHECKING:
    from bellows_design.store.key import Key
    from bellows_design.store.lookup import evaluated
    from bellows_design.store.place import NoPlace, cache_folder
    from bellows_design.store.store import Holdings, Store

__all__ = ["Holdings", "Key", "NoPlace", "Store", "cache_folder", "evaluated"]

__getattr__ = imported_when_asked_for(
    __name__,
    {
        "key": ("Key",),
        "lookup": ("evaluated",),
        "place": ("NoPlace", "cache_folder"),
        "store": ("Holdings", "Store"),
    },
)
