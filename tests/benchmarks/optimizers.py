"""Evaluations and time to the best finger: by Optuna, by egobox, and by exact gradients.

    python tests/benchmarks/optimizers.py FOLDER [DESIGNS] [METHOD ...]

Every method looks for the largest angle of ``finger`` within 4 MPa including 2 %, among the same
counts and lengths, with evaluations by themselves; ``gradients`` goes on from Optuna's first 16
with descents. Results are kept in FOLDER as they come, so that an interrupted run goes on; the
table is printed and written beside this file as JSON. Time is what the evaluations took together,
whoever worked on them.

egobox is no dependency: ``pip install egobox``.
"""

from __future__ import annotations

import json
import sys
import time
from collections.abc import Iterator
from functools import partial
from pathlib import Path

import numpy as np

from bellows_design.batch.cluster import Cluster
from bellows_design.batch.places import ThisMachine
from bellows_design.batch.results import opened
from bellows_design.batch.session import Session
from bellows_design.design.shipped import load_design
from bellows_design.study.optimize import stages
from bellows_design.study.optimize.coordinator import Coordinator
from bellows_design.study.optimize.goal import Goal
from bellows_design.study.optimize.point import Point
from bellows_design.study.optimize.run import study_of
from bellows_design.study.optimize.search.global_stage import COUNTS, Suggestion
from bellows_design.study.optimize.space.choices import Bounds, Choice
from bellows_design.study.optimize.stages import Effort, Optimization

FINGER = load_design("finger")
GOAL = Goal("angle", 4.0)
BOUNDS = Bounds(lines=(3, 4, 5))
FIRST = 16
"""Designs of the global stage before the descents."""

WORKERS = 1
"""Processes: times are those of evaluations, whoever works on them."""

IMPOSSIBLE = 1e3
"""In the place of the merit of a design that does not exist, or failed."""

MARKS = (10, 20, 40, 60, 100, 150, 200, 300)
"""Evaluations after which the best is noted."""


class EgoboxStage:
    """Efficient global optimization with egobox, under the interface of the product's stage.

    Counts are integers, lengths shares of their ranges; a merit is modelled, as for Optuna.
    """

    DESIGNS = 24
    """Of the Latin hypercube it begins with."""

    def __init__(self, choices, variables_of, seed: int) -> None:
        import egobox as egx

        self._choices = {choice: variables_of(choice) for choice in choices}
        self._levels = {n: sorted({getattr(c, n) for c in choices}) for n in COUNTS}
        specs = [egx.XSpec(egx.XType.INT, [0, len(v) - 1]) for v in self._levels.values()]
        specs += [egx.XSpec(egx.XType.FLOAT, [0.0, 1.0])] * 8
        self._specs, self._seed = specs, seed
        self._x: list[np.ndarray] = []
        self._y: list[float] = []
        self._doe = list(egx.lhs(specs, 40 * self.DESIGNS, seed=seed))

    def suggestions(self, number: int) -> list[Suggestion]:
        found: list[Suggestion] = []
        for _ in range(50 * number):
            if len(found) == number:
                break
            x = self._next()
            suggestion = self._suggestion(x)
            if suggestion is None:
                self._learn(x, IMPOSSIBLE)
            else:
                found.append(suggestion)
        return found

    def tell(self, suggestion: Suggestion, merit: float | None) -> None:
        self._learn(suggestion.trial, IMPOSSIBLE if merit is None else merit)

    def _next(self) -> np.ndarray:
        import egobox as egx

        if sum(y < IMPOSSIBLE for y in self._y) < self.DESIGNS and self._doe:
            return np.asarray(self._doe.pop())
        good = [k for k, y in enumerate(self._y) if y < IMPOSSIBLE]
        x, y = np.array(self._x)[good], np.array(self._y)[good][:, None]
        optimizer = egx.Egor(self._specs, seed=self._seed + len(self._y))
        return np.asarray(optimizer.suggest(x, y))[0]

    def _learn(self, x: np.ndarray, merit: float) -> None:
        self._x.append(x)
        self._y.append(merit)

    def _suggestion(self, x: np.ndarray) -> Suggestion | None:
        levels = zip(self._levels.items(), x, strict=False)
        counts = {name: values[round(float(place))] for (name, values), place in levels}
        variables = self._choices.get(Choice(**counts))
        if variables is None:
            return None
        shares = x[len(COUNTS) : len(COUNTS) + len(variables.names)]
        values = variables.lower + shares * (variables.upper - variables.lower)
        values = variables.rounded(variables.within_room(values))
        return None if variables.exists(values) else Suggestion(variables, values, x)


def optimization(method: str, designs: int) -> Optimization:
    if method == "gradients":
        effort = Effort(global_designs=FIRST)
    else:
        effort = Effort(global_designs=designs, gradients=False)
    return Optimization(FINGER, GOAL, BOUNDS, effort)


def best_so_far(points: list[Point]) -> Iterator[dict]:
    """The best design that keeps the limits, after so many evaluations."""
    seconds, best = 0.0, None
    for number, point in enumerate(points, start=1):
        seconds += point.answer.seconds
        if point.ordinary and GOAL.kept(point.values):
            best = max(best or 0.0, point.values["angle"])
        if number in MARKS or number == len(points):
            yield {
                "evaluations": number,
                "evaluation_seconds": round(seconds, 1),
                "best_angle_deg": best,
            }


def measured(method: str, folder: Path, designs: int, minutes: float) -> list[dict]:
    sought = optimization(method, designs)
    stages.GlobalStage = EgoboxStage if method == "egobox" else _OPTUNA
    began = time.monotonic()
    with opened(folder / f"{method}.sqlite", study_of(sought)) as results:
        machine = ThisMachine.of(WORKERS)
        workers = Cluster(partial(Session, budget=machine.budget), machine)
        try:
            at = Coordinator(GOAL, results, workers, began + 60 * minutes, lambda _: None)
            sought.search(at)
        finally:
            workers.close()
    return [{"method": method, **row} for row in best_so_far(at.points)]


_OPTUNA = stages.GlobalStage


def main() -> None:
    folder, *rest = sys.argv[1:]
    designs = int(rest[0]) if rest else 60
    methods = rest[1:] or ["optuna", "egobox", "gradients"]
    Path(folder).mkdir(exist_ok=True)
    place = Path(__file__).with_suffix(".json")
    rows = json.loads(place.read_text()) if place.exists() else []
    for method in methods:
        found = measured(method, Path(folder), designs, minutes=20)
        rows = [row for row in rows if row["method"] != method] + found
        place.write_text(json.dumps(rows, indent=1) + "\n")
        for row in found:
            print(row)


if __name__ == "__main__":
    main()
