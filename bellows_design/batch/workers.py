"""What happens in the worker processes of a cluster. Needs the extra ``studies``.

A worker keeps what answers questions, a ``Session`` as a rule, between one question and the next:
as a plugin of dask's worker, which also those get that start later.
"""

from __future__ import annotations

from collections.abc import Callable
from threading import Lock
from typing import Any, Protocol
from uuid import uuid4

from distributed import get_worker
from distributed.diagnostics.plugin import WorkerPlugin

from bellows_design.batch.answer import Answer
from bellows_design.batch.question import Question

ENVIRONMENT = {
    name: "1"
    for name in ("OMP_NUM_THREADS", "MKL_NUM_THREADS", "OPENBLAS_NUM_THREADS", "NUMBA_NUM_THREADS")
}
"""Of a worker, before it loads anything: as many workers as processors, each with one thread."""


class Answerer(Protocol):
    """What answers questions in a worker, one after the other."""

    def answer(self, question: Question) -> Answer:
        """The answer; a design that cannot be evaluated is an answer too."""


class Answering(WorkerPlugin):
    """Makes an answerer with a worker's first question and keeps it.

    It goes to the workers by pickle, and so does ``make``.
    """

    def __init__(self, make: Callable[[], Answerer]) -> None:
        self.name = f"bellows-{uuid4().hex}"
        self._make = make

    def setup(self, worker: Any) -> None:
        """In the worker; what a study before left in its memory goes, as nobody may have ended it.

        A study that is still at work makes itself another with its next question.
        """
        self._lock = Lock()
        self._answerer: Answerer | None = None
        for other in worker.plugins.values():
            if isinstance(other, Answering) and other is not self:
                other._answerer = None

    def answer(self, question: Question) -> Answer:
        """In the worker, by one of its threads at once."""
        with self._lock:
            answerer = self._answerer  # another study's setup may put None there at any moment
            if answerer is None:
                answerer = self._answerer = self._make()
            return answerer.answer(question)


def answer(question: Question, plugin: str) -> Answer:
    """The task that a question is: answered by the plugin of that name."""
    plugins: dict[str, Any] = get_worker().plugins
    found: Answer = plugins[plugin].answer(question)
    return found


def installed_version() -> str:
    """Of this program, in the worker."""
    from bellows_design import __version__

    return __version__
