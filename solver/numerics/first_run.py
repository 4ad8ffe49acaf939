"""The first run compiles the kernels, which takes a while: callers may want to say so."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from numba.core import caching, event

COMPILATION = "numba:compile"
"""numba's event for a function that is compiled, not read from the cache."""

Listener: Any = event.Listener
PACKAGE = __name__.partition(".")[0]


@contextmanager
def told_of_compilation(tell: Callable[[bool], None]) -> Iterator[None]:
    """Within the block ``tell`` is called once, when a function of the solver is to be compiled.

    It is given whether what is compiled is kept for later runs.
    """
    with event.install_listener(COMPILATION, _Once(tell)):
        yield


class CompilationClock(Listener):
    """Seconds in which functions were compiled, in any thread, each second once.

    numba compiles one function at a time, with those that it calls. One that another thread was
    compiling when the clock was made counts from then on.
    """

    def __init__(self) -> None:
        self.seconds = 0.0
        self._depth = 0
        self._began = time.perf_counter()
        self._lock = threading.Lock()

    def on_start(self, event: Any) -> None:
        """A function begins to be compiled."""
        with self._lock:
            if self._depth == 0:
                self._began = time.perf_counter()
            self._depth += 1

    def on_end(self, event: Any) -> None:
        """It is compiled."""
        with self._lock:
            self._depth = max(0, self._depth - 1)
            if self._depth == 0:
                now = time.perf_counter()
                self.seconds += now - self._began
                self._began = now


@contextmanager
def compilation_clock() -> Iterator[CompilationClock]:
    """Count the seconds of compilation within the block."""
    clock = CompilationClock()
    with event.install_listener(COMPILATION, clock):
        yield clock


class _Once(Listener):
    """Tells of the first compilation that begins."""

    def __init__(self, tell: Callable[[bool], None]) -> None:
        self.tell: Callable[[bool], None] | None = tell

    def on_start(self, event: Any) -> None:
        """A function begins to be compiled."""
        dispatcher = event.data["dispatcher"]
        of_ours = dispatcher.py_func.__module__.partition(".")[0] == PACKAGE
        if self.tell is not None and of_ours:
            tell, self.tell = self.tell, None
            tell(isinstance(dispatcher._cache, caching.FunctionCache))

    def on_end(self, event: Any) -> None:
        """It is compiled."""
