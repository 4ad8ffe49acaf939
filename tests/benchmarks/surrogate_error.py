"""Held-out error of the surrogates of ``bellows study sensitivity``, with and without gradients.

    python tests/benchmarks/surrogate_error.py ROWS.jsonl [DESIGN...]

For ``finger`` and Prototype 2, or the designs named: surrogates of values and gradients at a few
designs of the box of ± 10 % (``SAMPLES``), and of values alone at as many as cost the same,
judged at designs that none was fitted to: neighbours, and designs of the box beyond the reach of
neighbours, each evaluated by itself on a mesh of its own. Answers are appended to ROWS.jsonl as
they come; a second run goes on from there. Prints Markdown.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Iterable, Iterator
from dataclasses import asdict, replace
from itertools import product
from pathlib import Path

import numpy as np

from bellows_design.batch.answer import Answer
from bellows_design.batch.question import Question
from bellows_design.design.shipped import load_design
from bellows_design.design.variation import counted
from bellows_design.evaluation import evaluate
from bellows_design.neighbours.carried import REACH
from bellows_design.neighbours.distance import distance
from bellows_design.neighbours.sensitivities import RESPONSES, Sensitivities, sensitivities
from bellows_design.study.sensitivity.answers import Answers, in_this_process
from bellows_design.study.sensitivity.box import Box, Sample, sampled
from bellows_design.study.sensitivity.spread import box_around, data
from bellows_design.study.sensitivity.surrogate import HeldOut, Surrogate, error_at, fitted

DESIGNS = ("finger", "prototype_2")
PERCENT, SEED = 10.0, 1
SAMPLES, HELD_OUT, FAR = (16, 20, 32), 16, 8
"""With gradients, and to judge, near and far."""

COST = 1.8
"""Of a value with its derivatives, in values: of neighbours that take one factorization. Farther
away values cost more, and derivatives as much, so that this favours values."""


class Rows:
    """Answers by the key of their question, in a file of JSON lines."""

    def __init__(self, path: Path) -> None:
        self._path = path
        lines = path.read_text("utf-8").splitlines() if path.exists() else []
        rows = [Answer(**json.loads(line)) for line in lines]
        self._known = {row.key: row for row in rows}

    def through(self, answers: Answers) -> Answers:
        """Asks for what is not in the file, and adds it there."""

        def answered(questions: Iterable[Question]) -> Iterator[Answer]:
            for question in questions:
                if question.key not in self._known:
                    self._add(next(answers([question])))
                yield self._known[question.key]

        return answered

    def _add(self, answer: Answer) -> None:
        self._known[answer.key] = answer
        with self._path.open("a", encoding="utf-8") as file:
            file.write(json.dumps(asdict(answer)) + "\n")


def main(rows: str, *names: str) -> None:
    """Print a line for each design, response and kind of surrogate."""
    print(
        "| design | response | from | samples | terms | fifths held out, root mean square "
        "| near: R² | root mean square | largest | far: root mean square | largest |"
    )
    print("|---" * 11 + "|")
    for name in names or DESIGNS:
        for line in measured(name, Rows(Path(rows))):
            print(line, flush=True)


def measured(name: str, rows: Rows) -> Iterator[str]:
    """The lines of one design."""
    design = counted(load_design(name))
    base = evaluate(design, keep=True)
    found, answers = sensitivities(base), rows.through(in_this_process(base))
    box = box_around(found, PERCENT, base.model.name)
    held_out = sampled(box, HELD_OUT, SEED + 1)
    truth = gathered(held_out, answers, derivatives=False)
    far = beyond_reach(box)
    far_truth = tuple(answers(Question(design, "ordinary") for design in far.designs))
    for samples in SAMPLES:
        most = sampled(box, round(samples * COST), SEED)
        known = {each.digest: each for each in gathered(most, answers, derivatives=True)}
        few = sampled(box, samples, SEED)  # the first points of the same sequence
        for response, (sample, with_slopes) in product(RESPONSES, ((few, True), (most, False))):
            own = tuple(known[design.digest] for design in sample.designs)
            surrogate = surrogate_of(response, sample, own, found, with_slopes)
            near = judged(surrogate, response, held_out, truth)
            away = judged(surrogate, response, far, far_truth)
            yield line(name, response, with_slopes, len(own), surrogate, near, away)


def beyond_reach(box: Box) -> Sample:
    """Designs of a box that are too far from its middle for a neighbour."""
    points = np.random.default_rng(SEED).uniform(-1, 1, (20 * FAR, len(box.names)))
    designs = [box.at(point) for point in points]
    far = [
        (point, design)
        for point, design in zip(points, designs, strict=True)
        if design is not None and distance(box.design, design) > REACH
    ][:FAR]
    return Sample(box, np.array([point for point, _ in far]), tuple(d for _, d in far), 0, 0)


def gathered(sample: Sample, answers: Answers, derivatives: bool) -> tuple[Answer, ...]:
    """Answers to a sample, told about on stderr."""
    found = []
    start = sample.box.design
    for each in answers(Question(design, start, derivatives) for design in sample.designs):
        found.append(each)
        print(f"{len(found)} of {len(sample.designs)}", each.seconds, file=sys.stderr, flush=True)
    return tuple(found)


def surrogate_of(
    response: str,
    sample: Sample,
    answers: tuple[Answer, ...],
    found: Sensitivities,
    with_slopes: bool,
) -> Surrogate:
    """Fitted to values and gradients, or to values alone."""
    both = data(response, sample, answers, found)
    return fitted(both if with_slopes else replace(both, slopes=None))


def judged(
    surrogate: Surrogate, response: str, sample: Sample, truth: tuple[Answer, ...]
) -> HeldOut:
    """Its error at other designs."""
    done = [i for i, answer in enumerate(truth) if answer.done]
    values = np.array([getattr(truth[i], response) for i in done])
    return error_at(values, surrogate(sample.points[done]))


def line(
    name: str,
    response: str,
    with_slopes: bool,
    count: int,
    surrogate: Surrogate,
    near: HeldOut,
    away: HeldOut,
) -> str:
    """One of the table."""
    kind = "values and gradients" if with_slopes else "values"
    return (
        f"| {name} | {response} | {kind} | {count} | {len(surrogate.coefficients)} "
        f"| {surrogate.error.root_mean_square_percent:.2f} % "
        f"| {near.r_squared:.4f} | {near.root_mean_square_percent:.2f} % "
        f"| {near.largest_percent:.2f} % "
        f"| {away.root_mean_square_percent:.2f} % | {away.largest_percent:.2f} % |"
    )


if __name__ == "__main__":
    main(*sys.argv[1:])
