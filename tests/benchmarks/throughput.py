"""Designs per minute of a sweep, with and without neighbours, and how far the results differ.

    python tests/benchmarks/throughput.py FOLDER [number [space ...]]

The same designs around ``finger`` by workers of this machine: one and two of them, each design from
a neighbour or by itself. Every case is a results file in FOLDER, which goes on where it was ended;
only whole runs count for the speed. Then the coordinator alone: questions that are answered at
once. Prints Markdown, writes throughput.json beside this script.
"""

from __future__ import annotations

import json
import pickle
import sys
import time
from collections.abc import Iterator, Sequence
from contextlib import closing
from dataclasses import asdict, dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

HERE = Path(__file__).parent
sys.path.append(str(HERE.parent / "support"))

from answering_stub import Stub  # noqa: E402

from bellows_design.batch.answer import Answer  # noqa: E402
from bellows_design.batch.cluster import Cluster  # noqa: E402
from bellows_design.batch.dealing import answers  # noqa: E402
from bellows_design.batch.places import ThisMachine  # noqa: E402
from bellows_design.batch.results import opened, reading  # noqa: E402
from bellows_design.batch.session import Session  # noqa: E402
from bellows_design.design.shipped import load_design  # noqa: E402
from bellows_design.files.json_files import write_json  # noqa: E402
from bellows_design.machine import machine  # noqa: E402
from bellows_design.progress import on_stderr  # noqa: E402
from bellows_design.study.sweep.plan import Plan, Questions, Space, planned  # noqa: E402
from bellows_design.study.sweep.run import run  # noqa: E402
from bellows_design.study.sweep.sampling import Sampling  # noqa: E402
from bellows_design.study.sweep.space import axes  # noqa: E402

RESULT = HERE / "throughput.json"
SPACES = {
    "near": (
        "bubble_width=18.5:20", "bubble_height=18.5:20", "tendon_width=5.4:6.6",
        "tendon_thickness=1.4:1.8", "bubble_distance=1.1:1.3",
    ),
    "wide": (
        "bubble_width=18:20", "tendon_width=5:7", "tendon_height=5:7", "chamber_length=1.6:2.4",
        "bubble_distance=1:1.4", "indent.depth=0.3:0.5",
    ),
}  # fmt: skip
"""Ranges by about 8 % and 20 % around the design: one ordinary evaluation reaches nearly all of the
first; the second has several numbers of bubbles and topologies."""

CASES = (("nearest", 2), ("ordinary", 2), ("nearest", 1), ("ordinary", 1))
"""What evaluations start from, and workers."""

QUESTIONS = 1000
"""That the coordinator is measured with."""


@dataclass(frozen=True)
class Case:
    """One sweep: speed of its whole runs, and of its evaluations."""

    space: str
    start: str
    workers: int
    designs: int
    failed: int
    from_neighbours: int
    per_minute: float | None
    seconds_each: float
    file_bytes: int


@dataclass(frozen=True)
class Difference:
    """Of one design from a neighbour and by itself; % of the latter, and over its own estimate."""

    space: str
    workers: int
    distance: float
    angle_percent: float
    angle_estimate_percent: float
    stress_percent: float
    stress_estimate_percent: float


def plan_of(space: str, start: str, number: int) -> Plan:
    """A Latin hypercube around ``finger``."""
    base = load_design("finger")
    ranges = axes(SPACES[space], base)
    return planned(
        Space(base, ranges, Sampling.LATIN_HYPERCUBE, number, seed=15, start=start)  # type: ignore[arg-type]
    )


def measured(folder: Path, space: str, start: str, workers: int, number: int) -> Case:
    """Run a sweep to its end; its speed is kept beside it if it was not begun before."""
    file = folder / f"{space}-{start}-{workers}.sqlite"
    speed, begun = file.with_suffix(".json"), file.exists()
    plan, place = plan_of(space, start, number), ThisMachine(workers)
    executor = partial(Cluster, partial(Session, budget=place.budget), place)
    with on_stderr() as progress, opened(file, plan.study) as results:
        outcome = run(plan, results, executor, progress=progress)
        rows = list(results.rows())
    if not begun:
        write_json({"per_minute": outcome.per_minute}, speed)
    done = [row.answer for row in rows if row.answer.done]
    return Case(
        space,
        start,
        workers,
        len(rows),
        len(rows) - len(done),
        sum(each.origin == "neighbour" for each in done),
        json.loads(speed.read_text())["per_minute"] if speed.exists() else None,
        float(np.mean([each.seconds for each in done])),
        file.stat().st_size,
    )


def differences(folder: Path, space: str, workers: int) -> Iterator[Difference]:
    """Of each design from a neighbour against the same by itself."""
    by_itself = done_of(folder / f"{space}-ordinary-2.sqlite")
    for digest, found in done_of(folder / f"{space}-nearest-{workers}.sqlite").items():
        other = by_itself.get(digest)
        if other is not None and found.origin == "neighbour":
            yield Difference(
                space,
                workers,
                found.distance,
                off(found.bending_angle_deg, other.bending_angle_deg),
                found.bending_angle_error_percent or 0.0,
                off(found.max_von_mises_mpa, other.max_von_mises_mpa),
                found.max_von_mises_error_percent or 0.0,
            )


def done_of(file: Path) -> dict[str, Answer]:
    """Digest -> answer with a result."""
    with reading(file) as results:
        return {row.answer.digest: row.answer for row in results.rows() if row.answer.done}


def off(one: float | None, other: float | None) -> float:
    """Of one number against another, %."""
    assert one is not None and other is not None
    return 100 * abs(one / other - 1)


def coordinator(folder: Path) -> dict[str, Any]:
    """What a question costs besides its evaluation: seconds of the coordinator, bytes."""
    plan = plan_of("near", "ordinary", QUESTIONS)
    questions, made = Questions(plan, range(len(plan.keys))), time.perf_counter()
    for place in range(len(questions)):
        _ = questions[place].key
    made = (time.perf_counter() - made) / len(questions)
    file = folder / "coordinator.sqlite"
    file.unlink(missing_ok=True)
    found = {}
    with opened(file, plan.study) as results, closing(Cluster(Stub, ThisMachine(2))) as cluster:
        writing, wall, processor = 0.0, time.perf_counter(), time.process_time()
        for came in answers(questions, cluster):
            began = time.perf_counter()
            results.keep(*(plan.row(place, questions[place], answer) for place, answer in came))
            writing += time.perf_counter() - began
        wall, processor = time.perf_counter() - wall, time.process_time() - processor
        found = {
            "questions": len(questions),
            "milliseconds_of_processor": 1000 * processor / len(questions),
            "milliseconds_of_making": 1000 * made,
            "milliseconds_of_writing": 1000 * writing / len(questions),
            "per_second": len(questions) / wall,
            "question_bytes": len(pickle.dumps(questions[0])),
        }
    return {**found, "row_bytes": file.stat().st_size / len(questions)}


def write(cases: Sequence[Case], found: Sequence[Difference], costs: dict[str, Any]) -> None:
    """All that is measured so far."""
    content = {
        "machine": machine().to_dict(),
        "cases": [asdict(case) for case in cases],
        "differences": [asdict(each) for each in found],
        "coordinator": costs,
    }
    write_json(content, RESULT)


def table(cases: Sequence[Case], found: Sequence[Difference], costs: dict[str, Any]) -> str:
    """Markdown."""
    lines = [
        "| space | start | workers | designs | failed | from neighbours | a minute | s each | "
        "ratio |",
        "|---|---|---|---|---|---|---|---|---|",
    ]
    plain = {(c.space, c.workers): c.per_minute for c in cases if c.start == "ordinary"}
    for case in cases:
        base = plain.get((case.space, case.workers))
        ratio = f"{case.per_minute / base:.2f}" if case.per_minute and base else ""
        rate = "" if case.per_minute is None else f"{case.per_minute:.1f}"
        lines.append(
            f"| {case.space} | {case.start} | {case.workers} | {case.designs} | {case.failed} | "
            f"{case.from_neighbours} | {rate} | {case.seconds_each:.2f} | {ratio} |"
        )
    lines += [
        "",
        "| space | workers | designs | angle off, median / 90 % / most | at most 1 % | over its "
        "estimate, most | stress off | over its estimate, most |",
        "|---|---|---|---|---|---|---|---|",
    ]
    for space, workers in dict.fromkeys((each.space, each.workers) for each in found):
        lines.append(row([e for e in found if (e.space, e.workers) == (space, workers)]))
    return "\n".join([*lines, "", *(f"- {name}: {value:.4g}" for name, value in costs.items())])


def row(some: Sequence[Difference]) -> str:
    """Of the differences of one sweep."""
    angles = np.array([each.angle_percent for each in some])
    stresses = np.array([each.stress_percent for each in some])
    angle_share = max(each.angle_percent / each.angle_estimate_percent for each in some)
    stress_share = max(each.stress_percent / each.stress_estimate_percent for each in some)
    return (
        f"| {some[0].space} | {some[0].workers} | {len(some)} | {spread(angles)} | "
        f"{100 * np.mean(angles <= 1):.0f} % | {angle_share:.2f} | {spread(stresses)} | "
        f"{stress_share:.2f} |"
    )


def spread(values: np.ndarray) -> str:
    """Median, 90 % and most."""
    parts = (np.median(values), np.quantile(values, 0.9), values.max())
    return " / ".join(f"{part:.2f}" for part in parts) + " %"


def main(folder: str, number: str = "120", *spaces: str) -> None:
    """Measure all cases; what is there already is not measured again."""
    place = Path(folder)
    place.mkdir(parents=True, exist_ok=True)
    cases: list[Case] = []
    found: list[Difference] = []
    for space in spaces or tuple(SPACES):
        for start, workers in CASES:
            cases.append(measured(place, space, start, workers, int(number)))
            write(cases, found, {})
        found += [each for workers in (1, 2) for each in differences(place, space, workers)]
        write(cases, found, {})
    costs = coordinator(place)
    write(cases, found, costs)
    print(table(cases, found, costs))


if __name__ == "__main__":
    main(*sys.argv[1:])
