"""An optimization from its options to its optimum: searched, verified, corrected."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from contextlib import closing
from dataclasses import dataclass, replace
from typing import Any

from bellows_design.batch.executor import Executor
from bellows_design.batch.results import Results, Study
from bellows_design.budget import DEFAULT, Budget
from bellows_design.errors import BellowsError
from bellows_design.progress import SILENCE, Progress
from bellows_design.study.optimize.coordinator import Coordinator
from bellows_design.study.optimize.front import front
from bellows_design.study.optimize.point import Point
from bellows_design.study.optimize.space.passage import filling_seconds
from bellows_design.study.optimize.stages import Optimization
from bellows_design.study.optimize.verification import (
    Verification,
    blocked,
    exerted_at_least,
    verified,
)
from solver.errors import MeshingError, SolverError

VERIFYING = 0.2
"""Fraction of the time that is kept for the verification of the best."""

MOST_CORRECTIONS = 2
"""So often a best design that does not hold is sought again, within a lower limit."""

MOST_STRENGTHS = 8
"""Designs whose blocked force is looked at where the best is too weak."""

PAUSE = 2.0
"""s. Least time between two lines of progress."""


@dataclass(frozen=True)
class Optimum:
    """What an optimization found.

    Attributes:
        optimization: What was asked.
        best: The best design that keeps all limits; None if none was found.
        front: Designs that no other one beats in angle and stress together, by rising stress.
        points: Every design that the search asked for, evaluated in this run or one before.
        verification: Of the best; None without one.
        failure: Why the best could not be verified; empty if it was, or was not to be.
        asked, known, failed: Designs evaluated now, known from before, and without a result.
        seconds: Of this run.
        evaluation_seconds: Of all evaluations of this run together, on all workers.
        in_time: Whether all stages came to their ends.
    """

    optimization: Optimization
    best: Point | None
    front: tuple[Point, ...]
    points: tuple[Point, ...]
    verification: Verification | None
    failure: str
    asked: int
    known: int
    failed: int
    seconds: float
    evaluation_seconds: float
    in_time: bool

    @property
    def holds(self) -> bool:
        """Whether nothing speaks against the best; true of one that was not to be verified."""
        verified = self.verification is None or self.verification.holds
        return self.best is not None and verified and not self.failure

    @property
    def filling_seconds(self) -> float | None:
        """Time that air takes to fill the best design; None without one, and of a vacuum."""
        best = self.best
        if best is None or best.design.load.pressure <= 0:
            return None
        return filling_seconds(best.design, best.values["volume"])


def study_of(optimization: Optimization) -> Study:
    """What a results file of it belongs to."""
    goal, bounds, effort = optimization.goal, optimization.bounds, optimization.effort
    return Study(
        "optimum",
        optimization.base,
        {
            "quantity": goal.quantity,
            "most_stress_mpa": goal.most_stress_mpa,
            "least_angle_deg": goal.least_angle_deg,
            "most_strain": goal.most_strain,
            "least_gap_mm": goal.least_gap_mm,
            **{name: _plain(value) for name, value in vars(bounds).items()},
            "seed": effort.seed,
        },
    )


def optimize(
    optimization: Optimization,
    results: Results,
    executor: Callable[[], Executor],
    minutes: float,
    verify: bool = True,
    half: bool = True,
    progress: Progress = SILENCE,
    budget: Budget = DEFAULT,
) -> Optimum:
    """Search, verify the best, and search again within a lower limit if it does not hold.

    Args:
        optimization: What is sought, and where.
        results: Of its study; every answer is there before the next one is waited for.
        executor: Makes who evaluates.
        minutes: Time for all of it; what is being evaluated then is waited for.
        verify: Verify the best on finer meshes.
        half: Also by the half actuator.
        progress: Is told how far it is, and the best so far.
        budget: Of each evaluation of the verification.

    Raises:
        ClusterError: Nobody evaluates any more.
        CannotWrite: The results cannot be written.
    """
    began = time.monotonic()
    searching = 60 * minutes * (1 - VERIFYING if verify else 1)
    report = _Report(progress, began, minutes)
    progress.stage("starting workers")
    with closing(executor()) as at_work:
        coordinator = Coordinator(
            optimization.goal, results, at_work, began + searching, report.told
        )
        optimization.search(coordinator)
        in_time = not coordinator.late
        best, verification, failure = coordinator.best(), None, ""
        if verify and best is not None:
            coordinator.deadline = began + 60 * minutes
            try:
                best, verification = _verified(
                    optimization, coordinator, best, half, progress, budget
                )
            except (BellowsError, MeshingError, SolverError) as error:
                failure = str(error)
    return Optimum(
        optimization,
        best,
        front(coordinator.points, optimization.goal),
        tuple(coordinator.points),
        verification,
        failure,
        coordinator.asked,
        coordinator.known,
        coordinator.failed,
        time.monotonic() - began,
        coordinator.working_seconds,
        in_time,
    )


def _verified(
    optimization: Optimization,
    coordinator: Coordinator,
    best: Point,
    half: bool,
    progress: Progress,
    budget: Budget,
) -> tuple[Point, Verification]:
    """The best and what its verification says; sought again within a lower limit if it fails."""
    sought, limit = optimization.goal, optimization.goal.most_stress_mpa
    found = verified(best.design, sought, half, progress, budget)
    goal = sought
    for _ in range(MOST_CORRECTIONS):
        excess = found.stress_with_error_mpa / limit
        if not 1 < excess < math.inf or coordinator.late:
            break
        goal = replace(goal, most_stress_mpa=goal.most_stress_mpa / excess)
        before = len(coordinator.points)
        coordinator.lead([optimization.fine_descent(best, goal).search()])
        kept = [p for p in coordinator.points[before:] if p.ordinary and goal.kept(p.values)]
        if not kept:
            break
        best = min(kept, key=lambda point: goal.merit(point.values))
        found = verified(best.design, sought, half, progress, budget)
    if found.strong:
        return best, found
    stronger = strong_point(coordinator, best, progress, budget)
    if stronger is None:
        return best, found
    return stronger, verified(stronger.design, sought, half, progress, budget)


def strong_point(
    coordinator: Coordinator, weak: Point, progress: Progress, budget: Budget
) -> Point | None:
    """The best of the other points that keeps the limits and exerts the force asked for.

    The best point of each combination of counts is tried, in the order of their merits, as long as
    there is time; None if none is strong enough.
    """
    goal, tried = coordinator.goal, {weak.choice}
    kept = (
        each for each in coordinator.points if each.ordinary and goal.kept(each.values_with_error)
    )
    for point in sorted(kept, key=lambda each: goal.merit(each.values)):
        if coordinator.late or len(tried) > MOST_STRENGTHS:
            return None
        if point.choice in tried:
            continue
        tried.add(point.choice)
        force = blocked(point.design, progress, budget)
        if exerted_at_least(force) >= (goal.least_force_n or 0.0):
            return point
    return None


@dataclass
class _Report:
    """Tells how far a search is: a counter that belongs to one run."""

    progress: Progress
    began: float
    minutes: float
    _told: float = 0.0

    def told(self, at: Coordinator) -> None:
        """After every answer; says something now and then."""
        now = time.monotonic()
        if now - self._told < PAUSE:
            return
        self._told = now
        spent = (now - self.began) / 60
        known = f", {at.known} known before" if at.known else ""
        self.progress.stage(
            f"{at.asked} designs evaluated{known}, {spent:.1f} of {self.minutes:g} min; "
            f"{_best_text(at)}"
        )


def _best_text(at: Coordinator) -> str:
    best = at.best()
    if best is None:
        return "none keeps the limits so far"
    values = best.values
    return f"best {values['angle']:.0f}° at {values['stress']:.2f} MPa, {best.choice.text}"


def _plain(value: Any) -> Any:
    return list(value) if isinstance(value, tuple) else value
