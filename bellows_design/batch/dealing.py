"""Questions in an order, dealt to lanes so that what follows each other stays together."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from concurrent.futures import Future
from itertools import pairwise
from queue import SimpleQueue
from typing import TypeVar

from bellows_design.batch.answer import Answer
from bellows_design.batch.executor import Executor
from bellows_design.batch.question import Question

AHEAD = 2
"""Questions that a lane has at once: one at work, and one so that it never waits for the next."""


class Dealing:
    """Which question each lane is asked next: places in a sequence of so many.

    Each lane begins with an equal part of it; one that is done takes the second half of what the
    longest part still has.
    """

    def __init__(self, number: int, lanes: int) -> None:
        bounds = [number * lane // lanes for lane in range(lanes + 1)]
        self._rests = [range(*pair) for pair in pairwise(bounds)]

    def next(self, lane: int) -> int | None:
        """The place of the lane's next question; None if none is left. Lanes may be new."""
        while lane >= len(self._rests):
            self._rests.append(range(0))
        if not self._rests[lane]:
            longest = max(range(len(self._rests)), key=lambda each: len(self._rests[each]))
            rest = self._rests[longest]
            middle = len(rest) // 2
            self._rests[longest], self._rests[lane] = rest[:middle], rest[middle:]
        rest, self._rests[lane] = self._rests[lane], self._rests[lane][1:]
        return rest[0] if rest else None


Came = list[tuple[int, Answer]]
"""Places of questions, and their answers, that came since the last time."""


def answers(questions: Sequence[Question], executor: Executor) -> Iterator[Came]:
    """Answers as they come, each with the place of its question; all lanes work meanwhile.

    Where many come at once they come together, so that the caller can keep them together.

    Raises ``ClusterError`` where nobody works any more, after all that was answered before.
    """
    dealing = Dealing(len(questions), max(1, executor.lanes))
    ended: SimpleQueue[tuple[int, int, Future[Answer]]] = SimpleQueue()

    def ask(lane: int) -> int:
        place = dealing.next(lane)
        if place is None:
            return 0
        future = executor.submit(questions[place], lane)
        future.add_done_callback(lambda done: ended.put((lane, place, done)))
        return 1

    lanes = executor.lanes
    asked = sum(ask(lane) for _ in range(AHEAD) for lane in range(lanes))
    while asked:
        found = _all_of(ended)
        new = range(lanes, executor.lanes)
        lanes += len(new)
        asked -= len(found)
        asked += sum(ask(lane) for lane, _, _ in found)
        asked += sum(ask(lane) for _ in range(AHEAD) for lane in new)
        faults = [future.exception() for _, _, future in found]
        if good := [each for each, fault in zip(found, faults, strict=True) if fault is None]:
            yield [(place, future.result()) for _, place, future in good]
        for fault in filter(None, faults):
            raise fault


Item = TypeVar("Item")


def _all_of(queue: SimpleQueue[Item]) -> list[Item]:
    """All that a queue holds; waits for the first."""
    found = [queue.get()]
    while not queue.empty():
        found.append(queue.get())
    return found
