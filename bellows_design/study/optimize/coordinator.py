"""Searches at work: what they ask is answered from the file, or by a worker and then kept.

Searches are generators, so that one thread leads all of them and writes the file. What a search
does follows from its answers alone: a run that is resumed goes the same way, without work, up to
where it was interrupted.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, wait
from dataclasses import dataclass, field

from bellows_design.batch.answer import Answer
from bellows_design.batch.executor import Executor
from bellows_design.batch.results import Results
from bellows_design.batch.schema import Row
from bellows_design.study.optimize.goal import Goal
from bellows_design.study.optimize.point import Point, Request
from bellows_design.study.optimize.search.descent import Search
from bellows_design.study.optimize.space.choices import Choice

Told = Callable[["Coordinator"], None]


@dataclass
class Coordinator:
    """Leads searches; a session that collects their points.

    Attributes:
        goal: What the points are about.
        results: Where answers are kept.
        executor: Who evaluates.
        deadline: Time (``time.monotonic``) after which nothing more is asked.
        told: Called after every answer.
        points: Every design that was evaluated, in order.
        asked, known, failed: Questions answered now, before, and without a result.
    """

    goal: Goal
    results: Results
    executor: Executor
    deadline: float
    told: Told
    points: list[Point] = field(default_factory=list)
    asked: int = 0
    known: int = 0
    failed: int = 0
    working_seconds: float = 0.0

    @property
    def late(self) -> bool:
        """Whether the time is over."""
        return time.monotonic() > self.deadline

    def best(self) -> Point | None:
        """The best point evaluated by itself that keeps the limits with its own error."""
        found = [p for p in self.points if p.ordinary and self.goal.kept(p.values_with_error)]
        return min(found, key=self._merit, default=None)

    def most_promising(self, number: int) -> list[Point]:
        """The best points evaluated by themselves of so many different choices."""
        found: dict[Choice, Point] = {}
        for point in sorted((p for p in self.points if p.ordinary), key=self._merit):
            found.setdefault(point.choice, point)
        return list(found.values())[:number]

    def _merit(self, point: Point) -> float:
        return self.goal.merit(point.values)

    def lead(self, searches: Iterable[Search]) -> None:
        """Lead all searches to their ends, or until the time is over."""
        waiting, free = list(searches), list(range(self.executor.lanes))
        at_work: dict[Future[Answer], tuple[Search, Request, int]] = {}
        while (waiting and not self.late) or at_work:
            while waiting and free and not self.late:
                self._go_on(waiting.pop(0), None, free.pop(0), at_work, free)
            if at_work:
                done, _ = wait(at_work, return_when=FIRST_COMPLETED)
                # What is answered is kept before an error of another one ends all.
                for future in sorted(done, key=lambda each: each.exception() is not None):
                    search, request, lane = at_work.pop(future)
                    point = self._kept(request, future.result())
                    self._go_on(search, point, lane, at_work, free, begun=True)

    def evaluated(self, requests: Sequence[Request]) -> list[Point | None]:
        """The points of several designs, None for those that failed or for which time was over."""
        found: list[Point | None] = [None] * len(requests)

        def one(place: int, request: Request) -> Search:
            found[place] = yield request

        self.lead(one(place, request) for place, request in enumerate(requests))
        return found

    def _go_on(
        self,
        search: Search,
        point: Point | None,
        lane: int,
        at_work: dict[Future[Answer], tuple[Search, Request, int]],
        free: list[int],
        begun: bool = False,
    ) -> None:
        """Send a search its point, and ask what it wants next, as long as that is not known."""
        while not self.late:
            try:
                request = search.send(point) if begun else next(search)
            except StopIteration:
                break
            begun = True
            row = self.results.row(request.question.key)
            if row is None:
                at_work[self.executor.submit(request.question, lane)] = (search, request, lane)
                return
            self.known += 1
            point = self._counted(request, row.answer)
        search.close()
        free.append(lane)

    def _kept(self, request: Request, answer: Answer) -> Point | None:
        """The point of a new answer, once it is written."""
        varied = dict(zip(request.variables.names, map(float, request.values), strict=True))
        row = Row(answer, request.question.design, varied, len(self.points) + self.failed)
        self.results.keep(row)
        self.asked += 1
        self.working_seconds += answer.seconds
        return self._counted(request, answer)

    def _counted(self, request: Request, answer: Answer) -> Point | None:
        point = request.point(answer, self.goal)
        if point is None:
            self.failed += 1
        else:
            self.points.append(point)
        self.told(self)
        return point
