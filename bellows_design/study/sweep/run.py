"""A sweep at work: what is not answered yet is asked, and each answer is kept as it comes."""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Callable
from contextlib import closing
from dataclasses import asdict, dataclass
from typing import Any

from bellows_design.batch.dealing import answers
from bellows_design.batch.executor import Executor
from bellows_design.batch.results import Results
from bellows_design.progress import SILENCE, Progress
from bellows_design.study.sweep.pace import Pace
from bellows_design.study.sweep.plan import Plan, Questions
from bellows_design.versions import versions


@dataclass(frozen=True)
class Outcome:
    """What a sweep has after a run.

    Attributes:
        designs: Points that were looked at; the same design counts once.
        done, failed, impossible: Of them, with a result, without one, and no designs at all.
        asked: Of them in this run.
        seconds: Of this run, from the first question to the last answer.
        workers: That answered at last; 0 if nothing was to be asked.
    """

    designs: int
    done: int
    failed: int
    impossible: int
    asked: int
    seconds: float
    workers: int

    @property
    def per_minute(self) -> float | None:
        """Designs that were answered in a minute of this run."""
        return 60 * self.asked / self.seconds if self.asked and self.seconds else None

    def to_dict(self) -> dict[str, Any]:
        """Plain values for JSON; docs/json.md says what they mean."""
        return {**asdict(self), "per_minute": self.per_minute}


def run(
    plan: Plan,
    results: Results,
    executor: Callable[[], Executor],
    retry_failed: bool = False,
    progress: Progress = SILENCE,
) -> Outcome:
    """Answer what ``results`` do not have yet.

    Args:
        plan: What is asked, and in which order.
        results: Of the plan's study; every answer is there before the next one is waited for.
        executor: Makes who works on it; not called where nothing is left to ask.
        retry_failed: Ask again what failed, but for what is no design.
        progress: Is told how far it is.

    Raises:
        ClusterError: Nobody works any more.
        CannotWrite: The file cannot be written.
    """
    results.keep(*plan.impossible_rows())
    before = results.statuses()
    asked_again = {"failed"} if retry_failed else set()
    left = [
        position
        for position, key in enumerate(plan.keys)
        if before.get(key) is None or before[key] in asked_again
    ]
    _tell_of_versions(results, progress)
    workers, seconds = _ask(plan, results, executor, left, progress) if left else (0, 0.0)
    return _outcome(plan, results, len(left), seconds, workers)


def _ask(
    plan: Plan,
    results: Results,
    executor: Callable[[], Executor],
    left: list[int],
    progress: Progress,
) -> tuple[int, float]:
    """Have the questions at those positions answered; how many worked at last, and seconds."""
    progress.stage("starting workers")
    questions = Questions(plan, left)
    with closing(executor()) as at_work:
        began = time.perf_counter()
        pace = Pace(progress, total=len(plan.keys), before=len(plan.keys) - len(left))
        for came in answers(questions, at_work):
            results.keep(*(plan.row(left[at], questions[at], answer) for at, answer in came))
            pace.count([answer for _, answer in came])
        return at_work.lanes, time.perf_counter() - began


def _outcome(plan: Plan, results: Results, asked: int, seconds: float, workers: int) -> Outcome:
    statuses = results.statuses()
    found = Counter(statuses[key] for key in plan.keys)
    impossible = len(plan.impossible)
    designs = len(plan.keys) + impossible
    return Outcome(designs, found["done"], found["failed"], impossible, asked, seconds, workers)


def _tell_of_versions(results: Results, progress: Progress) -> None:
    """Answers of two versions of this program stand in one file: worth knowing."""
    begun, now = (each["bellows-design"] for each in (results.versions, versions()))
    if begun != now:
        progress.note(f"this sweep was begun by version {begun} and goes on with {now}")
