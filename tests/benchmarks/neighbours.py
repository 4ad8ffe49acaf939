"""Evaluations that start from a neighbour, against ordinary ones of another checkout.

    python tests/benchmarks/neighbours.py OTHER_CHECKOUT [count [results.json]]

Neighbours of Prototype 1, Prototype 2 and ``finger``: one geometric parameter by ±5 %, or four at
once by up to ±5 % at random. Two long-lived processes take turns: one on this checkout answers from
the neighbourhood of the base design, one on the other checkout evaluates the design by itself.
Then a random walk of as many steps, each of which changes every parameter by up to 2 %, through a
pool. Prints Markdown, writes JSON.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from statistics import median
from typing import Any

import numpy as np
from first_answer import environment

HERE = Path(__file__).parent
ROOT = HERE.parents[1]
SEED = 20261126
BASES = ("prototype_1", "prototype_2", "finger")
SHARE = 0.05
"""Largest change of a parameter."""

STEP = 0.02
"""The same in one step of the walk."""

ENDS = ("length", "offset")
"""Parameters that change the ends of an actuator of so many bubbles only."""

TOGETHER = 4
"""Parameters that change at once."""


@dataclass(frozen=True)
class Neighbour:
    """A design near to a base, and which parameters differ."""

    base: str
    changes: dict[str, float]
    table: dict[str, Any]


@dataclass(frozen=True)
class Row:
    """A neighbour from both sides; errors in percent, estimates of both."""

    base: str
    changes: dict[str, float]
    seconds: float
    other_seconds: float
    factorizations: int
    iterations: int
    steps: int
    distance: float
    fallback: str
    angle: float
    other_angle: float
    angle_estimates: tuple[float, float]
    stress: float
    other_stress: float
    stress_estimates: tuple[float, float]
    stable: bool | None

    @property
    def ratio(self) -> float:
        """Of the times."""
        return self.seconds / self.other_seconds

    @property
    def angle_error(self) -> float:
        """Percent of the other's."""
        return 100 * abs(self.angle - self.other_angle) / abs(self.other_angle)

    @property
    def stress_error(self) -> float:
        """Percent of the other's."""
        return 100 * abs(self.stress - self.other_stress) / self.other_stress


class Worker:
    """A process on the code of one checkout, which evaluates designs that come as JSON."""

    def __init__(self, checkout: Path, role: str) -> None:
        self._process = subprocess.Popen(
            [sys.executable, "-P", __file__, role],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            env=environment(checkout) | {"PYTHONPATH": f"{checkout}{os.pathsep}{HERE}"},
            cwd=checkout,
            encoding="utf-8",
        )

    def answer(self, neighbour: Neighbour) -> dict[str, Any]:
        """What it says about a design."""
        assert self._process.stdin is not None and self._process.stdout is not None
        self._process.stdin.write(json.dumps(asdict(neighbour)) + "\n")
        self._process.stdin.flush()
        line = self._process.stdout.readline()
        if not line:
            raise RuntimeError(f"the evaluating process ended: {self._process.wait()}")
        return dict(json.loads(line))

    def close(self) -> None:
        """End the process."""
        self._process.communicate()


def serve(role: str) -> None:
    """Answer designs from stdin: ``--ordinary`` by themselves, ``--near`` from their base."""
    from bellows_design.design.design import Design
    from bellows_design.design.shipped import load_design
    from bellows_design.evaluation import evaluate

    sessions: dict[str, Any] = {}
    if role == "--near":
        from bellows_design.evaluation import Neighbourhood

        sessions = {name: Neighbourhood(evaluate(load_design(name))) for name in BASES}
    for line in sys.stdin:
        asked = json.loads(line)
        design = Design.of(asked["table"])
        start = time.perf_counter()
        session = sessions.get(asked["base"])
        found = evaluate(design) if session is None else session.evaluate(design)
        seconds = time.perf_counter() - start
        print(json.dumps(numbers(found) | {"seconds": seconds}), flush=True)


def numbers(found: Any) -> dict[str, Any]:
    """What is compared."""
    estimates = found.error_estimate
    return {
        "angle": found.bending_angle_deg,
        "stress": found.max_von_mises_mpa,
        "estimates": [estimates.bending_angle_percent, estimates.max_von_mises_percent],
        "factorizations": found.solver.factorizations,
        "iterations": found.solver.newton_iterations,
        "stable": found.stable,
        "converged": found.converged,
        "steps": getattr(found, "steps", 0),
        "distance": getattr(found, "distance", 0.0),
        "fallback": getattr(found, "fallback", ""),
    }


def neighbours(count: int) -> Iterator[Neighbour]:
    """So many valid neighbours, base by base in turn."""
    from bellows_design.design.shipped import load_design
    from bellows_design.design.variation import geometric_parameters, varied
    from bellows_design.errors import BellowsError

    generator = np.random.default_rng(SEED)
    bases = [load_design(name) for name in BASES]
    number = found = 0
    while found < count:
        base = bases[number % len(bases)]
        values = {
            k: v for k, v in geometric_parameters(base).items() if k not in ("length", "offset")
        }
        changes = _changes(values, number // len(bases), generator)
        number += 1
        try:
            table = varied(base, {k: values[k] * (1 + c) for k, c in changes.items()})
        except BellowsError:
            continue
        found += 1
        yield Neighbour(base.name, changes, table.model_dump(mode="json"))


def _changes(
    values: dict[str, float], turn: int, generator: np.random.Generator
) -> dict[str, float]:
    """Relative changes: of one parameter in even turns, of several at once in odd ones."""
    names = [*values]
    if turn % 2:
        chosen = generator.choice(names, TOGETHER, replace=False)
        return {str(name): float(generator.uniform(-SHARE, SHARE)) for name in chosen}
    place = turn // 2
    return {names[place // 2 % len(names)]: SHARE if place % 2 else -SHARE}


def compared(checkout: Path, count: int) -> Iterator[Row]:
    """Neighbours on both checkouts in turn."""
    ours, theirs = Worker(ROOT, "--near"), Worker(checkout, "--ordinary")
    designs = list(neighbours(count))
    for first in designs[: len(BASES)]:  # compiles and warms up
        ours.answer(first), theirs.answer(first)
    for neighbour in designs:
        yield row(neighbour, ours.answer(neighbour), theirs.answer(neighbour))
    ours.close()
    theirs.close()


def row(neighbour: Neighbour, ours: dict[str, Any], theirs: dict[str, Any]) -> Row:
    """One neighbour from both answers."""
    angles, stresses = zip(ours["estimates"], theirs["estimates"], strict=True)
    return Row(
        base=neighbour.base,
        changes=neighbour.changes,
        seconds=ours["seconds"],
        other_seconds=theirs["seconds"],
        factorizations=ours["factorizations"],
        iterations=ours["iterations"],
        steps=ours["steps"],
        distance=ours["distance"],
        fallback=ours["fallback"],
        angle=ours["angle"],
        other_angle=theirs["angle"],
        angle_estimates=angles,
        stress=ours["stress"],
        other_stress=theirs["stress"],
        stress_estimates=stresses,
        stable=ours["stable"],
    )


def table(rows: Sequence[Row]) -> str:
    """One line for each base, and one for all, as Markdown."""
    lines = [
        "| base | neighbours | fell back | seconds | ordinary | ratio | factorizations "
        "| angle off, median | most | in estimates, most | stress off, median | most "
        "| in estimates, most |",
        "|---" * 13 + "|",
    ]
    for name in (*BASES, "all"):
        own = [each for each in rows if name in (each.base, "all")]
        if own:
            lines.append(_line(name, own))
    return "\n".join(lines)


def _line(name: str, rows: Sequence[Row]) -> str:
    angles, stresses = ([each.angle_error for each in rows], [each.stress_error for each in rows])
    angle_share = max(each.angle_error / sum(each.angle_estimates) for each in rows)
    stress_share = max(each.stress_error / sum(each.stress_estimates) for each in rows)
    return (
        f"| {name} | {len(rows)} | {sum(bool(each.fallback) for each in rows)} "
        f"| {median(each.seconds for each in rows):.2f} "
        f"| {median(each.other_seconds for each in rows):.2f} "
        f"| 1/{1 / median(each.ratio for each in rows):.1f} "
        f"| {median(each.factorizations for each in rows):.0f} "
        f"| {median(angles):.2f} % | {max(angles):.2f} % | {angle_share:.2f} "
        f"| {median(stresses):.2f} % | {max(stresses):.2f} % | {stress_share:.2f} |"
    )


def walk(count: int) -> dict[str, Any]:
    """A random walk from Prototype 1 through a pool: seconds for each design, and how it went."""
    from bellows_design.design.shipped import load_design
    from bellows_design.design.variation import geometric_parameters, varied
    from bellows_design.errors import BellowsError
    from bellows_design.evaluation import Pool

    generator, pool = np.random.default_rng(SEED), Pool()
    design = load_design("prototype_1")
    pool.evaluate(design)
    seconds, fallbacks, ratios = [], [], []
    while len(seconds) < count:
        values = geometric_parameters(design)
        changed = {k: v * (1 + generator.uniform(-STEP, STEP)) for k, v in values.items()}
        try:
            design = varied(design, changed)
        except BellowsError:
            continue
        start = time.perf_counter()
        found = pool.evaluate(design)
        seconds.append(time.perf_counter() - start)
        fallbacks.append(found.fallback)
        ratios.append(found.solver.factorizations)
    return {"seconds": seconds, "fallbacks": fallbacks, "factorizations": ratios}


def main(checkout: str, count: str = "200", results: str = "") -> None:
    """Print the tables, and write rows and walk as JSON."""
    rows = []
    for each in compared(Path(checkout).resolve(), int(count)):
        rows.append(each)
        print(f"{len(rows)}: {each.ratio:.3f} {each.fallback}", file=sys.stderr, flush=True)
    print(table(rows))
    walked = walk(int(count))
    ordinary = sum(bool(reason) for reason in walked["fallbacks"])
    print(
        f"\nA walk of {count} steps: {np.mean(walked['seconds']):.2f} s a design on average, "
        f"median {median(walked['seconds']):.2f} s; {ordinary} ordinary evaluations."
    )
    if results:
        record = {"neighbours": [asdict(each) for each in rows], "walk": walked}
        Path(results).write_text(json.dumps(record, indent=1) + "\n")


if __name__ == "__main__":
    if sys.argv[1:2] and sys.argv[1].startswith("--"):
        serve(sys.argv[1])
    else:
        main(*sys.argv[1:])
