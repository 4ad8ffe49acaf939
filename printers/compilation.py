"""``numba.njit`` whose cache on disk is a convenience: where there can be none, it goes without.

numba itself refuses to define a function if neither the package nor the user's home can be written
to, as in a container or a daemon, and ends a computation if the disk is full when it saves one.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from pickle import UnpicklingError
from typing import Any, TypeVar

import numba
from numba.core import caching

FunctionCache: Any = caching.FunctionCache
Function = TypeVar("Function", bound=Callable[..., Any])


def njit(cache: bool = False, **options: Any) -> Callable[[Function], Function]:
    """Decorator: compile with numba's ``options``; ``cache`` on disk where that is possible."""

    def decorate(function: Function) -> Function:
        dispatcher: Any = numba.njit(**options)(function)
        if cache:
            with suppress(RuntimeError, OSError):  # there is no folder that may be written to
                dispatcher._cache = _Cache(function)
        decorated: Function = dispatcher
        return decorated

    return decorate


class _Cache(FunctionCache):
    """What cannot be read is compiled anew, and what cannot be written is not kept."""

    def load_overload(self, *arguments: Any) -> Any:
        """The compiled function, or None."""
        try:
            return super().load_overload(*arguments)
        except (OSError, EOFError, UnpicklingError, ValueError):  # damaged, or another's
            with suppress(OSError):
                self.flush()
            return None

    def save_overload(self, *arguments: Any) -> None:
        """Keep a compiled function."""
        with suppress(OSError):
            super().save_overload(*arguments)
